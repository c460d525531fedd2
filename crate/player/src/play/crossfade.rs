//! Crossfade between actors: a performance that changes while it runs.
//!
//! An actor is a function of time over the whole performance. A clause that arrives suddenly needs
//! another actor, which may have prepared for it before its arrival. The figure eases from one to
//! the other instead of jumping. The active actors depend on the time alone: seeking shows the same
//! as playing.

use raconteur_actor::EvaluationReport;
use raconteur_actor::{Actor, FaceRig};
use raconteur_base::curve::{lerp, minimum_jerk};
use raconteur_body::face::FaceControls;
use raconteur_body::{Bone, Pose, Skeleton};
use raconteur_stage::{FramingMargin, Span};

use super::actor_builder::FramingNeeds;

/// Time in which the body changes over, seconds. Designed: as quick as a flinch is slow.
const BODY_SECS: f64 = 0.4;
/// Cross-fade time of eyes, lids and mouth, seconds: the silence that begins every baked utterance.
const FACE_SECS: f64 = 0.12;
/// Cross-fade of the framing, seconds. Designed: a calm zoom.
const ROOM_SECS: f64 = 1.2;
/// Maximum number of stored actors: as many as can be active together at [`ActorCrossfade::APART_SECS`],
/// and one for a seek back to before them.
const MAX_ACTORS: usize = 4;

struct FadingActor {
    from_secs: f64,
    actor: Actor,
    needs: FramingNeeds,
}

/// Successive actors of a performance, cross-faded when live clauses change it; at least one.
pub(crate) struct ActorCrossfade {
    first: FadingActor,
    later: Vec<FadingActor>,
    /// Room to evaluate a second actor in.
    room: EvaluatedPose,
}

/// Pose and morph weights computed by an actor at one time.
pub(crate) struct EvaluatedPose {
    pub(crate) pose: Pose,
    pub(crate) morph_weights: Vec<f32>,
}

impl EvaluatedPose {
    /// Allocates the output for a figure with a number of morph targets.
    pub(crate) fn new(morphs: usize) -> Self {
        Self {
            pose: Pose::zero(),
            morph_weights: vec![0.0; morphs],
        }
    }
}

impl ActorCrossfade {
    /// Shortest time between two changes, seconds: no more than three actors are evaluated
    /// for a frame.
    const APART_SECS: f64 = 0.2;

    pub(crate) fn new(actor: Actor, needs: FramingNeeds, morphs: usize) -> Self {
        let first = FadingActor {
            from_secs: f64::NEG_INFINITY,
            actor,
            needs,
        };
        Self {
            first,
            later: Vec::new(),
            room: EvaluatedPose::new(morphs),
        }
    }

    /// Returns the time at which the last actor takes over; minus infinity for the first one.
    pub(crate) fn last_change_secs(&self) -> f64 {
        self.last().from_secs
    }

    /// Returns the time of a change that is requested now: requests within one change share it, one
    /// soon after follows it, and after a seek to earlier times it is immediate.
    pub(crate) fn next_change_secs(&self, now_secs: f64) -> f64 {
        let last_secs = self.last_change_secs();
        if last_secs - now_secs > Self::APART_SECS {
            now_secs
        } else if last_secs >= now_secs {
            last_secs
        } else {
            now_secs.max(last_secs + Self::APART_SECS)
        }
    }

    /// Returns the actor of the latest version of the performance.
    pub(crate) fn actor(&self) -> &Actor {
        &self.last().actor
    }

    /// Returns the framing that the last actor needs.
    pub(crate) fn last_margin(&self) -> FramingMargin {
        self.last().needs.margin
    }

    fn last(&self) -> &FadingActor {
        self.later.last().unwrap_or(&self.first)
    }

    /// Schedules `actor` to take over at a time; replaces any that takes over at the same time or
    /// later.
    pub(crate) fn change(&mut self, from_secs: f64, actor: Actor, needs: FramingNeeds) {
        let layer = FadingActor {
            from_secs,
            actor,
            needs,
        };
        while self.later.pop_if(|l| l.from_secs >= from_secs).is_some() {}
        self.later.push(layer);
        if self.later.len() >= MAX_ACTORS {
            self.first = self.later.remove(0);
        }
    }

    /// Returns the framing at a time, for a figure of a stature in an image of `aspect`; it shows
    /// `rest` while no gesture needs more, and zooms at speed `zoom` for each gesture.
    pub(crate) fn margin_at(
        &self,
        time_secs: f64,
        (rest, zoom): (Span, f64),
        stature_m: f64,
        aspect: f64,
    ) -> FramingMargin {
        let of = |layer: &FadingActor| FramingMargin {
            span: rest.visible_span(&layer.needs.gestures, zoom, time_secs, stature_m, aspect),
            ..layer.needs.margin
        };
        self.later.iter().fold(of(&self.first), |room, layer| {
            let to = of(layer);
            let s = minimum_jerk((time_secs - layer.from_secs) / ROOM_SECS);
            FramingMargin {
                top_m: lerp(room.top_m, to.top_m, s),
                half_width_m: lerp(room.half_width_m, to.half_width_m, s),
                span: room.span.towards(to.span, s),
                ..room
            }
        })
    }

    /// Returns the face controls at a time; allocates nothing.
    pub(crate) fn controls(&self, time_secs: f64) -> FaceControls {
        let begun = self.later.partition_point(|l| l.from_secs < time_secs);
        let done = self
            .later
            .partition_point(|l| l.from_secs + FACE_SECS <= time_secs);
        let base = match done.checked_sub(1) {
            Some(i) => &self.later[i],
            None => &self.first,
        };
        let first = base.actor.controls(time_secs);
        self.later[done..begun]
            .iter()
            .fold(first, |controls, layer| {
                let share = minimum_jerk((time_secs - layer.from_secs) / FACE_SECS);
                controls.lerp(&layer.actor.controls(time_secs), share)
            })
    }

    /// Evaluates like [`Actor::evaluate`]; allocates nothing.
    pub(crate) fn evaluate(
        &mut self,
        skeleton: &Skeleton,
        face: &FaceRig,
        time_secs: f64,
        pose: &mut Pose,
        morph_weights: &mut [f32],
    ) -> EvaluationReport {
        let begun = self.later.partition_point(|l| l.from_secs < time_secs);
        let alone = self
            .later
            .partition_point(|l| l.from_secs + BODY_SECS <= time_secs);
        let base = match alone.checked_sub(1) {
            Some(i) => &self.later[i],
            None => &self.first,
        };
        let mut report = base
            .actor
            .evaluate(skeleton, face, time_secs, pose, morph_weights);
        for layer in &self.later[alone..begun] {
            self.room.morph_weights.copy_from_slice(morph_weights);
            let (other, weights) = (&mut self.room.pose, &mut self.room.morph_weights);
            let before = report.controls;
            report = layer
                .actor
                .evaluate(skeleton, face, time_secs, other, weights);
            let since_secs = time_secs - layer.from_secs;
            let body = minimum_jerk(since_secs / BODY_SECS);
            let face = minimum_jerk(since_secs / FACE_SECS);
            ease(pose, other, body, face);
            report.controls = before.lerp(&report.controls, face);
            for (weight, to) in morph_weights.iter_mut().zip(weights) {
                *weight = lerp(f64::from(*weight), f64::from(*to), face) as f32;
            }
        }
        report
    }
}

/// Blends a pose towards another by a share.
pub(crate) fn ease(pose: &mut Pose, to: &Pose, body: f64, face: f64) {
    pose.root_offset_in_world = pose
        .root_offset_in_world
        .lerp(to.root_offset_in_world, body);
    pose.root_rotation = pose.root_rotation.slerp(to.root_rotation, body);
    for bone in Bone::ALL {
        let share = if bone == Bone::Chin { face } else { body };
        pose.set(bone, pose.rotation(bone).slerp(to.rotation(bone), share));
    }
    pose.jaw_offset_in_skull = pose.jaw_offset_in_skull.lerp(to.jaw_offset_in_skull, face);
    for i in 0..2 {
        pose.eyes[i] = pose.eyes[i].slerp(to.eyes[i], face);
        pose.upper_lid_rad[i] = lerp(pose.upper_lid_rad[i], to.upper_lid_rad[i], face);
        pose.lower_lid_rad[i] = lerp(pose.lower_lid_rad[i], to.lower_lid_rad[i], face);
    }
}
