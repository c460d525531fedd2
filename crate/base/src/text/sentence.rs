//! Sentence boundaries.

use super::abbreviation;
use super::language::Language;
use super::months::is_month;
use super::roman;
use super::starters::is_starter;
use super::word::Word;

/// German words after which a number with a full stop is an ordinal.
const ARTICLES: &str = "der die das den dem des am vom zum zur im beim ein eine einen einem einer \
                        jeder jede jedes jeden jedem ihr ihre ihren sein seine seinen seinem mein \
                        meine meinen meinem bis ins und oder";

/// Returns true if a sentence ends after the word at `at`, judged by the surrounding words.
/// Separate signs count as words. A sentence that ends twice, after a word and after the sign
/// behind it, ends once. `language` is `None` for an unsupported language.
///
/// A sentence ends with `.`, `!`, `?` or `…` if the next word does not start with a lower-case
/// letter. The full stop of an abbreviation, an initial or a German ordinal does not end it.
#[must_use]
pub fn ends_after(words: &[Word<'_>], at: usize, language: Option<Language>) -> bool {
    let Some(word) = words.get(at) else {
        return false;
    };
    if !word.end.contains(['.', '!', '?']) {
        return false;
    }
    let after = words.get(at + 1..).unwrap_or_default();
    let Some(first) = after.iter().find_map(|word| first_letter(word)) else {
        return true;
    };
    if first.is_lowercase() {
        return false;
    }
    let is_ellipsis = word.raw.contains('\u{2026}') || word.raw.contains("..");
    let (Some(language), false) = (language, word.end.contains(['!', '?']) || is_ellipsis) else {
        return true;
    };
    // The second half of an abbreviation of two words: "z. B."
    if let Some(before) = at.checked_sub(1)
        && let Some(pair) = abbreviation::pair(words, before, language)
    {
        return pair.ends;
    }
    if let Some(found) = abbreviation::expand(words, at, language) {
        // The first half of a spaced abbreviation does not end a sentence.
        return found.ends && found.spoken.len() == 1;
    }
    language != Language::German || german_stop_ends(words, at)
}

/// Returns the first letter or digit of a word; `None` if it has none.
fn first_letter(word: &Word<'_>) -> Option<char> {
    word.raw.chars().find(|c| c.is_alphanumeric())
}

/// Returns true if the full stop after a German numeral ends a sentence: not in "am 3. Oktober",
/// "die 2. Tür", "24.12. und", "Ludwig XIV. war".
fn german_stop_ends(words: &[Word<'_>], at: usize) -> bool {
    let word = &words[at];
    let core = word.core.as_str();
    let is_digits = |text: &str| !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
    let is_date = core.split_once('.').is_some_and(|(day, month)| {
        is_digits(day) && is_digits(month) && day.len() <= 2 && month.len() <= 2
    });
    let is_roman = roman::value(core).is_some();
    if !is_date && !is_digits(core) && !is_roman {
        return true;
    }
    let next = words.get(at + 1).map_or("", |word| word.core.as_str());
    if is_starter(next, Language::German) {
        return true;
    }
    let previous = match at.checked_sub(1).and_then(|before| words.get(before)) {
        Some(word) if word.end.is_empty() && !word.closes => word.core.as_str(),
        _ => "",
    };
    let led = ARTICLES
        .split_ascii_whitespace()
        .any(|own| own == previous.to_lowercase());
    let dated = is_month(next, Language::German) || matches!(next, "Jh" | "Jahrhundert");
    let ruler = roman::is_ruler(previous, Language::German);
    let first = at == 0 && core.len() <= 2;
    !(is_date || led || dated || ruler || first)
}

/// State of the last word of an incomplete text: ends a sentence, does not, or depends on the next
/// word.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PendingEnd {
    /// A sentence ends here, unless a lower-case letter follows.
    Ends,
    /// No sentence ends here.
    GoesOn,
    /// The next word decides.
    Open,
}

/// Returns the sentence-end state after the last of `words` in an incomplete text.
#[must_use]
pub fn pending_end(words: &[Word<'_>], language: Option<Language>) -> PendingEnd {
    let Some(last) = words.last() else {
        return PendingEnd::GoesOn;
    };
    if !last.end.contains(['.', '!', '?']) {
        return PendingEnd::GoesOn;
    }
    // Half of an abbreviation in two words is this short.
    if last.dotted() && !last.core.is_empty() && last.core.len() <= 2 {
        return PendingEnd::Open;
    }
    let starter = language.map_or("The", |language| language.pick(["The", "Die", "O"]));
    // A beginning, a name, a number, a month, a numeral.
    let ends = [starter, "Xerxes", "7", "Mai", "IV"].map(|next| {
        let mut all = words.to_vec();
        all.push(Word::parse(next));
        ends_after(&all, words.len() - 1, language)
    });
    match (ends.contains(&true), ends.contains(&false)) {
        (true, true) => PendingEnd::Open,
        (true, false) => PendingEnd::Ends,
        (false, _) => PendingEnd::GoesOn,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sentences(text: &str, language: &str) -> Vec<String> {
        let words: Vec<Word<'_>> = text.split_whitespace().map(Word::parse).collect();
        let mut all = vec![String::new()];
        for (at, word) in words.iter().enumerate() {
            if let Some(last) = all.last_mut() {
                if !last.is_empty() {
                    last.push(' ');
                }
                last.push_str(&word.raw);
            }
            if ends_after(&words, at, Language::from_tag(language)) && at + 1 < words.len() {
                all.push(String::new());
            }
        }
        all
    }

    #[test]
    fn abbreviations_end_no_sentence_and_ends_do() {
        for (language, text) in [
            (
                "en",
                "Dr. Lee met J. R. R. Tolkien, e.g. in Oxford. | He left at 5 p.m. | The U.S. Army came.",
            ),
            (
                "en",
                "Did he come? | No. | He lives in the U.S. | It is No. 7. | Prof. Dr. Klee (sic!) left.",
            ),
            (
                "en",
                "It cost 3.50 euros etc. | Then he said “Stop!” and ran … | Away.",
            ),
            ("en", "Acme Inc. | He works for Mr. & Mrs. Brown vs. Green."),
            (
                "de",
                "Am 29. Juli kam z. B. Herr Dr. Klee. | Die 2. Tür, Nr. 7 usw. | Danach ging er.",
            ),
            (
                "de",
                "Ludwig XIV. und Elisabeth II. fuhren. | Am 3.10. | Er kam am 24.12. nach Haus.",
            ),
            (
                "de",
                "Es waren 12. | Dann d.h. Montag kam er um 1945. | Er ging.",
            ),
            (
                "pt",
                "O Sr. João e a Dra. Ana, p. ex. Lisboa. | Ele foi às 5. | A Sra. D. Maria ficou.",
            ),
        ] {
            let whole = text.replace(" | ", " ");
            let expected: Vec<&str> = text.split(" | ").collect();
            assert_eq!(sentences(&whole, language), expected, "{language}");
        }
    }

    #[test]
    fn what_comes_piece_by_piece_waits_where_the_next_word_decides() {
        let of = |text: &str| {
            let words: Vec<Word<'_>> = text.split_whitespace().map(Word::parse).collect();
            pending_end(&words, Some(Language::English))
        };
        for (text, expected) in [
            ("The cat sat.", PendingEnd::Ends),
            ("Really?!", PendingEnd::Ends),
            ("Well…", PendingEnd::Ends),
            ("said Dr.", PendingEnd::Open),
            ("at 5 p.m.", PendingEnd::Open),
            ("in the U.S.", PendingEnd::Open),
            ("by e.g.", PendingEnd::GoesOn),
            ("the cat", PendingEnd::GoesOn),
        ] {
            assert_eq!(of(text), expected, "{text}");
        }
    }
}
