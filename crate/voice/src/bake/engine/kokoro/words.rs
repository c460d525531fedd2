//! Words in the network's letters: from the author, from the dictionaries, from a known word with
//! an ending, or guessed.

use anyhow::{Context as _, Result};

use super::super::scheme;
use super::{Host, letters};
use crate::ipa::{self, Set};
use crate::spoken::{Sentence, Token};

/// Weak forms of function words, if the dictionaries have only their strong forms (*Cambridge
/// English Pronouncing Dictionary*, "weak forms").
const WEAK: [(&str, &str); 14] = [
    ("a", "ɐ"),
    ("an", "ən"),
    ("and", "ænd"),
    ("at", "æt"),
    ("but", "bʌt"),
    ("him", "hɪm"),
    ("me", "mi"),
    ("of", "ʌv"),
    ("shall", "ʃəl"),
    ("so", "sO"),
    ("some", "sʌm"),
    ("the", "ðə"),
    ("them", "ðəm"),
    ("us", "ʌs"),
];

/// SABLE emphasis from which a function word has its strong form.
const STRESSED: f64 = 1.0;

/// Returns the letters of each token; empty if there is nothing to speak.
pub(super) fn written(sentence: &Sentence, host: &dyn Host) -> Result<Vec<String>> {
    let tokens = &sentence.tokens;
    let mut out = Vec::with_capacity(tokens.len());
    for (t, token) in tokens.iter().enumerate() {
        let ends = !token.punctuation.is_empty() || token.pause || t + 1 == tokens.len();
        out.push(match &token.ipa {
            Some(ipa) => of_ipa(ipa).with_context(|| format!("the word {:?}", token.text))?,
            None => of_word(token, ends, host)?,
        });
    }
    adapt_before_vowels(tokens, &mut out);
    Ok(out)
}

/// Returns the letters of each token from espeak-ng, in one of its languages. A sentence is read as
/// one text, with linking between words, unless that changes the number of words.
pub(super) fn of_espeak(
    sentence: &Sentence,
    language: &str,
    host: &dyn Host,
) -> Result<Vec<String>> {
    let plain = |token: &Token| -> String {
        let letters = token.text.chars();
        letters
            .filter(|c| c.is_alphanumeric() || "'-".contains(*c))
            .collect()
    };
    let texts: Vec<String> = sentence.tokens.iter().map(plain).collect();
    let read = |text: &str| -> Result<Vec<String>> {
        let said = host.ipa(language, text)?;
        Ok(said.split_whitespace().map(in_letters).collect())
    };
    let spoken: Vec<&str> = texts
        .iter()
        .map(String::as_str)
        .filter(|t| !t.is_empty())
        .collect();
    let together = read(&spoken.join(" "))?;
    let mut together = (together.len() == spoken.len()).then_some(together.into_iter());
    sentence
        .tokens
        .iter()
        .zip(&texts)
        .map(|(token, text)| {
            let own = match &mut together {
                _ if text.is_empty() => return Ok(String::new()),
                Some(words) => words.next().unwrap_or_default(),
                None => read(text)?.concat(),
            };
            Ok(token.ipa.as_deref().map_or(own, in_letters))
        })
        .collect()
}

/// Converts IPA to the network's letters: diphthongs and affricates are single letters, as in the
/// developers' espeak-ng frontend; unknown symbols are dropped.
fn in_letters(ipa: &str) -> String {
    const ONE: [(&str, &str); 7] = [
        ("aɪ", "I"),
        ("aʊ", "W"),
        ("eɪ", "A"),
        ("oʊ", "O"),
        ("ɔɪ", "Y"),
        ("tʃ", "ʧ"),
        ("dʒ", "ʤ"),
    ];
    const LETTERS: &str =
        "AIOWYabcdefhijklmnopqrstuvwxyzɑɐɒæβɔɕçɖðʤəɚɛɜɟɡɥɨɪʝɯɰŋɳɲɴøɸθœɹɾɻʁɽʂʃʈʧʊʋʌɣɤχʎʒʔˈˌː\u{303}";
    let mut out = ipa
        .replace(['\u{200d}', '\u{361}', '_'], "")
        .replace('g', "ɡ");
    // A nasal vowel is two letters of the network's.
    for (one, vowel) in [('ã', 'a'), ('ẽ', 'e'), ('ĩ', 'i'), ('õ', 'o'), ('ũ', 'u')] {
        out = out.replace(one, &format!("{vowel}\u{303}"));
    }
    for (two, one) in ONE {
        out = out.replace(two, one);
    }
    out.retain(|c| LETTERS.contains(c));
    out
}

/// Converts the author's IPA pronunciation to Kokoro's letters.
fn of_ipa(ipa: &str) -> Result<String> {
    let syllables = ipa::syllables(ipa, Set::Radio)?;
    Ok(letters::of_phones(
        syllables.into_iter().map(|s| (s.stress, s.phones)),
    ))
}

fn of_word(token: &Token, ends: bool, host: &dyn Host) -> Result<String> {
    let word = scheme::plain(&token.text);
    let small = word.to_lowercase();
    if token.emphasis < STRESSED
        && !ends
        && let Some((_, weak)) = WEAK.iter().find(|(w, _)| *w == small)
    {
        return Ok((*weak).to_owned());
    }
    if word.is_empty() {
        return Ok(word);
    }
    if let Some(known) = known(&word, ends, host)? {
        return Ok(known);
    }
    let parts: Vec<&str> = word.split('-').filter(|p| !p.is_empty()).collect();
    if parts.len() > 1 {
        let mut out = String::new();
        for part in parts {
            out.push_str(&match known(part, false, host)? {
                Some(known) => known,
                None => guessed(part, host)?,
            });
        }
        return Ok(out);
    }
    guessed(&word, host)
}

/// Returns the letters of a word that the dictionaries contain, as it is or without an ending;
/// `None` otherwise.
fn known(word: &str, ends: bool, host: &dyn Host) -> Result<Option<String>> {
    let small = word.to_lowercase();
    let mut rest = small.chars();
    let capital: String = rest
        .next()
        .into_iter()
        .flat_map(char::to_uppercase)
        .chain(rest)
        .collect();
    for form in [word, &small, &capital] {
        if let Some((usual, last)) = host.word(form)? {
            return Ok(Some(last.filter(|_| ends).unwrap_or(usual)));
        }
    }
    for (ending, stems) in [
        ("'s", &[""][..]),
        ("s", &[""]),
        ("es", &[""]),
        ("ed", &["", "e"]),
        ("ing", &["", "e"]),
    ] {
        let Some(stem) = small.strip_suffix(ending).filter(|s| s.len() > 1) else {
            continue;
        };
        for last in stems {
            if let Some((letters, _)) = host.word(&format!("{stem}{last}"))? {
                return Ok(Some(with_ending(letters, ending)));
            }
        }
    }
    Ok(None)
}

/// Appends an ending to a word; the end of the word determines its pronunciation.
fn with_ending(mut letters: String, ending: &str) -> String {
    let last = letters.chars().last().unwrap_or_default();
    letters.push_str(match ending {
        "ing" => "ɪŋ",
        "ed" => match last {
            't' | 'd' | 'ɾ' => "ᵻd",
            'p' | 'k' | 'f' | 'θ' | 's' | 'ʃ' | 'ʧ' => "t",
            _ => "d",
        },
        _ => match last {
            's' | 'z' | 'ʃ' | 'ʒ' | 'ʧ' | 'ʤ' => "ᵻz",
            'p' | 't' | 'k' | 'f' | 'θ' => "s",
            _ => "z",
        },
    });
    letters
}

/// Returns guessed letters for a word in no dictionary. The stressed syllable is *designed*: the
/// first of two, the third from the end of more, as in most English nouns.
fn guessed(word: &str, host: &dyn Host) -> Result<String> {
    let told = host.guess(word)?;
    let phones: Vec<&str> = told.split_whitespace().collect();
    if phones.is_empty() {
        return Ok(String::new());
    }
    let mut starts = ipa::starts(phones.iter().copied(), Set::Radio);
    starts.push(phones.len());
    let count = starts.len() - 1;
    let stressed = count.saturating_sub(3);
    let syllables = starts
        .windows(2)
        .enumerate()
        .map(|(i, pair)| (u8::from(i == stressed), phones[pair[0]..pair[1]].to_vec()));
    Ok(letters::of_phones(syllables))
}

/// Changes the vowels of "the" and "to" before vowels.
fn adapt_before_vowels(tokens: &[Token], written: &mut [String]) {
    for t in 0..written.len().saturating_sub(1) {
        let vowel = written[t + 1]
            .chars()
            .find(|c| !"ˈˌ".contains(*c))
            .is_some_and(|c| "ɑæʌəɐᵊɔɒWIɛɜAeɪᵻiOQYʊu".contains(c));
        let full = match tokens[t].text.to_lowercase().as_str() {
            "the" if vowel => "ði",
            "to" if vowel => "tʊ",
            "to" => "tə",
            _ => continue,
        };
        if tokens[t].ipa.is_none()
            && tokens[t].emphasis < STRESSED
            && tokens[t].punctuation.is_empty()
        {
            written[t] = full.to_owned();
        }
    }
}
