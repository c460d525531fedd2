//! The network's letters and the phones of the set `radio`.

use super::super::labels::{Labels, Phone};
use super::Mark;
use crate::ipa::{self, Set};

/// Letters and their phones. Of those with one phone the first is written for it.
#[rustfmt::skip]
const TABLE: [(char, &str); 47] = [
    ('ɑ', "aa"), ('æ', "ae"), ('ʌ', "ah"), ('ə', "ax"), ('ɐ', "ax"), ('ᵊ', "ax"), ('ɔ', "ao"), ('ɒ', "aa"),
    ('W', "aw"), ('I', "ay"), ('ɛ', "eh"), ('ɜ', "er"), ('ɚ', "er"), ('A', "ey"), ('e', "eh"), ('ɪ', "ih"),
    ('ᵻ', "ih"), ('i', "iy"), ('O', "ow"), ('Q', "ow"), ('Y', "oy"), ('ʊ', "uh"), ('u', "uw"), ('b', "b"),
    ('ʧ', "ch"), ('d', "d"), ('ð', "dh"), ('ɾ', "dx"), ('T', "dx"), ('f', "f"), ('ɡ', "g"), ('h', "hh"),
    ('ʤ', "jh"), ('k', "k"), ('l', "l"), ('m', "m"), ('n', "n"), ('ŋ', "ng"), ('p', "p"), ('ɹ', "r"),
    ('s', "s"), ('ʃ', "sh"), ('t', "t"), ('θ', "th"), ('v', "v"), ('w', "w"), ('j', "y"),
];
/// Letters that few words have.
const MORE: [(char, &str); 3] = [('z', "z"), ('ʒ', "zh"), ('ʔ', "t")];

/// Stress marks, which precede the stressed vowel.
const STRESS: [char; 2] = ['ˈ', 'ˌ'];

/// Returns the phone of a letter; `None` for an unknown letter.
fn phone(letter: char) -> Option<&'static str> {
    let mut all = TABLE.iter().chain(&MORE);
    all.find(|(c, _)| *c == letter).map(|(_, phone)| *phone)
}

/// Returns the letters of phones, as syllables with their stress: 0 none, 1 primary, 2 secondary.
pub(super) fn of_phones<'a>(syllables: impl Iterator<Item = (u8, Vec<&'a str>)>) -> String {
    let mut out = String::new();
    for (stress, phones) in syllables {
        for phone in phones {
            let mark = usize::from(stress)
                .checked_sub(1)
                .and_then(|s| STRESS.get(s));
            if ipa::is_vowel(phone, Set::Radio) {
                out.extend(mark);
            }
            // The vowel of "bird" is written with the letter of r behind it.
            match phone {
                "er" if stress > 0 => out.push_str("ɜɹ"),
                "er" | "axr" => out.push_str("əɹ"),
                _ => out.extend(
                    TABLE
                        .iter()
                        .chain(&MORE)
                        .find(|(_, p)| *p == phone)
                        .map(|(c, _)| *c),
                ),
            }
        }
    }
    out
}

/// Puts a word's phones behind those that are there, in syllables.
pub(super) fn word(labels: &mut Labels, marks: &[Mark], ends: &[f64], token: usize) {
    let first = labels.phones.len();
    let mut stresses = Vec::new();
    let mut stress = 0;
    for (mark, end_secs) in marks.iter().zip(ends) {
        if let Some(place) = STRESS.iter().position(|s| *s == mark.letter) {
            // Its time is that of the vowel behind it.
            stress = place as u8 + 1;
            continue;
        }
        let here = labels.phones.len();
        // The r of "bird" and of "letter" is the end of their vowel.
        let colours = mark.letter == 'ɹ'
            && here > first
            && matches!(labels.phones[here - 1].symbol.as_str(), "er" | "ax");
        if colours {
            labels.phones[here - 1].symbol = "er".to_owned();
            labels.phones[here - 1].end_secs = *end_secs;
            continue;
        }
        let Some(symbol) = phone(mark.letter) else {
            if here > first {
                labels.phones[here - 1].end_secs = *end_secs;
            }
            continue;
        };
        labels.phones.push(Phone {
            symbol: symbol.to_owned(),
            end_secs: *end_secs,
            token: Some(token),
            syllable: None,
        });
        stresses.push(std::mem::take(&mut stress));
    }
    syllables(labels, first, &stresses, Set::Radio);
}

/// Adds the phones of one word to the labels: converts its IPA letters to the phones of a set.
pub(super) fn word_of(labels: &mut Labels, marks: &[Mark], ends: &[f64], token: usize, set: Set) {
    let first = labels.phones.len();
    let letters: Vec<char> = marks.iter().map(|m| m.letter).collect();
    let mut stresses = Vec::new();
    let mut at = 0;
    let mut begins = labels.phones.last().map_or(0.0, |p| p.end_secs);
    for (count, stress, names) in ipa::spans(&letters, set) {
        at += count;
        let end_secs = ends[at - 1];
        let names: Vec<&str> = names.split_ascii_whitespace().collect();
        // Several phones share the time of their letters.
        let share = (end_secs - begins) / names.len().max(1) as f64;
        for (i, name) in names.into_iter().enumerate() {
            labels.phones.push(Phone {
                symbol: name.to_owned(),
                end_secs: begins + share * (i + 1) as f64,
                token: Some(token),
                syllable: None,
            });
            stresses.push(if i == 0 { stress } else { 0 });
        }
        begins = end_secs;
    }
    syllables(labels, first, &stresses, set);
}

/// Parts the phones from `first` on into syllables; `stresses` are those of each.
fn syllables(labels: &mut Labels, first: usize, stresses: &[u8], set: Set) {
    let symbols: Vec<String> = labels.phones[first..]
        .iter()
        .map(|p| p.symbol.clone())
        .collect();
    if symbols.is_empty() {
        return;
    }
    let mut starts = ipa::starts(symbols.iter().map(String::as_str), set);
    starts.push(symbols.len());
    for pair in starts.windows(2) {
        let stress = stresses[pair[0]..pair[1]]
            .iter()
            .copied()
            .find(|s| *s > 0)
            .unwrap_or(0);
        for phone in &mut labels.phones[first + pair[0]..first + pair[1]] {
            phone.syllable = Some(labels.syllables.len());
        }
        labels.syllables.push((stress, String::new()));
    }
}
