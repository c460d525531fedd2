//! Durations of speech and animations: a trait that the player implements.

use crate::emoticon;
use crate::voice::{Item, is_letter};
use crate::{ClauseId, TextSegment, VoiceText};
use std::ops::ControlFlow;

/// Source of the durations of spoken texts and animations for a `Timeline`. The player takes them
/// from a speech bundle and its library.
pub trait Durations {
    /// Returns the timing of a clause's speech. The text is empty if the clause names a file or
    /// holds a SABLE document.
    fn voice(&self, clause: ClauseId, text: &VoiceText) -> VoiceTiming;

    /// Returns the length of one pass of an animation, seconds; `None` if unknown.
    fn animation(&self, name: &str) -> Option<f64> {
        let _ = name;
        None
    }
}

/// Times of the words and phones of one utterance, seconds from its start.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct VoiceTiming {
    /// Duration of the utterance, seconds.
    pub duration_secs: f64,
    /// Times of the words, one for each of [`VoiceText::words`].
    pub words: Vec<WordTime>,
    /// The phones in order; may be empty when they are not known.
    pub phones: Vec<PhoneTime>,
    /// True if the times are estimated from the text rather than measured.
    pub estimated: bool,
}

/// Start and end of a spoken word within its utterance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WordTime {
    /// Start of the word, seconds from the start of the utterance.
    pub start_secs: f64,
    /// End of the word, seconds from the start of the utterance.
    pub end_secs: f64,
}

/// Phone of an utterance with its start and end.
#[derive(Clone, Debug, PartialEq)]
pub struct PhoneTime {
    /// Symbol in the phone set of the voice.
    pub symbol: String,
    /// Start of the phone, seconds from the start of the utterance.
    pub start_secs: f64,
    /// End of the phone, seconds from the start of the utterance.
    pub end_secs: f64,
    /// Index of its word.
    pub word: usize,
}

/// Estimates durations from the text, for stories without a speech bundle and for tests.
#[derive(Clone, Copy, Debug, Default)]
pub struct EstimatedDurations;

/// Constant time per word, seconds. A word of the average 4.7 letters takes 1/2.7 s, the speech
/// rate of a storyteller; the split keeps short words from being too short: *designed*.
const SECS_PER_WORD: f64 = 0.12;
/// See [`SECS_PER_WORD`].
const SECS_PER_LETTER: f64 = 0.0533;
/// The pause after a comma, a semicolon or a colon: *designed*.
const COMMA_SECS: f64 = 0.2;
/// The pause after the end of a sentence: *designed*.
const SENTENCE_SECS: f64 = 0.45;

impl Durations for EstimatedDurations {
    fn voice(&self, _: ClauseId, text: &VoiceText) -> VoiceTiming {
        let mut timing = VoiceTiming {
            estimated: true,
            ..VoiceTiming::default()
        };
        let mut breaks = text.pieces.iter().filter_map(|piece| match piece {
            TextSegment::Break { msec, span, .. } => Some((span.start, f64::from(*msec) / 1000.0)),
            _ => None,
        });
        let mut next_break = breaks.next();
        // A growing list is copied several times, so the capacity suffices for words of three
        // letters; the excess is released.
        let bytes = text.pieces.iter().map(|piece| match piece {
            TextSegment::Text { text, .. } => text.len(),
            _ => 0,
        });
        timing.words.reserve_exact(bytes.sum::<usize>() / 4 + 1);
        let mut now = 0.0_f64;
        // The end of silence after the last word; the utterance ends with the word.
        let mut resume = 0.0_f64;
        let _ = text.scan(&mut |item| {
            let word = match item {
                Item::Word(word) => word,
                // Punctuation after an emoticon or without a word belongs to the last word.
                Item::Signs(signs) | Item::Emoticon { rest: signs, .. } if now > 0.0 => {
                    resume = resume.max(now + pause_after(signs));
                    return ControlFlow::Continue(());
                }
                _ => return ControlFlow::Continue(()),
            };
            while let Some((_, secs)) = next_break.filter(|&(at, _)| at < word.span.start) {
                resume += secs;
                next_break = breaks.next();
            }
            let start_secs = resume;
            now = start_secs + SECS_PER_WORD + SECS_PER_LETTER * word.letters as f64;
            timing.words.push(WordTime {
                start_secs,
                end_secs: now,
            });
            resume = now + pause_after(word.text());
            ControlFlow::Continue(())
        });
        timing.words.shrink_to_fit();
        let trailing: f64 = next_break
            .iter()
            .copied()
            .chain(breaks)
            .map(|(_, secs)| secs)
            .sum();
        timing.duration_secs = if trailing > 0.0 {
            resume + trailing
        } else {
            now
        };
        timing
    }
}

/// Returns the pause for the punctuation at the end of a word.
fn pause_after(word: &str) -> f64 {
    if word.bytes().next_back().is_some_and(is_letter) {
        return 0.0;
    }
    let is_around =
        |c: char| matches!(c, '"' | '\'' | ')' | '”' | '’' | '»') || emoticon::is_emoji(c);
    let bare = word.trim_end_matches(is_around);
    match bare.chars().next_back() {
        Some('.' | '!' | '?' | '…') => SENTENCE_SECS,
        Some(',' | ';' | ':') => COMMA_SECS,
        _ => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{ClauseKind, parse};

    fn timing(inner: &str) -> VoiceTiming {
        let source = format!("<eml><body><voice-text time='0'>{inner}</voice-text></body></eml>");
        match &parse(&source).document.clauses[0].kind {
            ClauseKind::VoiceText(text) => EstimatedDurations.voice(ClauseId(0), text),
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn the_pace_is_that_of_a_storyteller() {
        let text = "the small white rabbit went home and could not open her own front door again";
        let timing = timing(text);
        let pace = timing.words.len() as f64 / timing.duration_secs;
        assert!((2.4..3.0).contains(&pace), "{pace}");
    }

    #[test]
    fn emoticons_take_no_time_and_punctuation_behind_them_pauses() {
        let plain = timing("One two. Three");
        for text in [
            "One :-) two. Three",
            "One 😀 two. 😀 Three",
            "One two 😂. Three",
            "One :D two :o). Three",
            "One two.😀 Three",
            "One two : - ) . Three",
        ] {
            assert_eq!(timing(text), plain, "{text}");
        }
    }

    #[test]
    fn punctuation_and_breaks_pause() {
        let timing = timing("One, two. <break msec='100'/>Three<break msec='50'/>");
        let gap = |i: usize| timing.words[i + 1].start_secs - timing.words[i].end_secs;
        assert!(
            (gap(0) - COMMA_SECS).abs() < 1e-12,
            "the pause after the comma"
        );
        assert!(
            (gap(1) - SENTENCE_SECS - 0.1).abs() < 1e-12,
            "the pause after the sentence and its break"
        );
        assert!(
            (timing.duration_secs - timing.words[2].end_secs - 0.05).abs() < 1e-12,
            "the pause after the last word"
        );
    }
}
