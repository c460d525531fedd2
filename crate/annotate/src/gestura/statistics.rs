//! Statistics of a transcription (GEVH C.1, step 5).

use std::collections::BTreeMap;

use raconteur_base::Side;
use raconteur_base::order::sort_by_number;
use serde::Serialize;

use super::{Interval, Noted, PhaseKind, Transcription, Vocabulary, beat_score};
use crate::gsl::Shape;

/// Figures of a transcription.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Statistics {
    /// Length from the first to the last annotation, seconds.
    pub length_secs: f64,
    /// Number of words, pauses not counted.
    pub words: usize,
    /// Number of utterances.
    pub utterances: usize,
    /// Number of gestures of all classes; without pass 4, the number of phrases.
    pub gestures: usize,
    /// Utterances by discourse level.
    pub levels: Vec<Tally>,
    /// Gestures by class.
    pub classes: Vec<Tally>,
    /// Phrases by dimension.
    pub dimensions: Vec<Tally>,
    /// Phrases by hands.
    pub hands: Vec<Tally>,
    /// Phrases with both hands that mirror each other.
    pub symmetric: usize,
    /// Phrases by the score of the beat filter, from 0 on.
    pub beat_scores: Vec<usize>,
    /// Gestures that begin in each half minute.
    pub per_half_minute: Vec<usize>,
    /// Durations of phases by kind.
    pub phases: Vec<Durations>,
    /// Number of phases with each hand shape, most frequent first.
    pub shapes: Vec<(u8, usize)>,
    /// Phrases by confidence, 1 to 4.
    pub confidence: [usize; 4],
    /// Time from the start of the stroke to the start of the nearest word, seconds, mean over the
    /// phrases; positive when the word comes later. `None` without words or strokes.
    pub stroke_lead_secs: Option<f64>,
}

/// Count of the annotations with one value.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Tally {
    /// Value; `none` for annotations without one.
    pub name: &'static str,
    /// Number of annotations.
    pub count: usize,
}

/// Durations of the phases of one kind.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Durations {
    /// Kind.
    pub name: &'static str,
    /// Number of phases.
    pub count: usize,
    /// Mean, seconds.
    pub mean_secs: f64,
    /// Standard deviation, seconds.
    pub deviation_secs: f64,
    /// Shortest, seconds.
    pub least_secs: f64,
    /// Longest, seconds.
    pub most_secs: f64,
}

impl Statistics {
    /// Counts a transcription.
    #[must_use]
    pub fn new(transcription: &Transcription) -> Self {
        let layers = &transcription.layers;
        let phases = || layers.iter().flat_map(|layer| &layer.phases);
        let phrases = || layers.iter().flat_map(|layer| &layer.phrases);
        let words = &transcription.words;
        let scores = layers.iter().flat_map(|layer| {
            layer
                .phrases
                .iter()
                .map(|phrase| beat_score(layer, phrase).total() as usize)
        });
        let mut beat_scores = Vec::new();
        for score in scores {
            beat_scores.resize(beat_scores.len().max(score + 1), 0);
            beat_scores[score] += 1;
        }
        let mut confidence = [0; 4];
        for level in phrases().filter_map(|phrase| phrase.confidence) {
            confidence[usize::from(level.clamp(1, 4)) - 1] += 1;
        }
        let levels = transcription.levels.iter();
        let levels = levels.flat_map(|span| span.utterances.clone().map(|_| Some(span.level)));
        let gestures = transcription.gestures.len();
        Self {
            length_secs: length_secs(transcription),
            words: words.iter().filter(|word| word.is_spoken()).count(),
            utterances: transcription.utterances.len(),
            gestures: if gestures == 0 {
                phrases().count()
            } else {
                gestures
            },
            levels: tallies(levels),
            classes: tallies(transcription.gestures.iter().map(|g| Some(g.class))),
            dimensions: tallies(phrases().map(|phrase| phrase.dimension)),
            hands: tallies(phrases().map(|phrase| phrase.handedness)),
            symmetric: phrases()
                .filter(|phrase| phrase.symmetry == Some(true))
                .count(),
            beat_scores,
            per_half_minute: per_half_minute(transcription),
            phases: durations(transcription),
            shapes: shapes(phases().filter_map(|phase| phase.form.hand_shapes.as_ref())),
            confidence,
            stroke_lead_secs: stroke_lead_secs(transcription),
        }
    }

    /// Returns the gestures per minute; 0 without length.
    #[must_use]
    pub fn gestures_per_minute(&self) -> f64 {
        if self.length_secs > 0.0 {
            60.0 * self.gestures as f64 / self.length_secs
        } else {
            0.0
        }
    }
}

/// Returns the time from the first to the last annotation, seconds.
fn length_secs(transcription: &Transcription) -> f64 {
    let layers = &transcription.layers;
    let words = transcription.words.iter().map(|word| word.interval);
    let gestures = transcription
        .gestures
        .iter()
        .map(|gesture| gesture.interval);
    let phases = layers
        .iter()
        .flat_map(|layer| layer.phases.iter().map(|phase| phase.interval));
    let all = words.chain(gestures).chain(phases);
    all.reduce(Interval::to).map_or(0.0, Interval::length_secs)
}

/// Counts gestures by the half minute in which they begin; without pass 4, phrases.
fn per_half_minute(transcription: &Transcription) -> Vec<usize> {
    let layers = transcription.layers.iter();
    let phrases = layers.flat_map(|layer| {
        layer
            .phrases
            .iter()
            .filter_map(|phrase| layer.phrase_interval(phrase))
    });
    let gestures = transcription
        .gestures
        .iter()
        .map(|gesture| gesture.interval);
    let starts: Vec<f64> = if transcription.gestures.is_empty() {
        phrases.map(|interval| interval.start_secs).collect()
    } else {
        gestures.map(|interval| interval.start_secs).collect()
    };
    let mut counts = Vec::new();
    for start_secs in starts {
        let half = (start_secs.max(0.0) / 30.0) as usize;
        counts.resize(counts.len().max(half + 1), 0);
        counts[half] += 1;
    }
    counts
}

/// Counts values in the order of their list, those without one last.
fn tallies<V: Vocabulary>(values: impl Iterator<Item = Option<V>>) -> Vec<Tally> {
    let values: Vec<Option<V>> = values.collect();
    let known = V::WORDS.iter().map(|(value, word)| (Some(*value), *word));
    known
        .chain([(None, "none")])
        .map(|(value, name)| Tally {
            name,
            count: values.iter().filter(|v| **v == value).count(),
        })
        .filter(|tally| tally.count > 0)
        .collect()
}

fn durations(transcription: &Transcription) -> Vec<Durations> {
    let of_kind = |&(kind, name): &(PhaseKind, &'static str)| {
        let phases = transcription.layers.iter().flat_map(|layer| &layer.phases);
        let lengths: Vec<f64> = phases
            .filter(|phase| phase.kind == kind)
            .map(|phase| phase.interval.length_secs())
            .collect();
        let count = lengths.len() as f64;
        let mean_secs = lengths.iter().sum::<f64>() / count;
        let squares = lengths
            .iter()
            .map(|length| (length - mean_secs) * (length - mean_secs));
        (!lengths.is_empty()).then(|| Durations {
            name,
            count: lengths.len(),
            mean_secs,
            deviation_secs: (squares.sum::<f64>() / count).sqrt(),
            least_secs: lengths.iter().copied().fold(f64::INFINITY, f64::min),
            most_secs: lengths.iter().copied().fold(0.0, f64::max),
        })
    };
    PhaseKind::WORDS.iter().filter_map(of_kind).collect()
}

fn shapes<'a>(noted: impl Iterator<Item = &'a Noted<Shape>>) -> Vec<(u8, usize)> {
    let mut counts: BTreeMap<u8, usize> = BTreeMap::new();
    for value in noted.filter_map(|noted| noted.value.as_ref()) {
        let sequences = Side::BOTH
            .into_iter()
            .filter_map(|side| value.for_hand(side));
        let mut ids: Vec<u8> = sequences
            .flat_map(|s| s.items.iter().map(|item| item.feature.0))
            .collect();
        ids.sort_unstable();
        ids.dedup();
        for id in ids {
            *counts.entry(id).or_default() += 1;
        }
    }
    let mut counts: Vec<(u8, usize)> = counts.into_iter().collect();
    counts.sort_by_key(|&(_, count)| std::cmp::Reverse(count));
    counts
}

fn stroke_lead_secs(transcription: &Transcription) -> Option<f64> {
    let mut starts: Vec<f64> = transcription
        .words
        .iter()
        .map(|word| word.interval.start_secs)
        .collect();
    sort_by_number(&mut starts, |start| *start);
    let phases = transcription.layers.iter().flat_map(|layer| &layer.phases);
    let strokes = phases.filter(|phase| phase.kind == PhaseKind::Stroke);
    let leads: Vec<f64> = strokes
        .filter_map(|stroke| {
            let start = stroke.interval.start_secs;
            let next = starts.partition_point(|&word| word < start);
            let near = [next.checked_sub(1), Some(next)].into_iter().flatten();
            let leads = near.filter_map(|word| Some(starts.get(word)? - start));
            leads.reduce(|a, b| if b.abs() < a.abs() { b } else { a })
        })
        .collect();
    (!leads.is_empty()).then(|| leads.iter().sum::<f64>() / leads.len() as f64)
}
