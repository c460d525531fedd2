//! Direct speech between quotation marks.

/// Quotation marks of direct speech. Single ones are apostrophes as well, so they do not count.
const MARKS: [char; 6] = ['\u{201c}', '\u{201d}', '\u{201e}', '\u{ab}', '\u{bb}', '"'];

/// Quotation marks at the edges of a word. Marks before its first letter open and later ones
/// close, whichever they are, because languages use the same marks differently.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct WordQuotes {
    /// True if direct speech begins at the word.
    pub opens: bool,
    /// True if direct speech ends after the word.
    pub closes: bool,
}

impl WordQuotes {
    /// Reads the quotation marks of a word with attached punctuation.
    #[must_use]
    pub fn parse(word: &str) -> Self {
        let before = word.find(char::is_alphanumeric).unwrap_or(word.len());
        let (front, rest) = word.split_at(before);
        Self {
            opens: front.contains(MARKS),
            closes: rest.contains(MARKS),
        }
    }
}

/// State of direct speech while the words of a text are read in order.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Quotes {
    /// True if direct speech has begun and not ended.
    pub is_open: bool,
}

impl Quotes {
    /// Reads the next word, and returns true if it is between quotation marks.
    pub fn read(&mut self, word: &str) -> bool {
        let marks = WordQuotes::parse(word);
        let quoted = self.is_open || marks.opens;
        self.is_open = quoted && !marks.closes;
        quoted
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn marks_open_before_a_word_and_close_after_it() {
        for (text, expected) in [
            ("He said: “Go away.” And left.", "Go away."),
            ("Er rief: „Geh weg!“ Und ging.", "Geh weg!"),
            ("Disse: «Vai.» E foi.", "Vai."),
            ("She \"cried\" there.", "cried"),
            ("Nobody’s here.", ""),
            ("It was over.” He left.", ""),
            ("So “it goes on", "it goes on"),
        ] {
            let mut quotes = Quotes::default();
            let words = text.split(' ').filter(|word| quotes.read(word));
            let bare = |word: &str| word.trim_matches(MARKS).to_owned();
            let found: Vec<String> = words.map(bare).collect();
            assert_eq!(found.join(" "), expected, "{text}");
        }
    }
}
