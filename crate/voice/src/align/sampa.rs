//! SAMPA sequence as phones: `'gI-N@n` is two syllables of g I and N @ n.

use raconteur_speech::phones;

/// Phone of a transcription with its syllable and stress.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Sounded<'a> {
    pub(super) phone: &'a str,
    /// Number of the syllable, from 0.
    pub(super) syllable: usize,
    /// Stress: 0 none, 1 primary, 2 secondary.
    pub(super) stress: u8,
}

/// Longest symbol of a phone, in characters: `6~w~`.
const MAX_SYMBOL_CHARS: usize = 4;

/// Splits a transcription into phones: the longest known symbol at each position; an unknown one is
/// a single character. `-` separates syllables, `'` and `"` stress the next syllable, `,` and `%`
/// weakly; white space separates phones, as in MARY's later dialect.
pub(super) fn split(transcription: &str) -> Vec<Sounded<'_>> {
    let mut phones: Vec<Sounded<'_>> = Vec::new();
    let (mut rest, mut syllable, mut stress) = (transcription, 0, 0);
    while let Some(c) = rest.chars().next() {
        let mut length = c.len_utf8();
        match c {
            '-' => {
                if phones.last().is_some_and(|p| p.syllable == syllable) {
                    syllable += 1;
                }
                stress = 0;
            }
            '\'' | '"' => stress = 1,
            ',' | '%' => stress = 2,
            _ if c.is_whitespace() => {}
            _ => {
                let ends = rest.char_indices().map(|(i, c)| i + c.len_utf8());
                for end in ends.take(MAX_SYMBOL_CHARS) {
                    if phones::find("sampa", &rest[..end]).is_some() {
                        length = end.max(length);
                    }
                }
                let phone = &rest[..length];
                phones.push(Sounded {
                    phone,
                    syllable,
                    stress,
                });
            }
        }
        rest = &rest[length..];
    }
    phones
}

#[cfg(test)]
mod tests {
    use super::*;

    fn told(transcription: &str) -> String {
        let split = split(transcription);
        let told = split.iter().map(|p| {
            format!(
                "{}{}{}",
                p.phone,
                p.syllable,
                ["", "'", ","][usize::from(p.stress)]
            )
        });
        told.collect::<Vec<_>>().join(" ")
    }

    #[test]
    fn symbols_of_several_characters_stay_whole() {
        assert_eq!(told("'gI-N@n"), "g0' I0' N1 @1 n1");
        assert_eq!(told("'tsvaI"), "ts0' v0' aI0'");
        assert_eq!(told("'pa-ra-'le:-l@n"), "p0' a0' r1 a1 l2' e:2' l3 @3 n3");
        assert_eq!(told("h @ - ' l @U"), "h0 @0 l1' @U1'");
        assert_eq!(told("é"), "é0");
        assert_eq!(told("- -"), "");
    }
}
