//! Rotation of a joint by its bones.

use raconteur_base::{DQuat, DVec3, Side};

use super::Bone;

/// Source of a joint's rotation, for example a bone, a share of a bone's rotation, an eye, or a
/// spring.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Drive {
    /// A bone of appendix A: its own rotation in the pose.
    Bone(Bone),
    /// A share of a bone's rotation (slerp from none), at the bone's own place but attached to the
    /// bone's parent: preserves volume at elbow, knee and finger joints.
    Share(Bone, f64),
    /// A share of the rotation of a bone about its own x axis (its twist), hanging on
    /// the bone's parent: spreads the wrist's twist along the forearm.
    Twist(Bone, f64),
    /// A share of a bone's swing (its rotation without the twist) and a share of its twist, at the
    /// bone's own place but attached to the bone's parent: the skin of the upper arm follows the
    /// arm in every direction and its twist only gradually.
    Part(Bone, f64, f64),
    /// An eyeball; hangs on the skull.
    Eye(Side),
    /// An upper lid, at the centre of the eyeball; hangs on the skull.
    UpperLid(Side),
    /// A lower lid, at the centre of the eyeball; hangs on the skull.
    LowerLid(Side),
    /// Swings; chains count from 0, and so do the joints of one. At rest in every pose.
    Spring(u8, u8),
    /// Fixed relative to its parent.
    Fixed,
}

impl Drive {
    /// Returns the half-turn helper of a bone. Shoulder and wrist also twist: the shoulder's half
    /// leaves the twist to the upper arm's helpers, the wrist's continues the forearm's.
    #[must_use]
    pub fn half(bone: Bone) -> Self {
        match bone {
            Bone::LShoulder | Bone::RShoulder => Self::Part(bone, 0.5, 0.0),
            Bone::LWrist | Bone::RWrist => Self::Part(bone, 0.5, 5.0 / 6.0),
            _ => Self::Share(bone, 0.5),
        }
    }

    /// Returns the bone whose rotation drives the joint; `None` for eyes, lids, springs and fixed
    /// joints.
    #[must_use]
    pub fn bone(self) -> Option<Bone> {
        match self {
            Self::Bone(b) | Self::Share(b, _) | Self::Twist(b, _) | Self::Part(b, ..) => Some(b),
            _ => None,
        }
    }

    /// Returns the share of its bone's rotation that the joint takes, 0 to 2: swing and twist count
    /// one each.
    #[must_use]
    pub fn share(self) -> f64 {
        match self {
            Self::Bone(_) => 2.0,
            Self::Share(_, share) => 2.0 * share,
            Self::Twist(_, twist) => twist,
            Self::Part(_, swing, twist) => swing + twist,
            _ => 0.0,
        }
    }

    /// Returns the joint's rotation for its bone's rotation from the zero pose.
    #[must_use]
    pub fn of_turn(self, turn: DQuat) -> DQuat {
        let none = DQuat::IDENTITY;
        match self {
            Self::Bone(_) => turn,
            Self::Share(_, share) => none.slerp(turn, share),
            Self::Twist(_, share) => none.slerp(twist_about_x(turn), share),
            Self::Part(_, swing, share) => {
                let twist = twist_about_x(turn);
                none.slerp(turn * twist.inverse(), swing) * none.slerp(twist, share)
            }
            _ => none,
        }
    }

    /// Returns the displacement of a half joint in its own frame under a turn of its bone, as a
    /// share of stature. A bent joint bares the head of its bone: without this the back of a
    /// knuckle flattens and elbow and knee lose volume. Designed: 1.9 mm at the knuckles, 1.1 mm at
    /// the other joints of a finger, 11 mm at the elbow and 39 mm at the knee of an adult at full
    /// flexion.
    #[must_use]
    pub fn rise(self, turn: DQuat) -> DVec3 {
        let Self::Share(bone, _) = self else {
            return DVec3::ZERO;
        };
        let after_wrist = if bone > Bone::LWrist {
            bone.index() - Bone::LIndex0.index()
        } else {
            bone.index().wrapping_sub(Bone::RIndex0.index())
        };
        let full = match (bone, after_wrist) {
            (Bone::LElbow | Bone::RElbow, _) => -DVec3::Y * 0.0065,
            (Bone::LKnee, _) => DVec3::Z * 0.023,
            (Bone::RKnee, _) => -DVec3::Z * 0.023,
            (_, 0 | 3 | 6 | 9) => DVec3::Y * 0.0011,
            (_, 0..12) => DVec3::Y * 0.000_65,
            _ => DVec3::ZERO,
        };
        // The square of the sine of half the angle.
        full * (1.0 - turn.w * turn.w)
    }
}

/// Returns the twist of a rotation about its own x axis (swing–twist decomposition).
#[must_use]
pub fn twist_about_x(q: DQuat) -> DQuat {
    let norm = raconteur_base::ops::hypot(q.x, q.w);
    if norm < 1e-12 {
        return DQuat::IDENTITY;
    }
    // The sign of w selects the shorter rotation.
    let sign = if q.w < 0.0 { -1.0 } else { 1.0 };
    DQuat::from_xyzw(sign * q.x / norm, 0.0, 0.0, sign * q.w / norm)
}
