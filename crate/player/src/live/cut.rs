//! Interruption of a fragment: started clauses end, the rest is never performed.

use std::sync::Arc;

use raconteur_actor::gesture::{ArmPlan, GesturePhase, HandKey};
use raconteur_actor::limb::Limb;
use raconteur_actor::manipulator::{Command, Motion};
use raconteur_actor::{Actor, EmotionSpan, GestureStroke};
use raconteur_base::Side;
use raconteur_speech::Utterance;
use raconteur_speech::bundle::FRAME_SECS;

use super::{Fragment, FragmentOutcome, LivePerformance, SETTLE_SECS};
use crate::lower::cues::{Cue, CueKind, UtteranceCue};
use crate::lower::plan::ScriptPlan;

/// A hand that is interrupted stops in this time, seconds. Designed.
const HALT_SECS: f64 = 0.15;
/// Maximum time before and after a stroke during which a hand may be in motion, seconds.
const PREPARATION_SECS: f64 = 0.9;

/// Interruption of a performance.
#[derive(Clone, Copy)]
struct Interruption {
    /// Story time, seconds.
    at_secs: f64,
    /// Time up to which starts have been delivered, so their ends must follow; not after the cut.
    told_secs: f64,
}

impl Interruption {
    /// Returns true if something with a given start time has begun.
    fn has_begun(&self, time_secs: f64) -> bool {
        time_secs < self.at_secs || time_secs <= self.told_secs
    }
}

/// Returns true if a message is `<interrupt/>`, which ends the actions of fragments.
pub(crate) fn is_interrupt(text: &str) -> bool {
    let inside = text.trim().strip_prefix("<interrupt");
    let inside = inside.and_then(|rest| rest.strip_suffix("/>"));
    inside.is_some_and(|rest| rest.trim().is_empty())
}

impl LivePerformance {
    /// Accepts the message `<interrupt/>`, which counts as a fragment of its mind; see
    /// [`Live::interrupt`].
    pub(crate) fn admit_interrupt(&mut self, mind: u32, now_secs: f64) -> FragmentOutcome {
        self.fragments_begun = self.fragments_begun.wrapping_add(1);
        let allowed = self.check_rate(mind, now_secs);
        FragmentOutcome {
            fragment: self.fragments_begun,
            first_utterance: self.utterances_begun,
            interrupts: allowed.is_ok(),
            diagnostics: allowed.err().into_iter().collect(),
            ..FragmentOutcome::default()
        }
    }

    /// Ends the actions of fragments at a time. Cues up to `told_secs` have been delivered. Returns
    /// true if there was anything to end.
    pub(crate) fn interrupt(
        &mut self,
        at_secs: f64,
        told_secs: f64,
        story: &ScriptPlan,
        actor: &Actor,
    ) -> bool {
        let cut = Interruption { at_secs, told_secs };
        let halts = Side::BOTH.map(|side| {
            let own = self.fragments.iter();
            let own = own.flat_map(|f| &f.plan.strokes[side.index()]);
            let led = &story.strokes[side.index()];
            halt(actor.plan(side), own, led, at_secs)
        });
        let mut last_cut = None;
        for (i, fragment) in self.fragments.iter_mut().enumerate() {
            let last = fragment.plan.cues.last();
            if last.is_none_or(|cue| cue.time_secs <= at_secs) {
                continue;
            }
            last_cut = Some(i);
            let ends = fragment.plan.interrupt(&cut, &story.manipulators.commands);
            if at_secs <= told_secs && !fragment.fresh {
                self.due.extend(ends);
            }
            // The arms are lowered.
            fragment.end_secs = fragment.end_secs.min(at_secs + SETTLE_SECS);
            fragment.cut_secs = fragment.cut_secs.min(at_secs);
        }
        if let Some(i) = last_cut {
            for (strokes, halt) in self.fragments[i].plan.strokes.iter_mut().zip(halts) {
                strokes.extend(halt);
            }
        }
        let moves = |f: &Fragment| f.plan.strokes.iter().any(|strokes| !strokes.is_empty());
        self.fragments
            .retain(|f| !f.plan.cues.is_empty() || moves(f));
        last_cut.is_some()
    }
}

impl ScriptPlan {
    /// Ends ongoing actions at a cut and removes those that have not begun; `others` are the
    /// story's commands to manipulators. Returns the cues of the ends; nothing before the cut
    /// changes. Switched states persist: shots, music, parameters, postures, animation players; and the
    /// figure walks on to its destination.
    fn interrupt(&mut self, cut: &Interruption, others: &[Command]) -> Vec<Cue> {
        let at_secs = cut.at_secs;
        self.utterances
            .retain(|u| cut.has_begun(u.timed.start_secs));
        for cue in &mut self.utterances {
            shorten(cue, at_secs);
        }
        for strokes in &mut self.strokes {
            strokes.iter_mut().for_each(|s| release(s, at_secs));
            strokes.retain(|s| has_set_in(s, at_secs));
        }
        stop(&mut self.manipulators.commands, others, at_secs);
        self.manipulators.moves.retain(|m| m.time_secs < at_secs);
        self.postures.retain(|p| p.start_secs < at_secs);
        self.switches.retain(|(secs, _)| *secs < at_secs);
        self.players.retain(|(secs, _)| *secs < at_secs);
        self.geometry.retain(|(secs, _)| *secs < at_secs);
        self.shots.retain(|s| s.start_secs < at_secs);
        self.music.retain(|m| m.start_secs < at_secs);
        self.discourse.cut(at_secs);
        self.face.parameters.retain(|(secs, _)| *secs < at_secs);
        self.face.emotions.retain(|e| e.span.start_secs < at_secs);
        let felt = self.face.emotions.iter_mut();
        felt.for_each(|e| fade(&mut e.span, at_secs));
        self.end_cues(cut)
    }

    /// Removes the cues after a cut, except the ends of what has begun, which become due
    /// immediately.
    fn end_cues(&mut self, cut: &Interruption) -> Vec<Cue> {
        let mut open: Vec<CueKind> = Vec::new();
        let mut ends = Vec::new();
        let mut kept = Vec::with_capacity(self.cues.len());
        for mut cue in std::mem::take(&mut self.cues) {
            if let Some(end) = end_of(&cue.kind)
                && cut.has_begun(cue.time_secs)
            {
                open.push(end);
            }
            if let Some(begun) = open.iter().position(|end| *end == cue.kind) {
                open.swap_remove(begun);
                if cue.time_secs > cut.at_secs {
                    cue.time_secs = cut.at_secs;
                    ends.push(cue);
                    continue;
                }
                kept.push(cue);
            } else if cut.has_begun(cue.time_secs) {
                kept.push(cue);
            }
        }
        kept.extend_from_slice(&ends);
        self.cues = kept;
        ends
    }
}

/// Returns the cue that ends the state begun by a cue.
fn end_of(kind: &CueKind) -> Option<CueKind> {
    match kind {
        CueKind::ClauseStart(clause) => Some(CueKind::ClauseEnd(clause.clone())),
        &CueKind::UtteranceStart { utterance } => Some(CueKind::UtteranceEnd { utterance }),
        _ => None,
    }
}

/// Ends an utterance, if it is not over before.
fn shorten(cue: &mut UtteranceCue, at_secs: f64) {
    let secs = (at_secs - cue.timed.start_secs).max(0.0);
    if secs >= cue.timed.utterance.duration_secs {
        return;
    }
    let u = Arc::make_mut(&mut cue.timed.utterance);
    u.duration_secs = secs;
    u.words.retain(|w| w.start_secs < secs);
    u.phones.retain(|p| p.start_secs < secs);
    let ends = u.words.iter_mut().map(|w| &mut w.end_secs);
    let ends = ends.chain(u.phones.iter_mut().map(|p| &mut p.end_secs));
    ends.for_each(|end| *end = end.min(secs));
    u.emotions.retain(|e| e.start_secs < secs);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a number of frames that are there"
    )]
    let frames = (secs / FRAME_SECS).ceil() as usize;
    u.f0.truncate(frames);
    u.intensity.truncate(frames);
    retain_whole(u);
}

/// Removes references to words or phones that no longer exist.
fn retain_whole(u: &mut Utterance) {
    let (words, phones) = (u.words.len(), u.phones.len());
    u.text_starts.truncate(words);
    let whole =
        |s: &raconteur_speech::bundle::Syllable| s.first_phone.saturating_add(s.phones) <= phones;
    // Accents refer to syllables by their index.
    let syllables = u.syllables.iter().take_while(|s| whole(s)).count();
    u.syllables.truncate(syllables);
    u.accents.retain(|a| a.syllable < syllables);
    u.phrases
        .retain(|p| p.first_word.saturating_add(p.words) <= words);
    u.sentences
        .retain(|s| s.first_word.saturating_add(s.words) <= words);
}

/// Returns true if any of a stroke remains; a preparation added by the planner is discarded.
fn has_set_in(stroke: &GestureStroke, at_secs: f64) -> bool {
    let needs_keys = stroke.phase == GesturePhase::Stroke;
    stroke.start_secs < at_secs && (!needs_keys || !stroke.keys.is_empty())
}

/// Removes later commands, and stops the limbs last moved by these and not by the `others`.
fn stop(commands: &mut Vec<Command>, others: &[Command], at_secs: f64) {
    commands.retain(|c| c.time_secs < at_secs);
    let moves = |c: &&Command| {
        !matches!(
            c.motion,
            Motion::Configure { .. } | Motion::Stop | Motion::Lock(_)
        )
    };
    let of = |commands: &[Command], limb: Limb| {
        let own = commands
            .iter()
            .filter(|c| c.limb == limb && c.time_secs < at_secs);
        own.filter(moves).map(|c| c.time_secs).reduce(f64::max)
    };
    for limb in Limb::ALL {
        let Some(since) = of(commands, limb) else {
            continue;
        };
        if of(others, limb).is_none_or(|other| other < since) {
            commands.push(Command {
                time_secs: at_secs,
                limb,
                motion: Motion::Stop,
            });
        }
    }
}

/// Removes the keys of a stroke that the hand has not reached.
fn release(stroke: &mut GestureStroke, at_secs: f64) {
    stroke.keys.retain(|k| k.time_secs < at_secs);
    stroke.end_secs = stroke.end_secs.min(at_secs);
}

/// Returns the place at which an interrupted gesturing hand briefly comes to rest, slightly further
/// along its path, so it eases back from there. `own` are the interrupted strokes; a hand driven by
/// the story continues.
fn halt<'a>(
    plan: &ArmPlan,
    mut own: impl Iterator<Item = &'a GestureStroke>,
    story: &[GestureStroke],
    at_secs: f64,
) -> Option<GestureStroke> {
    let is_led = |s: &GestureStroke| {
        (s.start_secs - PREPARATION_SECS..s.end_secs + PREPARATION_SECS).contains(&at_secs)
    };
    let time_secs = at_secs + HALT_SECS;
    let hand = plan.sample(time_secs);
    if hand.rest_share > 0.99 || !own.any(|s| s.end_secs > at_secs) || story.iter().any(is_led) {
        return None;
    }
    Some(GestureStroke {
        start_secs: time_secs,
        end_secs: time_secs,
        keys: vec![HandKey {
            time_secs,
            wrist_in_world: Some(hand.wrist),
            hand_in_world: Some(hand.hand),
            shape: Some(hand.shape),
            ..HandKey::default()
        }],
        ..GestureStroke::default()
    })
}

/// Fades an emotion at full strength; a growing one first reaches its apex.
fn fade(emotion: &mut EmotionSpan, at_secs: f64) {
    let until = emotion.until_secs.min(at_secs.max(emotion.apex_secs));
    let fade_secs = emotion.end_secs - emotion.until_secs;
    if until < emotion.until_secs && fade_secs.is_finite() {
        emotion.end_secs = until + fade_secs;
        emotion.until_secs = until;
    }
}
