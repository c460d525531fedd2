//! Classification of capitals: shouted words and spelled letters.

use super::capitals_lists::{LETTERS, NAMES, UNCLEAR, WORDS};
use super::language::Language;
use super::word::Word;

/// Context that surrounding words give to a word in capitals; decides whether it is an acronym,
/// shouted, or part of a name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CapitalContext {
    /// None: the neighbouring words are in lower case.
    Nothing,
    /// Ordinary words in capitals are adjacent: the text is shouted.
    Shouting,
    /// The position of a name: "the US".
    Name,
}

/// Maximum distance to which runs of capitals are examined, in words.
const MAX_DISTANCE_WORDS: usize = 8;

/// Consonant clusters with which words begin, in addition to single consonants (English, German and
/// Portuguese).
const ONSETS: &str = "bl br ch chr cl cr dr dw fl fr gh gl gn gr kl kn kr lh nh ph phl phr pl pn pr \
                      ps qu rh sc sch schl schm schn schr schw scr sh shr sk sl sm sn sp sph spl \
                      spr squ st str sv sw th thr tr ts tsch tw vl vr wh wr zw";

fn is_vowel(c: char) -> bool {
    "aeiouyäöüáàâãéêíóôõú".contains(c)
}

fn has(list: &str, word: &str) -> bool {
    list.split_ascii_whitespace().any(|own| own == word)
}

/// Returns true if a word of letters, in any case, can be pronounced as a word: it has a valid
/// onset, vowels, and no long run without any.
#[must_use]
pub fn is_pronounceable(word: &str) -> bool {
    let word = word.to_lowercase();
    let (mut run, mut longest, mut vowels, mut most_vowels) = (0, 0, 0, 0);
    for c in word.chars() {
        if is_vowel(c) {
            (run, vowels) = (0, vowels + 1);
        } else {
            (run, vowels) = (run + 1, 0);
        }
        longest = longest.max(run);
        most_vowels = most_vowels.max(vowels);
    }
    let onset: String = word.chars().take_while(|c| !is_vowel(*c)).collect();
    let begins = onset.chars().count() < 2 || has(ONSETS, &onset);
    // Few three-letter words end in two consonants, so "ibm" is not a word.
    let (least, most) = if word.chars().count() < 4 {
        (3, 1)
    } else {
        (4, 2)
    };
    // Long words are not acronyms: "angst", "length".
    let is_long = word.chars().count() > 4;
    // "arms", "asks", "tents".
    let most = if word.ends_with('s') { most + 1 } else { most };
    word.chars().count() >= least
        && word.chars().any(is_vowel)
        && (is_long || begins && longest <= 3 && most_vowels <= 3 && run <= most)
}

/// Returns true if a word has more than one letter, all in capitals.
#[must_use]
pub fn is_capitals(word: &str) -> bool {
    word.chars().count() > 1 && word.chars().all(char::is_uppercase)
}

/// Returns true if capitals are spelt out as letters rather than read as a word: by lists of both,
/// otherwise by their shape and context.
#[must_use]
pub fn is_acronym(word: &str, around: CapitalContext, language: Language) -> bool {
    if !is_capitals(word) {
        return false;
    }
    let own = language as usize;
    if has(UNCLEAR[own], word) {
        return around == CapitalContext::Name;
    }
    if has(LETTERS[own], word) {
        return true;
    }
    if has(NAMES, word) || has(WORDS[own], &word.to_lowercase()) {
        return false;
    }
    let is_short = word.chars().count() < 4;
    is_short && around != CapitalContext::Shouting || !is_pronounceable(word)
}

/// Returns true if a word in capitals is emphasised: an ordinary word among words in lower case.
#[must_use]
pub fn is_stressed(words: &[Word<'_>], at: usize, language: Option<Language>) -> bool {
    let Some(word) = words.get(at).map(|word| word.core.as_str()) else {
        return false;
    };
    let Some(language) = language else {
        return is_capitals(word);
    };
    let around = around(words, at, language);
    is_capitals(word)
        && around != CapitalContext::Shouting
        && super::roman::value(word).is_none()
        && !has(NAMES, word)
        && !is_acronym(word, around, language)
}

/// Returns the context of the word in capitals at `at`. The search stops at punctuation, so the
/// result does not depend on segmentation at punctuation marks.
#[must_use]
pub fn around(words: &[Word<'_>], at: usize, language: Language) -> CapitalContext {
    let Some(word) = words.get(at) else {
        return CapitalContext::Nothing;
    };
    let previous = before(words, at).map_or("", |at| words[at].core.as_str());
    let next = after(words, at).map_or("", |at| words[at].core.as_str());
    if has(UNCLEAR[language as usize], &word.core) && is_named(&word.core, previous, next, language)
    {
        return CapitalContext::Name;
    }
    let shouts = |at: usize| {
        let core = words[at].core.as_str();
        is_capitals(core)
            && !is_acronym(core, CapitalContext::Nothing, language)
            && !has(NAMES, core)
            || core.contains(['\'', '\u{2019}', '-'])
                && !core.contains(char::is_lowercase)
                && core.chars().count() > 3
    };
    let [mut left, mut right] = [at; 2];
    // A run of capitals, single letters and numbers.
    let runs = |at: &usize| !words[*at].core.contains(char::is_lowercase);
    while let Some(next) = before(words, left).filter(runs)
        && at - next <= MAX_DISTANCE_WORDS
    {
        left = next;
        if shouts(left) {
            return CapitalContext::Shouting;
        }
    }
    while let Some(next) = after(words, right).filter(runs)
        && next - at <= MAX_DISTANCE_WORDS
    {
        right = next;
        if shouts(right) {
            return CapitalContext::Shouting;
        }
    }
    CapitalContext::Nothing
}

/// Returns the word before the one at `at`, if no punctuation separates the two.
fn before(words: &[Word<'_>], at: usize) -> Option<usize> {
    let before = at.checked_sub(1)?;
    let (word, this) = (words.get(before)?, words.get(at)?);
    (word.end.is_empty() && !word.closes && !this.opens && !word.core.is_empty()).then_some(before)
}

/// Returns the word after the one at `at`, if no punctuation separates the two.
fn after(words: &[Word<'_>], at: usize) -> Option<usize> {
    let next = words.get(at + 1)?;
    let this = words.get(at)?;
    (this.end.is_empty() && !this.closes && !next.opens && !next.core.is_empty()).then_some(at + 1)
}

/// Returns true if capitals that are also a common word occur in a position reserved for a name.
fn is_named(word: &str, previous: &str, next: &str, language: Language) -> bool {
    let name_follows = next.starts_with(char::is_uppercase) && next.contains(char::is_lowercase);
    match (language, word) {
        (Language::English, "US") => {
            let before = "the a an The A THE in In across former from between many most several";
            has(before, previous)
                || name_follows
                || has(
                    "dollar dollars government army president citizen citizens state states officials \
                     troops firms cities forces soldiers law economy market markets company companies \
                     senator election military navy exports",
                    next,
                )
        }
        (Language::English, "IT") => {
            has(
                "the in an our your their his her my of modern",
                &previous.to_lowercase(),
            ) || has(
                "department support company manager staff team system systems specialist \
                     industry sector security services expert consultant",
                next,
            )
        }
        (Language::English, "WHO") => {
            has("the The", previous)
                || has(
                    "officials chief says said warns report director experts guidelines member",
                    next,
                )
        }
        _ => has("the The a der die das o a", previous),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns a text with its acronyms spelled out, for tests.
    fn read(text: &str, language: Language) -> String {
        let words: Vec<Word<'_>> = text.split(' ').map(Word::parse).collect();
        let said = |at: usize| {
            let core = &words[at].core;
            if is_acronym(core, around(&words, at, language), language) {
                return core.chars().map(|c| format!("{c}.")).collect();
            }
            if is_capitals(core) {
                core.to_lowercase()
            } else {
                core.clone()
            }
        };
        (0..words.len())
            .map(said)
            .collect::<Vec<String>>()
            .join(" ")
    }

    #[test]
    fn shouted_words_are_words_and_acronyms_letters() {
        for (text, expected) in [
            ("THE END", "the end"),
            ("THE END OF THE ROAD.", "the end of the road"),
            (
                "NO! I SAID STOP RIGHT NOW, YOU SILLY GOOSE!",
                "no I said stop right now you silly goose",
            ),
            (
                "HELP ME, he cried. GO AWAY! OH DEAR. IT WAS MY CAT. AM I NEXT?",
                "help me he cried go away oh dear it was my cat am I next",
            ),
            (
                "The US and the WHO met NASA & the BBC.",
                "The U.S. and the W.H.O. met nasa & the B.B.C.",
            ),
            (
                "He works in IT; WHO are you? Tell US more.",
                "He works in I.T. who are you Tell us more",
            ),
            (
                "The US Army has a new CEO. THE BBC IS HERE.",
                "The U.S. Army has a new C.E.O. the B.B.C. is here",
            ),
            (
                "a HUGE wood, there WAS a FULL cup, an ELF and a FOX",
                "a huge wood there was a full cup an elf and a fox",
            ),
            (
                "HTML, JPEG, HDMI, ISBN and USSR",
                "H.T.M.L. jpeg H.D.M.I. I.S.B.N. and U.S.S.R.",
            ),
            (
                "WHAT A STRENGTH, BRIGHT WORLD THROUGHOUT!",
                "what A strength bright world throughout",
            ),
        ] {
            assert_eq!(read(text, Language::English), expected, "{text}");
        }
        assert_eq!(
            read(
                "DAS IST MEIN HUND, sagte die ARD in der EU.",
                Language::German
            ),
            "das ist mein hund sagte die A.R.D. in der E.U."
        );
        assert_eq!(
            read(
                "NÃO VÁS JÁ, disse a RTP dos EUA à ONU.",
                Language::Portuguese
            ),
            "não vás já disse a R.T.P. dos E.U.A. à onu"
        );
    }
}
