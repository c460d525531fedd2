//! Roman numerals, read only where the preceding word identifies them.

use super::grammar::{Form, Grammars as _};
use super::language::Language;
use raconteur_base::text::roman::RULERS;
pub(super) use raconteur_base::text::roman::{is_ruler, value};

/// Nouns before Roman numerals that are read as cardinals.
const PARTS: [&[&str]; 3] = [
    &[
        "Chapter", "Part", "Book", "Act", "Scene", "Volume", "War", "Section", "Canto", "Article",
        "Bowl", "Vol", "Ch", "Fig", "Sec",
    ],
    &[
        "Kapitel", "Band", "Teil", "Akt", "Buch", "Szene", "Artikel", "Gesang", "Kap", "Bd", "Art",
        "Abs",
    ],
    &[
        "Capítulo",
        "Acto",
        "Ato",
        "Cena",
        "Livro",
        "Parte",
        "Tomo",
        "Volume",
        "Artigo",
        "Cap",
        "Vol",
        "Art",
    ],
];
/// Portuguese counts these as rulers up to ten: "século quinto", "século vinte".
const COUNTED_AS_RULERS: &[&str] = &["século", "séc", "canto"];

/// Reads `text` as a Roman numeral if the previous word makes it one; otherwise returns `None`.
pub(super) fn after(previous: &str, text: &str, language: Language) -> Option<String> {
    let n = value(text)?;
    let grammar = language.grammar();
    if is_ruler(previous, language) {
        return Some(ruler(n, previous, language));
    }
    let counted = language == Language::Portuguese
        && COUNTED_AS_RULERS.contains(&previous.to_lowercase().as_str());
    if counted {
        return Some(ruler(n, "", language));
    }
    let part = |word: &&str| *word == previous || word.to_lowercase() == previous;
    PARTS[language as usize]
        .iter()
        .any(part)
        .then(|| grammar.cardinal(n, Form::Alone))
}

/// Returns a ruler's ordinal as spoken after the name, even for a name that is not in the table.
pub(super) fn ruler(n: u64, name: &str, language: Language) -> String {
    let grammar = language.grammar();
    match language {
        Language::English => format!("the {}", grammar.ordinal(n, "")),
        Language::German if name.ends_with("th") || name.ends_with('a') => {
            format!("die {}", grammar.ordinal(n, "e"))
        }
        Language::German if name.len() > 1 && name.ends_with('s') && !RULERS[1].contains(&name) => {
            format!("des {}", grammar.ordinal(n, "en"))
        }
        Language::German => format!("der {}", grammar.ordinal(n, "e")),
        // Ordinals up to ten, cardinals after: "João segundo", "Luís catorze".
        Language::Portuguese if n > 10 => grammar.cardinal(n, Form::Alone),
        Language::Portuguese => {
            let feminine = name == "Isabel" || name.ends_with('a');
            grammar.ordinal(n, if feminine { "a" } else { "o" })
        }
    }
}
