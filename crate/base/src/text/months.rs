//! Names of months.

use super::language::Language;

/// Month names [English, German, Portuguese].
pub const MONTHS: [[&str; 3]; 12] = [
    ["January", "Januar", "janeiro"],
    ["February", "Februar", "fevereiro"],
    ["March", "März", "março"],
    ["April", "April", "abril"],
    ["May", "Mai", "maio"],
    ["June", "Juni", "junho"],
    ["July", "Juli", "julho"],
    ["August", "August", "agosto"],
    ["September", "September", "setembro"],
    ["October", "Oktober", "outubro"],
    ["November", "November", "novembro"],
    ["December", "Dezember", "dezembro"],
];

/// Whether `word` names a month; only with its capital in English and German, where "may"
/// and "März" differ from other words by it.
#[must_use]
pub fn is_month(word: &str, language: Language) -> bool {
    MONTHS.iter().any(|row| match language {
        Language::Portuguese => row[language as usize] == word.to_lowercase(),
        _ => row[language as usize] == word,
    })
}
