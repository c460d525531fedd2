//! Spoken tokens, made of phrases, within bounds.

use super::word::{is_joiner, is_letter};
use super::{TOKEN_CHARS, Token, WORD_TOKENS};

impl Token {
    /// Creates a token without punctuation; `None` if `text` has no letter.
    pub(super) fn parse(text: &str) -> Option<Self> {
        let kept: String = text
            .chars()
            .filter_map(|c| match c {
                '\u{2019}' => Some('\''),
                '\u{2010}' | '\u{2011}' => Some('-'),
                c => (is_letter(c) || is_joiner(c)).then_some(c),
            })
            .collect();
        let text = kept.trim_matches(is_joiner).to_owned();
        let said = text.chars().any(char::is_alphabetic);
        said.then(|| Self {
            text,
            punctuation: String::new(),
            ipa: None,
        })
    }
}

/// Splits a phrase into tokens: words with single punctuation signs after them. Long words are cut,
/// and characters beyond the limit of a written word are omitted.
pub(super) fn tokens(phrase: &str) -> Vec<Token> {
    let mut tokens: Vec<Token> = Vec::new();
    for word in phrase.split_whitespace() {
        let body = word.trim_end_matches([',', '.', ';', ':', '!', '?']);
        let chars: Vec<char> = body.chars().collect();
        for piece in chars.chunks(TOKEN_CHARS) {
            tokens.extend(Token::parse(&piece.iter().collect::<String>()));
            if tokens.len() >= WORD_TOKENS {
                return tokens;
            }
        }
        let punctuation = &word[body.len()..];
        if let Some(last) = tokens.last_mut()
            && last.punctuation.is_empty()
        {
            last.punctuation = punctuation.chars().take(3).collect();
        }
    }
    tokens
}

/// Returns a word unchanged, for unsupported languages: without the punctuation around it, split if
/// it is too long, with any characters.
pub(super) fn untouched(core: &str) -> Vec<Token> {
    let kept: Vec<char> = core
        .chars()
        .filter(|c| !c.is_control() && !c.is_whitespace())
        .collect();
    kept.chunks(TOKEN_CHARS)
        .take(WORD_TOKENS)
        .map(|piece| Token {
            text: piece.iter().collect(),
            punctuation: String::new(),
            ipa: None,
        })
        .collect()
}
