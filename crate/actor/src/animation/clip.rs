//! Animations: motion over time, independent of the figure.

use raconteur_base::{DQuat, DVec3, Side};
use raconteur_body::Bone;
use raconteur_body::hand_shape::HandShape;

use super::curve::{Curve, Ease};
use super::groups::BoneSet;

/// Path of a foot in a clip, in units independent of the figure's size.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct FootTrack {
    /// Offset from the foot's place in the zero pose, shares of stature: outwards, up, to the
    /// front; and outward angle of the knee, radians.
    pub(crate) place: Curve,
    /// Radians: heel raised over the ball of the foot (negative: toes raised over the heel),
    /// toes turned outwards, sole turned inwards.
    pub(crate) turn: Curve,
}

/// Path of a hand in a clip, relative to the shoulders; each figure solves it for its own arm.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct ReachTrack {
    pub(crate) side: Side,
    pub(crate) keys: Vec<ReachKey>,
    pub(crate) ease: Ease,
}

/// Key of a [`ReachTrack`]: hand position and directions of fingers and palm at one time, for the
/// left hand. The right hand is mirrored.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ReachKey {
    pub(crate) time_secs: f64,
    /// Wrist from the middle between the shoulders, in the axes of the chest, shares of
    /// stature: outwards, up, to the front.
    pub(crate) place: DVec3,
    /// Directions of the fingers and of the palm in the chest's axes; a zero leaves the wrist
    /// relaxed.
    pub(crate) fingers: DVec3,
    pub(crate) palm: DVec3,
}

/// Animation of bones, root, feet and hands that fits any figure. [`super::Library`] creates clips
/// from files.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Clip {
    pub(crate) duration_secs: f64,
    /// True if the end continues into the beginning (a closed loop).
    pub(crate) closed: bool,
    /// Local rotations, relative to the zero pose.
    pub(crate) bones: Vec<(Bone, Curve)>,
    /// Displacement of the figure, shares of stature: left, up, front.
    pub(crate) root: Option<Curve>,
    /// The left and right foot.
    pub(crate) feet: [Option<FootTrack>; 2],
    pub(crate) reaches: Vec<ReachTrack>,
}

impl Clip {
    /// Returns the duration of one pass, seconds; 0 for a static posture.
    #[must_use]
    pub fn duration_secs(&self) -> f64 {
        self.duration_secs
    }

    /// Returns true if the clip's end continues into its beginning.
    #[must_use]
    pub fn is_closed(&self) -> bool {
        self.closed
    }

    /// Returns the distance that the clip moves the figure from its place, share of stature.
    #[must_use]
    pub fn travel(&self) -> f64 {
        const BASE_EXPRESSIONS: u32 = 32;
        self.root.as_ref().map_or(0.0, |root| {
            let at = |i: u32| self.duration_secs * f64::from(i) / f64::from(BASE_EXPRESSIONS);
            (0..=BASE_EXPRESSIONS)
                .map(|i| {
                    let [left, up, front, _] = root.sample(at(i));
                    DVec3::new(left, up, front).length()
                })
                .fold(0.0, f64::max)
        })
    }

    /// Returns the bones that the clip moves.
    #[must_use]
    pub fn moves(&self) -> BoneSet {
        let mut set = BoneSet::NONE;
        for (bone, _) in &self.bones {
            set = set.with(*bone);
        }
        for side in Side::BOTH {
            if self.feet[side.index()].is_some() {
                set = set.or(BoneSet::leg(side));
            }
        }
        for reach in &self.reaches {
            for bone in crate::limb::ARM_BONES[reach.side.index()] {
                set = set.with(bone);
            }
        }
        set
    }

    /// Returns a static clip that holds a hand shape of the dictionary (GEVH 3.5.1) on both hands.
    #[must_use]
    pub(crate) fn of_hand_shape(shape: &HandShape) -> Self {
        let hands = Side::BOTH
            .into_iter()
            .flat_map(|side| shape.rotations(side));
        let held = |q: DQuat| Curve::of_rotations(&[0.0], &[q], Ease::Step, None);
        Self {
            closed: true,
            bones: hands.map(|(bone, q)| (bone, held(q))).collect(),
            ..Self::default()
        }
    }
}
