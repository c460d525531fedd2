//! Isolated signs between words: each is shown with an adjacent word, because a caption consists of
//! words.

/// Opening signs, which belong to the following word.
const OPENING: &str = "([{«“„‚‹¿¡‘";
/// Closing signs, and signs that continue after a closing one.
const CLOSING: &str = ")]}»”’›'\".,;:!?…";
/// Signs that belong to the following number if no number precedes them.
const BEFORE_NUMBERS: &str = "$€£¥₹¢#§~±√<>≤≥≈+−-";

/// Returns the number of `signs` between two words that belong to the word before; the others
/// belong to the word after. Without a word before, or after, all belong to the other.
#[must_use]
pub fn belonging_to_previous(signs: &[&str], previous: Option<&str>, next: Option<&str>) -> usize {
    let (Some(previous), Some(next)) = (previous, next) else {
        return if previous.is_some() { signs.len() } else { 0 };
    };
    let is_number = |c: char| c.is_numeric();
    let after_number = previous.ends_with(is_number);
    let before_number = next.trim_start_matches(['.', '-']).starts_with(is_number);
    let mut before = previous;
    signs
        .iter()
        .position(|sign| {
            let is_next =
                // After a punctuation mark, signs begin a phrase, except closing signs.
                is_marked(before) && !sign.chars().all(|c| CLOSING.contains(c))
                || sign.ends_with(|c| OPENING.contains(c))
                || before_number
                    && !after_number
                    && sign.chars().all(|c| BEFORE_NUMBERS.contains(c))
                    && *sign != "-";
            before = sign;
            is_next
        })
        .unwrap_or(signs.len())
}

/// Returns true if a word or sign ends with a punctuation mark, ignoring quotes and brackets.
fn is_marked(text: &str) -> bool {
    text.trim_end_matches([')', ']', '}', '»', '”', '’', '›', '\'', '"'])
        .ends_with(['.', ',', ';', ':', '!', '?', '\u{2026}'])
}

/// Appends a separate sign to the word that it belongs to. No language separates full stops and
/// commas; text between them and the word is not shown.
pub fn attach(word: &mut String, sign: &str) {
    if !sign.starts_with(['.', ',', '\u{2026}']) {
        word.push(' ');
    }
    word.push_str(sign);
}

/// Builder of words for display, for example in captions; attaches free-standing signs to
/// neighbouring words.
#[derive(Debug, Default)]
pub struct DisplayedWords {
    words: Vec<String>,
    /// Since the last word.
    signs: Vec<String>,
    /// True if the last word accepts no more signs.
    is_parted: bool,
}

impl DisplayedWords {
    /// Adds a word.
    pub fn word(&mut self, text: &str) {
        let kept = self.settle(Some(text));
        let mut shown = kept.join(" ");
        if !shown.is_empty() {
            shown.push(' ');
        }
        shown.push_str(text);
        self.words.push(shown);
        self.is_parted = false;
    }

    /// Appends signs that belong to no word, such as a dash, an ampersand or an emoji.
    pub fn sign(&mut self, text: &str) {
        self.signs.push(text.to_owned());
    }

    /// Removes the last `signs` signs, which were an emoticon and are not shown.
    pub fn remove_last(&mut self, signs: usize) {
        self.signs.truncate(self.signs.len().saturating_sub(signs));
    }

    /// Marks a pause, a recording or the end of a division, which signs do not cross.
    pub fn separate(&mut self) {
        if !self.words.is_empty() && !self.is_parted {
            self.settle(None);
            self.is_parted = true;
        }
    }

    /// Returns all words, with their signs attached.
    #[must_use]
    pub fn finish(mut self) -> Vec<String> {
        self.is_parted = false;
        self.settle(None);
        self.words
    }

    /// Attaches pending signs to the previous word, and returns those that belong to the next.
    fn settle(&mut self, next: Option<&str>) -> Vec<String> {
        let mut signs = core::mem::take(&mut self.signs);
        let previous = self.words.last_mut().filter(|_| !self.is_parted);
        let count = belonging_to_previous(
            &signs.iter().map(String::as_str).collect::<Vec<_>>(),
            previous.as_deref().map(String::as_str),
            next,
        );
        let after = signs.split_off(count);
        if let Some(previous) = previous {
            for sign in signs {
                attach(previous, &sign);
            }
        }
        after
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shown(text: &str) -> Vec<String> {
        let mut shown = DisplayedWords::default();
        for token in text.split(' ') {
            match token {
                "|" => shown.separate(),
                _ if token.contains(char::is_alphanumeric) => shown.word(token),
                _ => shown.sign(token),
            }
        }
        shown.finish()
    }

    #[test]
    fn every_sign_is_shown_with_a_word() {
        for (text, words) in [
            (
                "Mr Fox & Co. pay 5 % more.",
                &["Mr", "Fox &", "Co.", "pay", "5 %", "more."][..],
            ),
            ("What is 2 + 2 = 4?", &["What", "is", "2 +", "2 =", "4?"]),
            (
                "for € 5 or 5 € or $ 7",
                &["for", "€ 5", "or", "5 €", "or", "$ 7"],
            ),
            ("— so – it is —", &["— so –", "it", "is —"]),
            ("he said « yes »", &["he", "said", "« yes »"]),
            ("one — | & two", &["one —", "& two"]),
            (
                "It ended. — Then “ it” & so.",
                &["It", "ended.", "— Then", "“ it” &", "so."],
            ),
            ("% |", &[]),
        ] {
            assert_eq!(shown(text), words, "{text}");
        }
    }
}
