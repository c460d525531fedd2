//! What a gesture-key holds (GEVH 3.5.1, D.5), in EML's own units and axes.

use crate::Span;
use raconteur_base::Side;

/// Moves hands through shapes, palm orientations and positions. A track that is
/// missing leaves that feature as it was.
#[derive(Clone, Debug, PartialEq)]
pub struct GestureKey {
    /// Length in seconds, at least 0.
    pub duration_secs: f64,
    /// The hands that take part.
    pub handedness: Handedness,
    /// Shapes, at most one track a hand.
    pub hand_shapes: Vec<Track<ShapeKey>>,
    /// Palm orientations, at most one track a hand.
    pub palms: Vec<Track<PalmKey>>,
    /// Positions, at most one track a hand.
    pub motions: Vec<Track<MotionKey>>,
}

/// Which hands a gesture uses.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Handedness {
    /// Both hands.
    #[default]
    Both,
    /// The left hand.
    Left,
    /// The right hand.
    Right,
}

impl Handedness {
    /// Whether this hand takes part.
    #[must_use]
    pub fn includes(self, side: Side) -> bool {
        match self {
            Self::Both => true,
            Self::Left => side == Side::Left,
            Self::Right => side == Side::Right,
        }
    }
}

/// The course of one feature.
#[derive(Clone, Debug, PartialEq)]
pub struct Track<K> {
    /// The hand it moves. None: every hand that takes part; palms and motion are
    /// then given for the dominant hand and mirrored for the other (GEVH D.5.4).
    pub hand: Option<Side>,
    /// The keys by time, at least one.
    pub keys: Vec<Key<K>>,
    /// The whole element.
    pub span: Span,
}

/// A value to reach at a time.
#[derive(Clone, Debug, PartialEq)]
pub struct Key<K> {
    /// Seconds after the start of the gesture-key, at least 0.
    pub offset_secs: f64,
    /// What to reach.
    pub value: K,
    /// The whole element.
    pub span: Span,
}

/// A hand shape of Portuguese Sign Language.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ShapeKey {
    /// Its number, 0 to 60.
    pub id: u8,
}

/// A palm orientation.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PalmKey {
    /// Angle about the axis in degrees, left-hand rule.
    pub angle_deg: f64,
    /// The palm's outward normal: x left, y up, z back. Finite, not zero, not
    /// normalised.
    pub axis: [f64; 3],
}

/// A position of the wrist.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MotionKey {
    /// Where, in skeleton units: x left, y up, z back. Finite.
    pub position: [f64; 3],
    /// What the position is relative to.
    pub coords: Coords,
}

/// The origin of positions (GEVH appendix C).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Coords {
    /// The speaker's pelvis.
    #[default]
    Speaker,
    /// The floor point under the speaker's first place.
    World,
}
