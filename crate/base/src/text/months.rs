//! Names of months.

use super::language::Language;

/// Names of the months, January to December, as `[English, German, Portuguese]`.
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

/// Returns true if `word` names a month; only capitalised in English and German, where the capital
/// distinguishes "may" and "März" from other words.
#[must_use]
pub fn is_month(word: &str, language: Language) -> bool {
    MONTHS.iter().any(|row| match language {
        Language::Portuguese => row[language as usize] == word.to_lowercase(),
        _ => row[language as usize] == word,
    })
}
