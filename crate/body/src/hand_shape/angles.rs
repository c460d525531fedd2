//! Angles of a hand, and the rotations of its bones.

use std::sync::OnceLock;

use raconteur_base::{DQuat, DVec3, Length, Side};

use super::{LEFT_FINGER_BONES, finger_bones};
use crate::skeleton::{Bone, zero_frames};

/// Turn of each finger's flexion axis about the finger, left hand, index to little finger,
/// radians. Fingers whose axes were parallel would fan out in a fist; real ones converge
/// on the scaphoid. Chosen by eye, inside the rotations of F&H table 6.4.
pub const FINGER_ROLL_RAD: [f64; 4] = [
    3.0_f64.to_radians(),
    1.0_f64.to_radians(),
    (-2.0_f64).to_radians(),
    (-5.0_f64).to_radians(),
];

/// Turn of the thumb's flexion axis about the thumb from the y axis of table A.1, left hand,
/// radians: its nail points partly towards the back of the hand. Chosen by eye.
pub const THUMB_ROLL_RAD: f64 = (-22.0_f64).to_radians();

/// Joint angles of one finger, radians; 0 is straight.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FingerAngles {
    /// Knuckle, towards the palm.
    pub mcp_flexion: f64,
    /// Knuckle, towards the thumb.
    pub mcp_abduction: f64,
    /// Flexion of the middle (PIP) joint, radians.
    pub pip_flexion: f64,
    /// Flexion of the last (DIP) joint, radians.
    pub dip_flexion: f64,
}

/// Joint angles of the thumb, radians.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ThumbAngles {
    /// Saddle joint, across the palm; negative out to the side.
    pub cmc_flexion: f64,
    /// Saddle joint, away from the palm.
    pub cmc_abduction: f64,
    /// Saddle joint, about the thumb; negative is pronation.
    pub cmc_rotation: f64,
    /// Flexion of the knuckle (MCP joint), radians.
    pub mcp_flexion: f64,
    /// Flexion of the last (IP) joint, radians.
    pub ip_flexion: f64,
}

/// Angles of all joints of a hand, radians; hand shapes and gestures set fingers by them. Linear
/// blends stay inside the joint limits and bend every joint in its own plane.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct HandAngles {
    /// Index, middle, ring and little finger.
    pub fingers: [FingerAngles; 4],
    /// Joint angles of the thumb.
    pub thumb: ThumbAngles,
}

impl HandAngles {
    /// Creates the angles from degrees: a finger is `[mcp flexion, mcp abduction, pip, dip]`, the
    /// thumb `[cmc flexion, cmc abduction, cmc rotation, mcp, ip]`.
    #[must_use]
    pub const fn from_degrees(fingers: [[f64; 4]; 4], thumb: [f64; 5]) -> Self {
        const fn finger(deg: [f64; 4]) -> FingerAngles {
            FingerAngles {
                mcp_flexion: deg[0].to_radians(),
                mcp_abduction: deg[1].to_radians(),
                pip_flexion: deg[2].to_radians(),
                dip_flexion: deg[3].to_radians(),
            }
        }
        let [index, middle, ring, little] = fingers;
        Self {
            fingers: [finger(index), finger(middle), finger(ring), finger(little)],
            thumb: ThumbAngles {
                cmc_flexion: thumb[0].to_radians(),
                cmc_abduction: thumb[1].to_radians(),
                cmc_rotation: thumb[2].to_radians(),
                mcp_flexion: thumb[3].to_radians(),
                ip_flexion: thumb[4].to_radians(),
            },
        }
    }

    /// Returns the blend `self` · (1 − weight) + `other` · weight of every angle.
    #[must_use]
    pub fn lerp(&self, other: &Self, weight: f64) -> Self {
        let mix = |a: f64, b: f64| a + (b - a) * weight;
        let finger = |i: usize| {
            let (a, b) = (&self.fingers[i], &other.fingers[i]);
            FingerAngles {
                mcp_flexion: mix(a.mcp_flexion, b.mcp_flexion),
                mcp_abduction: mix(a.mcp_abduction, b.mcp_abduction),
                pip_flexion: mix(a.pip_flexion, b.pip_flexion),
                dip_flexion: mix(a.dip_flexion, b.dip_flexion),
            }
        };
        let (a, b) = (&self.thumb, &other.thumb);
        Self {
            fingers: core::array::from_fn(finger),
            thumb: ThumbAngles {
                cmc_flexion: mix(a.cmc_flexion, b.cmc_flexion),
                cmc_abduction: mix(a.cmc_abduction, b.cmc_abduction),
                cmc_rotation: mix(a.cmc_rotation, b.cmc_rotation),
                mcp_flexion: mix(a.mcp_flexion, b.mcp_flexion),
                ip_flexion: mix(a.ip_flexion, b.ip_flexion),
            },
        }
    }

    /// Returns the greatest difference between corresponding flexion angles of two hand shapes,
    /// radians.
    #[must_use]
    pub fn greatest_difference(&self, other: &Self) -> f64 {
        let pairs = self.fingers.iter().zip(&other.fingers);
        let fingers = pairs.map(|(a, b)| {
            let knuckle = (a.mcp_flexion - b.mcp_flexion).abs();
            let middle = (a.pip_flexion - b.pip_flexion).abs();
            knuckle
                .max(middle)
                .max((a.dip_flexion - b.dip_flexion).abs())
        });
        let (a, b) = (&self.thumb, &other.thumb);
        let saddle = (a.cmc_flexion - b.cmc_flexion).abs();
        let palmar = (a.cmc_abduction - b.cmc_abduction).abs();
        let bends = (a.mcp_flexion - b.mcp_flexion)
            .abs()
            .max((a.ip_flexion - b.ip_flexion).abs());
        fingers.fold(saddle.max(palmar).max(bends), f64::max)
    }

    /// Returns the local rotations of the finger bones relative to the zero pose, as stored in
    /// [`Pose`](crate::pose::Pose), in the order of [`finger_bones`].
    #[must_use]
    pub fn rotations(&self, side: Side) -> [(Bone, DQuat); 15] {
        let world = self.left_world();
        let zero = left_zero_frames();
        let bones = finger_bones(side);
        core::array::from_fn(|i| {
            let local = if i % 3 == 0 {
                zero[i].inverse() * world[i]
            } else {
                let zero_in_parent = zero[i - 1].inverse() * zero[i];
                zero_in_parent.inverse() * (world[i - 1].inverse() * world[i])
            };
            let q = local.normalized();
            let mirrored = match side {
                Side::Left => q,
                Side::Right => DQuat::from_xyzw(-q.x, -q.y, q.z, q.w),
            };
            (bones[i], mirrored)
        })
    }

    /// Returns the orientation of the left hand's finger bones, world from bone, with the wrist in
    /// the zero pose (fingers along +x, back of the hand up, thumb to the front).
    #[must_use]
    pub fn left_world(&self) -> [DQuat; 15] {
        let mut world = [DQuat::IDENTITY; 15];
        for (i, angles) in self.fingers.iter().enumerate() {
            let mut q = DQuat::from_rotation_y(-angles.mcp_abduction)
                * DQuat::from_rotation_x(FINGER_ROLL_RAD[i]);
            let bends = [angles.mcp_flexion, angles.pip_flexion, angles.dip_flexion];
            for (k, bend) in bends.into_iter().enumerate() {
                q *= DQuat::from_rotation_z(-bend);
                world[3 * i + k] = q;
            }
        }
        let t = &self.thumb;
        let at_rest = left_zero_frames()[12];
        let flexed = DQuat::from_rotation_y(t.cmc_flexion);
        let along = flexed * at_rest * DVec3::X;
        // Abduction tips the thumb out of the palm's plane, about the horizontal axis
        // square to it.
        let axis = DVec3::new(along.x, 0.0, along.z).cross(DVec3::NEG_Y);
        let abducted =
            DQuat::from_axis_angle(axis.try_normalized().unwrap_or(DVec3::Z), t.cmc_abduction);
        let along = abducted * along;
        let rolled = DQuat::from_axis_angle(along, -t.cmc_rotation);
        let roll = DQuat::from_rotation_x(THUMB_ROLL_RAD);
        let mut q = rolled * abducted * flexed * at_rest;
        world[12] = q;
        for (k, bend) in [t.mcp_flexion, t.ip_flexion].into_iter().enumerate() {
            q *= roll * DQuat::from_rotation_y(bend) * roll.inverse();
            world[13 + k] = q;
        }
        world
    }
}

/// Returns the zero frames of the left finger bones, world from bone; computed once.
fn left_zero_frames() -> &'static [DQuat; 15] {
    static FRAMES: OnceLock<[DQuat; 15]> = OnceLock::new();
    FRAMES.get_or_init(|| {
        let frames = zero_frames();
        LEFT_FINGER_BONES.map(|bone| frames[bone.index()])
    })
}
