//! Roman numerals, read only where the word before them makes them clear.

use super::grammar::Form;
use super::language::Language;

/// Names of rulers and popes that commonly take a number, [English, German, Portuguese];
/// a genitive s is allowed.
const RULERS: [&[&str]; 3] = [
    &[
        "Henry",
        "Louis",
        "George",
        "Edward",
        "Charles",
        "James",
        "William",
        "Richard",
        "Elizabeth",
        "Philip",
        "Napoleon",
        "Pius",
        "Benedict",
        "Leo",
        "Gregory",
        "Clement",
        "Innocent",
        "John",
        "Paul",
        "Frederick",
        "Alexander",
        "Nicholas",
        "Peter",
        "Catherine",
        "Ferdinand",
        "Alfonso",
        "Urban",
        "Otto",
        "Ramesses",
        "Ptolemy",
    ],
    &[
        "Heinrich",
        "Ludwig",
        "Friedrich",
        "Wilhelm",
        "Karl",
        "Otto",
        "Konrad",
        "Franz",
        "Josef",
        "Leopold",
        "Maximilian",
        "Pius",
        "Benedikt",
        "Leo",
        "Gregor",
        "Clemens",
        "Johannes",
        "Paul",
        "Elisabeth",
        "Katharina",
        "Napoleon",
        "Rudolf",
        "Georg",
        "Eduard",
        "Richard",
        "Philipp",
        "Peter",
        "Alexander",
        "Nikolaus",
        "Ferdinand",
    ],
    &[
        "João",
        "Pedro",
        "Afonso",
        "Manuel",
        "Sancho",
        "Filipe",
        "José",
        "Luís",
        "Carlos",
        "Duarte",
        "Fernando",
        "Sebastião",
        "Maria",
        "Isabel",
        "Henrique",
        "Bento",
        "Pio",
        "Napoleão",
        "Paulo",
        "Leão",
        "Gregório",
        "Miguel",
        "Jorge",
        "Ricardo",
        "Catarina",
        "Alexandre",
        "Guilherme",
    ],
];
/// Nouns before Roman numerals that are read as cardinals.
const PARTS: [&[&str]; 3] = [
    &[
        "Chapter", "Part", "Book", "Act", "Scene", "Volume", "War", "Section", "Canto", "Article",
        "Vol", "Ch", "Fig", "Sec",
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

const DIGITS: [(&str, u64); 13] = [
    ("M", 1000),
    ("CM", 900),
    ("D", 500),
    ("CD", 400),
    ("C", 100),
    ("XC", 90),
    ("L", 50),
    ("XL", 40),
    ("X", 10),
    ("IX", 9),
    ("V", 5),
    ("IV", 4),
    ("I", 1),
];

/// The value of a numeral in its one correct spelling, below 4000.
pub(super) fn value(text: &str) -> Option<u64> {
    if text.is_empty() || text.len() > 15 {
        return None;
    }
    let (mut rest, mut sum) = (text, 0);
    for (sign, value) in DIGITS {
        // Only M, C, X and I repeat, three times at most.
        let most = if sign.len() == 1 && value.to_string().starts_with('1') {
            3
        } else {
            1
        };
        for _ in 0..most {
            if let Some(shorter) = rest.strip_prefix(sign) {
                rest = shorter;
                sum += value;
            }
        }
    }
    (rest.is_empty() && spelled(sum) == text).then_some(sum)
}

fn spelled(mut n: u64) -> String {
    let mut text = String::new();
    for (sign, value) in DIGITS {
        while n >= value {
            text += sign;
            n -= value;
        }
    }
    text
}

/// The numeral `text` after the word `previous`, where that word makes it one.
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

/// A ruler's number after the name, also where the name is not in the table.
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

/// Whether `name` is one that takes a number, also in the genitive.
pub(super) fn is_ruler(name: &str, language: Language) -> bool {
    let rulers = RULERS[language as usize];
    rulers.contains(&name)
        || name
            .strip_suffix('s')
            .is_some_and(|stem| rulers.contains(&stem))
}
