//! Phrases of gesticulation: their order, gaps in their form, and conflicts over a hand.

use std::borrow::Cow;

use raconteur_base::Side;
use raconteur_base::order::order_by_number;
use raconteur_eml::{ClauseKind, Diagnostic, Span};

use super::anchors::Anchors;
use super::{hands, phase};
use crate::gestura::{Form, Hands, Layer, Noted, Phase, PhaseKind, Transcription, Vocabulary};
use crate::gsl::{Feature, Item, Position, Sequence, Value};
use crate::script::Builder;

/// Place in front of the body of a stroke without a position, GSL: the centre of gesture space on
/// the right side. Designed.
const NEUTRAL: Position = Position([-7.0, 12.0, 12.0]);
/// Shortest rest of a phase that is cut, seconds.
const MIN_SECS: f64 = 0.02;

/// Phrase to perform.
pub(super) struct Planned<'t> {
    pub(super) phases: Vec<Cow<'t, Phase>>,
    pub(super) hands: Hands,
    span: Span,
}

impl Planned<'_> {
    /// Returns the start of the stroke, seconds; without one, that of the first phase.
    pub(super) fn stroke_secs(&self) -> f64 {
        let mut phases = self.phases.iter();
        let stroke = phases.find(|phase| phase.kind == PhaseKind::Stroke);
        let phase = stroke.or(self.phases.first());
        phase.map_or(0.0, |phase| phase.interval.start_secs)
    }

    fn start_secs(&self) -> f64 {
        self.phases
            .first()
            .map_or(0.0, |phase| phase.interval.start_secs)
    }

    fn end_secs(&self) -> f64 {
        self.phases
            .last()
            .map_or(0.0, |phase| phase.interval.end_secs)
    }

    /// Ends the phrase by a time: later phases are left out, the one at that time is cut.
    fn cut(&mut self, end_secs: f64) {
        self.phases
            .retain(|phase| phase.interval.start_secs < end_secs - MIN_SECS);
        if let Some(last) = self.phases.last_mut()
            && last.interval.end_secs > end_secs
        {
            last.to_mut().interval.end_secs = end_secs;
        }
    }
}

/// Returns the phrases of all layers in the order of time, with what is missing filled in.
pub(super) fn plan<'t>(
    transcription: &'t Transcription,
    problems: &mut Vec<Diagnostic>,
) -> Vec<Planned<'t>> {
    let mut all: Vec<Planned<'t>> = Vec::new();
    for layer in &transcription.layers {
        for (phases, hands, span) in phrases(layer) {
            let hands = hands
                .or_else(|| hands::named(phases))
                .or_else(|| hands::of_layer(&layer.name));
            let hands = hands.unwrap_or_else(|| {
                let message = "the gesture names no hands; it is performed by the right hand";
                problems.push(Diagnostic::warning("gestura::no-hands", span, message));
                Hands::Right
            });
            let mut planned = Planned {
                phases: phases.iter().map(Cow::Borrowed).collect(),
                hands,
                span,
            };
            fill(&mut planned, problems);
            complete(&mut planned.phases);
            all.push(planned);
        }
    }
    if let Some(order) = order_by_number(&all, Planned::start_secs) {
        let mut slots: Vec<Option<Planned<'t>>> = all.into_iter().map(Some).collect();
        all = order.into_iter().filter_map(|i| slots[i].take()).collect();
    }
    separate(&mut all, problems);
    all.retain(|planned| !planned.phases.is_empty());
    all
}

/// Returns the phases, hands and span of each phrase, and of each run of phases without one.
fn phrases(layer: &Layer) -> Vec<(&[Phase], Option<Hands>, Span)> {
    let mut out = Vec::new();
    let mut is_taken = vec![false; layer.phases.len()];
    for phrase in &layer.phrases {
        let phases = layer.phases_of(phrase);
        if !phases.is_empty() {
            out.push((phases, phrase.handedness, phrase.span));
            is_taken[phrase.phases.clone()].fill(true);
        }
    }
    let mut start = 0;
    while start < layer.phases.len() {
        if is_taken[start] {
            start += 1;
            continue;
        }
        let rest = &layer.phases[start..];
        let taken = is_taken[start..]
            .iter()
            .position(|taken| *taken)
            .unwrap_or(rest.len());
        // A gesture ends where the next one prepares or, without, at its second stroke.
        let mut length = 1;
        while length < taken && !begins(rest[length].kind, &rest[..length]) {
            length += 1;
        }
        out.push((&rest[..length], None, rest[0].span));
        start += length;
    }
    out
}

/// Returns true if a phase of a kind begins another gesture after some phases.
fn begins(kind: PhaseKind, before: &[Phase]) -> bool {
    let has_stroke = before.iter().any(|phase| phase.kind == PhaseKind::Stroke);
    let prepares = matches!(
        kind,
        PhaseKind::Preparation | PhaseKind::PreStrokeHold | PhaseKind::Stroke
    );
    let is_back = before.last().is_some_and(|phase| {
        matches!(
            phase.kind,
            PhaseKind::Retraction | PhaseKind::PartialRetraction
        )
    });
    is_back || (has_stroke && prepares)
}

/// Completes preparations: what they do not tell is the beginning of the stroke or of a hold before
/// it, where they lead.
fn complete(phases: &mut [Cow<'_, Phase>]) {
    for index in 1..phases.len() {
        let (before, after) = phases.split_at_mut(index);
        let preparation = &mut before[index - 1];
        if preparation.kind != PhaseKind::Preparation {
            continue;
        }
        let stroke = after.iter().position(|p| p.kind == PhaseKind::Stroke);
        let to = &after[..=stroke.unwrap_or(0)];
        let motion = to.iter().find_map(|phase| phase::motion(&phase.form));
        let shapes = to
            .iter()
            .find_map(|p| phase::formal(p.form.hand_shapes.as_ref()));
        let palms = to
            .iter()
            .find_map(|p| phase::formal(p.form.palm_orientations.as_ref()));
        let form = &preparation.form;
        let filled = Form {
            motion: lead_to(phase::motion(form).as_ref(), motion.as_ref()),
            hand_shapes: lead_to(phase::formal(form.hand_shapes.as_ref()), shapes),
            palm_orientations: lead_to(phase::formal(form.palm_orientations.as_ref()), palms),
            ..form.clone()
        };
        preparation.to_mut().form = filled;
    }
}

/// Returns the feature of a preparation: its own, which ends by half of it if the next phase begins
/// with another, else the beginning of the next phase.
fn lead_to<F: Feature>(own: Option<&Value<F>>, next: Option<&Value<F>>) -> Option<Noted<F>> {
    let first = next.and_then(hands::first);
    let value = match (own, first) {
        (None, first) => first?,
        (Some(own), Some(first)) => hands::before(own, &first),
        (Some(own), None) => own.clone(),
    };
    Some(Noted::formal(value))
}

/// Fills in a missing form of the stroke, with a note each.
fn fill(planned: &mut Planned<'_>, problems: &mut Vec<Diagnostic>) {
    let span = planned.span;
    let mut note = |code, message: String| {
        problems.push(Diagnostic::warning(code, span, message));
    };
    let any = |has: fn(&Form) -> bool| planned.phases.iter().any(|phase| has(&phase.form));
    if !any(|form| phase::formal(form.hand_shapes.as_ref()).is_some()) {
        let message = "the gesture has no hand shape; the hand keeps the one before, or is relaxed";
        note("gestura::no-hand-shape", message.into());
    }
    if !any(|form| phase::formal(form.palm_orientations.as_ref()).is_some()) {
        let message =
            "the gesture has no palm orientation; the hand is turned as the arm carries it";
        note("gestura::no-palm", message.into());
    }
    if any(|form| form.body_shape.is_some()) {
        let message = "the body shape is informal and is not performed";
        note("gestura::body-shape", message.into());
    }
    let mut position: Option<Value<Position>> = None;
    for phase in &mut planned.phases {
        if phase::is_late(phase) {
            let message = format!(
                "the form of the {} goes on after its end, where it is performed",
                phase.kind.word()
            );
            note("gestura::late", message);
        }
        let hands = planned.hands;
        let motion = phase::motion(&phase.form).filter(|value| hands::moves(value, hands));
        let is_stroke = phase.kind == PhaseKind::Stroke;
        if is_stroke && motion.is_none() {
            let value = position.clone().unwrap_or_else(|| {
                let message = "the stroke has no formal position; it is performed in front of the \
                               body";
                note("gestura::no-position", message.into());
                neutral(planned.hands)
            });
            phase.to_mut().form.motion = Some(Noted::formal(value));
        }
        position = motion.and_then(|value| hands::last(&value)).or(position);
    }
}

/// Returns the neutral place of the hands of a gesture.
fn neutral(hands: Hands) -> Value<Position> {
    let at = |[x, y, z]: [f64; 3], side: Side| Sequence {
        items: vec![Item {
            offset: None,
            feature: Position(if side == Side::Right {
                [x, y, z]
            } else {
                [-x, y, z]
            }),
        }],
    };
    match hands {
        Hands::Left => Value::PerHand {
            right: None,
            left: Some(at(NEUTRAL.0, Side::Left)),
        },
        Hands::Right | Hands::Both => Value::Common(at(NEUTRAL.0, Side::Right)),
    }
}

/// Ends each phrase by the start of a later one that needs one of its hands.
fn separate(all: &mut [Planned<'_>], problems: &mut Vec<Diagnostic>) {
    for index in 0..all.len() {
        let (before, later) = all.split_at_mut(index + 1);
        let planned = &mut before[index];
        let shares = |other: &Planned<'_>| {
            Side::BOTH.into_iter().any(|side| {
                hands::includes(planned.hands, side) && hands::includes(other.hands, side)
            })
        };
        let end_secs = planned.end_secs();
        let overlapping = later
            .iter()
            .take_while(|other| other.start_secs() < end_secs)
            .find(|other| shares(other));
        let Some(start_secs) = overlapping.map(Planned::start_secs) else {
            continue;
        };
        if start_secs < end_secs - MIN_SECS {
            let kinds: Vec<&str> = planned
                .phases
                .iter()
                .filter(|phase| phase.interval.end_secs > start_secs + MIN_SECS)
                .map(|phase| phase.kind.word())
                .collect();
            let message = format!(
                "a gesture of the same hand begins at {start_secs:.2} s; this one ends there: {}",
                kinds.join(", ")
            );
            problems.push(Diagnostic::warning(
                "gestura::same-hand",
                planned.span,
                message,
            ));
        }
        planned.cut(start_secs);
    }
}

/// Adds the gesture-keys of the phrases, relative to the words on which the strokes fall.
pub(super) fn write(builder: &mut Builder, plan: &[Planned<'_>], anchors: &Anchors) {
    for planned in plan {
        let anchor_secs = planned.stroke_secs();
        let handedness = hands::handedness(planned.hands);
        for phase in &planned.phases {
            let key = phase::gesture_key(phase, handedness);
            let time = anchors.time(phase.interval.start_secs, anchor_secs);
            builder.push(time, ClauseKind::GestureKey(key));
        }
    }
}
