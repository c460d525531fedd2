//! Before a story is played: the figure breathes, blinks and looks at the viewer, in a
//! welcoming posture, on a clock of its own.
//!
//! How long it has waited is no story time: what a story shows at any time stays the same.
//! When the story begins to play, the welcome fades into it. Half a second later, and after
//! any seek, nothing of it is left, to the last bit.

use raconteur_actor::{Actor, FaceRig, Performance, Sex};
use raconteur_base::curve::{lerp, minimum_jerk};
use raconteur_base::{DAffine3, DQuat, DVec3, Length};
use raconteur_body::face::FaceControls;
use raconteur_body::{Pose, Skeleton};
use raconteur_stage::Frame;

use super::Player;
use crate::play::layers::{Posed, ease};
use crate::play::soft::SoftFace;
use crate::play::sway::Sway;

/// How long the figure takes from its welcome into the story, seconds. Designed: before the
/// first word of most stories.
const LEAVE_SECS: f64 = 0.3;
/// When the tissue of the face has forgotten it, too, seconds: the way into a segment of
/// [`SoftFace`] is as long.
const GONE_SECS: f64 = LEAVE_SECS + 0.2;
/// Waiting longer than this begins anew, seconds: a day.
const LONGEST_SECS: f64 = 86_400.0;

/// How the figure waits.
pub(super) struct Welcome {
    actor: Actor,
    /// Where its face has tissue.
    soft: Option<SoftFace>,
    /// World from the figure: where the story begins.
    moved: Option<DAffine3>,
    /// How long it has waited, seconds.
    waited_secs: f64,
    /// When the story began to play, story time, seconds; none while the figure waits.
    left_secs: Option<f64>,
    /// Room to evaluate it in.
    room: Posed,
    /// Its hair, if that swings.
    sway: Option<Sway>,
}

impl Welcome {
    /// Evaluates the welcome into its own pose and weights.
    fn evaluate(&mut self, skeleton: &Skeleton, face: &FaceRig, waited_secs: f64) {
        let (pose, weights) = (&mut self.room.pose, &mut self.room.morph_weights);
        self.actor
            .evaluate(skeleton, face, waited_secs, pose, weights);
        if let Some(moved) = &self.moved {
            let turned = DQuat::from_mat3(&moved.matrix3);
            pose.root_rotation = (turned * pose.root_rotation).normalized();
            pose.root_offset_in_world = moved.transform_point3(pose.root_offset_in_world);
        }
    }

    /// How much of the story there is at a story time, and how long the figure would have
    /// waited; none while it waits.
    fn share(&self, time_secs: f64) -> Option<(f64, f64)> {
        let since_secs = time_secs - self.left_secs?;
        let share = minimum_jerk(since_secs / LEAVE_SECS);
        Some((share, self.waited_secs + since_secs))
    }

    /// Takes a pose and morph weights of the story back to the welcome as far as it has not
    /// faded.
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
        ease(&mut self.room.pose, pose, share, share);
        core::mem::swap(&mut self.room.pose, pose);
        for (weight, from) in morph_weights.iter_mut().zip(&self.room.morph_weights) {
            *weight = lerp(f64::from(*from), f64::from(*weight), share) as f32;
        }
    }

    /// Controls of the face at a story time, from the story's own.
    pub(super) fn controls(&self, time_secs: f64, story: &FaceControls) -> FaceControls {
        match self.share(time_secs) {
            Some((share, waited_secs)) if share < 1.0 => {
                self.actor.controls(waited_secs).lerp(story, share)
            }
            _ => *story,
        }
    }
}

impl Player {
    /// The frame of a figure that has waited so many seconds for the story to be played, for a
    /// picture of `aspect` (width over height), where the story's first moment has it.
    ///
    /// The next [`Player::frame`] begins to leave it; [`Player::seek`] leaves it at once.
    pub fn welcome(&mut self, waited_secs: f64, aspect: f64) -> &Frame {
        let waited_secs = if waited_secs.is_finite() {
            waited_secs.max(0.0) % LONGEST_SECS
        } else {
            0.0
        };
        let mut welcome = match self.welcome.take() {
            Some(welcome) => welcome,
            None => Box::new(self.prepare_welcome()),
        };
        welcome.waited_secs = waited_secs;
        welcome.left_secs = None;
        let skeleton = &self.cast.figure.skeleton;
        welcome.evaluate(skeleton, &self.cast.face, waited_secs);
        let frame = &mut self.frame;
        skeleton.solve(&welcome.room.pose, &mut frame.world_from_joint);
        frame
            .morph_weights
            .copy_from_slice(&welcome.room.morph_weights);
        if let Some(mut sway) = welcome.sway.take() {
            let mut posture = |t: f64, out: &mut Vec<DAffine3>| {
                welcome.evaluate(skeleton, &self.cast.face, t);
                skeleton.solve(&welcome.room.pose, out);
            };
            let of = (skeleton, &self.cast.figure.springs);
            sway.at(of, waited_secs, &mut posture, &mut frame.world_from_joint);
            welcome.sway = Some(sway);
        }
        if let (Some(tissue), Some(soft)) = (&self.cast.figure.tissue, &mut welcome.soft) {
            let controls = |t: f64| welcome.actor.controls(t);
            soft.at(tissue, waited_secs, &controls, &mut frame.tissue);
        }
        frame.time_secs = 0.0;
        frame.speech = None;
        frame.shown = self.picture.shown(0.0);
        frame.handles.clear();
        self.draw_tissue();
        self.frame.camera = self.camera(aspect);
        self.welcome = Some(welcome);
        &self.frame
    }

    fn prepare_welcome(&self) -> Welcome {
        let stature_m = self.cast.figure.skeleton.stature_m();
        let room = self.layers.last_room();
        let listener = self
            .options
            .shot
            .frame(DVec3::ZERO, stature_m, 16.0 / 9.0, room);
        let performance = Performance {
            seed: self.options.seed,
            motion_amount: self.options.motion_amount,
            manner: self.options.manner,
            listener_in_world: listener.eye_in_world,
            sex: Sex::of(self.cast.figure.sex),
            trunk: Some(self.cast.trunk),
            welcomes: true,
            ..Performance::default()
        };
        let tissue = self.cast.figure.tissue.as_ref();
        Welcome {
            actor: Actor::new(&performance, &self.cast.figure.skeleton),
            soft: tissue.map(SoftFace::new),
            moved: self.layers.actor().world_from_figure(0.0),
            waited_secs: 0.0,
            left_secs: None,
            room: Posed::new(self.cast.morphs()),
            sway: Sway::new(
                &self.cast.figure.springs,
                self.cast.figure.skeleton.joints().len(),
            ),
        }
    }

    /// Begins to leave the welcome, if the figure waits, and forgets it when it has faded.
    pub(super) fn leave_welcome(&mut self, time_secs: f64) {
        let Some(welcome) = &mut self.welcome else {
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

    /// Nothing of the welcome is left.
    pub(super) fn forget_welcome(&mut self) {
        if self.welcome.take().is_some() {
            self.forget_motion();
        }
    }
}
