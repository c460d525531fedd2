//! Feet: steps and pivots, and the weight that they need.
//!
//! The figure stands at a place with a heading. A change of place is a pair of steps: the weight
//! moves to one foot, the other is put to its new place, and the same in turn. A foot that is not
//! stepping does not move at all.

use raconteur_base::curve::{lerp, minimum_jerk};

use crate::superposition::SuperposedTrack;

/// Time that a foot is in the air, seconds (people 0.2 to 0.3 s in oration; computed from ZeroEGGS
/// "067_Speech_2").
const STEP_SECS: f64 = 0.32;
/// Time from the first step of a pair to the second, seconds. Designed.
const BETWEEN_SECS: f64 = 0.46;
/// Time before a step in which the weight moves to the other foot, seconds. Designed.
const UNLOAD_SECS: f64 = 0.34;
/// Lift of the ankle in a step, for a stature of 1.7 m, metres. Designed.
const LIFT_M: f64 = 0.028;
/// Pitch of a lifted foot, toes down, radians; less than the lift, so that the toes stay above the
/// floor. Designed.
const PITCH_RAD: f64 = 0.13;
/// Weight on the standing foot during a step, 0 to 1. Designed.
const STANDING_WEIGHT: f64 = 0.8;

/// Place and heading of a standing figure, or of one of its feet, relative to the initial ones.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Standing {
    /// Displacement to the left, metres for a stature of 1.7 m.
    pub(crate) x: f64,
    /// Displacement to the front, metres for a stature of 1.7 m.
    pub(crate) z: f64,
    /// Turn to the left, radians.
    pub(crate) yaw: f64,
}

impl Standing {
    fn lerp(&self, to: &Self, s: f64) -> Self {
        Self {
            x: lerp(self.x, to.x, s),
            z: lerp(self.z, to.z, s),
            yaw: lerp(self.yaw, to.yaw, s),
        }
    }
}

/// Place of one foot at one time: where it stands or is carried, its lift and its pitch.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct FootPose {
    pub(crate) standing: Standing,
    /// Lift, metres for a stature of 1.7 m.
    pub(crate) lift_m: f64,
    /// Pitch, toes down, radians.
    pub(crate) pitch_rad: f64,
}

/// Step of one foot.
#[derive(Clone, Copy, Debug)]
struct Step {
    start_secs: f64,
    to: Standing,
}

/// Planned steps of both feet, with the place of the body between them.
#[derive(Clone, Debug, Default)]
pub(crate) struct Footwork {
    steps: [Vec<Step>; 2],
    /// Place and heading of the body.
    body: SuperposedTrack<3>,
    /// Weight, −1 on the right foot to 1 on the left, and the share of the planned weight in it.
    weight: SuperposedTrack<2>,
}

/// Change of the standing place: time at which the first foot leaves, and the new place.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StandingChange {
    pub(crate) at_secs: f64,
    pub(crate) to: Standing,
}

/// Time that a change of place takes from the start of the weight shift to the last step's end,
/// seconds.
pub(crate) const CHANGE_SECS: f64 = UNLOAD_SECS + BETWEEN_SECS + STEP_SECS;

impl Footwork {
    /// Plans the steps for changes sorted by time, each [`CHANGE_SECS`] after the one before at
    /// least.
    pub(crate) fn new(changes: &[StandingChange]) -> Self {
        let mut footwork = Self::default();
        let (mut body, mut weight) = (Vec::new(), Vec::new());
        let mut at = Standing::default();
        for change in changes {
            let to = change.to;
            // The foot on the side of the movement steps first; feet never cross.
            let sideways = (to.x - at.x) + 0.25 * (to.yaw - at.yaw);
            let first = usize::from(sideways < 0.0);
            let sign = if first == 0 { 1.0 } else { -1.0 };
            let start = change.at_secs;
            for (foot, start_secs) in [(first, start), (1 - first, start + BETWEEN_SECS)] {
                footwork.steps[foot].push(Step { start_secs, to });
            }
            weight.extend([
                (
                    start - UNLOAD_SECS,
                    UNLOAD_SECS + 0.1,
                    [-sign * STANDING_WEIGHT, 1.0],
                ),
                (
                    start + 0.6 * STEP_SECS,
                    BETWEEN_SECS,
                    [sign * STANDING_WEIGHT, 1.0],
                ),
                (start + BETWEEN_SECS + STEP_SECS, 1.4, [0.4 * sign, 0.0]),
            ]);
            body.push((
                start - 0.15,
                BETWEEN_SECS + STEP_SECS + 0.2,
                [to.x, to.z, to.yaw],
            ));
            at = to;
        }
        footwork.body = SuperposedTrack::new(body);
        footwork.weight = SuperposedTrack::new(weight);
        footwork
    }

    /// Returns the place and heading of the body at a time.
    pub(crate) fn body(&self, time_secs: f64) -> Standing {
        let [x, z, yaw] = self.body.sample(time_secs);
        Standing { x, z, yaw }
    }

    /// Returns the weight at a time, if the feet stood without steps with `idle`; −1 on the right
    /// foot to 1 on the left.
    pub(crate) fn weight(&self, time_secs: f64, idle: f64) -> f64 {
        let [planned, share] = self.weight.sample(time_secs);
        let share = share.clamp(0.0, 1.0);
        idle * (1.0 - share) + planned * share
    }

    /// Returns the pose of the left and right foot at a time.
    pub(crate) fn feet(&self, time_secs: f64) -> [FootPose; 2] {
        self.steps.each_ref().map(|steps| {
            let begun = steps.partition_point(|step| step.start_secs <= time_secs);
            let Some(i) = begun.checked_sub(1) else {
                return FootPose::default();
            };
            let from = i
                .checked_sub(1)
                .map_or_else(Standing::default, |i| steps[i].to);
            let s = (time_secs - steps[i].start_secs) / STEP_SECS;
            if s >= 1.0 {
                return FootPose {
                    standing: steps[i].to,
                    ..FootPose::default()
                };
            }
            let bump = 4.0 * s * (1.0 - s);
            let bump = bump * bump;
            FootPose {
                standing: from.lerp(&steps[i].to, minimum_jerk(s)),
                lift_m: LIFT_M * bump,
                pitch_rad: PITCH_RAD * bump,
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_foot_moves_in_its_step_only() {
        let to = Standing {
            x: 0.06,
            z: -0.03,
            yaw: 0.2,
        };
        let footwork = Footwork::new(&[StandingChange { at_secs: 2.0, to }]);
        for i in 0..400 {
            let t = 0.01 * f64::from(i);
            let [left, right] = footwork.feet(t);
            let lifted = [left, right].map(|foot| foot.lift_m > 1e-12);
            assert!(!(lifted[0] && lifted[1]), "one foot stands at {t}");
            for (foot, start) in [(left, 2.0), (right, 2.0 + BETWEEN_SECS)] {
                let expected = if t <= start { Standing::default() } else { to };
                if t <= start || t >= start + STEP_SECS {
                    assert_eq!(foot.standing, expected);
                }
            }
        }
        assert_eq!(footwork.body(9.0), to);
    }
}
