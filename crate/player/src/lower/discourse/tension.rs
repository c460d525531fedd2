//! Tension of a story: set by `r:beat`, or derived from its course and its sentences.

use raconteur_actor::TensionKey;
use raconteur_base::text::language::Language;
use raconteur_base::text::sentence::ends_after;
use raconteur_base::text::word::Word;
use raconteur_eml::{ClauseId, Document};
use raconteur_spoken::spoken_clauses;

use super::roles::TurnSpeaker;
use super::spoken::{MarkedUtterance, MarkedWord};

/// Arc of a story's tension by share of its spoken time: it rises to a climax late in the story and
/// falls after it (Rühlemann 2024, doi:10.3389/fpsyg.2024.1477263). *Designed*.
const ARC: [(f64, f64); 4] = [(0.0, 0.25), (0.5, 0.55), (0.8, 0.9), (1.0, 0.3)];
/// Tension of plain narration in stories that are too short for an arc.
const PLAIN: f64 = 0.5;
/// Minimum number of sentences of a story with an arc.
const ARC_SENTENCES: usize = 4;
/// Changes of the tension by features of a sentence, and their bound. *Designed*.
const EXCLAIMED: f64 = 0.1;
const ASKED: f64 = 0.05;
const QUOTED: f64 = 0.05;
const EMPHASISED: f64 = 0.05;
const LONG: f64 = -0.05;
const BOUND: f64 = 0.15;
/// Minimum number of words of a long sentence.
const LONG_WORDS: usize = 16;

/// Sentence with the features that change its tension.
struct Sentence {
    clause: ClauseId,
    start_secs: f64,
    /// Spoken time before it, seconds.
    spoken_secs: f64,
    /// Change of the tension by its features.
    change: f64,
}

/// Returns the tension of a script: a key at the start of each sentence, and one at the end of a
/// story with an arc. `speakers` are those of the words of each utterance, if the story has
/// direct speech.
pub(super) fn tension(
    document: &Document,
    utterances: &[MarkedUtterance<'_>],
    speakers: Option<&[Vec<TurnSpeaker>]>,
) -> Vec<TensionKey> {
    let mut sentences: Vec<Sentence> = Vec::new();
    let mut spoken_secs = 0.0;
    for (index, utterance) in utterances.iter().enumerate() {
        let speakers = speakers.and_then(|all| all.get(index));
        let speakers = speakers.map_or(&[][..], Vec::as_slice);
        add_sentences(&mut sentences, utterance, speakers, spoken_secs);
        spoken_secs += utterance.duration_secs;
    }
    let beats: Vec<(ClauseId, Option<f64>)> = spoken_clauses(document)
        .iter()
        .map(|spoken| (spoken.id, spoken.tension))
        .collect();
    let set = |clause: ClauseId| {
        let place = beats.partition_point(|(id, _)| *id < clause);
        let (_, tension) = beats.get(place).filter(|(id, _)| *id == clause)?;
        *tension
    };
    let has_arc = sentences.len() >= ARC_SENTENCES && spoken_secs > 0.0;
    let mut keys: Vec<TensionKey> = sentences
        .iter()
        .map(|sentence| {
            let derived = || {
                let plain = if has_arc {
                    arc(sentence.spoken_secs / spoken_secs)
                } else {
                    PLAIN
                };
                plain + sentence.change
            };
            TensionKey {
                at_secs: sentence.start_secs,
                tension: set(sentence.clause).unwrap_or_else(derived).clamp(0.0, 1.0),
            }
        })
        .collect();
    let last = sentences
        .last()
        .filter(|last| has_arc && set(last.clause).is_none());
    if let (Some(_), Some(utterance)) = (last, utterances.last()) {
        keys.push(TensionKey {
            at_secs: utterance.start_secs + utterance.duration_secs,
            tension: arc(1.0),
        });
    }
    keys
}

/// Returns the tension of the arc at a share of the spoken time.
fn arc(share: f64) -> f64 {
    let pair = ARC.windows(2).find(|pair| share <= pair[1].0);
    let Some(&[(from, low), (to, high)]) = pair else {
        return ARC[ARC.len() - 1].1;
    };
    low + (high - low) * ((share - from) / (to - from)).clamp(0.0, 1.0)
}

/// Adds the sentences of an utterance. Divisions end sentences.
fn add_sentences(
    sentences: &mut Vec<Sentence>,
    utterance: &MarkedUtterance<'_>,
    speakers: &[TurnSpeaker],
    spoken_secs: f64,
) {
    let language = utterance.language.and_then(Language::from_tag);
    let words = &utterance.words;
    let written: Vec<Word<'_>> = words.iter().map(|word| Word::parse(&word.text)).collect();
    let mut first = 0;
    for at in 0..words.len() {
        let next = words.get(at + 1);
        let divided = next.is_none_or(|word| word.follows_division);
        if !divided && !ends_after(&written, at, language) {
            continue;
        }
        let own = first..at + 1;
        let offset_secs = words[first].start_secs - utterance.start_secs;
        sentences.push(Sentence {
            clause: utterance.clause,
            start_secs: words[first].start_secs,
            spoken_secs: spoken_secs + offset_secs.clamp(0.0, utterance.duration_secs),
            change: change(
                &words[own.clone()],
                &written[at],
                speakers.get(own).unwrap_or_default(),
            ),
        });
        first = at + 1;
    }
}

/// Returns the change of tension by the features of a sentence.
fn change(words: &[MarkedWord], last: &Word<'_>, speakers: &[TurnSpeaker]) -> f64 {
    let mut change = 0.0;
    if last.end.contains('!') {
        change += EXCLAIMED;
    } else if last.end.contains('?') {
        change += ASKED;
    }
    if speakers.iter().any(|s| *s != TurnSpeaker::Narrator) {
        change += QUOTED;
    }
    if words.iter().any(|word| word.emphasized) {
        change += EMPHASISED;
    }
    if change == 0.0 && words.len() >= LONG_WORDS {
        change = LONG;
    }
    change.clamp(-BOUND, BOUND)
}
