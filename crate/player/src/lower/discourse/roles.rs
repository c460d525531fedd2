//! Direct speech: the turns of a script's speakers, and the sides of its characters.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use raconteur_actor::RoleSpan;
use raconteur_base::text::quotes::{Quotes, WordQuotes};

use super::spoken::MarkedUtterance;

/// Sides of the first four characters; further ones share them in the same order.
const SIDES: [f64; 4] = [-0.6, 0.6, -1.0, 1.0];
/// Successive spans of one character closer than this are one, seconds.
const MERGE_SECS: f64 = 0.6;

/// Speaker of a turn.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum TurnSpeaker {
    /// The storyteller as narrator.
    Narrator,
    /// Character named by `r:speaker`.
    Named(Arc<str>),
    /// Character without a name, between quotation marks.
    Quoted,
}

/// Successive words of one speaker.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Turn {
    /// Start of the first word, story time, seconds.
    pub(crate) start_secs: f64,
    /// End of the last word, story time, seconds.
    pub(crate) end_secs: f64,
    /// The speaker.
    pub(crate) speaker: TurnSpeaker,
}

/// Returns the speaker of each word of each utterance: by `r:speaker` if the script has any, else
/// by quotation marks.
pub(super) fn speakers(utterances: &[MarkedUtterance<'_>]) -> Vec<Vec<TurnSpeaker>> {
    let mut words = utterances.iter().flat_map(|utterance| &utterance.words);
    if words.any(|word| word.speaker.is_some()) {
        let of_word = |speaker: &Option<Arc<str>>| match speaker {
            Some(name) => TurnSpeaker::Named(Arc::clone(name)),
            None => TurnSpeaker::Narrator,
        };
        let words = utterances.iter().map(|utterance| utterance.words.iter());
        return words
            .map(|words| words.map(|word| of_word(&word.speaker)).collect())
            .collect();
    }
    let mut quotes = Quotes::default();
    let mut all = Vec::with_capacity(utterances.len());
    for utterance in utterances {
        // Direct speech goes on in the next utterance only if that one ends it.
        let mut marks = utterance.words.iter().map(|w| WordQuotes::parse(&w.text));
        let first = marks.find(|marks| marks.opens || marks.closes);
        quotes.is_open &= first.is_some_and(|marks| !marks.opens);
        let of_word = |text: &str| match quotes.read(text) {
            true => TurnSpeaker::Quoted,
            false => TurnSpeaker::Narrator,
        };
        let words = utterance.words.iter().map(|word| word.text.as_str());
        all.push(words.map(of_word).collect());
    }
    all
}

/// Returns the turns of a script, in order.
pub(super) fn turns(
    utterances: &[MarkedUtterance<'_>],
    speakers: &[Vec<TurnSpeaker>],
) -> Vec<Turn> {
    let mut turns: Vec<Turn> = Vec::new();
    for (utterance, speakers) in utterances.iter().zip(speakers) {
        let mut is_first = true;
        for (word, speaker) in utterance.words.iter().zip(speakers) {
            // Utterances may be far apart, so each begins a turn.
            let last = turns.last_mut().filter(|turn| turn.speaker == *speaker);
            match last.filter(|_| !is_first) {
                Some(turn) => turn.end_secs = turn.end_secs.max(word.end_secs),
                None => turns.push(Turn {
                    start_secs: word.start_secs,
                    end_secs: word.end_secs,
                    speaker: speaker.clone(),
                }),
            }
            is_first = false;
        }
    }
    turns
}

/// Returns true if turns have several speakers; a story of one character has no direct speech.
pub(super) fn has_roles(turns: &[Turn]) -> bool {
    turns
        .windows(2)
        .any(|pair| pair[0].speaker != pair[1].speaker)
}

/// Sides of characters, in order of their appearance in scripts that follow each other.
#[derive(Default)]
pub(super) struct Roles {
    /// Spans of direct speech with the numbers of their characters.
    spans: Vec<(Character, RoleSpan)>,
    speakers: BTreeSet<TurnSpeaker>,
    numbers: BTreeMap<Arc<str>, usize>,
    /// Number of quotes separated by narration.
    quotes: usize,
    /// True if narration follows the last quote.
    has_narrated: bool,
}

/// Number of a character: by name, or by quote.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Character {
    Named(usize),
    Quoted(usize),
}

impl Roles {
    /// Adds the turns of the next script. Its direct speech counts if it and the scripts before it
    /// have several speakers, so a later script changes nothing before it.
    pub(super) fn add(&mut self, turns: &[Turn]) {
        let speakers = turns.iter().map(|turn| turn.speaker.clone());
        self.speakers.extend(speakers);
        let has_roles = self.speakers.len() > 1;
        for turn in turns {
            let (character, side) = match &turn.speaker {
                TurnSpeaker::Narrator => {
                    self.has_narrated = true;
                    continue;
                }
                TurnSpeaker::Named(name) => {
                    let next = self.numbers.len();
                    let number = *self.numbers.entry(Arc::clone(name)).or_insert(next);
                    (Character::Named(number), SIDES[number % SIDES.len()])
                }
                TurnSpeaker::Quoted => {
                    if std::mem::take(&mut self.has_narrated) || self.quotes == 0 {
                        self.quotes += 1;
                    }
                    let number = self.quotes - 1;
                    (Character::Quoted(number), SIDES[number % 2])
                }
            };
            if has_roles {
                self.push(character, turn, side);
            }
        }
    }

    fn push(&mut self, character: Character, turn: &Turn, side: f64) {
        if let Some((last, span)) = self.spans.last_mut()
            && *last == character
            && turn.start_secs - span.end_secs < MERGE_SECS
        {
            span.start_secs = span.start_secs.min(turn.start_secs);
            span.end_secs = span.end_secs.max(turn.end_secs);
            return;
        }
        let span = RoleSpan {
            start_secs: turn.start_secs,
            end_secs: turn.end_secs,
            side,
        };
        self.spans.push((character, span));
    }

    /// Returns all spans of direct speech.
    pub(super) fn finish(self) -> Vec<RoleSpan> {
        self.spans.into_iter().map(|(_, span)| span).collect()
    }
}
