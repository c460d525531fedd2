//! Idle figure before a story and during a question: it breathes, blinks and looks at the viewer,
//! in a welcoming posture, on its own clock.
//!
//! The idle time is not story time: a story shows the same at any time. When the story starts to
//! play, the welcome fades into it. Half a second later, and after any seek, nothing of it is left,
//! to the last bit.

use raconteur_actor::{Actor, FaceRig, Performance};
use raconteur_base::curve::{lerp, minimum_jerk};
use raconteur_base::{DAffine3, DQuat, DVec3, Length};
use raconteur_body::face::FaceControls;
use raconteur_body::{Bone, Pose, Skeleton, Springs};
use raconteur_stage::Frame;

use super::Player;
use crate::play::crossfade::{EvaluatedPose, ease};
use crate::play::soft::SoftFace;
use crate::play::swinging_parts::{Posture, SwingingParts, blend_chains};

/// Duration of the transition from the welcome into the story, seconds. Designed: before the first
/// word of most stories.
const LEAVE_SECS: f64 = 0.3;
/// Time at which the tissue of the face is free of the welcome, too, seconds: the lead-in of a
/// [`SoftFace`] segment has this length.
const GONE_SECS: f64 = LEAVE_SECS + 0.2;
/// Duration of the transition from the story into waiting for an answer, and between two gaze
/// targets, seconds. Designed: slower than leaving, since nobody waits for it.
const TURN_SECS: f64 = 0.6;
/// Waiting time after which it restarts, seconds: a day.
const MAX_SECS: f64 = 86_400.0;

/// Figure that waits before the story or for an answer: it breathes, blinks and looks at the
/// viewer, on its own clock.
pub(super) struct IdleBehaviour {
    actor: Actor,
    /// Previous actor with another gaze target, and the waiting time at which it was replaced,
    /// seconds.
    before: Option<(Actor, f64)>,
    /// Gaze target; `None`: the viewer.
    looked_at: Option<Bone>,
    /// Story time at which it waits, seconds; `None` before the story has begun.
    asked_secs: Option<f64>,
    /// Soft face, if it has tissue.
    soft: Option<SoftFace>,
    /// World from the figure: where the story begins.
    moved: Option<DAffine3>,
    /// Waiting time up to now, seconds.
    waited_secs: f64,
    /// Story time at which playback began, seconds; `None` while the figure waits.
    left_secs: Option<f64>,
    /// Room to evaluate it in.
    room: EvaluatedPose,
    /// Buffer for the previous pose.
    spare: EvaluatedPose,
    /// Swinging hair of the figure; `None` if it has none.
    sway: Option<SwingingParts>,
    /// Hair of the story alone while the welcome fades.
    leaving: Option<LeavingHair>,
}

/// Hair of the story without the welcome, to which the hair is blended while the welcome fades:
/// strands may come to rest at another side of a shoulder.
struct LeavingHair {
    sway: SwingingParts,
    joints: Vec<DAffine3>,
    original: Vec<DAffine3>,
}

impl IdleBehaviour {
    /// Evaluates the welcome into its own pose and weights.
    fn evaluate(&mut self, skeleton: &Skeleton, face: &FaceRig, waited_secs: f64) {
        let (pose, weights) = (&mut self.room.pose, &mut self.room.morph_weights);
        self.actor
            .evaluate(skeleton, face, waited_secs, pose, weights);
        if let Some((before, share)) = turning(&self.before, waited_secs) {
            let (was, were) = (&mut self.spare.pose, &mut self.spare.morph_weights);
            before.evaluate(skeleton, face, waited_secs, was, were);
            mix(was, were, pose, weights, share);
        }
        if let Some(moved) = &self.moved {
            let turned = DQuat::from_mat3(&moved.matrix3);
            pose.root_rotation = (turned * pose.root_rotation).normalized();
            pose.root_offset_in_world = moved.transform_point3(pose.root_offset_in_world);
        }
    }

    /// Controls of the face after so much waiting.
    fn face_controls(&self, waited_secs: f64) -> FaceControls {
        let controls = self.actor.controls(waited_secs);
        match turning(&self.before, waited_secs) {
            Some((before, share)) => before.controls(waited_secs).lerp(&controls, share),
            None => controls,
        }
    }

    /// Returns the share of the story at a story time, and the hypothetical waiting time; `None`
    /// while it waits.
    fn share(&self, time_secs: f64) -> Option<(f64, f64)> {
        let since_secs = time_secs - self.left_secs?;
        let share = minimum_jerk(since_secs / LEAVE_SECS);
        Some((share, self.waited_secs + since_secs))
    }

    /// Blends a pose and morph weights of the story back to the welcome while that fades.
    pub(super) fn blend(
        &mut self,
        skeleton: &Skeleton,
        face: &FaceRig,
        time_secs: f64,
        pose: &mut Pose,
        morph_weights: &mut [f32],
    ) {
        let Some((share, waited_secs)) = self.share(time_secs).filter(|(s, _)| *s < 1.0) else {
            return;
        };
        self.evaluate(skeleton, face, waited_secs);
        let EvaluatedPose {
            pose: from,
            morph_weights: were,
        } = &mut self.room;
        mix(from, were, pose, morph_weights, share);
    }

    /// Blends the hair of a frame to that of the story alone at a story time. `story` solves the
    /// story's joints at a time.
    pub(super) fn blend_hair(
        &mut self,
        (skeleton, springs): (&Skeleton, &Springs),
        time_secs: f64,
        story: &mut Posture<'_>,
        joints: &mut [DAffine3],
    ) {
        let (Some(left_secs), Some(leaving)) = (self.left_secs, &mut self.leaving) else {
            return;
        };
        let share = minimum_jerk((time_secs - left_secs) / GONE_SECS);
        story(time_secs, &mut leaving.joints);
        leaving
            .sway
            .advance_to((skeleton, springs), time_secs, story, &mut leaving.joints);
        let towards = (&leaving.joints[..], share);
        blend_chains(skeleton, joints, towards, &mut leaving.original);
    }

    /// Controls of the face at a story time, from the story's own.
    pub(super) fn controls(&self, time_secs: f64, story: &FaceControls) -> FaceControls {
        match self.share(time_secs) {
            Some((share, waited_secs)) if share < 1.0 => {
                self.face_controls(waited_secs).lerp(story, share)
            }
            _ => *story,
        }
    }
}

/// Returns the actor before an unfinished turn, and the progress of the turn.
fn turning(before: &Option<(Actor, f64)>, waited_secs: f64) -> Option<(&Actor, f64)> {
    let (actor, since_secs) = before.as_ref()?;
    let share = minimum_jerk((waited_secs - since_secs) / TURN_SECS);
    (share < 1.0).then_some((actor, share))
}

/// Blends the output towards the previous one, which has the weight 1 − `share`; the previous one
/// is overwritten.
fn mix(was: &mut Pose, were: &[f32], pose: &mut Pose, weights: &mut [f32], share: f64) {
    ease(was, pose, share, share);
    core::mem::swap(was, pose);
    for (weight, from) in weights.iter_mut().zip(were) {
        *weight = lerp(f64::from(*from), f64::from(*weight), share) as f32;
    }
}

impl Player {
    /// Evaluates the frame of a figure that has waited a number of seconds for playback, for an
    /// image of `aspect` (width over height), at the place of the story's start.
    ///
    /// The next [`Player::frame`] begins to leave the idle state; [`Player::seek`] leaves it
    /// immediately.
    pub fn evaluate_idle(&mut self, waited_secs: f64, aspect: f64) -> &Frame {
        self.evaluate_at_rest(None, waited_secs, None, aspect)
    }

    /// Evaluates the frame of a figure that has waited a number of seconds for an answer at
    /// `time_secs`, and looks at one of its bones, or at the viewer. It eases from the story's
    /// frame into waiting.
    ///
    /// After a call of [`Player::seek_with_fade`], the next [`Player::frame`] begins to leave the
    /// waiting state.
    pub fn evaluate_waiting(
        &mut self,
        time_secs: f64,
        waited_secs: f64,
        looked_at: Option<Bone>,
        aspect: f64,
    ) -> &Frame {
        let t = self.clock.shown_secs(time_secs, self.end_secs());
        self.evaluate_at_rest(Some(t), waited_secs, looked_at, aspect)
    }

    /// Seeks like [`Player::seek`], but fades from the waiting behaviour into the story.
    pub fn seek_with_fade(&mut self, time_secs: f64) {
        let welcome = self.idle.take();
        self.seek(time_secs);
        self.idle = welcome;
    }

    fn evaluate_at_rest(
        &mut self,
        asked_secs: Option<f64>,
        waited_secs: f64,
        looked_at: Option<Bone>,
        aspect: f64,
    ) -> &Frame {
        let waited_secs = if waited_secs.is_finite() {
            waited_secs.max(0.0) % MAX_SECS
        } else {
            0.0
        };
        let kept = self.idle.take().filter(|w| w.asked_secs == asked_secs);
        let mut welcome = match kept {
            Some(welcome) => welcome,
            None => Box::new(self.prepare_welcome(asked_secs)),
        };
        if welcome.looked_at != looked_at {
            let to = looked_at.and_then(|b| self.frame.world_from_joint.get(b.index()));
            let actor = self.waiting_actor(to.map(|joint| joint.translation));
            let before = core::mem::replace(&mut welcome.actor, actor);
            welcome.before = Some((before, waited_secs));
            welcome.looked_at = looked_at;
        }
        welcome.waited_secs = waited_secs;
        welcome.left_secs = None;
        self.show_waiting(&mut welcome);
        self.frame.time_secs = asked_secs.unwrap_or(0.0);
        self.frame.speech = None;
        self.light(self.frame.time_secs);
        self.frame.visibility = self.shots.visibility(self.frame.time_secs);
        self.frame.handles.clear();
        self.draw_tissue();
        self.frame.camera = self.camera(aspect);
        self.idle = Some(welcome);
        &self.frame
    }

    /// Puts joints, weights and tissue of a figure that waits into the frame.
    fn show_waiting(&mut self, welcome: &mut IdleBehaviour) {
        let waited_secs = welcome.waited_secs;
        let (skeleton, face) = (&self.cast.figure.skeleton, &self.cast.face);
        let layers = &mut self.actors;
        let room = &mut self.scratch;
        // The weight of the idle figure, and the story time before it.
        let asked = |t: f64, asked_secs: Option<f64>| {
            let share = minimum_jerk(t / TURN_SECS);
            asked_secs.filter(|_| share < 1.0).map(|at| (at, share))
        };
        let mut evaluate = |welcome: &mut IdleBehaviour, t: f64| {
            welcome.evaluate(skeleton, face, t);
            let Some((at, share)) = asked(t, welcome.asked_secs) else {
                return;
            };
            let (was, were) = (&mut room.pose, &mut room.morph_weights);
            layers.evaluate(skeleton, face, at, was, were);
            let (pose, weights) = (&mut welcome.room.pose, &mut welcome.room.morph_weights);
            mix(was, were, pose, weights, share);
        };
        evaluate(welcome, waited_secs);
        let frame = &mut self.frame;
        skeleton.solve(&welcome.room.pose, &mut frame.world_from_joint);
        frame
            .morph_weights
            .copy_from_slice(&welcome.room.morph_weights);
        if let Some(mut sway) = welcome.sway.take() {
            let mut posture = |t: f64, out: &mut Vec<DAffine3>| {
                evaluate(welcome, t);
                skeleton.solve(&welcome.room.pose, out);
            };
            let of = (skeleton, &self.cast.figure.springs);
            sway.advance_to(of, waited_secs, &mut posture, &mut frame.world_from_joint);
            welcome.sway = Some(sway);
        }
        let Some(mut soft) = welcome.soft.take() else {
            return;
        };
        if let Some(tissue) = &self.cast.figure.tissue {
            let controls = |t: f64| match asked(t, welcome.asked_secs) {
                Some((at, share)) => self
                    .actors
                    .controls(at)
                    .lerp(&welcome.face_controls(t), share),
                None => welcome.face_controls(t),
            };
            soft.advance_to(tissue, waited_secs, &controls, &mut frame.tissue);
        }
        welcome.soft = Some(soft);
    }

    /// Returns an actor that waits and looks at a position, or at the viewer.
    fn waiting_actor(&self, looked_at: Option<DVec3>) -> Actor {
        let stature_m = self.cast.figure.skeleton.stature_m();
        let room = self.actors.last_margin();
        let listener = self
            .options
            .shot
            .frame(DVec3::ZERO, stature_m, 16.0 / 9.0, room);
        let performance = Performance {
            seed: self.options.seed,
            motion_amount: self.options.motion_amount,
            manner: self.options.manner,
            listener_in_world: looked_at.unwrap_or(listener.eye_in_world),
            build: self.cast.build,
            welcomes: true,
            ..Performance::default()
        };
        Actor::new(&performance, &self.cast.figure.skeleton)
    }

    fn prepare_welcome(&self, asked_secs: Option<f64>) -> IdleBehaviour {
        let tissue = self.cast.figure.tissue.as_ref();
        let joints = self.cast.figure.skeleton.joints().len();
        let hair = || SwingingParts::new(&self.cast.figure.springs, joints);
        IdleBehaviour {
            actor: self.waiting_actor(None),
            before: None,
            looked_at: None,
            asked_secs,
            soft: tissue.map(SoftFace::new),
            moved: self
                .actors
                .actor()
                .world_from_figure(asked_secs.unwrap_or(0.0)),
            waited_secs: 0.0,
            left_secs: None,
            room: EvaluatedPose::new(self.cast.morphs()),
            spare: EvaluatedPose::new(self.cast.morphs()),
            sway: hair(),
            leaving: hair().map(|sway| LeavingHair {
                sway,
                joints: Vec::with_capacity(joints),
                original: Vec::with_capacity(joints),
            }),
        }
    }

    /// Begins to leave the welcome, if the figure waits, and forgets it when it has faded.
    pub(super) fn leave_welcome(&mut self, time_secs: f64) {
        let Some(welcome) = &mut self.idle else {
            return;
        };
        let begins = welcome.left_secs.is_none();
        let left_secs = *welcome.left_secs.get_or_insert(time_secs);
        if begins {
            self.forget_motion();
        }
        if !(0.0..GONE_SECS).contains(&(time_secs - left_secs)) {
            self.forget_welcome();
        }
    }

    /// Removes the welcome.
    pub(super) fn forget_welcome(&mut self) {
        if self.idle.take().is_some() {
            self.forget_motion();
        }
    }
}
