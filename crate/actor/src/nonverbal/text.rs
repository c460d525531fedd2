//! Pitch predicted from the text: accents, phrases and their boundary tones (F&H section 4.3.5,
//! "Expressions linked to intonation").

use raconteur_base::curve::ramp;
use raconteur_base::noise;
use raconteur_speech::bundle::Phrase;
use raconteur_speech::{TimedUtterance, Utterance, Word};

use super::accent::Accent;
use super::extreme::Extreme;
use crate::idle::stream;

/// Maximum time from an accent to the lowest pitch after it, seconds. Designed.
const FALL_SECS: f64 = 0.45;
/// Accents nearer to each other than this have no lowest pitch between, seconds. Designed.
const NEAR_SECS: f64 = 0.45;
/// A word longer than this has an accent more often, and a guessed accent is no longer,
/// seconds. Designed.
const LONG_WORD_SECS: f64 = 0.3;
/// Share by which the last accent of a phrase is lower than its first: declination. Designed.
const DECLINATION: f64 = 0.3;

/// Returns the height of an accent with a ToBI label in the speaker's range, 0 to 1; `None` for a
/// low one. Designed after the labels' meanings (Beckman and Ayers 1997).
fn height_of(label: &str) -> Option<f64> {
    if label.starts_with("L*") {
        None
    } else if label.contains('!') {
        Some(0.5)
    } else if label.starts_with("L+") {
        Some(1.0)
    } else {
        Some(0.75)
    }
}

/// Returns the final height of a phrase with a final rise, by the label of its boundary tone.
fn rise_of(tone: &str) -> Option<f64> {
    let is_rising = tone.ends_with("H%");
    is_rising.then_some(if tone.starts_with('H') { 0.9 } else { 0.5 })
}

/// Returns the accents of an utterance without known accents: on some of the longer words, which
/// carry most accents (F&H section 4.3.2: on content words).
pub(super) fn accents(u: &Utterance, seed: u64) -> Vec<Accent> {
    let is_accented = |(i, word): &(usize, &Word)| {
        let is_long = word.end_secs - word.start_secs > LONG_WORD_SECS;
        let share = if is_long { 0.5 } else { 0.1 };
        noise::unit(seed, stream::ACCENT, *i as i64) < share
    };
    let words = u.words.iter().enumerate().filter(is_accented);
    words
        .map(|(_, word)| Accent {
            start_secs: word.start_secs,
            end_secs: word.end_secs.min(word.start_secs + LONG_WORD_SECS),
            strength: 0.8,
            label: String::new(),
        })
        .collect()
}

/// Adds the assumed pitch of an utterance: a maximum in the middle of each accented syllable and at
/// the end of each rising phrase, with minima between.
pub(super) fn extremes(timed: &TimedUtterance, accents: &[Accent], out: &mut Vec<Extreme>) {
    let u = &*timed.utterance;
    let mut maxima: Vec<(f64, f64)> = Vec::with_capacity(accents.len());
    for accent in accents {
        if let Some(height) = height_of(&accent.label) {
            let at_secs = 0.5 * (accent.start_secs + accent.end_secs);
            let lower = 1.0 - DECLINATION * share_of_phrase(u, at_secs);
            let height = height * lower * accent.strength;
            maxima.push((at_secs, height.clamp(0.15, 1.0)));
        }
    }
    for phrase in &u.phrases {
        let last = phrase
            .first_word
            .saturating_add(phrase.words)
            .checked_sub(1);
        let word = last.and_then(|last| u.words.get(last));
        if let Some((word, height)) = word.zip(rise_of(&phrase.tone)) {
            maxima.push((word.end_secs, height));
        }
    }
    raconteur_base::order::sort_by_number(&mut maxima, |m| m.0);
    let mut push = |at_secs: f64, height: f64| {
        out.push(Extreme {
            at_secs: timed.story_secs(at_secs),
            height,
            is_question: false,
        });
    };
    for (i, (at_secs, height)) in maxima.iter().enumerate() {
        push(*at_secs, *height);
        let gap_secs = maxima
            .get(i + 1)
            .map_or(f64::INFINITY, |next| next.0 - at_secs);
        if gap_secs >= NEAR_SECS {
            push(at_secs + FALL_SECS.min(0.5 * gap_secs), 0.0);
        }
    }
}

/// Returns the relative position of a time in its phrase, 0 to 1; 0 if no phrases are known.
fn share_of_phrase(u: &Utterance, at_secs: f64) -> f64 {
    let start = |phrase: &Phrase| u.words.get(phrase.first_word).map(|w| w.start_secs);
    let begun = u
        .phrases
        .partition_point(|p| start(p).is_some_and(|start| start <= at_secs));
    let Some(phrase) = begun.checked_sub(1).map(|i| &u.phrases[i]) else {
        return 0.0;
    };
    let last = phrase
        .first_word
        .saturating_add(phrase.words)
        .checked_sub(1);
    let end = last.and_then(|last| u.words.get(last)).map(|w| w.end_secs);
    start(phrase)
        .zip(end)
        .map_or(0.0, |(from, to)| ramp(from, to, at_secs))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::Arc;

    #[test]
    fn accents_raise_and_their_labels_tell_how_far() {
        let accent = |start_secs: f64, label: &str| Accent {
            start_secs,
            end_secs: start_secs + 0.2,
            strength: 1.0,
            label: label.to_owned(),
        };
        let word = |start_secs: f64, end_secs: f64| Word {
            text: "word".to_owned(),
            start_secs,
            end_secs,
            emphasized: false,
        };
        let accents: Vec<Accent> = ["L+H*", "L*", "!H*"]
            .iter()
            .zip([0.0, 0.5, 2.0])
            .map(|(l, t)| accent(t, l))
            .collect();
        let u = Utterance {
            duration_secs: 3.0,
            words: vec![word(0.0, 1.0), word(1.0, 2.9)],
            phrases: vec![Phrase {
                first_word: 0,
                words: 2,
                tone: "L-H%".to_owned(),
            }],
            ..Utterance::default()
        };
        let timed = TimedUtterance {
            start_secs: 5.0,
            utterance: Arc::new(u),
        };
        let mut out = Vec::new();
        extremes(&timed, &accents, &mut out);
        let times: Vec<f64> = out.iter().map(|e| e.at_secs - 5.0).collect();
        let heights: Vec<bool> = out.iter().map(|e| e.height > 0.0).collect();
        assert_eq!(heights, [true, false, true, false, true, false]);
        for (time, wanted) in times.iter().zip([0.1, 0.55, 2.1, 2.5, 2.9, 3.35]) {
            assert!((time - wanted).abs() < 1e-9, "{times:?}");
        }
        assert!(
            out[0].height > out[2].height,
            "the first accent is higher than the second"
        );
    }
}
