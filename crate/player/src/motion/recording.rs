//! Joints of a story at all samples.

use std::ops::{Range, RangeInclusive};

use raconteur_actor::limb::LEG_BONES;
use raconteur_base::{DAffine3, DQuat, DVec3, Length, Side, ops};
use raconteur_body::{Bone, Pose};

use super::RATE_HZ;
use super::signal::{Sampled, low_passed, rates};
use crate::Player;

/// Cut-off of the low pass of positions and rotations, Hz, as for the values of people.
pub(super) const CUTOFF_HZ: f64 = 7.0;

/// A foot as recorded, in the world.
#[derive(Default)]
pub(super) struct FootRecording {
    /// Position of the ankle, metres.
    pub(super) ankle: Vec<DVec3>,
    /// Position of the metatarsal joint (the ball of the foot), metres.
    pub(super) ball: Vec<DVec3>,
    /// Rotation of the foot relative to the zero pose.
    pub(super) turn: Vec<DQuat>,
    /// Heights of ankle and metatarsal joint in the zero pose, metres.
    pub(super) resting_m: [f64; 2],
}

/// Joints of a figure at 60 Hz. Rotations are relative to the zero pose; rotations and positions
/// are in the figure's own frame, except those of the feet.
#[derive(Default)]
pub(super) struct Recording {
    first_sample: f64,
    /// Runs of samples between cuts.
    pub(super) runs: Vec<Range<usize>>,
    pub(super) pelvis: Vec<DQuat>,
    pub(super) chest: Vec<DQuat>,
    pub(super) head: Vec<DQuat>,
    /// Position of the pelvis, metres.
    pub(super) pelvis_at: Vec<DVec3>,
    /// Position of the chest, metres.
    pub(super) chest_at: Vec<DVec3>,
    /// Height of the waist (the lumbar joint), metres.
    pub(super) waist_m: Vec<f64>,
    /// Positions of the left and right wrist, metres.
    pub(super) wrists: [Vec<DVec3>; 2],
    pub(super) feet: [FootRecording; 2],
}

impl Recording {
    /// Plays an interval of a story, story time, seconds.
    pub(super) fn new(player: &mut Player, secs: &RangeInclusive<f64>) -> Self {
        let zero = zero_joints(player);
        let first = (secs.start() * RATE_HZ).ceil();
        let last = (secs.end() * RATE_HZ).floor();
        let mut recording = Self {
            first_sample: first,
            ..Self::default()
        };
        for side in Side::BOTH {
            recording.feet[side.index()].resting_m =
                foot(side).map(|bone| zero[bone.index()].translation.y);
        }
        let mut joints = Vec::new();
        let mut run_start = 0;
        let mut sample = first;
        while sample <= last {
            let t = sample / RATE_HZ;
            let count = recording.len();
            if count > run_start && player.cuts_between(t - RATE_HZ.recip(), t) {
                recording.runs.push(run_start..count);
                run_start = count;
            }
            player.solve_joints(t, &mut joints);
            let figure_from_world = player.world_from_figure(t).inverse();
            recording.push(&joints, &zero, &figure_from_world);
            sample += 1.0;
        }
        recording.runs.push(run_start..recording.len());
        recording
    }

    fn push(&mut self, joints: &[DAffine3], zero: &[DAffine3], figure_from_world: &DAffine3) {
        let turned = |from: &DAffine3, bone: Bone| {
            let now = DQuat::from_mat3(&(from.matrix3 * joints[bone.index()].matrix3));
            (now * DQuat::from_mat3(&zero[bone.index()].matrix3).inverse()).normalized()
        };
        let at = |bone: Bone| figure_from_world.transform_point3(joints[bone.index()].translation);
        push_turn(
            &mut self.pelvis,
            turned(figure_from_world, Bone::Sacroiliac),
        );
        push_turn(&mut self.chest, turned(figure_from_world, Bone::Thoracic));
        push_turn(&mut self.head, turned(figure_from_world, Bone::Skull));
        self.pelvis_at.push(at(Bone::Sacroiliac));
        self.chest_at.push(at(Bone::Thoracic));
        self.waist_m.push(at(Bone::Lumbar).y);
        for side in Side::BOTH {
            self.wrists[side.index()].push(at(Bone::on(side, "wrist")));
            let [ankle, ball] = foot(side);
            let recorded = &mut self.feet[side.index()];
            recorded.ankle.push(joints[ankle.index()].translation);
            recorded.ball.push(joints[ball.index()].translation);
            push_turn(&mut recorded.turn, turned(&DAffine3::IDENTITY, ankle));
        }
    }

    /// Returns the number of samples.
    pub(super) fn len(&self) -> usize {
        self.waist_m.len()
    }

    /// Returns the time of a sample, story time, seconds.
    pub(super) fn time_secs(&self, sample: usize) -> f64 {
        (self.first_sample + sample as f64) / RATE_HZ
    }

    /// Returns the samples within an interval of story time, seconds.
    pub(super) fn samples(&self, secs: &RangeInclusive<f64>) -> Range<usize> {
        let place = |secs: f64| (secs * RATE_HZ - self.first_sample).max(0.0);
        let from = place(*secs.start()).ceil() as usize;
        let to = place(*secs.end() + RATE_HZ.recip()).floor() as usize;
        from..to.clamp(from, self.len().max(from))
    }

    /// Returns a number of occurrences per minute; `None` without samples.
    pub(super) fn per_minute(&self, count: f64) -> Option<f64> {
        let minutes = self.len() as f64 / RATE_HZ / 60.0;
        (minutes > 0.0).then(|| count / minutes)
    }

    /// Returns smoothed values.
    pub(super) fn smoothed<T: Sampled>(&self, values: &[T]) -> Vec<T> {
        low_passed(values, &self.runs, CUTOFF_HZ)
    }

    /// Returns smoothed rotations.
    pub(super) fn smoothed_turns(&self, turns: &[DQuat]) -> Vec<DQuat> {
        let smoothed = self.smoothed(turns).into_iter();
        smoothed.map(Length::normalized).collect()
    }

    /// Returns the angular speed of smoothed rotations, degrees per second: between each sample and
    /// the next one of its run.
    pub(super) fn turn_speeds_deg_s(&self, turns: &[DQuat]) -> Vec<f64> {
        let turns = self.smoothed_turns(turns);
        let pairs = self.runs.iter().flat_map(|r| turns[r.clone()].windows(2));
        let speeds = pairs.map(|pair| {
            let half = 0.5 * pair[0].distance_to(pair[1]);
            (4.0 * ops::asin_clamped(half) * RATE_HZ).to_degrees()
        });
        speeds.collect()
    }

    /// Returns the speed of positions after a low pass, metres per second.
    pub(super) fn speeds_m_s(&self, positions: &[DVec3], cutoff_hz: f64) -> Vec<f64> {
        let smoothed = low_passed(positions, &self.runs, cutoff_hz);
        let rates = rates(&smoothed, &self.runs).into_iter();
        rates.map(Length::magnitude).collect()
    }
}

/// Returns ankle and metatarsal joint of a foot.
fn foot(side: Side) -> [Bone; 2] {
    [LEG_BONES[side.index()][2], Bone::on(side, "metatarsal")]
}

/// Returns the joints of the zero pose.
fn zero_joints(player: &Player) -> Vec<DAffine3> {
    let mut joints = Vec::new();
    player.figure().skeleton.solve(&Pose::zero(), &mut joints);
    joints
}

/// Adds a rotation, of its two quaternions the one nearer to the last.
fn push_turn(turns: &mut Vec<DQuat>, turn: DQuat) {
    let is_near = turns.last().is_none_or(|last| last.dot(turn) >= 0.0);
    turns.push(if is_near { turn } else { -turn });
}
