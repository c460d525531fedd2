//! Phone sets of engines, with the table row of each symbol. Symbols: Festival's `radio_phones.scm`
//! and `mrpa_phones.scm`, SAMPA, and espeak-ng's English; those of German and Portuguese are in
//! `names.rs`.

use super::columns::COLUMNS;
use super::table::TABLE;
use super::{PhoneTargets, names};

/// Names of the phone sets of [`find`]. SAMPA names a phone the same in all three languages;
/// espeak-ng does not, so its German and its Portuguese have their own sets.
pub const PHONE_SETS: [&str; 6] = ["radio", "sampa", "espeak", "mrpa", "espeak-de", "espeak-pt"];

/// Returns the targets of a symbol in a phone set (one of [`PHONE_SETS`]; any other name is read as
/// `radio`). `radio` accepts upper case and stress digits of the CMU dictionary; espeak-ng's sets
/// accept leading stress marks. `sampa` and `espeak` have the symbols of English, then those of
/// German, then of Portuguese; in `espeak-de` and `espeak-pt` their language comes first. `None`
/// for an unknown symbol.
#[must_use]
pub fn find(phone_set: &str, symbol: &str) -> Option<&'static PhoneTargets> {
    let set = PHONE_SETS.iter().position(|s| *s == phone_set).unwrap_or(0);
    let column = if set < 4 { set } else { 2 };
    let bare = match column {
        0 => symbol.trim_end_matches(|c: char| c.is_ascii_digit()),
        2 => symbol.trim_start_matches(['\'', ',', '%', '=']),
        _ => symbol,
    };
    let languages = match set {
        1 | 2 => [names::ENGLISH, names::GERMAN, names::PORTUGUESE],
        4 => [names::GERMAN, "", names::ENGLISH],
        5 => [names::PORTUGUESE, "", names::ENGLISH],
        _ => ["", "", ""],
    };
    // The table's own symbols are those of English.
    if set < 4
        && let Some(row) = row_of_symbol(column, bare)
    {
        return Some(row);
    }
    for language in languages {
        if let Some(sampa) = names::sampa(language, column, bare) {
            return row_of_symbol(1, sampa);
        }
    }
    row_of_symbol(column, bare)
}

/// Translates a symbol of a phone set to one of another set with the same lip movement; `None` if
/// there is none.
#[must_use]
pub fn translate(from: &str, symbol: &str, to: &str) -> Option<&'static str> {
    let row = find(from, symbol)?;
    let place = TABLE.iter().position(|other| core::ptr::eq(other, row))?;
    let mut symbols = COLUMNS[place].into_iter();
    symbols.find(|s| find(to, s).is_some_and(|other| core::ptr::eq(other, row)))
}

/// Returns the row whose own symbol in a column equals `symbol`.
fn row_of_symbol(column: usize, symbol: &str) -> Option<&'static PhoneTargets> {
    if symbol.is_empty() {
        return None;
    }
    let place = COLUMNS.iter().position(|symbols| {
        let own = symbols[column];
        own == symbol || column == 0 && own.eq_ignore_ascii_case(symbol)
    });
    place.map(|row| &TABLE[row])
}

#[cfg(test)]
mod tests {
    use super::super::Class;
    use super::*;

    #[test]
    fn every_symbol_of_the_radio_set_is_known() {
        let radio = "aa ae ah ao aw ax axr ay b ch d dh dx eh el em en er ey f g hh hv ih iy jh k l m n \
                     ng nx ow oy p r s sh t th uh uw v w y z zh pau brth h#";
        for symbol in radio.split_whitespace() {
            assert!(find("radio", symbol).is_some(), "{symbol}");
        }
        assert_eq!(find("radio", "AH0"), find("radio", "ah"));
        assert_eq!(find("espeak", "'i:").map(|p| p.viseme), Some("ih"));
        assert!(
            find("radio", "xyzzy").is_none(),
            "an unknown radio symbol is not found"
        );
    }

    /// Symbols written by espeak-ng 1.51 (`-x --sep`) for some hundred words of each voice; foreign
    /// words among them follow the rules of their languages.
    const EMITTED: [(&str, &str); 5] = [
        (
            "espeak-de",
            "0 3 3: ; @ A A: A~ C E E: I N O OY R S T U UR W W~ Y: _! _: _| a aI aU b d dZ e: eI \
             f g h i i: j k l m n o: oU p pF r s t ts u: v x y y: z",
        ),
        (
            "espeak-pt",
            "& &U~ &~ * ; @- A E EI EU N O OI R S U Z a aI aU b d e eI eU f g i iU j k l l^ m n \
             n^ o oI oU o~ p r- s s# t u uI u~ v w x y z",
        ),
        (
            "espeak-pt",
            "& &U~ &~ * ; @- E EI EU N O OI R S U Z a aI aU b d dZ e eI eU f g i iU j k l l^ m n \
             n^ o oI o~ p r s t tS u uI u~ v w x y z",
        ),
        (
            "espeak",
            "0 3 3: ; ? @ @- @2 @L A: A@ A~ D E I I# I2 N O2 O: O@ OI S T U U@ V Z _! _: a a# aI \
             aI3 aU aa b d dZ e@ eI f g h i i: i@ i@3 j k l m n n- o@ oU p r r- s t t# tS u: v w \
             x z",
        ),
        (
            "espeak",
            "0 3 3: ; @ @- @L A: A@ A~ D E I I2 N O: O@ OI S T U U@ V Z _! _: a a# aI aI@ aU aa b \
             d dZ e@ eI f g h i i: i@ i@3 j k l m n o@ oU p r r- s t tS u: v w x z",
        ),
    ];

    #[test]
    fn every_mnemonic_that_espeak_ng_writes_is_known() {
        for (set, mnemonics) in EMITTED {
            for symbol in mnemonics.split_whitespace() {
                assert!(find(set, symbol).is_some(), "{set}: {symbol}");
                assert!(find("espeak", symbol).is_some(), "espeak: {symbol}");
            }
        }
    }

    #[test]
    fn names_of_other_languages_are_triples_of_rows_that_exist() {
        for language in [names::ENGLISH, names::GERMAN, names::PORTUGUESE] {
            let words: Vec<&str> = language.split_whitespace().collect();
            assert_eq!(words.len() % 3, 0, "{language}");
            for (i, triple) in words.chunks(3).enumerate() {
                assert!(row_of_symbol(1, triple[2]).is_some(), "{triple:?}");
                for column in 0..2 {
                    let again = |other: &&[&str]| other[column] == triple[column];
                    let once =
                        triple[column] == "-" || !words.chunks(3).skip(i + 1).any(|t| again(&t));
                    assert!(once, "{triple:?}");
                }
            }
        }
    }

    #[test]
    fn a_language_names_its_own_phone_first() {
        // German [a] is open, English "a" the vowel of trap; r is a velar there.
        assert_eq!(find("espeak-de", "a"), find("radio", "aa"));
        assert_eq!(find("espeak", "a"), find("radio", "ae"));
        assert_eq!(find("espeak-de", "r"), find("radio", "k"));
        assert_eq!(find("espeak-de", "'Y:"), find("radio", "uw"));
        assert_eq!(find("espeak-pt", "y"), find("radio", "ix"));
        assert_eq!(find("sampa", "2:"), find("radio", "uw"));
        assert_eq!(
            find("sampa", "pf").map(|p| p.class),
            Some(Class::BilabialStop)
        );
        assert_eq!(
            find("espeak-pt", "eU").and_then(PhoneTargets::glide),
            find("radio", "uh")
        );
        assert!(
            find("espeak-de", "xyzzy").is_none() && find("sampa", "-").is_none(),
            "unknown symbols are not found"
        );
    }

    #[test]
    fn the_same_letter_means_another_vowel_in_another_set() {
        assert_eq!(find("mrpa", "uh"), find("radio", "ah"));
        assert_eq!(find("mrpa", "oo"), find("radio", "ao"));
    }

    #[test]
    fn a_guest_in_another_language_has_a_mouth() {
        for (from, symbol, to, expected) in [
            ("espeak-pt", "oI", "radio", Some("oy")),
            ("espeak-de", "y:", "radio", Some("uw")),
            ("radio", "iy", "espeak-de", Some("i:")),
            ("radio", "aa", "radio", Some("aa")),
            ("radio", "xyzzy", "espeak", None),
        ] {
            assert_eq!(
                translate(from, symbol, to),
                expected,
                "{from} {symbol} {to}"
            );
        }
    }

    #[test]
    fn rows_are_called_by_festival_or_by_sampa() {
        for (row, symbols) in TABLE.iter().zip(COLUMNS) {
            let name = if symbols[0].is_empty() {
                symbols[1]
            } else {
                symbols[0]
            };
            assert_eq!(row.name, name);
            let again = TABLE.iter().filter(|other| other.name == name);
            assert_eq!(again.count(), 1, "{name}");
        }
    }
}
