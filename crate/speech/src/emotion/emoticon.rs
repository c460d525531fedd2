//! Emoticons and their words (F&H 4.3.2).

/// F&H table 4.1, each with a word of [`WORDS`](super::WORDS).
pub const EMOTICONS: [(&str, &str); 6] = [
    (":-)", "joy"),
    (":-(", "distress"),
    (":-o", "surprise"),
    (";-)", "kidding"),
    (">:-<", "anger"),
    (":-|", "disgusted"),
];

/// The word of an emoticon that is a whole token.
#[must_use]
pub fn of_emoticon(token: &str) -> Option<&'static str> {
    let (_, word) = EMOTICONS
        .iter()
        .find(|(sign, _)| sign.eq_ignore_ascii_case(token))?;
    Some(word)
}

/// Whether a token is an emoticon.
#[must_use]
pub fn is_emoticon(token: &str) -> bool {
    of_emoticon(token).is_some()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::emotion::place;

    #[test]
    fn every_emoticon_has_a_word_of_the_table() {
        for (sign, word) in EMOTICONS {
            assert_eq!(of_emoticon(sign), Some(word));
            assert!(place(word).is_some());
        }
    }
}
