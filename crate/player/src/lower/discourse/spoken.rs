//! Words of a script at their story times, with the markup around them.

use std::sync::Arc;

use raconteur_base::order::sort_by_number;
use raconteur_base::text::word::composed;
use raconteur_eml::{
    Age, ClauseId, DivKind, Gender, Level, Markup, Span, Speaker, TextSegment, VoiceText, Word,
};
use raconteur_speech::TimedUtterance;

use crate::lower::cues::UtteranceCue;
use crate::lower::script::Script;

/// Gain of a volume below which speech is hushed; 1 is the usual volume. *Designed*.
const QUIET: f64 = 0.7;

/// Word at its time.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct TimedWord {
    /// The word in lower case, without surrounding punctuation.
    pub(crate) bare: String,
    /// Start, story time, seconds.
    pub(crate) start_secs: f64,
    /// End, story time, seconds.
    pub(crate) end_secs: f64,
}

/// Word of an utterance with the markup around it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct MarkedWord {
    /// The word with attached punctuation.
    pub(super) text: String,
    /// Start, story time, seconds.
    pub(super) start_secs: f64,
    /// End, story time, seconds.
    pub(super) end_secs: f64,
    /// True if it is emphasised.
    pub(super) emphasized: bool,
    /// Speaker of the innermost `r:speaker` around it.
    pub(super) speaker: Option<Arc<str>>,
    /// True if its volume makes it hushed.
    pub(super) quiet: bool,
    /// True if a paragraph begins with it.
    pub(super) begins_paragraph: bool,
    /// True if a division begins or ends before it.
    pub(super) follows_division: bool,
}

/// Utterance of a script with its marked words.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct MarkedUtterance<'s> {
    /// Clause of the utterance.
    pub(super) clause: ClauseId,
    /// Story time of its first sample, seconds.
    pub(super) start_secs: f64,
    /// Length, seconds.
    pub(super) duration_secs: f64,
    /// BCP 47 tag of its language.
    pub(super) language: Option<&'s str>,
    /// Its words; at least one.
    pub(super) words: Vec<MarkedWord>,
}

/// Returns the utterances of a script that have words, sorted by time. Words and utterances without
/// finite times are omitted.
pub(super) fn utterances<'s>(
    script: &'s Script,
    cues: &'s [UtteranceCue],
) -> Vec<MarkedUtterance<'s>> {
    let mut all: Vec<MarkedUtterance<'s>> = cues
        .iter()
        .filter_map(|cue| {
            let text = script.document.clause(cue.clause).kind.spoken_text()?;
            let words = words(&text, &cue.timed);
            let (start_secs, duration_secs) =
                (cue.timed.start_secs, cue.timed.utterance.duration_secs);
            let is_timed = start_secs.is_finite() && duration_secs.is_finite();
            (is_timed && !words.is_empty()).then(|| MarkedUtterance {
                clause: cue.clause,
                start_secs,
                duration_secs: duration_secs.max(0.0),
                language: cue.language.as_deref().or_else(|| script.usual_language()),
                words,
            })
        })
        .collect();
    sort_by_number(&mut all, |utterance| utterance.start_secs);
    all
}

/// Returns the words of an utterance with their markup.
fn words(text: &VoiceText, timed: &TimedUtterance) -> Vec<MarkedWord> {
    let mut marks = marks(text).into_iter();
    let words = timed.utterance.words.iter().map(|word| {
        let mark = marks.next().unwrap_or_default();
        MarkedWord {
            text: word.text.clone(),
            start_secs: timed.story_secs(word.start_secs),
            end_secs: timed.story_secs(word.end_secs.max(word.start_secs)),
            emphasized: word.emphasized,
            speaker: mark.speaker,
            quiet: mark.quiet,
            begins_paragraph: mark.begins_paragraph,
            follows_division: mark.follows_division,
        }
    });
    words
        .filter(|word| word.start_secs.is_finite() && word.end_secs.is_finite())
        .collect()
}

/// Markup around a word.
#[derive(Clone, Debug, Default)]
struct WordMark {
    speaker: Option<Arc<str>>,
    quiet: bool,
    begins_paragraph: bool,
    follows_division: bool,
}

/// Returns the markup around each word of a text. A word belongs to the markup around its first
/// letter or digit.
fn marks(text: &VoiceText) -> Vec<WordMark> {
    let words = text.words();
    let mut marks: Vec<WordMark> = Vec::with_capacity(words.len());
    // Speaker and quietness in the open containers, the innermost last.
    let mut open: Vec<(Option<Arc<str>>, bool)> = Vec::new();
    let mut divisions: Vec<Option<DivKind>> = Vec::new();
    let mut pending = WordMark::default();
    for piece in &text.pieces {
        match piece {
            TextSegment::Text { text, span, .. } => {
                let (speaker, quiet) = open.last().cloned().unwrap_or_default();
                let begun = begun_words(&words[marks.len()..], text, *span);
                for _ in 0..begun {
                    marks.push(WordMark {
                        speaker: speaker.clone(),
                        quiet,
                        ..std::mem::take(&mut pending)
                    });
                }
            }
            TextSegment::Start { markup, .. } => {
                let (outer, quiet) = open.last().cloned().unwrap_or_default();
                open.push(match &**markup {
                    Markup::Speaker(speaker) => (Some(name_of(speaker)), quiet),
                    Markup::Volume(volume) => (outer, is_quiet(&volume.level)),
                    _ => (outer, quiet),
                });
            }
            TextSegment::End => {
                open.pop();
            }
            TextSegment::DivStart { kind, .. } => {
                divisions.push(*kind);
                pending.follows_division = true;
                pending.begins_paragraph |= *kind == Some(DivKind::Paragraph);
            }
            TextSegment::DivEnd => {
                let kind = divisions.pop().flatten();
                pending.follows_division = true;
                pending.begins_paragraph |= kind == Some(DivKind::Paragraph);
            }
            TextSegment::Break { .. }
            | TextSegment::Audio { .. }
            | TextSegment::Marker { .. }
            | TextSegment::Mark { .. } => {}
        }
    }
    marks
}

/// Returns true if a volume makes speech hushed.
fn is_quiet(level: &Level) -> bool {
    match level {
        Level::Word(word) => *word == "quiet",
        Level::Percent(change) => 1.0 + change / 1e2 < QUIET,
        Level::Number(gain) => *gain < QUIET,
    }
}

/// Returns the number of the next words whose first letter or digit is in a piece of text or before
/// it.
fn begun_words(words: &[Word], text: &str, span: Span) -> usize {
    let is_verbatim = text.len() == (span.end - span.start) as usize;
    // A resolved reference has one character, which is anywhere in its source.
    let whole = !is_verbatim && text.contains(char::is_alphanumeric);
    let has_begun = |word: &&Word| {
        let (from, to) = (word.span.start.max(span.start), word.span.end.min(span.end));
        if word.span.end <= span.start {
            true
        } else if from >= to {
            false
        } else if is_verbatim {
            let range = (from - span.start) as usize..(to - span.start) as usize;
            let part = text.get(range).unwrap_or_default();
            part.contains(char::is_alphanumeric)
        } else {
            whole
        }
    };
    words.iter().take_while(has_begun).count()
}

/// Returns the identity of a speaker: the name, or else sex and age.
fn name_of(speaker: &Speaker) -> Arc<str> {
    match &speaker.name {
        Some(name) => name.as_str().into(),
        None => {
            let sex = speaker.gender.map_or("", Gender::word);
            let age = speaker.age.map_or("", Age::word);
            // No name has this character.
            format!("\n{sex} {age}").into()
        }
    }
}

/// Returns a word in lower case, without surrounding punctuation, with straight apostrophes.
pub(super) fn bare(text: &str) -> String {
    let composed = composed(text);
    let trimmed = composed.trim_matches(|c: char| !c.is_alphanumeric());
    trimmed.to_lowercase().replace('\u{2019}', "'")
}

/// Returns the words of utterances for the search of mentions, sorted by time.
pub(super) fn timed_words(utterances: &[MarkedUtterance<'_>]) -> Vec<TimedWord> {
    let words = utterances.iter().flat_map(|utterance| &utterance.words);
    let mut timed: Vec<TimedWord> = words
        .map(|word| TimedWord {
            bare: bare(&word.text),
            start_secs: word.start_secs,
            end_secs: word.end_secs,
        })
        .collect();
    sort_by_number(&mut timed, |word| word.start_secs);
    timed
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lower::cues;

    /// Returns the words of a speech, each with its speaker.
    fn spoken(inner: &str) -> Vec<(String, Option<Arc<str>>)> {
        let eml = format!(
            "<eml xmlns:r='urn:raconteur:eml:1'><body><voice-text>{inner}</voice-text></body></eml>"
        );
        let script = Script::read(&eml, None);
        let cues = cues::utterances(&script);
        let marked = utterances(&script, &cues);
        let words = marked.into_iter().flat_map(|utterance| utterance.words);
        words.map(|word| (word.text, word.speaker)).collect()
    }

    fn by<'w>(words: &'w [(String, Option<Arc<str>>)], speaker: Option<&str>) -> Vec<&'w str> {
        let own = words.iter().filter(|(_, name)| name.as_deref() == speaker);
        own.map(|(word, _)| word.as_str()).collect()
    }

    #[test]
    fn the_innermost_speaker_has_the_word() {
        let words = spoken(
            "He <r:speaker name='a'>said <emph>it: <r:speaker name='b'>yes</r:speaker></emph> \
             sir</r:speaker> then",
        );
        assert_eq!(by(&words, None), ["He", "then"], "narration");
        assert_eq!(by(&words, Some("a")), ["said", "it:", "sir"], "outer");
        assert_eq!(by(&words, Some("b")), ["yes"], "inner");
    }

    #[test]
    fn the_first_letter_of_a_word_decides() {
        let words = spoken(
            "x &#8220;<r:speaker name='a'>Who are</r:speaker>!&#8221; w&#246;<r:speaker \
             name='b'>rld <r:speaker gender='male'>me</r:speaker></r:speaker>",
        );
        assert_eq!(by(&words, Some("a")), ["\u{201c}Who", "are!\u{201d}"], "a");
        assert_eq!(by(&words, None), ["x", "w\u{f6}rld"], "narration");
        assert_eq!(by(&words, Some("\nmale ")), ["me"], "no name");
        assert!(by(&words, Some("b")).is_empty(), "the letter w is outside");
    }

    #[test]
    fn a_bare_word_has_no_punctuation_and_no_capitals() {
        for (text, expected) in [
            ("\u{2014} \u{201c}Goat\u{2019}s!\u{201d}", "goat's"),
            ("\u{c1}gua,", "\u{e1}gua"),
            ("A\u{301}gua", "\u{e1}gua"),
            ("\u{2026}", ""),
            ("goat-house", "goat-house"),
        ] {
            assert_eq!(bare(text), expected, "{text}");
        }
    }
}
