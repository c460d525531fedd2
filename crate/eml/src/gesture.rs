//! Content of a gesture-key (GEVH 3.5.1, D.5), in EML's own units and axes.

use crate::Span;
use crate::record::{record, words};
use raconteur_base::Side;

words! {
    /// A phase of a gesture (GEVH 3.5.2 and appendix C; extension).
    Phase {
        /// The movement to the start of the stroke.
        Preparation = "preparation",
        /// A hold before the stroke.
        PreStroke = "prestroke",
        /// The meaningful phase.
        Stroke = "stroke",
        /// A hold after the stroke.
        PostStroke = "poststroke",
        /// The return to rest.
        Retraction = "retraction",
        /// A return that ends early.
        PartialRetraction = "partial-retraction",
    }
}

words! {
    /// The course between two keys (GEVH 3.5.1; extension).
    Interpolator {
        /// Constant speed.
        Linear = "linear",
        /// Slow at both ends.
        Cosine = "cosine",
        /// Bézier curve from (0, 0) to (1, 1) with two control points.
        Bezier = "bezier",
        /// Hermite curve from 0 to 1 with a slope at each end.
        Hermite = "hermite",
    }
}

impl Interpolator {
    /// Returns the number of control values of the interpolation.
    #[must_use]
    pub fn controls(self) -> usize {
        match self {
            Self::Linear | Self::Cosine => 0,
            Self::Bezier => 4,
            Self::Hermite => 2,
        }
    }
}

words! {
    /// The interpolated quantity (GEVH 3.5.1; extension).
    Space {
        /// Positions.
        Cartesian = "cartesian",
        /// Joint angles.
        Joint = "joint",
    }
}

record! {
    /// Transition of a hand to a key, or to all keys of a track (extension). Missing values come
    /// from the track, and then from the gesture planner.
    Profile = "" {
        /// The course.
        interpolator: Option<Interpolator> = "interpolation",
        /// Control values of the interpolation: x and y of both points, or both slopes.
        controls: Option<Vec<f64>> = "controls",
        /// The interpolated quantity.
        space: Option<Space> = "space",
    }
}

/// Gesture clause: moves hands through hand shapes, palm orientations and positions. A feature
/// without a track stays unchanged.
#[derive(Clone, Debug, PartialEq)]
pub struct GestureKey {
    /// Length in seconds, at least 0.
    pub duration_secs: f64,
    /// Hands that take part.
    pub handedness: Handedness,
    /// The phase of a gesture that it is (extension).
    pub phase: Option<Phase>,
    /// Velocity profile of the whole, overriding the profiles of its keys (extension); `None`: the
    /// times of the keys.
    pub pace: Option<Box<Profile>>,
    /// Shapes, at most one track a hand.
    pub hand_shapes: Box<[Track<ShapeKey>]>,
    /// Palm orientations, at most one track a hand.
    pub palms: Box<[Track<PalmKey>]>,
    /// Positions, at most one track a hand.
    pub motions: Box<[Track<MotionKey>]>,
}

/// Hands that perform a gesture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Handedness {
    /// Left and right hand.
    #[default]
    Both,
    /// The left hand.
    Left,
    /// The right hand.
    Right,
    /// The speaker's dominant hand (extension). Values are written for the hand that the script
    /// assumes dominant, and mirrored for the other.
    Dominant,
    /// The speaker's other hand, likewise (extension).
    NonDominant,
}

impl Handedness {
    /// All values with their EML words.
    pub(crate) const WORDS: [(Self, &'static str); 5] = [
        (Self::Both, "both"),
        (Self::Left, "left"),
        (Self::Right, "right"),
        (Self::Dominant, "dominant"),
        (Self::NonDominant, "non-dominant"),
    ];

    /// Returns true if this hand of a speaker with a given dominant hand takes part.
    #[must_use]
    pub fn includes(self, side: Side, dominant: Side) -> bool {
        match self {
            Self::Both => true,
            Self::Left => side == Side::Left,
            Self::Right => side == Side::Right,
            Self::Dominant => side == dominant,
            Self::NonDominant => side != dominant,
        }
    }

    /// Returns true if the hand depends on the speaker.
    #[must_use]
    pub fn is_relative(self) -> bool {
        matches!(self, Self::Dominant | Self::NonDominant)
    }
}

/// Keyed values of one feature of a gesture (hand shape, palm or position) for one hand or both.
#[derive(Clone, Debug, PartialEq)]
pub struct Track<K> {
    /// Hand to move. `None`: every hand that takes part; palms and motion are then given for the
    /// dominant hand and mirrored for the other (GEVH D.5.4).
    pub hand: Option<Side>,
    /// The keys by time, at least one.
    pub keys: Vec<Key<K>>,
    /// Transition between the keys; `None`: chosen by the gesture planner.
    pub profile: Option<Box<Profile>>,
    /// Span of the whole element.
    pub span: Span,
}

/// Key of a gesture track: value to reach at a time.
#[derive(Clone, Debug, PartialEq)]
pub struct Key<K> {
    /// Seconds after the start of the gesture-key, at least 0.
    pub offset_secs: f64,
    /// Value to reach at the key.
    pub value: K,
    /// Transition to it; `None`: that of the track.
    pub profile: Option<Box<Profile>>,
    /// Span of the whole element.
    pub span: Span,
}

/// Hand shape of Portuguese Sign Language to reach, optionally blended with a second one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ShapeKey {
    /// Number of the hand shape, 0 to 60.
    pub id: u8,
    /// A second shape and its share, 0 to 1 (extension).
    pub blend: Option<(u8, f64)>,
}

/// Palm orientation to reach: axis and angle about it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PalmKey {
    /// Angle about the axis in degrees, left-hand rule.
    pub angle_deg: f64,
    /// The palm's outward normal: x left, y up, z back. Finite, not zero, not
    /// normalised.
    pub axis: [f64; 3],
}

/// Wrist position to reach, with the origin of its coordinates.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MotionKey {
    /// Position, in skeleton units: x left, y up, z back. Finite.
    pub position: [f64; 3],
    /// Reference frame of the position.
    pub coords: Coords,
}

/// Origin of wrist positions: speaker or world (GEVH appendix C).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Coords {
    /// The speaker's pelvis.
    #[default]
    Speaker,
    /// The floor point under the speaker's initial place.
    World,
}
