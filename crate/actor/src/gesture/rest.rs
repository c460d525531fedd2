//! Rest postures of the hands on a figure: where each of them is, and the way from one to another.

use std::sync::Arc;

use raconteur_base::curve::{lerp, minimum_jerk};
use raconteur_base::{DQuat, DVec3, Side, noise};
use raconteur_body::hand_shape::HandAngles;
use raconteur_body::{HandShape, Skeleton};

use super::IdleSettings;
use super::rest_posture::RestSpot;
use super::rest_schedule::RestSchedule;
use crate::{ArmRig, palm};

const RANDOM_DRIFT: u64 = 0xd21f7;
/// Detour of the dominant hand on its way to or from the other hand, and of a hand that leaves a
/// hip, metres. Designed: more than the thickness of a hand.
const DETOUR_M: f64 = 0.07;
/// Bow to the front of any other change, metres. Designed.
const BOW_M: f64 = 0.02;
/// Share of a change of posture that each part of a way with one and with two places between takes.
/// The parts overlap, so that the hand does not stop. Designed.
const PART_SHARES: [f64; 2] = [0.64, 0.5];
/// Share of the other hand's movements that a hand in front of the belly, and one that hangs, takes
/// over. Designed.
const SYMPATHY: [f64; 2] = [0.5, 0.2];
/// Hand shapes of rests: flat with fingers together, and a loose fist.
const FLAT: u8 = 1;
const LOOSE_FIST: u8 = 57;

/// Pose of a resting hand, relative to the trunk in the zero pose.
#[derive(Clone, Copy, Debug)]
pub struct RestingHand {
    /// Position of the wrist, metres.
    pub wrist: DVec3,
    /// Rotation of the hand ([`crate::palm`]).
    pub hand: DQuat,
}

/// Place, rotation and fingers of a hand in one rest posture.
#[derive(Clone, Copy, Debug)]
struct SpotPose {
    at: RestingHand,
    shape: HandAngles,
}

/// Rest postures of one arm of a figure with the schedule of changes between them.
#[derive(Clone, Debug)]
pub struct RestPostures {
    poses: [SpotPose; RestSpot::ALL.len()],
    schedule: Arc<RestSchedule>,
    ready: DVec3,
    /// Place on the way behind the back, and on the way to folded arms.
    via: [DVec3; 2],
    side: Side,
    life: IdleSettings,
}

impl RestPostures {
    /// Adapts the rest postures to the measures of a figure.
    #[must_use]
    pub fn new(
        skeleton: &Skeleton,
        rig: &ArmRig,
        life: &IdleSettings,
        schedule: Arc<RestSchedule>,
    ) -> Self {
        let (side, space) = (rig.side(), rig.space());
        let scale = skeleton.scale();
        let waist = space.waist_m();
        let front = space.front_m(waist);
        let measures = Measures {
            side,
            scale,
            shoulder: rig.shoulder_in_world(),
            reach: rig.reach_m(),
            column: space.wrist_column_half_width_m(),
            waist,
            front,
            hip_front: space.front_m(waist - 0.1 * scale),
            chest_front: space.front_m(rig.shoulder_in_world().y - 0.22 * scale),
            // The hips are behind the waist.
            back: [0.06, 0.12, 0.18]
                .map(|below| space.back_m(waist - below * scale))
                .into_iter()
                .fold(f64::INFINITY, f64::min),
            is_dominant: side == life.dominant,
        };
        Self {
            poses: RestSpot::ALL.map(|spot| measures.pose(spot)),
            schedule,
            ready: DVec3::new(
                side.sign() * 0.16 * scale,
                waist + 0.06 * scale,
                front + 0.14 * scale,
            ),
            via: measures.via(),
            side,
            life: *life,
        }
    }

    /// Restricts rest to one posture, a welcome: the arms slightly away from the sides, the
    /// forearms in front of them, the palms turned to the audience. It is close enough to the
    /// hanging arm for a story to begin with that.
    pub(crate) fn use_welcome_posture(&mut self, skeleton: &Skeleton) {
        let scale = skeleton.scale();
        let sign = self.side.sign();
        let out = |x: f64, y: f64, z: f64| DVec3::new(x * sign, y, z);
        let hand = palm::from_directions(self.side, out(0.22, -0.72, 0.62), out(-0.62, 0.35, 0.62));
        let hanging = self.poses[RestSpot::Hanging as usize];
        let open = SpotPose {
            at: RestingHand {
                wrist: hanging.at.wrist + out(0.045, 0.085, 0.11) * scale,
                hand: hand.unwrap_or(hanging.at.hand),
            },
            shape: Self::shape(),
        };
        self.poses = [open; RestSpot::ALL.len()];
    }

    /// Returns the pose of the resting hand at a story time, relative to the trunk in the zero
    /// pose.
    #[must_use]
    pub fn sample(&self, time_secs: f64) -> RestingHand {
        let change = self.change(time_secs);
        let size = 0.004 * self.life.amount;
        let seed = self.life.seed ^ RANDOM_DRIFT;
        let drift = |id| size * noise::perlin(seed, id, 0.23 * time_secs);
        // The drift of a left-hander mirrors that of a right-hander.
        let (side, sign) = match self.life.dominant {
            Side::Right => (self.side, 1.0),
            Side::Left => (self.side.opposite(), -1.0),
        };
        let k = 3 * side.index() as u64;
        let drift = DVec3::new(sign * drift(k), drift(k + 1), drift(k + 2));
        RestingHand {
            wrist: change.place() + drift,
            hand: change.hand(),
        }
    }

    /// Returns the finger angles of the resting hand at a story time.
    #[must_use]
    pub fn fingers(&self, time_secs: f64) -> HandAngles {
        let change = self.change(time_secs);
        (change.from.shape).lerp(&change.to.shape, minimum_jerk(change.share))
    }

    /// Returns the share of the other hand's movements that the resting hand takes over at a time:
    /// a hand that lies nowhere moves along.
    pub(super) fn sympathy(&self, time_secs: f64) -> f64 {
        let change = self.change(time_secs);
        let [from, to] = change.spots.map(|spot| match spot {
            RestSpot::Belly => SYMPATHY[0],
            RestSpot::Hanging => SYMPATHY[1],
            _ => 0.0,
        });
        lerp(from, to, minimum_jerk(change.share)) * self.life.amount
    }

    /// Returns the planned changes of posture, seconds.
    pub(super) fn planned_changes(&self) -> Vec<(f64, f64)> {
        self.schedule.planned_changes(self.side)
    }

    /// Returns the seed of all that is left to chance.
    pub(super) fn seed(&self) -> u64 {
        self.life.seed
    }

    /// Returns the amount of idle motion, 0 to 1.
    pub(super) fn amount(&self) -> f64 {
        self.life.amount
    }

    /// Returns the posture that a change has reached or is nearer to at a time.
    pub(super) fn spot_at(&self, time_secs: f64) -> RestSpot {
        let change = self.change(time_secs);
        change.spots[usize::from(change.share >= 0.5)]
    }

    /// Returns the place in front of the body from which gestures start and to which hands sink
    /// back between them, relative to the trunk of the zero pose, metres.
    #[must_use]
    pub fn ready(&self) -> DVec3 {
        self.ready
    }

    /// Returns the finger angles of a relaxed hand.
    #[must_use]
    pub fn shape() -> HandAngles {
        *HandShape::RELAXED.angles()
    }

    /// Returns the change of posture in force at a time.
    fn change(&self, time_secs: f64) -> PostureChange<'_> {
        let (change, before) = self.schedule.change_at(self.side, time_secs);
        let via = if before == change.to {
            [None; 2]
        } else {
            [before, change.to].map(|spot| self.via(spot))
        };
        PostureChange {
            from: &self.poses[before as usize],
            to: &self.poses[change.to as usize],
            spots: [before, change.to],
            via,
            hand_between: (before != change.to && [before, change.to].contains(&RestSpot::Behind))
                .then(|| self.poses[RestSpot::Hanging as usize].at.hand),
            detour: self.detour(before, change.to),
            share: (time_secs - change.at_secs) / change.length_secs(before),
        }
    }

    /// Returns the detour of a hand that passes the other one or the hip on its way, metres: the
    /// dominant hand keeps to the outside.
    fn detour(&self, before: RestSpot, after: RestSpot) -> DVec3 {
        let behind = [before, after].contains(&RestSpot::Behind);
        let meets = [before, after].iter().any(|spot| {
            matches!(
                spot,
                RestSpot::Clasped | RestSpot::WristHeld | RestSpot::Folded
            )
        });
        let on_hip = [before, after].contains(&RestSpot::Hip);
        let out = if on_hip {
            self.side.sign() * DETOUR_M
        } else {
            0.0
        };
        let past = match (self.side == self.life.dominant, behind, meets) {
            (true, true, _) => DVec3::NEG_Z * DETOUR_M,
            (true, false, true) => DVec3::Z * DETOUR_M,
            _ => DVec3::Z * BOW_M,
        };
        past + DVec3::X * out
    }

    /// Returns the place by which a hand comes to a posture and leaves it, if not directly.
    fn via(&self, spot: RestSpot) -> Option<DVec3> {
        match spot {
            RestSpot::Behind => Some(self.via[0]),
            RestSpot::Folded => Some(self.via[1]),
            _ => None,
        }
    }
}

/// Change from one rest posture to another at one time.
struct PostureChange<'a> {
    from: &'a SpotPose,
    to: &'a SpotPose,
    spots: [RestSpot; 2],
    /// Places between.
    via: [Option<DVec3>; 2],
    /// Rotation of the hand on the way.
    hand_between: Option<DQuat>,
    /// Displacement in the middle of the way, metres.
    detour: DVec3,
    /// Progress; the change is under way between 0 and 1.
    share: f64,
}

impl PostureChange<'_> {
    /// Returns the rotation of the hand. On its way behind the back it hangs.
    fn hand(&self) -> DQuat {
        let [from, to] = [self.from.at.hand, self.to.at.hand];
        let Some(between) = self.hand_between else {
            return from.slerp(to, minimum_jerk(self.share));
        };
        let part = PART_SHARES[0];
        from.slerp(between, minimum_jerk(self.share / part))
            .slerp(to, minimum_jerk((self.share - (1.0 - part)) / part))
    }

    /// Returns the place of the wrist, metres: a superposition of the parts of its way.
    fn place(&self) -> DVec3 {
        let (from, to) = (self.from.at.wrist, self.to.at.wrist);
        let between = self.via.iter().flatten().count();
        let s = self.share.clamp(0.0, 1.0);
        // A hand leaves the hip outwards first: the bump grows before the way.
        let s = minimum_jerk(s);
        let detour = self.detour * (4.0 * s * (1.0 - s));
        let Some(part) = between.checked_sub(1).and_then(|i| PART_SHARES.get(i)) else {
            return from.lerp(to, minimum_jerk(self.share)) + detour;
        };
        let apart = (1.0 - part) / between as f64;
        let mut place = from;
        let mut last = from;
        let ends = self.via.iter().flatten().chain(core::iter::once(&to));
        for (k, end) in ends.enumerate() {
            let share = (self.share - apart * k as f64) / part;
            place += (*end - last) * minimum_jerk(share);
            last = *end;
        }
        place + detour
    }
}

/// Measures of a figure that its rest postures depend on, metres.
struct Measures {
    side: Side,
    scale: f64,
    shoulder: DVec3,
    reach: f64,
    /// Half width of the column about the trunk that a wrist stays out of.
    column: f64,
    waist: f64,
    /// Front of that column at the waist, at the hips and at the chest.
    front: f64,
    hip_front: f64,
    chest_front: f64,
    /// Back of that column.
    back: f64,
    is_dominant: bool,
}

impl Measures {
    /// Returns the places on the way behind the back, beside the hip, and on the way to folded
    /// arms, in front of the chest.
    fn via(&self) -> [DVec3; 2] {
        let sign = self.side.sign();
        let scale = self.scale;
        [
            DVec3::new(
                sign * (self.column + 0.14 * scale),
                self.waist - 0.07 * scale,
                self.shoulder.z - 0.05 * scale,
            ),
            DVec3::new(
                sign * 0.17 * scale,
                self.waist + 0.08 * scale,
                self.front + (if self.is_dominant { 0.17 } else { 0.1 }) * scale,
            ),
        ]
    }

    /// Returns the pose of the hand in a rest posture.
    fn pose(&self, spot: RestSpot) -> SpotPose {
        let sign = self.side.sign();
        let out = |[x, y, z]: [f64; 3]| DVec3::new(x * sign, y, z);
        let [fingers, normal] = self.directions(spot);
        let hand = palm::from_directions(self.side, out(fingers), out(normal));
        let shape = match spot {
            RestSpot::Fingertips | RestSpot::Pocket => HandShape::get(FLAT),
            RestSpot::Hip => HandShape::get(LOOSE_FIST),
            _ => None,
        };
        let relaxed = RestPostures::shape();
        SpotPose {
            at: RestingHand {
                wrist: out(self.place(spot)),
                hand: hand.unwrap_or(DQuat::IDENTITY),
            },
            shape: shape.map_or(relaxed, |shape| relaxed.lerp(shape.angles(), 0.7)),
        }
    }

    /// Returns the place of the wrist in a rest posture: outwards, up, front, metres. Designed.
    fn place(&self, spot: RestSpot) -> [f64; 3] {
        let scale = self.scale;
        // The dominant hand is in front of the other.
        let nearer = if self.is_dominant { 1.0 } else { 0.0 };
        match spot {
            // The elbow bent by some 25°, the hand a little before the thigh.
            RestSpot::Hanging => [
                (self.shoulder.x.abs() + 0.035 * scale).max(self.column + 0.03 * scale),
                self.shoulder.y - 0.955 * self.reach,
                self.shoulder.z + 0.075 * scale,
            ],
            RestSpot::Belly => [
                0.16 * scale,
                self.waist - 0.006 * nearer * scale,
                self.front + (0.068 + 0.02 * nearer) * scale,
            ],
            RestSpot::Clasped => [
                0.095 * scale,
                self.waist - (0.085 - 0.02 * nearer) * scale,
                self.hip_front + (0.035 + 0.04 * nearer) * scale,
            ],
            RestSpot::Fingertips => [
                0.125 * scale,
                self.waist + 0.085 * scale,
                self.front + 0.1 * scale,
            ],
            RestSpot::WristHeld => [
                (0.115 - 0.045 * nearer) * scale,
                self.waist - (0.075 - 0.04 * nearer) * scale,
                self.hip_front + (0.02 + 0.065 * nearer) * scale,
            ],
            RestSpot::Hip => [
                self.column + 0.056 * scale,
                self.waist + 0.005 * scale,
                self.shoulder.z + 0.03 * scale,
            ],
            RestSpot::Pocket => [
                self.column + 0.042 * scale,
                self.waist - 0.13 * scale,
                self.shoulder.z + 0.03 * scale,
            ],
            RestSpot::Behind => [
                (0.075 + 0.02 * nearer) * scale,
                self.waist - 0.06 * scale,
                self.back - (0.098 + 0.035 * nearer) * scale,
            ],
            // Each hand at the other arm's elbow, the dominant forearm in front.
            RestSpot::Folded => [
                -0.04 * scale,
                self.shoulder.y - (0.25 - 0.03 * nearer) * scale,
                self.chest_front + (0.035 + 0.075 * nearer) * scale,
            ],
        }
    }

    /// Returns the directions of the fingers and of the palm's normal in a rest posture: outwards,
    /// up, front. Designed.
    fn directions(&self, spot: RestSpot) -> [[f64; 3]; 2] {
        match spot {
            RestSpot::Hanging => [[-0.04, -1.0, 0.16], [-1.0, 0.0, -0.42]],
            RestSpot::Belly => [[-0.82, -0.30, 0.46], [-0.40, 0.35, -1.0]],
            RestSpot::Clasped => [[-0.72, -0.66, 0.22], [-0.25, 0.1, -1.0]],
            RestSpot::Fingertips => [[-0.66, 0.5, 0.42], [-0.8, -0.5, -0.2]],
            RestSpot::WristHeld if self.is_dominant => [[-0.9, -0.36, 0.0], [0.0, -0.2, -1.0]],
            RestSpot::WristHeld => [[-0.45, -0.88, 0.1], [-0.5, 0.1, -0.9]],
            RestSpot::Hip => [[-0.3, -0.5, 0.82], [-0.95, -0.05, -0.3]],
            RestSpot::Pocket => [[-0.06, -0.97, 0.22], [-0.95, 0.05, -0.3]],
            RestSpot::Behind => [[-0.8, -0.55, 0.1], [-0.1, 0.15, -1.0]],
            RestSpot::Folded => [[-0.94, 0.1, -0.3], [-0.25, -0.25, -0.94]],
        }
    }
}
