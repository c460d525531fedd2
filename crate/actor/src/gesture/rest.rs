//! Rest positions of the hands.
//!
//! Two postures: arms hanging at the sides, and hands held loosely in front of the belly. Both arms
//! follow one seeded schedule, so that they change simultaneously; the rest position is therefore a
//! function of time.

use raconteur_base::curve::minimum_jerk;
use raconteur_base::{DQuat, DVec3, Side, noise};
use raconteur_body::hand_shape::HandAngles;
use raconteur_body::{HandShape, Skeleton};

use super::IdleSettings;
use crate::{ArmRig, palm};

/// Minimum duration of a rest posture, seconds. Designed.
const KEEP_SECS: f64 = 13.0;
/// Time for changing from one posture to the other, seconds. Designed.
const CHANGE_SECS: f64 = 1.5;
/// Share of intervals spent with the arms hanging.
const HANGING_SHARE: f64 = 0.4;
const RANDOM_POSTURE: u64 = 0x5e57;
const RANDOM_DRIFT: u64 = 0xd21f7;

/// Pose of a resting hand, relative to the trunk in the zero pose.
#[derive(Clone, Copy, Debug)]
pub struct RestingHand {
    /// Position of the wrist, metres.
    pub wrist: DVec3,
    /// Rotation of the hand ([`crate::palm`]).
    pub hand: DQuat,
}

/// Rest postures of one arm of a figure, arms hanging or hands in front of the belly, with the
/// seeded schedule of changes between them.
#[derive(Clone, Debug)]
pub struct RestPostures {
    hanging: RestingHand,
    in_front: RestingHand,
    ready: DVec3,
    side: Side,
    life: IdleSettings,
}

impl RestPostures {
    /// Adapts the rest postures to the measures of a figure.
    #[must_use]
    pub fn new(skeleton: &Skeleton, rig: &ArmRig, life: &IdleSettings) -> Self {
        let (side, space) = (rig.side(), rig.space());
        let scale = skeleton.scale();
        let sign = side.sign();
        let out = |x: f64, y: f64, z: f64| DVec3::new(x * sign, y, z);
        let shoulder = rig.shoulder_in_world();
        // Hanging: the elbow bent by some 25°, the hand a little before the thigh.
        let outwards = (shoulder.x.abs() + 0.035 * scale)
            .max(space.wrist_column_half_width_m() + 0.03 * scale);
        let drop = rig.reach_m() * 0.955;
        let hanging = DVec3::new(
            sign * outwards,
            shoulder.y - drop,
            shoulder.z + 0.075 * scale,
        );
        let waist = space.waist_m();
        let front = space.front_m(waist);
        // In the front posture, the fingertips nearly meet, with the dominant hand slightly in
        // front.
        let nearer = if side == life.dominant { 0.02 } else { 0.0 };
        let in_front = DVec3::new(
            sign * 0.16 * scale,
            waist - nearer * 0.3 * scale,
            front + (0.055 + nearer) * scale,
        );
        let turn = |fingers, normal| {
            palm::from_directions(side, fingers, normal).unwrap_or(DQuat::IDENTITY)
        };
        Self {
            hanging: RestingHand {
                wrist: hanging,
                hand: turn(out(-0.04, -1.0, 0.16), out(-1.0, 0.0, -0.42)),
            },
            in_front: RestingHand {
                wrist: in_front,
                hand: turn(out(-0.82, -0.30, 0.46), out(-0.40, 0.35, -1.0)),
            },
            ready: DVec3::new(
                sign * 0.16 * scale,
                waist + 0.06 * scale,
                front + 0.14 * scale,
            ),
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
        let open = RestingHand {
            wrist: self.hanging.wrist + out(0.045, 0.085, 0.11) * scale,
            hand: hand.unwrap_or(self.hanging.hand),
        };
        (self.hanging, self.in_front) = (open, open);
    }

    /// Returns the pose of the resting hand at a story time, relative to the trunk in the zero
    /// pose.
    #[must_use]
    pub fn sample(&self, time_secs: f64) -> RestingHand {
        let s = self.front_share(time_secs);
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
            wrist: self.hanging.wrist.lerp(self.in_front.wrist, s) + drift,
            hand: self.hanging.hand.slerp(self.in_front.hand, s),
        }
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

    /// Returns the weight of the posture in front of the belly, 0 (arms hanging) to 1.
    fn front_share(&self, time_secs: f64) -> f64 {
        let posture = |bucket: i64| {
            let u = noise::unit(self.life.seed, RANDOM_POSTURE, bucket);
            if u < HANGING_SHARE { 0.0 } else { 1.0 }
        };
        // A story does not begin with a posture change; a less lively character holds a posture
        // longer.
        let phase = time_secs * self.life.amount + 0.4 * KEEP_SECS;
        let bucket = (phase / KEEP_SECS).floor();
        let since = (phase - bucket * KEEP_SECS) / self.life.amount.max(1e-6);
        let bucket = bucket as i64;
        // One arm follows the other by a tenth of a second.
        let lag = if self.side == self.life.dominant {
            0.0
        } else {
            0.1
        };
        let s = minimum_jerk((since - lag) / CHANGE_SECS);
        let before = posture(bucket.wrapping_sub(1));
        before + (posture(bucket) - before) * s
    }
}
