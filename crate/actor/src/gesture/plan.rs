//! Motion of one arm as a function of time.

use std::sync::Arc;

use raconteur_base::curve::last_at_or_before;
use raconteur_base::profile::Profile;
use raconteur_base::{DQuat, DVec3, Length};
use raconteur_body::Skeleton;
use raconteur_body::hand_shape::HandAngles;

use super::beats::Beats;
use super::fingers::FingerTrack;
use super::path::reach_secs;
use super::planner::{PlannedKey, Planner};
use super::tempo::Tempo;
use super::tracks::{HandTrack, WristTrack, piece_at};
use super::{ArmScript, IdleSettings, RestPostures, RestSchedule, RestSpot};
use crate::ArmRig;
use crate::discourse::Discourse;

/// Target of a hand at one time: wrist, rotation, finger angles, and the share of rest in each.
#[derive(Clone, Copy, Debug)]
pub struct HandTarget {
    /// Wrist position; in the world for scripted places, relative to the zero pose of the trunk at
    /// rest. [`HandTarget::rest_share`] gives the mix of both.
    pub wrist: DVec3,
    /// Hand rotation, likewise by [`HandTarget::hand_rest_share`].
    pub hand: DQuat,
    /// Angles of the finger joints.
    pub shape: HandAngles,
    /// 1 at rest (the wrist moves with the trunk), 0 in a gesture (it is in the world).
    pub rest_share: f64,
    /// Share of the rest posture in the hand's rotation, 0 to 1.
    pub hand_rest_share: f64,
    /// Share of the rest posture in the fingers, 0 to 1; they may gesture while the arm rests.
    pub finger_rest_share: f64,
    /// Share of the other hand's movements that the resting hand takes over, 0 to 1.
    pub(crate) sympathy: f64,
    /// Displacement of the gesturing hand from where gestures start, metres; none at rest.
    pub(crate) excursion: DVec3,
}

/// Least share of the other hand's movements that a free resting hand takes over.
const FREE_SYMPATHY: f64 = 0.3;

/// Activity of an arm at one time: at rest or gesturing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HandState {
    /// Arm in its rest posture.
    Rest,
    /// Moving to a stroke, in it, held, or returning.
    Busy,
}

/// Interval of story time in which the gestures follow a speed profile.
#[derive(Clone, Copy, Debug)]
pub(super) struct SpeedSpan {
    pub(super) start_secs: f64,
    pub(super) end_secs: f64,
    pub(super) profile: Profile,
}

/// Planned gesture motion of one arm over the whole story.
#[derive(Clone, Debug)]
pub struct ArmPlan {
    wrist: WristTrack,
    hand: HandTrack,
    fingers: FingerTrack,
    /// Start times of the intervals in `paces`.
    pace_starts: Vec<f64>,
    paces: Vec<SpeedSpan>,
    keys: Vec<PlannedKey>,
    rest: RestPostures,
    beats: Beats,
    rig: Arc<ArmRig>,
}

impl ArmPlan {
    /// Plans one arm of a figure, avoiding its body. Keys with non-finite times or places are left
    /// out.
    #[must_use]
    pub fn new(
        script: &ArmScript,
        skeleton: &Skeleton,
        rig: Arc<ArmRig>,
        life: &IdleSettings,
    ) -> Self {
        let mut scripts = <[ArmScript; 2]>::default();
        scripts[rig.side().index()].clone_from(script);
        let rests = Arc::new(RestSchedule::new(&scripts, life));
        Self::with_rests(script, (skeleton, rig), life, rests, &Discourse::default())
    }

    /// Plans one arm of a figure that rests by a schedule for both arms, at the tempo of a
    /// discourse with its keys sorted by time.
    #[must_use]
    pub fn with_rests(
        script: &ArmScript,
        (skeleton, rig): (&Skeleton, Arc<ArmRig>),
        life: &IdleSettings,
        rests: Arc<RestSchedule>,
        discourse: &Discourse,
    ) -> Self {
        let rest = RestPostures::new(skeleton, &rig, life, rests);
        let planned = Planner::new(&rig, &rest, Tempo { discourse }, life.amount).plan(script);
        let mut paces: Vec<SpeedSpan> = script
            .strokes
            .iter()
            .filter_map(|s| {
                let pace = SpeedSpan {
                    start_secs: s.start_secs,
                    end_secs: s.end_secs,
                    profile: s.pace?,
                };
                (pace.end_secs - pace.start_secs)
                    .is_finite()
                    .then_some(pace)
            })
            .collect();
        raconteur_base::order::sort_by_number(&mut paces, |p| p.start_secs);
        Self {
            wrist: planned.wrist,
            hand: planned.hand,
            fingers: planned.fingers,
            pace_starts: paces.iter().map(|p| p.start_secs).collect(),
            paces,
            keys: planned.keys,
            rest,
            beats: Beats::default(),
            rig,
        }
    }

    /// Adds beats to the holds of the hand, and to its free rests while the other one gestures, at
    /// accents in ascending order, seconds. `others` are the intervals in which the other one
    /// gestures. `size_at` gives the size of beats at a time; 1 for ordinary speech of a person
    /// 1.7 m tall.
    pub(crate) fn add_beats(
        &mut self,
        accents: &[f64],
        others: &[(f64, f64)],
        size_at: &dyn Fn(f64) -> f64,
    ) {
        let rests = without(others, &self.moving());
        let is_free = |&(from, to): &(f64, f64)| {
            self.rest.sympathy(0.5 * (from + to)) > FREE_SYMPATHY * self.rest.amount()
        };
        let beside: Vec<(f64, f64)> = rests.into_iter().filter(is_free).collect();
        let seed = self.rest.seed() ^ self.rig.side().index() as u64;
        self.beats = Beats::new(&self.wrist, &beside, accents, size_at, seed);
    }

    /// Returns the arm for which the motion is planned.
    #[must_use]
    pub fn rig(&self) -> &ArmRig {
        &self.rig
    }

    /// Returns the hand target at a time: at a planned key its exact place, between two keys the
    /// interpolation, before the first and after the last rest. O(log n), no allocation.
    #[must_use]
    pub fn sample(&self, time_secs: f64) -> HandTarget {
        let rest = self.rest.sample(time_secs);
        let t = self.paced(time_secs);
        let (wrist, rest_share) = self.wrist.sample(&self.rig, t, rest.wrist);
        let (hand, hand_rest_share) = self.hand.sample(&self.rig, t, &rest, wrist);
        let wrist = wrist + self.beats.sample(t);
        let (shape, finger_rest_share) = self.fingers.sample(t, &self.rest.fingers(time_secs));
        HandTarget {
            wrist,
            hand,
            shape,
            rest_share,
            hand_rest_share,
            finger_rest_share,
            sympathy: rest_share * self.rest.sympathy(time_secs),
            excursion: (wrist - self.rest.ready()) * (1.0 - rest_share),
        }
    }

    /// Converts story time into the time of the planned keys, seconds, by the speed profile in
    /// force.
    fn paced(&self, time_secs: f64) -> f64 {
        let pace = last_at_or_before(&self.pace_starts, time_secs).map(|i| self.paces[i]);
        match pace {
            Some(p) if time_secs < p.end_secs => {
                let length = p.end_secs - p.start_secs;
                p.start_secs + length * p.profile.sample((time_secs - p.start_secs) / length)
            }
            _ => time_secs,
        }
    }

    /// Returns the script's keys with their planned times, in the order of planning.
    #[must_use]
    pub fn keys(&self) -> &[PlannedKey] {
        &self.keys
    }

    /// Returns the posture in which the arm rests at a time; `None` if it is nearer to a gesture.
    #[must_use]
    pub fn rest_spot_at(&self, time_secs: f64) -> Option<RestSpot> {
        let rests = self.sample(time_secs).rest_share >= 0.5;
        rests.then(|| self.rest.spot_at(time_secs))
    }

    /// Returns the intervals in which wrist or hand are not at rest, story time, seconds.
    pub(crate) fn moving(&self) -> Vec<(f64, f64)> {
        let wrist = self.wrist.nodes.iter().map(|node| node.place.is_some());
        let moved = [
            busy(&self.wrist.times, wrist),
            busy(&self.hand.times, self.hand.turned()),
        ];
        joined(moved.concat())
    }

    /// Returns the intervals in which the arm gestures or changes its rest posture, story time,
    /// seconds; without the regular changes after the last gesture.
    pub(crate) fn changing(&self) -> Vec<(f64, f64)> {
        let mut spans = self.moving();
        spans.extend(self.rest.planned_changes());
        joined(spans)
    }

    /// Restricts the rest posture to a welcome, see [`RestPostures::use_welcome_posture`].
    pub(crate) fn use_welcome_posture(&mut self, skeleton: &Skeleton) {
        self.rest.use_welcome_posture(skeleton);
    }

    /// Returns the time that the hand needs from its position at `from_secs`, or from rest, to the
    /// first key of an unprepared stroke, seconds. `None` for a key that moves the fingers only.
    #[must_use]
    pub fn time_to(&self, from_secs: f64, wrist_in_world: Option<DVec3>) -> f64 {
        let places = [
            self.sample(from_secs).wrist,
            self.rest.sample(from_secs).wrist,
        ];
        let far = |to: DVec3| {
            places
                .map(|p| p.distance_to(to))
                .into_iter()
                .fold(0.0, f64::max)
        };
        reach_secs(wrist_in_world.map_or(0.0, far))
    }

    /// Returns the state of the arm at a time.
    #[must_use]
    pub fn state_at(&self, time_secs: f64) -> HandState {
        let piece = piece_at(&self.wrist.times, self.paced(time_secs));
        match piece.map(|(i, ..)| [i, i + 1].map(|k| self.wrist.nodes[k].place)) {
            Some([None, None]) | None => HandState::Rest,
            Some(_) => HandState::Busy,
        }
    }
}

/// Returns intervals sorted, those that overlap as one.
fn joined(mut spans: Vec<(f64, f64)>) -> Vec<(f64, f64)> {
    raconteur_base::order::sort_by_number(&mut spans, |(from, _)| *from);
    let mut joined: Vec<(f64, f64)> = Vec::with_capacity(spans.len());
    for (from, to) in spans {
        match joined.last_mut() {
            Some(last) if from <= last.1 => last.1 = last.1.max(to),
            _ => joined.push((from, to)),
        }
    }
    joined
}

/// Returns the parts of intervals outside others; both are sorted and do not overlap.
fn without(spans: &[(f64, f64)], others: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let mut rest = Vec::new();
    let mut next = 0;
    for &(from, to) in spans {
        let mut start = from;
        while let Some(&(other_from, other_to)) = others.get(next) {
            if other_from >= to {
                break;
            }
            if other_from > start {
                rest.push((start, other_from));
            }
            start = start.max(other_to);
            if other_to > to {
                break;
            }
            next += 1;
        }
        if start < to {
            rest.push((start, to));
        }
    }
    rest
}

/// Returns the intervals between successive keys, of which at least one end is not at rest.
fn busy(times: &[f64], is_led: impl Iterator<Item = bool>) -> Vec<(f64, f64)> {
    let led: Vec<bool> = is_led.collect();
    let ends = times.windows(2).zip(led.windows(2));
    ends.filter(|(_, led)| led[0] || led[1])
        .map(|(times, _)| (times[0], times[1]))
        .collect()
}
