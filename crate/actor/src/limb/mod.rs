//! Limbs: arms and legs, their joint ranges and the solvers for their targets.
//!
//! All modules that drive a limb share one solver: [`two_bone`] is the hinge between two bones,
//! [`chain`] the joints of a limb on the bones of a figure, [`solve`] all joint angles for a
//! target, [`swivel`] the position of elbow or knee, [`limits`] the joint ranges, [`wrist`] a wrist
//! in the frame of its forearm, [`girdle`] the base of an arm, [`body_space`] and [`obstacles`] the
//! obstacles of an arm. Two policies use it: [`arm`], which places a wrist for gestures and
//! animations, and [`crate::manipulator`], which drives limbs by commands.
//!
//! A limb has the six joints of GEVH table 3.1 and a seventh that the thesis omits: the turn of the
//! upper bone about itself, which lets the elbow or knee swivel while the end stays in place.

pub mod arm;
pub mod body_space;
pub mod chain;
pub mod girdle;
pub mod limits;
pub mod obstacles;
pub mod solve;
pub mod swivel;
pub mod two_bone;
pub mod wrist;

use raconteur_base::{DAffine3, DQuat, DVec3, Length, Side};
use raconteur_body::{Bone, Figure};

pub use arm::{ArmGoal, ArmRig, ArmSolution};
pub use body_space::{BodySpace, TrunkShape};
pub use chain::LimbRig;
pub use limits::{Limit, Sex};
pub use solve::Solutions;

/// Scapula, shoulder, elbow and wrist of the left and right side.
pub const ARM_BONES: [[Bone; 4]; 2] = [
    [Bone::LScapula, Bone::LShoulder, Bone::LElbow, Bone::LWrist],
    [Bone::RScapula, Bone::RShoulder, Bone::RElbow, Bone::RWrist],
];

/// Hip, knee and ankle of the left and right side.
pub const LEG_BONES: [[Bone; 3]; 2] = [
    [Bone::LHip, Bone::LKnee, Bone::LSubtalar],
    [Bone::RHip, Bone::RKnee, Bone::RSubtalar],
];

/// Parameters of a figure's build that affect the motion of its limbs: sex and shape of the trunk.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Build {
    /// Sex, which selects the joint limits.
    pub sex: Sex,
    /// Shape of its trunk; `None` uses an average one.
    pub trunk: Option<TrunkShape>,
}

impl Build {
    /// Measures the build of a figure, including its clothes.
    #[must_use]
    pub fn from_figure(figure: &Figure) -> Self {
        Self {
            sex: Sex::from_share(figure.sex),
            trunk: Some(TrunkShape::from_figure(figure)),
        }
    }
}

/// Limb, or the head, that a manipulator command moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Limb {
    /// Arm from the left shoulder to the wrist.
    LeftArm,
    /// Arm from the right shoulder to the wrist.
    RightArm,
    /// Leg from the left hip to the ankle.
    LeftLeg,
    /// Leg from the right hip to the ankle.
    RightLeg,
    /// Neck and skull.
    Head,
}

impl Limb {
    /// All limbs, in the order of [`Limb::index`].
    pub const ALL: [Self; 5] = [
        Self::LeftArm,
        Self::RightArm,
        Self::LeftLeg,
        Self::RightLeg,
        Self::Head,
    ];

    /// Returns the index of the limb in [`Limb::ALL`], 0 to 4.
    #[must_use]
    pub fn index(self) -> usize {
        self as usize
    }

    /// Returns the side, and true for an arm; `None` for the head.
    #[must_use]
    pub fn side(self) -> Option<(Side, bool)> {
        match self {
            Self::LeftArm => Some((Side::Left, true)),
            Self::RightArm => Some((Side::Right, true)),
            Self::LeftLeg => Some((Side::Left, false)),
            Self::RightLeg => Some((Side::Right, false)),
            Self::Head => None,
        }
    }
}

/// Joint angles, radians. For a limb the six of GEVH table 3.1 and, last, the axial rotation of the
/// upper bone; for the head five, the rest 0. Zero is the neutral pose: arms hanging with the palms
/// to the thighs, legs standing, head upright. Equal angles on both sides mirror each other. Signs:
/// see [`limits::limits`].
pub type Joints = [f64; 7];

/// Position and orientation of a limb's end or target, in figure axes or the base axes of a
/// manipulator.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigidFrame {
    /// Position, metres.
    pub position: DVec3,
    /// Rotation of the target frame.
    pub rotation: DQuat,
}

impl RigidFrame {
    /// Interpolates towards another frame: straight line and shortest rotation.
    #[must_use]
    pub fn lerp(&self, to: &Self, share: f64) -> Self {
        Self {
            position: self.position.lerp(to.position, share),
            rotation: self.rotation.slerp(to.rotation, share).normalized(),
        }
    }

    /// Returns the frame transformed by a rigid motion.
    #[must_use]
    pub fn moved(&self, motion: &DAffine3) -> Self {
        Self {
            position: motion.transform_point3(self.position),
            rotation: (crate::kinematics::rotation_of(motion) * self.rotation).normalized(),
        }
    }
}
