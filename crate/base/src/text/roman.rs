//! Roman numerals, and the names of rulers followed by one.

use super::language::Language;

/// Names of rulers and popes that commonly take a number, [English, German, Portuguese]; a genitive
/// s is allowed.
pub const RULERS: [&[&str]; 3] = [
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

/// Returns the value of a Roman numeral below 4000; `None` unless it is in its standard spelling.
#[must_use]
pub fn value(text: &str) -> Option<u64> {
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

/// Returns true if `name` is one that takes a number, also in the genitive.
#[must_use]
pub fn is_ruler(name: &str, language: Language) -> bool {
    let rulers = RULERS[language as usize];
    rulers.contains(&name)
        || name
            .strip_suffix('s')
            .is_some_and(|stem| rulers.contains(&stem))
}
