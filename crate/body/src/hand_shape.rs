//! Hand shapes: the angles of the 20 finger joints by number, and the resulting local rotations of
//! the 15 finger bones.
//!
//! The numbers are those of the gesture dictionary of Portuguese sign language (LGP) that GEVH uses
//! for its hands (section 3.5, figures 3.13 and C.4). It describes only shape 7, the "open-like
//! claw" of the greeting; **all other numbers and all angles are designed** (chosen by eye and
//! solved for contacts), after
//! - letters and digits: the SignWriting symbols of the LGP fingerspelling alphabet
//!   (github.com/sign-language-processing/signwriting, `fingerspelling/data/psr.json`);
//! - proportions of bends: `HamNoSys` shapes of github.com/upf-gti/performs,
//!   `js/sigml/HandShape.js`;
//! - limits of every joint: F&H table 6.4.
//!
//! The angles of fingertip contacts (a pinch, a thumb across a fist) were solved by damped least
//! squares on the surface of the generated hand, pad against pad with at most 3 mm between them,
//! and stored in whole degrees. Closed fingers are opened at the knuckle until their tips only
//! touch the palm.
//!
//! Conventions. Angle zero is a flat hand whose fingers run parallel to the forearm, with the thumb
//! as in the zero pose of GEVH table A.1 (40° radial, 26° palmar). Flexion bends towards the palm;
//! abduction of a finger is positive towards the thumb, so that a spread hand has +18° at the index
//! and −18° at the little finger. A knuckle turns by abduction about the dorsal axis, then by
//! flexion. The thumb's saddle joint turns by flexion about the hand's dorsal axis (positive across
//! the palm), abduction away from the palm, and rotation about itself (negative: pronation, as in
//! opposition). At rest its nail is turned partly to the back of the hand, [`THUMB_ROLL_RAD`] away
//! from the frame of table A.1, so that the table of limits, which allows 10° of pronation, allows
//! 32° here.

mod angles;

use raconteur_base::{DQuat, Side};

pub use self::angles::{FINGER_ROLL_RAD, FingerAngles, HandAngles, THUMB_ROLL_RAD, ThumbAngles};
use crate::pose::Pose;
use crate::skeleton::Bone;

/// The finger bones of the left hand: index, middle, ring, little finger, thumb, each
/// from the hand outwards.
pub const LEFT_FINGER_BONES: [Bone; 15] = [
    Bone::LIndex0,
    Bone::LIndex1,
    Bone::LIndex2,
    Bone::LMiddle0,
    Bone::LMiddle1,
    Bone::LMiddle2,
    Bone::LRing0,
    Bone::LRing1,
    Bone::LRing2,
    Bone::LPinky0,
    Bone::LPinky1,
    Bone::LPinky2,
    Bone::LThumb0,
    Bone::LThumb1,
    Bone::LThumb2,
];

/// The finger bones of the right hand, in the order of [`LEFT_FINGER_BONES`].
pub const RIGHT_FINGER_BONES: [Bone; 15] = [
    Bone::RIndex0,
    Bone::RIndex1,
    Bone::RIndex2,
    Bone::RMiddle0,
    Bone::RMiddle1,
    Bone::RMiddle2,
    Bone::RRing0,
    Bone::RRing1,
    Bone::RRing2,
    Bone::RPinky0,
    Bone::RPinky1,
    Bone::RPinky2,
    Bone::RThumb0,
    Bone::RThumb1,
    Bone::RThumb2,
];

/// Returns the finger bones of a hand, in the order of [`LEFT_FINGER_BONES`].
#[must_use]
pub fn finger_bones(side: Side) -> &'static [Bone; 15] {
    match side {
        Side::Left => &LEFT_FINGER_BONES,
        Side::Right => &RIGHT_FINGER_BONES,
    }
}

/// Interpolates two hands' rotations by slerp: `a` at weight 0, `b` at 1. Both must be of the same
/// side; the bones of `a` are kept.
#[must_use]
pub fn blend_rotations(
    a: &[(Bone, DQuat); 15],
    b: &[(Bone, DQuat); 15],
    weight: f64,
) -> [(Bone, DQuat); 15] {
    core::array::from_fn(|i| (a[i].0, a[i].1.slerp(b[i].1, weight)))
}

/// Hand shape of the gesture dictionary (GEVH 3.5, Portuguese Sign Language), by its number;
/// gestures name it.
#[derive(Clone, Debug, PartialEq)]
pub struct HandShape {
    id: u8,
    name: &'static str,
    angles: HandAngles,
}

impl HandShape {
    /// All hand shapes, indexed by number.
    pub const ALL: &'static [Self; 61] = &SHAPES;

    /// The hanging hand, number 0: the shape to which a hand returns.
    pub const RELAXED: &'static Self = &SHAPES[0];

    /// Returns the hand shape with a number, 0 to 60; `None` for any other.
    #[must_use]
    pub fn get(id: u8) -> Option<&'static Self> {
        SHAPES.get(usize::from(id))
    }

    /// Returns the number of the hand shape in the dictionary, 0 to 60.
    #[must_use]
    pub fn id(&self) -> u8 {
        self.id
    }

    /// Returns the English name of the hand shape.
    #[must_use]
    pub fn name(&self) -> &'static str {
        self.name
    }

    /// Returns the joint angles of the hand shape.
    #[must_use]
    pub fn angles(&self) -> &HandAngles {
        &self.angles
    }

    /// Returns the local rotations of the finger bones of one hand; see [`HandAngles::rotations`].
    #[must_use]
    pub fn rotations(&self, side: Side) -> [(Bone, DQuat); 15] {
        self.angles.rotations(side)
    }

    /// Sets the finger bones of one hand of a pose.
    pub fn apply(&self, side: Side, pose: &mut Pose) {
        for (bone, rotation) in self.rotations(side) {
            pose.set(bone, rotation);
        }
    }
}

const fn shape(id: u8, name: &'static str, fingers: [[f64; 4]; 4], thumb: [f64; 5]) -> HandShape {
    HandShape {
        id,
        name,
        angles: HandAngles::from_degrees(fingers, thumb),
    }
}

/// Hand shapes in degrees, as [`HandAngles::from_degrees`] takes them.
#[rustfmt::skip]
static SHAPES: [HandShape; 61] = [
    shape(0, "relaxed hand", [[15.0, 4.0, 20.0, 10.0], [18.0, 0.0, 25.0, 14.0], [22.0, 0.0, 28.0, 16.0], [25.0, -6.0, 30.0, 18.0]], [0.0, 0.0, 0.0, 10.0, 10.0]),
    shape(1, "flat hand", [[0.0, 0.0, 0.0, 0.0], [0.0, 0.0, 0.0, 0.0], [0.0, 0.0, 0.0, 0.0], [0.0, 0.0, 0.0, 0.0]], [25.0, -23.0, 0.0, 5.0, 0.0]),
    shape(2, "flat hand, thumb out", [[0.0, 0.0, 0.0, 0.0], [0.0, 0.0, 0.0, 0.0], [0.0, 0.0, 0.0, 0.0], [0.0, 0.0, 0.0, 0.0]], [-30.0, -25.0, 0.0, -5.0, -10.0]),
    shape(3, "flat hand, thumb folded", [[0.0, 0.0, 0.0, 0.0], [0.0, 0.0, 0.0, 0.0], [0.0, 0.0, 0.0, 0.0], [0.0, 0.0, 0.0, 0.0]], [24.0, -29.0, -3.0, 61.0, 48.0]),
    shape(4, "open hand, spread", [[0.0, 18.0, 0.0, 0.0], [0.0, 2.0, 0.0, 0.0], [0.0, -8.0, 0.0, 0.0], [0.0, -18.0, 0.0, 0.0]], [-30.0, -25.0, 0.0, -5.0, -10.0]),
    shape(5, "four fingers spread, thumb folded", [[0.0, 18.0, 0.0, 0.0], [0.0, 2.0, 0.0, 0.0], [0.0, -8.0, 0.0, 0.0], [0.0, -18.0, 0.0, 0.0]], [28.0, -29.0, -4.0, 55.0, 48.0]),
    shape(6, "bent flat hand", [[80.0, 0.0, 0.0, 0.0], [82.0, 0.0, 0.0, 0.0], [84.0, 0.0, 0.0, 0.0], [85.0, 0.0, 0.0, 0.0]], [22.0, -24.0, 0.0, 4.0, 0.0]),
    shape(7, "open claw", [[5.0, 18.0, 45.0, 28.0], [8.0, 2.0, 48.0, 30.0], [8.0, -8.0, 48.0, 30.0], [5.0, -18.0, 42.0, 26.0]], [-10.0, 15.0, -4.0, 15.0, 35.0]),
    shape(8, "closed claw", [[25.0, 12.0, 80.0, 52.0], [28.0, 2.0, 82.0, 54.0], [30.0, -6.0, 82.0, 54.0], [28.0, -12.0, 76.0, 50.0]], [10.0, 35.0, -10.0, 20.0, 35.0]),
    shape(9, "C hand", [[50.0, 0.0, 43.0, 20.0], [50.0, 0.0, 43.0, 20.0], [50.0, 0.0, 43.0, 20.0], [50.0, 0.0, 43.0, 20.0]], [10.0, 35.0, -10.0, 20.0, 35.0]),
    shape(10, "wide cup", [[30.0, 5.0, 35.0, 18.0], [30.0, 0.0, 35.0, 18.0], [30.0, 0.0, 35.0, 18.0], [30.0, -6.0, 35.0, 18.0]], [0.0, 35.0, -8.0, 5.0, 10.0]),
    shape(11, "O hand", [[64.0, -6.0, 40.0, 8.0], [80.0, -15.0, 42.0, 12.0], [85.0, 0.0, 38.0, 12.0], [76.0, 0.0, 36.0, 14.0]], [43.0, 18.0, -32.0, -10.0, 0.0]),
    shape(12, "closed beak", [[90.0, -1.0, 20.0, -10.0], [100.0, -8.0, 23.0, -15.0], [98.0, 4.0, 18.0, -2.0], [96.0, 8.0, 18.0, 0.0]], [6.0, 35.0, -26.0, 33.0, 8.0]),
    shape(13, "open beak", [[45.0, 0.0, 8.0, 4.0], [47.0, 0.0, 8.0, 4.0], [49.0, 0.0, 8.0, 4.0], [51.0, 0.0, 8.0, 4.0]], [18.0, 35.0, -10.0, 10.0, 0.0]),
    shape(14, "fist", [[85.0, 2.0, 105.0, 70.0], [90.0, -4.0, 105.0, 70.0], [91.0, -4.0, 105.0, 70.0], [75.0, -10.0, 100.0, 65.0]], [33.0, 15.0, -32.0, 26.0, 55.0]),
    shape(15, "fist, thumb alongside", [[85.0, 2.0, 105.0, 70.0], [90.0, -4.0, 105.0, 70.0], [91.0, -4.0, 105.0, 70.0], [75.0, -10.0, 100.0, 65.0]], [2.0, 7.0, -26.0, 50.0, -10.0]),
    shape(16, "thumb up", [[85.0, 2.0, 105.0, 70.0], [90.0, -4.0, 105.0, 70.0], [91.0, -4.0, 105.0, 70.0], [75.0, -10.0, 100.0, 65.0]], [-25.0, -15.0, 0.0, -10.0, -20.0]),
    shape(17, "tucked fingertips", [[30.0, 0.0, 108.0, 70.0], [32.0, 0.0, 108.0, 70.0], [34.0, 0.0, 108.0, 70.0], [34.0, 0.0, 104.0, 68.0]], [25.0, -27.0, -8.0, 61.0, 49.0]),
    shape(18, "thumb between index and middle", [[85.0, 2.0, 105.0, 70.0], [90.0, -4.0, 105.0, 70.0], [91.0, -4.0, 105.0, 70.0], [75.0, -10.0, 100.0, 65.0]], [9.0, 13.0, -16.0, 34.0, 42.0]),
    shape(19, "pointing index", [[0.0, 0.0, 0.0, 0.0], [90.0, -4.0, 105.0, 70.0], [91.0, -4.0, 105.0, 70.0], [75.0, -10.0, 100.0, 65.0]], [18.0, 25.0, -32.0, 68.0, 3.0]),
    shape(20, "hooked index", [[5.0, 0.0, 95.0, 62.0], [90.0, -4.0, 105.0, 70.0], [91.0, -4.0, 105.0, 70.0], [75.0, -10.0, 100.0, 65.0]], [18.0, 25.0, -32.0, 68.0, 3.0]),
    shape(21, "index bent at base", [[75.0, 0.0, 0.0, 0.0], [90.0, -4.0, 105.0, 70.0], [91.0, -4.0, 105.0, 70.0], [75.0, -10.0, 100.0, 65.0]], [18.0, 25.0, -32.0, 68.0, 3.0]),
    shape(22, "curved index", [[35.0, 0.0, 45.0, 28.0], [90.0, -4.0, 105.0, 70.0], [91.0, -4.0, 105.0, 70.0], [75.0, -10.0, 100.0, 65.0]], [18.0, 25.0, -32.0, 68.0, 3.0]),
    shape(23, "index on circle", [[0.0, 0.0, 0.0, 0.0], [87.0, -7.0, 23.0, -15.0], [64.0, 0.0, 48.0, 26.0], [66.0, 0.0, 46.0, 24.0]], [41.0, 23.0, -29.0, 8.0, -15.0]),
    shape(24, "index-thumb pinch", [[59.0, -3.0, 42.0, 24.0], [90.0, -4.0, 105.0, 70.0], [91.0, -4.0, 105.0, 70.0], [75.0, -10.0, 100.0, 65.0]], [35.0, 8.0, -15.0, -5.0, -10.0]),
    shape(25, "open pinch", [[45.0, 0.0, 8.0, 4.0], [90.0, -4.0, 105.0, 70.0], [91.0, -4.0, 105.0, 70.0], [75.0, -10.0, 100.0, 65.0]], [18.0, 35.0, -10.0, 10.0, 0.0]),
    shape(26, "small C", [[50.0, 0.0, 43.0, 20.0], [90.0, -4.0, 105.0, 70.0], [91.0, -4.0, 105.0, 70.0], [75.0, -10.0, 100.0, 65.0]], [10.0, 35.0, -10.0, 20.0, 35.0]),
    shape(27, "ring, others open", [[60.0, -4.0, 43.0, 19.0], [15.0, 0.0, 8.0, 4.0], [6.0, -8.0, 5.0, 3.0], [0.0, -18.0, 3.0, 2.0]], [35.0, 8.0, -20.0, -7.0, -5.0]),
    shape(28, "F hand LGP", [[40.0, 0.0, 70.0, 40.0], [0.0, 0.0, 0.0, 0.0], [0.0, 0.0, 0.0, 0.0], [0.0, 0.0, 0.0, 0.0]], [5.0, 30.0, -8.0, 15.0, 40.0]),
    shape(29, "H hand LGP", [[20.0, 0.0, 85.0, 55.0], [0.0, 0.0, 0.0, 0.0], [0.0, 0.0, 0.0, 0.0], [0.0, 0.0, 0.0, 0.0]], [-10.0, 15.0, -4.0, 15.0, 35.0]),
    shape(30, "P hand LGP", [[77.0, 2.0, 55.0, 8.0], [0.0, 0.0, 0.0, 0.0], [0.0, 0.0, 0.0, 0.0], [0.0, 0.0, 0.0, 0.0]], [21.0, 30.0, -23.0, 46.0, 52.0]),
    shape(31, "three ulnar fingers half bent", [[85.0, 2.0, 105.0, 70.0], [10.0, 6.0, 55.0, 35.0], [10.0, -4.0, 55.0, 35.0], [10.0, -14.0, 50.0, 32.0]], [-1.0, 23.0, -32.0, 65.0, 1.0]),
    shape(32, "L hand", [[0.0, 0.0, 0.0, 0.0], [90.0, -4.0, 105.0, 70.0], [91.0, -4.0, 105.0, 70.0], [75.0, -10.0, 100.0, 65.0]], [-30.0, -25.0, 0.0, -5.0, -10.0]),
    shape(33, "L with hooked index", [[5.0, 0.0, 90.0, 60.0], [90.0, -4.0, 105.0, 70.0], [91.0, -4.0, 105.0, 70.0], [75.0, -10.0, 100.0, 65.0]], [-30.0, -25.0, 0.0, -5.0, -10.0]),
    shape(34, "E hand LGP", [[50.0, -2.0, 75.0, 31.0], [90.0, -4.0, 105.0, 70.0], [91.0, -4.0, 105.0, 70.0], [75.0, -10.0, 100.0, 65.0]], [24.0, 13.0, -18.0, 29.0, 55.0]),
    shape(35, "A hand LGP", [[36.0, -7.0, 25.0, 12.0], [64.0, -2.0, 42.0, 21.0], [91.0, -4.0, 105.0, 70.0], [75.0, -10.0, 100.0, 65.0]], [42.0, 10.0, -30.0, 6.0, -13.0]),
    shape(36, "K hand", [[0.0, 6.0, 0.0, 0.0], [72.0, -3.0, 8.0, 4.0], [91.0, -4.0, 105.0, 70.0], [75.0, -10.0, 100.0, 65.0]], [36.0, 1.0, -21.0, 15.0, -10.0]),
    shape(37, "U hand", [[0.0, 1.0, 0.0, 0.0], [0.0, 2.0, 0.0, 0.0], [91.0, -4.0, 105.0, 70.0], [75.0, -10.0, 100.0, 65.0]], [38.0, 15.0, -28.0, 45.0, 29.0]),
    shape(38, "V hand", [[0.0, 13.0, 0.0, 0.0], [0.0, -10.0, 0.0, 0.0], [91.0, -4.0, 105.0, 70.0], [75.0, -10.0, 100.0, 65.0]], [38.0, 15.0, -28.0, 45.0, 29.0]),
    shape(39, "hooked V", [[10.0, 12.0, 90.0, 58.0], [10.0, -9.0, 90.0, 58.0], [91.0, -4.0, 105.0, 70.0], [75.0, -10.0, 100.0, 65.0]], [38.0, 15.0, -28.0, 45.0, 29.0]),
    shape(40, "N hand", [[78.0, 1.0, 0.0, 0.0], [80.0, -2.0, 0.0, 0.0], [91.0, -4.0, 105.0, 70.0], [75.0, -10.0, 100.0, 65.0]], [38.0, 15.0, -28.0, 45.0, 29.0]),
    shape(41, "R hand", [[15.0, 0.0, 85.0, 55.0], [0.0, 0.0, 0.0, 0.0], [91.0, -4.0, 105.0, 70.0], [75.0, -10.0, 100.0, 65.0]], [38.0, 15.0, -28.0, 45.0, 29.0]),
    shape(42, "crossed fingers", [[32.0, -8.0, 3.0, 8.0], [-6.0, 14.0, 30.0, 18.0], [91.0, -4.0, 105.0, 70.0], [75.0, -10.0, 100.0, 65.0]], [38.0, 15.0, -28.0, 45.0, 29.0]),
    shape(43, "thumb index middle spread", [[0.0, 14.0, 0.0, 0.0], [0.0, -8.0, 0.0, 0.0], [91.0, -4.0, 105.0, 70.0], [75.0, -10.0, 100.0, 65.0]], [-30.0, -25.0, 0.0, -5.0, -10.0]),
    shape(44, "triple pinch", [[64.0, -8.0, 39.0, 8.0], [84.0, -15.0, 35.0, 6.0], [91.0, -4.0, 105.0, 70.0], [75.0, -10.0, 100.0, 65.0]], [43.0, 18.0, -32.0, -10.0, 2.0]),
    shape(45, "triple claw", [[15.0, 12.0, 70.0, 45.0], [15.0, -8.0, 72.0, 46.0], [91.0, -4.0, 105.0, 70.0], [75.0, -10.0, 100.0, 65.0]], [10.0, 35.0, -10.0, 20.0, 35.0]),
    shape(46, "W hand (unit)", [[0.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 1.0, 3.0, 2.0], [75.0, -10.0, 100.0, 65.0]], [54.0, 5.0, -16.0, 42.0, 0.0]),
    shape(47, "three fingers spread", [[0.0, 15.0, 0.0, 0.0], [0.0, 0.0, 0.0, 0.0], [0.0, -13.0, 3.0, 2.0], [75.0, -10.0, 100.0, 65.0]], [54.0, 5.0, -16.0, 42.0, 0.0]),
    shape(48, "M hand", [[78.0, 3.0, 0.0, 0.0], [80.0, 0.0, 0.0, 0.0], [82.0, 0.0, 0.0, 0.0], [75.0, -10.0, 100.0, 65.0]], [54.0, 5.0, -16.0, 42.0, 0.0]),
    shape(49, "little finger", [[85.0, 2.0, 105.0, 70.0], [90.0, -4.0, 105.0, 70.0], [91.0, -4.0, 105.0, 70.0], [0.0, -8.0, 0.0, 0.0]], [33.0, 15.0, -32.0, 26.0, 55.0]),
    shape(50, "thumb and little finger", [[85.0, 2.0, 105.0, 70.0], [90.0, -4.0, 105.0, 70.0], [91.0, -4.0, 105.0, 70.0], [0.0, -20.0, 0.0, 0.0]], [-25.0, -15.0, 0.0, -10.0, -20.0]),
    shape(51, "horns", [[0.0, 5.0, 0.0, 0.0], [90.0, -4.0, 105.0, 70.0], [91.0, -4.0, 105.0, 70.0], [0.0, -12.0, 0.0, 0.0]], [18.0, 25.0, -32.0, 68.0, 3.0]),
    shape(52, "thumb index little", [[0.0, 8.0, 0.0, 0.0], [90.0, -4.0, 105.0, 70.0], [91.0, -4.0, 105.0, 70.0], [0.0, -15.0, 0.0, 0.0]], [-30.0, -25.0, 0.0, -5.0, -10.0]),
    shape(53, "middle-thumb hook", [[85.0, 2.0, 105.0, 70.0], [25.0, 0.0, 70.0, 42.0], [91.0, -4.0, 105.0, 70.0], [75.0, -10.0, 100.0, 65.0]], [10.0, 35.0, -10.0, 20.0, 35.0]),
    shape(54, "bent middle finger, others open", [[0.0, 18.0, 0.0, 0.0], [60.0, 2.0, 5.0, 3.0], [0.0, -8.0, 0.0, 0.0], [0.0, -18.0, 0.0, 0.0]], [-30.0, -25.0, 0.0, -5.0, -10.0]),
    shape(55, "middle-thumb ring, others open", [[0.0, 18.0, 5.0, 3.0], [74.0, -15.0, 40.0, 18.0], [5.0, -8.0, 5.0, 3.0], [0.0, -18.0, 3.0, 2.0]], [20.0, 21.0, -25.0, 15.0, 39.0]),
    shape(56, "snap", [[10.0, 0.0, 20.0, 10.0], [66.0, -13.0, 43.0, 14.0], [91.0, -4.0, 105.0, 70.0], [75.0, -10.0, 100.0, 65.0]], [47.0, 13.0, -26.0, -2.0, -10.0]),
    shape(57, "shallow bowl", [[20.0, 0.0, 22.0, 12.0], [20.0, 0.0, 22.0, 12.0], [20.0, 0.0, 22.0, 12.0], [20.0, 0.0, 22.0, 12.0]], [24.0, -21.0, 0.0, 5.0, 0.0]),
    shape(58, "cylinder grip", [[50.0, 0.0, 65.0, 35.0], [55.0, 0.0, 68.0, 38.0], [58.0, 0.0, 68.0, 38.0], [60.0, 0.0, 65.0, 35.0]], [20.0, 35.0, -10.0, 15.0, 20.0]),
    shape(59, "sphere grip", [[35.0, 18.0, 40.0, 22.0], [38.0, 2.0, 42.0, 24.0], [38.0, -8.0, 42.0, 24.0], [35.0, -18.0, 38.0, 20.0]], [0.0, 35.0, -8.0, 5.0, 10.0]),
    shape(60, "soft fist", [[55.0, 1.0, 80.0, 50.0], [60.0, 0.0, 85.0, 55.0], [65.0, -1.0, 85.0, 55.0], [65.0, 0.0, 80.0, 50.0]], [30.0, -8.0, -2.0, -2.0, -11.0]),
];

#[cfg(test)]
mod tests {
    use raconteur_base::{DVec3, mirror_vector};

    use super::*;
    use crate::skeleton::Skeleton;

    /// Tips of the five fingers, world, the soft tip an inch beyond the last joint.
    fn tips(id: u8, side: Side) -> [DVec3; 5] {
        let mut pose = Pose::zero();
        HandShape::get(id).unwrap().apply(side, &mut pose);
        let mut world = Vec::new();
        Skeleton::example().solve(&pose, &mut world);
        core::array::from_fn(|f| {
            let joint = world[finger_bones(side)[3 * f + 2].index()];
            joint.transform_point3(DVec3::X * raconteur_base::METRES_PER_INCH)
        })
    }

    #[test]
    fn every_shape_stays_inside_the_joint_limits() {
        // F&H table 6.4: flexion and abduction of the knuckles, fingers two to five.
        let mcp = [
            [-25.0, 90.0, -20.0, 30.0],
            [-25.0, 100.0, -15.0, 15.0],
            [-25.0, 115.0, -15.0, 15.0],
            [-25.0, 115.0, -25.0, 15.0],
        ];
        let within = |rad: f64, low: f64, high: f64, what: &str| {
            let deg = rad.to_degrees();
            assert!(
                deg >= low - 1e-9 && deg <= high + 1e-9,
                "{what}: {deg} not in {low}..{high}"
            );
        };
        for shape in HandShape::ALL {
            for (finger, [f0, f1, a0, a1]) in shape.angles().fingers.iter().zip(mcp) {
                within(finger.mcp_flexion, f0, f1, shape.name());
                within(finger.mcp_abduction, a0, a1, shape.name());
                within(finger.pip_flexion, -5.0, 110.0, shape.name());
                within(finger.dip_flexion, -15.0, 90.0, shape.name());
            }
            let thumb = &shape.angles().thumb;
            within(thumb.cmc_flexion, -35.0, 55.0, shape.name());
            within(thumb.cmc_abduction, -40.0, 35.0, shape.name());
            let roll = THUMB_ROLL_RAD.to_degrees();
            within(thumb.cmc_rotation, roll - 10.0, 0.0, shape.name());
            within(thumb.mcp_flexion, -30.0, 85.0, shape.name());
            within(thumb.ip_flexion, -60.0, 90.0, shape.name());
        }
    }

    #[test]
    fn the_index_is_the_number() {
        for (i, shape) in HandShape::ALL.iter().enumerate() {
            assert_eq!(usize::from(shape.id()), i);
        }
        assert!(
            HandShape::get(61).is_none(),
            "no hand shape has the number 61"
        );
    }

    #[test]
    fn left_and_right_mirror_each_other() {
        for shape in HandShape::ALL {
            let (l, r) = (tips(shape.id(), Side::Left), tips(shape.id(), Side::Right));
            for (l, r) in l.into_iter().zip(r) {
                assert!(
                    (mirror_vector(l) - r).length() < 1e-9,
                    "{} {l} {r}",
                    shape.name()
                );
            }
        }
    }

    #[test]
    fn a_flat_hand_has_parallel_fingers() {
        let mut pose = Pose::zero();
        HandShape::get(1).unwrap().apply(Side::Left, &mut pose);
        let mut world = Vec::new();
        Skeleton::example().solve(&pose, &mut world);
        for bone in &LEFT_FINGER_BONES[..12] {
            let along = world[bone.index()].transform_vector3(DVec3::X);
            assert!(along.x > 1.0 - 1e-9, "{} {along}", bone.name());
        }
    }

    #[test]
    fn a_fist_brings_the_fingertips_to_the_palm() {
        let wrist = Bone::LWrist.example_position_m();
        let knuckle = Bone::LMiddle0.example_position_m();
        let palm = wrist.lerp(knuckle, 0.6) - DVec3::Y * 0.01;
        for tip in &tips(14, Side::Left)[..4] {
            assert!((*tip - palm).length() < 0.045, "{tip} {palm}");
        }
        for tip in &tips(1, Side::Left)[..4] {
            assert!((*tip - palm).length() > 0.09, "{tip} {palm}");
        }
    }

    #[test]
    fn seven_is_an_open_claw() {
        let shape = HandShape::get(7).unwrap();
        assert_eq!(shape.name(), "open claw");
        let spread =
            shape.angles().fingers[0].mcp_abduction - shape.angles().fingers[3].mcp_abduction;
        assert!(
            spread.to_degrees() > 30.0,
            "the fingers spread by more than 30 degrees"
        );
        // Open: far from the fist's tips; claw: the tips are well below the knuckles.
        let knuckle = Bone::LMiddle0.example_position_m();
        for (claw, fist) in tips(7, Side::Left).iter().zip(tips(14, Side::Left)).take(4) {
            assert!(
                claw.x > knuckle.x + 0.03 && (*claw - fist).length() > 0.05,
                "the claw is open and far from the fist"
            );
            assert!(
                claw.y < knuckle.y - 0.02,
                "the fingertips are below the knuckle"
            );
        }
    }

    #[test]
    fn a_pinch_brings_thumb_and_index_together_and_opposite_ends_blend() {
        let [index, .., thumb] = tips(24, Side::Right);
        assert!((index - thumb).length() < 0.03, "{index} {thumb}");
        let (a, b) = (HandShape::RELAXED, HandShape::get(14).unwrap());
        let (ra, rb) = (a.rotations(Side::Left), b.rotations(Side::Left));
        assert_eq!(a.angles().lerp(b.angles(), 0.0), *a.angles());
        for (blended, end) in blend_rotations(&ra, &rb, 1.0).iter().zip(rb) {
            assert!(
                blended.1.angle_between(end.1) < 1e-6,
                "the full blend equals the second hand shape"
            );
        }
    }
}
