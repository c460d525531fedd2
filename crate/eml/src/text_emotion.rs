//! Emotions of a spoken text: its emoticons and their phrases (F&H section 4.3.5).

use crate::VoiceText;
use crate::emoticon::is_emoji;
use crate::voice::Item;
use std::ops::ControlFlow;

/// Emoticon or emoji in a spoken text, with the phrase on which its emotion is expressed. Words are
/// indices of [`VoiceText::words`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Emoticon {
    /// The word of its emotion.
    pub name: &'static str,
    /// Index of the following word; at the end, the number of words.
    pub before: usize,
    /// First word on which the emotion is expressed.
    pub first_word: usize,
    /// Last word on which the emotion is expressed. First and last word bound the emoticon's phrase,
    /// or both phrases if it is between two.
    pub last_word: usize,
}

/// A potential phrase border, pending until its signs are known to be an emoticon or not.
struct Border {
    words: usize,
    ends: bool,
    is_sign: bool,
}

impl VoiceText {
    /// Returns the emoticons and emoji in order. A phrase ends with punctuation, a dash, a pause, a
    /// recording or a division: the same for baked and unbaked text. In a text without words, first
    /// and last word are 0.
    #[must_use]
    pub fn emoticons(&self) -> Vec<Emoticon> {
        let mut found: Vec<(&'static str, usize)> = Vec::new();
        let mut borders: Vec<Border> = Vec::new();
        let mut words = 0;
        let _ = self.scan(&mut |item| {
            let (ends, is_sign) = match item {
                Item::Word(token) => {
                    words += 1;
                    (ends_phrase(token.text()), false)
                }
                Item::Signs(signs) => (is_border(signs), true),
                Item::Gap => (true, false),
                Item::Emoticon { name, parts, rest } => {
                    for _ in 0..parts {
                        borders.pop_if(|border| border.is_sign);
                    }
                    found.push((name, words));
                    (is_border(rest), false)
                }
                Item::Mark(_) => return ControlFlow::Continue(()),
            };
            borders.push(Border {
                words,
                ends,
                is_sign,
            });
            ControlFlow::Continue(())
        });
        let ends = borders.iter().filter(|border| border.ends);
        let mut ends: Vec<usize> = ends.map(|border| border.words).collect();
        ends.push(words);
        let phrase_of = |word: usize| {
            let next = ends.partition_point(|end| *end <= word);
            let first = next.checked_sub(1).map_or(0, |i| ends[i]);
            (word < words).then(|| (first, ends[next] - 1))
        };
        let phrases = |(name, before): (&'static str, usize)| {
            let left = before.checked_sub(1).and_then(phrase_of);
            let right = phrase_of(before);
            Emoticon {
                name,
                before,
                first_word: left.or(right).map_or(0, |(first, _)| first),
                last_word: right.or(left).map_or(0, |(_, last)| last),
            }
        };
        found.into_iter().map(phrases).collect()
    }
}

/// Returns true if signs that are separate, or behind an emoticon, end a phrase.
fn is_border(signs: &str) -> bool {
    signs.contains(['.', ',', ';', ':', '!', '?', '…', '-', '–', '—'])
}

/// Returns true if a word ends its phrase.
fn ends_phrase(word: &str) -> bool {
    let is_around =
        |c: char| matches!(c, '"' | '\'' | ')' | ']' | '”' | '“' | '’' | '»' | '«') || is_emoji(c);
    let bare = word.trim_end_matches(is_around);
    bare.ends_with(['.', ',', ';', ':', '!', '?', '…', '–', '—'])
}

#[cfg(test)]
mod tests {
    use crate::{ClauseKind, parse};

    fn emoticons_in(text: &str) -> Vec<(&'static str, usize, usize, usize)> {
        let source = format!("<eml><body><voice-text time='0'>{text}</voice-text></body></eml>");
        let Some(ClauseKind::VoiceText(voice)) =
            parse(&source).document.clauses.pop().map(|c| c.kind)
        else {
            panic!("{text}")
        };
        let found = voice.emoticons();
        found
            .iter()
            .map(|e| (e.name, e.before, e.first_word, e.last_word))
            .collect()
    }

    #[test]
    fn an_emoticon_has_its_phrase_or_the_two_between_which_it_stands() {
        // F&H figure 4.7 and table 4.2.
        assert_eq!(
            emoticons_in("Hi! ;-) Can you show me the way to the conference hall? :-)"),
            [("kidding", 1, 0, 10), ("joy", 11, 1, 10)]
        );
        assert_eq!(
            emoticons_in("Es gingen zwei Parallelen <break msec='9'/>ins ;-) Endlose hinaus, zwei"),
            [("kidding", 5, 4, 6)]
        );
        assert_eq!(
            emoticons_in("bis an ihr seliges Grab: :-( Das war nun einmal"),
            [("distress", 5, 0, 8)]
        );
    }

    #[test]
    fn signs_of_an_emoticon_end_no_phrase_and_others_do() {
        assert_eq!(emoticons_in("one : - ) two"), [("joy", 1, 0, 1)]);
        assert_eq!(emoticons_in("one - two :-) three"), [("joy", 2, 1, 2)]);
        assert_eq!(emoticons_in("one :-), two"), [("joy", 1, 0, 1)]);
        assert_eq!(emoticons_in("one 😀. Two three"), [("joy", 1, 0, 2)]);
        assert_eq!(
            emoticons_in("one two😢 three. Four"),
            [("distress", 2, 0, 2)]
        );
        assert_eq!(
            emoticons_in("😀One 😱"),
            [("joy", 0, 0, 0), ("panic", 1, 0, 0)]
        );
        assert_eq!(emoticons_in(":-) "), [("joy", 0, 0, 0)]);
        assert_eq!(emoticons_in("at 8:0, http://a:o a:o :oh"), []);
    }
}
