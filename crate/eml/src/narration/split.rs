//! Split points between the clauses of a streamed text.

use crate::emoticon;
use raconteur_base::text::language::Language;
use raconteur_base::text::sentence::{PendingEnd, ends_after, pending_end};
use raconteur_base::text::word::Word;

/// Maximum number of characters without an end before text is cut between two words.
const MAX_CLAUSE_CHARS: usize = 240;
/// Minimum number of words in a clause ended by a comma or dash.
const ENOUGH_WORDS: usize = 5;

/// Text split into complete clauses and a rest; together they are the whole text.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ClauseSplit<'t> {
    /// Complete clauses.
    pub clauses: Vec<&'t str>,
    /// Remainder that may continue.
    pub rest: &'t str,
}

/// Splits a text into clauses: at the ends of its sentences and lines, at `;` and `:`, at commas
/// and dashes after five words, and at the latest after 240 characters. With `is_whole` the text is
/// complete; otherwise the last word, and a word whose full stop is distinguished from that of an
/// abbreviation only by the next word, are kept for later. The clauses do not depend on the pieces
/// in which a text arrives, except for an emoticon that arrives after its clause.
#[must_use]
pub fn split_clauses<'t>(text: &'t str, language: &str, is_whole: bool) -> ClauseSplit<'t> {
    let mut cutter = ClauseSplitter {
        text,
        language: Language::from_tag(language),
        found: ClauseSplit::default(),
        from: 0,
        words: Vec::new(),
        counted: 0,
        is_open: false,
        ends_at: None,
    };
    let mut tokens = tokens(text).peekable();
    while let Some((start, end)) = tokens.next() {
        let next = tokens.peek().map(|(start, _)| *start);
        let is_complete = is_whole || end < text.len();
        cutter.shorten(start, end);
        if !is_complete {
            break;
        }
        cutter.token(start, end);
        let gap = &text[end..next.unwrap_or(text.len())];
        if gap.contains(['\n', '\r']) && cutter.counted > 0 {
            cutter.emit(end);
        }
    }
    cutter.finish(is_whole)
}

/// Returns the ranges of text between white space.
fn tokens(text: &str) -> impl Iterator<Item = (usize, usize)> {
    text.split_whitespace().map(move |token| {
        let start = token.as_ptr() as usize - text.as_ptr() as usize;
        (start, start + token.len())
    })
}

struct ClauseSplitter<'t> {
    text: &'t str,
    language: Option<Language>,
    found: ClauseSplit<'t>,
    /// Start of the incomplete clause.
    from: usize,
    /// Words in it.
    words: Vec<Word<'t>>,
    /// Number of these with a letter or a digit.
    counted: usize,
    /// True if only the next word decides whether the last word ended a sentence.
    is_open: bool,
    /// The clause is whole here, unless an emoticon follows that belongs to it.
    ends_at: Option<usize>,
}

impl<'t> ClauseSplitter<'t> {
    fn token(&mut self, start: usize, end: usize) {
        let token = &self.text[start..end];
        let is_word = token.contains(char::is_alphanumeric);
        if emoticon::whole(token).is_some()
            || !is_word && emoticon::without_emoji(token).is_some_and(|rest| rest.is_empty())
        {
            if let Some(end_of_clause) = &mut self.ends_at {
                *end_of_clause = end;
            }
            return;
        }
        if let Some(at) = self.ends_at.take() {
            self.emit(at);
        }
        self.words.push(Word::parse(token));
        let before = self.words.len().saturating_sub(2);
        if core::mem::take(&mut self.is_open) && ends_after(&self.words, before, self.language) {
            // Text in between stays with the clause that it ends.
            let end_before = self.text[..start].trim_end().len();
            self.emit(end_before);
            self.words.push(Word::parse(token));
        }
        self.counted += usize::from(is_word);
        if self.counted > 0 {
            self.check_end(end);
        }
    }

    /// Checks for the end of a clause at the last word.
    fn check_end(&mut self, end: usize) {
        let Some(word) = self.words.last() else {
            return;
        };
        let is_dash = word.core.is_empty() && word.raw.chars().all(|c| "-–—".contains(c));
        // Numbers continue across such signs: "May 5, 1990".
        let number = |word: &Word<'_>| word.core.ends_with(char::is_numeric);
        let before = self.words.len().checked_sub(2).map(|at| &self.words[at]);
        let after_number = if is_dash {
            before.is_some_and(number)
        } else {
            number(word)
        };
        let is_weak = is_dash || word.end.contains(',') || word.raw.ends_with('—');
        if word.end.contains([';', ':']) || is_weak && !after_number && self.counted >= ENOUGH_WORDS
        {
            self.ends_at = Some(end);
            return;
        }
        match pending_end(&self.words, self.language) {
            PendingEnd::Ends => self.ends_at = Some(end),
            PendingEnd::Open => self.is_open = true,
            PendingEnd::GoesOn => {}
        }
    }

    /// Cuts overlong text before the token from `start` to `end`, or in it.
    fn shorten(&mut self, start: usize, end: usize) {
        let length = |from: usize, to: usize| self.text[from..to].chars().count();
        if length(self.from, end) <= MAX_CLAUSE_CHARS {
            return;
        }
        if let Some(at) = self.ends_at.take() {
            self.emit(at);
        } else if !self.text[self.from..start].trim().is_empty() {
            let at = self.text[..start].trim_end().len();
            self.emit(at);
        }
        while let Some((at, _)) = self.text[self.from..end]
            .char_indices()
            .nth(MAX_CLAUSE_CHARS)
        {
            self.emit(self.from + at);
        }
    }

    fn emit(&mut self, to: usize) {
        self.found.clauses.push(&self.text[self.from..to]);
        self.from = to;
        self.words.clear();
        self.counted = 0;
        self.is_open = false;
        self.ends_at = None;
    }

    fn finish(mut self, is_whole: bool) -> ClauseSplit<'t> {
        if let Some(at) = self.ends_at.take() {
            self.emit(at);
        }
        if is_whole && !self.text[self.from..].trim().is_empty() {
            self.emit(self.text.len());
        }
        self.found.rest = &self.text[self.from..];
        self.found
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "Dr. Miller paid 3.50 euros, e.g. for bread. Really?! Well… the old man who \
        lived there, as everybody knew, had left; nobody knew when: perhaps at 10:30 — or later. It \
        weighs 1,000 kg! 🙂 Yes.\nThe end";

    /// Returns the clauses of a text that arrives in pieces of a given number of characters.
    pub(super) fn in_pieces(text: &str, length: usize, language: &str) -> Vec<String> {
        let chars: Vec<char> = text.chars().collect();
        let (mut rest, mut all) = (String::new(), Vec::new());
        for piece in chars.chunks(length) {
            rest.extend(piece);
            let cut = split_clauses(&rest, language, false);
            all.extend(cut.clauses.iter().map(|clause| (*clause).to_owned()));
            rest = cut.rest.to_owned();
        }
        let last = split_clauses(&rest, language, true);
        all.extend(last.clauses.iter().map(|clause| (*clause).to_owned()));
        all.iter().map(|clause| clause.trim().to_owned()).collect()
    }

    #[test]
    fn a_text_is_cut_at_its_marks_and_neither_in_numbers_nor_after_abbreviations() {
        let whole = split_clauses(TEXT, "en", true);
        let clauses: Vec<&str> = whole.clauses.iter().map(|clause| clause.trim()).collect();
        assert_eq!(
            clauses,
            [
                "Dr. Miller paid 3.50 euros,",
                "e.g. for bread.",
                "Really?!",
                "Well…",
                "the old man who lived there,",
                "as everybody knew, had left;",
                "nobody knew when:",
                "perhaps at 10:30 — or later.",
                "It weighs 1,000 kg! 🙂",
                "Yes.",
                "The end",
            ]
        );
        assert_eq!(whole.clauses.concat(), TEXT);
    }

    #[test]
    fn however_a_text_comes_it_is_cut_at_the_same_places() {
        let bare = |clauses: &[String]| -> Vec<String> {
            let bare = clauses
                .iter()
                .map(|c| c.replace('🙂', "").trim().to_owned());
            bare.filter(|clause| !clause.is_empty()).collect()
        };
        let whole = bare(&in_pieces(TEXT, 10_000, "en"));
        for length in 1..40 {
            assert_eq!(bare(&in_pieces(TEXT, length, "en")), whole, "{length}");
        }
    }

    #[test]
    fn what_has_no_marks_is_cut_between_words_or_anywhere() {
        for text in [
            "word ".repeat(500),
            "x".repeat(2000),
            "🙂".repeat(500),
            "a,".repeat(900),
        ] {
            let ClauseSplit { clauses, rest } = split_clauses(&text, "en", false);
            assert_eq!(clauses.concat() + rest, text);
            for clause in clauses.iter().chain([&rest]) {
                assert!(clause.chars().count() <= MAX_CLAUSE_CHARS + 1, "{clause}");
            }
            assert_eq!(
                split_clauses(&text, "en", true).clauses.concat().trim(),
                text.trim()
            );
        }
    }
}
