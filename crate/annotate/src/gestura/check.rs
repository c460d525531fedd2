//! Checks of a transcription against the rules of GestuRA (GEVH C.3).

use std::collections::BTreeSet;

use raconteur_eml::{Diagnostic, Span, quoted};

use super::letters;
use super::{Cover, Dimension, Gesture, Vocabulary};
use super::{GestureClass, Hands, Interval, Layer, PhaseKind, Phrase, Transcription, beat_score};

/// Tolerance of times that should coincide, seconds: a frame of a film.
const TOLERANCE_SECS: f64 = 0.04;

/// Returns what contradicts the rules: times out of order, spans outside their parents, phrases
/// without exactly one stroke or with phases out of order, hands that are not those of the form, and
/// dimensions that the beat filter doubts.
#[must_use]
pub fn check(transcription: &Transcription) -> Vec<Diagnostic> {
    let mut problems = Vec::new();
    let words = transcription
        .words
        .iter()
        .map(|word| (word.interval, word.span));
    in_order("word", words, &mut problems);
    let gestures = transcription.gestures.iter();
    starts_in_order(
        "gesture",
        gestures.map(|g| (g.interval, g.span)),
        &mut problems,
    );
    check_utterances(transcription, &mut problems);
    check_strokes(transcription, &mut problems);
    let gesticulation = Cover::new(gesticulation(transcription).map(|g| g.interval));
    for layer in &transcription.layers {
        let phases = layer
            .phases
            .iter()
            .map(|phase| (phase.interval, phase.span));
        in_order("phase", phases, &mut problems);
        check_layer(layer, &mut problems);
        if !transcription.gestures.is_empty() {
            check_places(layer, &gesticulation, &mut problems);
        }
    }
    problems
}

fn report(problems: &mut Vec<Diagnostic>, code: &'static str, span: Span, message: String) {
    problems.push(Diagnostic::warning(code, span, message));
}

/// Reports items that begin before the one before ends.
fn in_order(
    name: &str,
    items: impl Iterator<Item = (Interval, Span)>,
    problems: &mut Vec<Diagnostic>,
) {
    let mut end_secs = 0.0;
    for (interval, span) in items {
        if interval.start_secs + TOLERANCE_SECS < end_secs {
            let message = format!(
                "the {name} begins at {:.2} s, before the one before ends at {end_secs:.2} s",
                interval.start_secs
            );
            report(problems, "gestura::overlap", span, message);
        }
        end_secs = interval.end_secs.max(end_secs);
    }
}

/// Reports items that begin before the one before begins; they may overlap.
fn starts_in_order(
    name: &str,
    items: impl Iterator<Item = (Interval, Span)>,
    problems: &mut Vec<Diagnostic>,
) {
    let mut last_secs = 0.0;
    for (interval, span) in items {
        if interval.start_secs < last_secs {
            let message = format!("the {name} begins before the one before");
            report(problems, "gestura::order", span, message);
        }
        last_secs = interval.start_secs;
    }
}

fn check_utterances(transcription: &Transcription, problems: &mut Vec<Diagnostic>) {
    let mut spoken = BTreeSet::new();
    for utterance in &transcription.utterances {
        let words = transcription
            .words
            .get(utterance.words.clone())
            .unwrap_or_default();
        let told: String = words.iter().map(|word| letters(&word.token)).collect();
        if !utterance.text.is_empty() && letters(&utterance.text) != told {
            let text = quoted(&utterance.text);
            let message = format!("the text of the utterance {text} is not that of its words");
            report(problems, "gestura::text", utterance.span, message);
        }
        let twice = utterance
            .words
            .clone()
            .filter(|&word| !spoken.insert(word))
            .count();
        if twice > 0 {
            let message = format!("{twice} of its words belong to an utterance before");
            report(problems, "gestura::overlap", utterance.span, message);
        }
    }
    let mut levelled = BTreeSet::new();
    for level in &transcription.levels {
        if level
            .utterances
            .clone()
            .filter(|&u| !levelled.insert(u))
            .count()
            > 0
        {
            let message = "some of its utterances have a discourse level already";
            report(problems, "gestura::overlap", level.span, message.into());
        }
    }
}

fn check_layer(layer: &Layer, problems: &mut Vec<Diagnostic>) {
    let mut taken = BTreeSet::new();
    for phrase in &layer.phrases {
        if phrase
            .phases
            .clone()
            .filter(|&phase| !taken.insert(phase))
            .count()
            > 0
        {
            let message = "some of its phases belong to a phrase before";
            report(problems, "gestura::overlap", phrase.span, message.into());
        }
        check_phases(layer, phrase, problems);
        check_hands(layer, phrase, problems);
        check_dimension(layer, phrase, problems);
    }
    for (index, phase) in layer.phases.iter().enumerate() {
        if phase.interval.length_secs() <= 0.0 {
            let message = format!("the {} has no length", phase.kind.word());
            report(problems, "gestura::no-length", phase.span, message);
        }
        if !taken.contains(&index) {
            let message = format!("the {} belongs to no phrase", phase.kind.word());
            report(problems, "gestura::no-phrase", phase.span, message);
        }
        if phase.kind.is_hold() && phase.form.travels() {
            let message = format!("the {} moves the hand", phase.kind.word());
            report(problems, "gestura::hold", phase.span, message);
        }
    }
    if let Some(last) = layer.phases.last()
        && last.kind == PhaseKind::PartialRetraction
    {
        let message = "no gesture follows the partial retraction";
        report(problems, "gestura::phase-order", last.span, message.into());
    }
}

fn check_phases(layer: &Layer, phrase: &Phrase, problems: &mut Vec<Diagnostic>) {
    let phases = layer.phases_of(phrase);
    let strokes = phases
        .iter()
        .filter(|phase| phase.kind == PhaseKind::Stroke)
        .count();
    if strokes != 1 {
        let message = format!("the phrase has {strokes} strokes; each gesture has one");
        report(problems, "gestura::strokes", phrase.span, message);
    }
    for pair in phases.windows(2) {
        if order(pair[1].kind) <= order(pair[0].kind) {
            let message = format!(
                "a {} does not follow a {}",
                pair[1].kind.word(),
                pair[0].kind.word()
            );
            report(problems, "gestura::phase-order", pair[1].span, message);
        }
        let gap = pair[1].interval.start_secs - pair[0].interval.end_secs;
        if gap > TOLERANCE_SECS {
            let message = format!("{gap:.2} s between two phases of one gesture");
            report(problems, "gestura::gap", pair[1].span, message);
        }
    }
}

/// Returns the place of a kind in the order of phases; partial and full retraction share one.
fn order(kind: PhaseKind) -> u8 {
    match kind {
        PhaseKind::Preparation => 0,
        PhaseKind::PreStrokeHold => 1,
        PhaseKind::Stroke => 2,
        PhaseKind::PostStrokeHold => 3,
        PhaseKind::PartialRetraction | PhaseKind::Retraction => 4,
    }
}

fn check_hands(layer: &Layer, phrase: &Phrase, problems: &mut Vec<Diagnostic>) {
    let resting = match phrase.handedness {
        Some(Hands::Right) => raconteur_base::Side::Left,
        Some(Hands::Left) => raconteur_base::Side::Right,
        Some(Hands::Both) | None => return,
    };
    if phrase.symmetry == Some(true) {
        let message = "a gesture of one hand is not symmetrical";
        report(problems, "gestura::hands", phrase.span, message.into());
    }
    for phase in layer.phases_of(phrase) {
        if phase.form.has_only(resting) {
            let message = "the form is of the hand that does not take part";
            report(problems, "gestura::hands", phase.span, message.into());
        }
    }
}

fn check_dimension(layer: &Layer, phrase: &Phrase, problems: &mut Vec<Diagnostic>) {
    let score = beat_score(layer, phrase).total();
    let message = match phrase.dimension {
        Some(Dimension::Iconic | Dimension::Metaphoric) if score == 0 => {
            "by the beat filter, this is probably a beat"
        }
        None => "the phrase has no dimension",
        _ => return,
    };
    report(problems, "gestura::dimension", phrase.span, message.into());
}

/// Returns the gestures that pass 4 classified as gesticulation.
fn gesticulation(transcription: &Transcription) -> impl Iterator<Item = &Gesture> {
    let gestures = transcription.gestures.iter();
    gestures.filter(|gesture| gesture.class == GestureClass::Gesticulation)
}

/// Reports phrases outside the gesticulation of pass 4.
fn check_places(layer: &Layer, gesticulation: &Cover, problems: &mut Vec<Diagnostic>) {
    for phrase in &layer.phrases {
        let Some(interval) = layer.phrase_interval(phrase) else {
            continue;
        };
        if !gesticulation.contains(interval, TOLERANCE_SECS) {
            let message = "the phrase lies in no gesture of the class gesticulation";
            let code = "gestura::outside-gesture";
            report(problems, code, phrase.span, message.into());
        }
    }
}

/// Reports gesticulation in which pass 5 found no stroke.
fn check_strokes(transcription: &Transcription, problems: &mut Vec<Diagnostic>) {
    let phases = transcription.layers.iter().flat_map(|layer| &layer.phases);
    let strokes = phases.filter(|phase| phase.kind == PhaseKind::Stroke);
    let mut middles: Vec<f64> = strokes
        .map(|stroke| 0.5 * (stroke.interval.start_secs + stroke.interval.end_secs))
        .collect();
    if middles.is_empty() {
        return;
    }
    middles.sort_by(f64::total_cmp);
    for gesture in gesticulation(transcription) {
        let next = middles.partition_point(|secs| *secs < gesture.interval.start_secs);
        let is_inside = |secs: &f64| *secs <= gesture.interval.end_secs;
        if !middles.get(next).is_some_and(is_inside) {
            let message = "the gesticulation has no stroke";
            report(problems, "gestura::strokes", gesture.span, message.into());
        }
    }
}
