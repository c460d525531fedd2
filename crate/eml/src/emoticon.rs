//! Emoticons and emoji in texts, each with the word of an emotion (F&H section 4.3.2).
//!
//! Word counts, captions, speech and emotions must agree on the tokens that are not words, so all
//! of them use this module.

/// Emoticons of F&H table 4.1. They may also be written with spaces between their signs, as in
/// table 4.2.
pub const EMOTICONS: [(&str, &str); 6] = [
    (":-)", "joy"),
    (":-(", "distress"),
    (":-o", "surprise"),
    (";-)", "kidding"),
    (">:-<", "anger"),
    (":-|", "disgust"),
];

/// Common variants; these have no spaces.
const VARIANTS: [(&str, &str); 17] = [
    (":)", "joy"),
    (":D", "joy"),
    (":-D", "joy"),
    (":o)", "joy"),
    (":(", "distress"),
    (":'(", "distress"),
    (":'-(", "distress"),
    (":o", "surprise"),
    (":O", "surprise"),
    (":-O", "surprise"),
    (";)", "kidding"),
    (":|", "disgust"),
    (">:(", "anger"),
    (">:-(", "anger"),
    (":P", "kidding"),
    (":-P", "kidding"),
    ("<3", "love"),
];

/// Emoji by the word that they stand for, without variation selectors and skin tones.
pub const EMOJI: [(&str, &[&str]); 19] = [
    (
        "joy",
        &[
            "😀", "😃", "😄", "😁", "😆", "😅", "😂", "🤣", "🙂", "😊", "☺", "😇", "🥳", "😸", "😹",
        ],
    ),
    (
        "distress",
        &["😢", "😭", "😥", "🙁", "☹", "😿", "🥺", "😩", "😫"],
    ),
    ("disappointment", &["😞", "😔", "😕"]),
    ("anger", &["😠", "😡", "🤬", "😤"]),
    ("surprise", &["😮", "😯", "😲", "🙀"]),
    ("panic", &["😱"]),
    ("fear", &["😨", "😧"]),
    ("anxiety", &["😟", "😰"]),
    ("kidding", &["😉", "😜", "😝", "😛", "🤪"]),
    ("disgust", &["🤢", "🤮"]),
    ("disliking", &["😐", "😑", "😒", "🙄"]),
    ("shame", &["😳"]),
    ("relief", &["😌", "😮\u{200d}💨"]),
    ("pride", &["😎"]),
    ("gloating", &["😏", "😈"]),
    ("hope", &["🤞"]),
    ("gratitude", &["🙏"]),
    ("admiration", &["🤩", "👏"]),
    (
        "love",
        &["❤", "♥", "😍", "🥰", "😘", "💕", "💖", "💗", "💓"],
    ),
];

/// Characters that may precede a sign in its token, and follow it.
const OPENING: [char; 8] = ['(', '[', '"', '\'', '“', '„', '‘', '«'];
const CLOSING: [char; 14] = [
    '.', ',', ';', ':', '!', '?', '…', ')', ']', '"', '\'', '”', '’', '»',
];

/// Joins emoji into one.
const JOINER: char = '\u{200d}';

/// Returns true if a character belongs to an emoji: it is displayed, but neither spoken nor part of
/// a word.
#[must_use]
pub fn is_emoji(c: char) -> bool {
    matches!(c,
        '\u{1f000}'..='\u{1f2ff}' | '\u{1f300}'..='\u{1faff}' | '\u{2600}'..='\u{27bf}'
        | '\u{231a}' | '\u{231b}' | '\u{23e9}'..='\u{23ff}' | '\u{25fb}'..='\u{25fe}'
        | '\u{2b05}'..='\u{2b07}' | '\u{2b1b}' | '\u{2b1c}' | '\u{2b50}' | '\u{2b55}'
        | '\u{3030}' | '\u{303d}' | '\u{fe0e}' | '\u{fe0f}' | '\u{20e3}'
        | '\u{e0020}'..='\u{e007f}' | JOINER)
        && !c.is_alphanumeric()
}

/// Returns true for skin tones and variation selectors, which change no meaning.
fn is_variation(c: char) -> bool {
    matches!(c, '\u{fe0e}' | '\u{fe0f}' | '\u{1f3fb}'..='\u{1f3ff}')
}

/// Returns the emotion of a token that is an emoticon with at most punctuation around it, and the
/// punctuation after it.
#[must_use]
pub fn whole(token: &str) -> Option<(&'static str, &str)> {
    // No sign is empty, and every sign begins with one of these characters.
    let sign = token.trim_start_matches(OPENING);
    if !sign.starts_with([':', ';', '>', '<']) {
        return None;
    }
    let all = EMOTICONS.iter().chain(&VARIANTS);
    let fits = all.filter_map(|(own, word)| {
        let rest = sign.strip_prefix(own)?;
        rest.chars()
            .all(|c| CLOSING.contains(&c))
            .then_some((*word, rest))
    });
    // Of two that fit, the longer: it leaves less.
    fits.min_by_key(|(_, rest)| rest.len())
}

/// Shows the emoji of a token: the word of each that has one, where its first byte is.
fn each_emoji(token: &str, visit: &mut dyn FnMut(&'static str, usize)) {
    let mut chars = token.char_indices().peekable();
    while let Some((at, c)) = chars.next() {
        if !is_emoji(c) || is_variation(c) || c == JOINER {
            continue;
        }
        let mut end = at + c.len_utf8();
        while let Some((next, c)) = chars.next_if(|(_, c)| is_variation(*c) || *c == JOINER) {
            end = next + c.len_utf8();
            if c == JOINER
                && let Some((next, c)) = chars.next()
            {
                end = next + c.len_utf8();
            }
        }
        let sign = || token[at..end].chars().filter(|c| !is_variation(*c));
        let known = EMOJI
            .iter()
            .find(|(_, own)| own.iter().any(|own| own.chars().eq(sign())));
        if let Some((word, _)) = known {
            visit(word, at);
        }
    }
}

/// Returns the emotions of a token's emoji, before its first letter or digit and after it;
/// consecutive repetitions count once.
#[must_use]
pub fn of_emoji(token: &str) -> [Vec<&'static str>; 2] {
    let mut found = [Vec::new(), Vec::new()];
    let letter = token.find(char::is_alphanumeric).unwrap_or(token.len());
    each_emoji(token, &mut |word, at| {
        let list = &mut found[usize::from(at > letter)];
        if list.last() != Some(&word) {
            list.push(word);
        }
    });
    found
}

/// Returns a token without its emoji; `None` if it has none.
#[must_use]
pub fn without_emoji(token: &str) -> Option<String> {
    if token.is_ascii() || !token.contains(is_emoji) {
        return None;
    }
    Some(token.chars().filter(|c| !is_emoji(*c)).collect())
}

/// Detector of emoticons of F&H table 4.1 that are written with spaces; it remembers the last
/// tokens.
#[derive(Clone, Copy, Debug, Default)]
pub struct Spaced {
    /// The last tokens without a letter or a digit, one behind the other.
    signs: [u8; Self::MAX_SIGN_TOKENS - 1],
    /// Length of each of them, the last one last; 0 for none.
    lengths: [u8; Self::MAX_SIGN_TOKENS - 1],
}

impl Spaced {
    /// Number of tokens of the longest spaced emoticon.
    const MAX_SIGN_TOKENS: usize = 4;

    /// Resets the detector at any other character, which separates the tokens around it.
    pub fn separate(&mut self) {
        *self = Self::default();
    }

    /// Takes the next token. If it ends an emoticon, returns the number of previous tokens in it,
    /// at least one, and its word. `is_word` marks a token with a letter or a digit.
    pub fn take(&mut self, token: &str, is_word: bool) -> Option<(usize, &'static str)> {
        let found = self.ended_by(token);
        if is_word || found.is_some() || token.len() >= Self::MAX_SIGN_TOKENS {
            self.separate();
        } else {
            self.push(token.as_bytes());
        }
        found
    }

    fn pending(&self) -> usize {
        self.lengths.iter().map(|n| usize::from(*n)).sum()
    }

    fn ended_by(&self, token: &str) -> Option<(usize, &'static str)> {
        let held = self.pending();
        let (mut before, mut found) = (0, None);
        for (parts, length) in self.lengths.iter().rev().enumerate() {
            before += usize::from(*length);
            if *length == 0 || before + token.len() > Self::MAX_SIGN_TOKENS {
                break;
            }
            let signs = &self.signs[held - before..held];
            let is = |own: &str| own.as_bytes().strip_prefix(signs) == Some(token.as_bytes());
            if let Some((_, word)) = EMOTICONS.iter().find(|(own, _)| is(own)) {
                found = Some((parts + 1, *word));
            }
        }
        found
    }

    fn push(&mut self, token: &[u8]) {
        // The oldest signs are removed until the new one fits.
        while self.pending() + token.len() > self.signs.len() || self.lengths[0] > 0 {
            let first = self.lengths.iter().position(|n| *n > 0).unwrap_or(0);
            let gone = usize::from(core::mem::take(&mut self.lengths[first]));
            if gone == 0 {
                break;
            }
            self.signs.rotate_left(gone);
        }
        let held = self.pending();
        self.signs[held..held + token.len()].copy_from_slice(token);
        self.lengths.rotate_left(1);
        self.lengths[Self::MAX_SIGN_TOKENS - 2] = token.len() as u8;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whole_tokens_are_emoticons_and_parts_of_others_are_not() {
        for (token, word, rest) in [
            (":-)", "joy", ""),
            (":-).", "joy", "."),
            ("(:-)", "joy", ""),
            (":))", "joy", ")"),
            ("\";-)\"", "kidding", "\""),
            (":D!", "joy", "!"),
            (":o", "surprise", ""),
            (":O?", "surprise", "?"),
            (":o)", "joy", ""),
            (":-o,", "surprise", ","),
            (">:-<", "anger", ""),
            (":|", "disgust", ""),
            (":'(", "distress", ""),
        ] {
            assert_eq!(whole(token), Some((word, rest)), "{token}");
        }
        for token in [
            "a:o", "http://", "8:0", "x:)", ":oh", ":-oh", ":", ":-", ":/", "o", ")", "", "::",
            ":D4", "C:D", "1:)", ":)a", ";", "(", ":d",
        ] {
            assert_eq!(whole(token), None, "{token}");
        }
    }

    #[test]
    fn emoji_are_found_around_a_word_and_taken_from_it() {
        let of = |token: &str| of_emoji(token);
        assert_eq!(of("😀"), [vec!["joy"], vec![]]);
        assert_eq!(of("😂😂😂"), [vec!["joy"], vec![]]);
        assert_eq!(of("😢Oh😱!"), [vec!["distress"], vec!["panic"]]);
        assert_eq!(of("❤\u{fe0f}"), [vec!["love"], vec![]]);
        assert_eq!(of("🙏🏽"), [vec!["gratitude"], vec![]]);
        assert_eq!(of("😮\u{200d}💨"), [vec!["relief"], vec![]]);
        // A joined sequence is a different sign.
        assert_eq!(of("❤\u{fe0f}\u{200d}🔥"), [Vec::<&str>::new(), vec![]]);
        assert_eq!(without_emoji("Hi🐇!").as_deref(), Some("Hi!"));
        for sign in [
            "🐈\u{200d}⬛",
            "⚠\u{fe0e}",
            "⭐",
            "⏰",
            "🏴\u{e0067}\u{e007f}",
            "🀄",
        ] {
            assert_eq!(without_emoji(sign).as_deref(), Some(""), "{sign}");
        }
        assert_eq!(without_emoji("wörld"), None);
        assert_eq!(without_emoji("plain"), None);
    }

    #[test]
    fn signs_with_spaces_are_joined() {
        let parts = |text: &str| -> Vec<(usize, &'static str)> {
            let mut spaced = Spaced::default();
            let is_word = |t: &str| t.contains(char::is_alphanumeric);
            let tokens = text.split(' ');
            tokens
                .filter_map(|token| spaced.take(token, is_word(token)))
                .collect()
        };
        assert_eq!(parts(": - )"), [(2, "joy")]);
        assert_eq!(parts("a :- o b"), [(1, "surprise")]);
        assert_eq!(parts(": -o"), [(1, "surprise")]);
        assert_eq!(parts("> : - <"), [(3, "anger")]);
        assert_eq!(parts("- - : - ( : - |"), [(2, "distress"), (2, "disgust")]);
        assert_eq!(parts("! !! ; - )"), [(2, "kidding")]);
        for none in [": )", ": o", "- o", ": - O", ": - x )", ": - a"] {
            assert_eq!(parts(none), [], "{none}");
        }
    }
}
