//! Foundations shared by every crate: deterministic maths, curves, seeded noise.
//!
//! Scope: the `glam` types in double precision, trigonometry through `libm` so that native and wasm
//! agree bit for bit, motion curves, hash-based noise, colours as light, normals and
//! self-intersections of surfaces, encodings of text, segmentation of written language.
//! Out of scope: stories, bodies and time-keeping.
//!
//! Frames: right-handed, metres, radians, seconds; +x is the character's left,
//! +y up, +z front (glTF's own frame).

pub mod color;
pub mod curve;
pub mod encoding;
mod length;
mod node;
pub mod noise;
pub mod ops;
pub mod order;
pub mod panic;
pub mod printable;
pub mod profile;
pub mod self_intersection;
pub mod surface;
pub mod text;

pub use glam;
pub use glam::{DAffine3, DMat3, DMat4, DQuat, DVec2, DVec3};
pub use length::Length;
pub use node::NodeState;

/// Metres per inch; the unit of GEVH's skeleton table is inch-like (standing height about 77).
/// Exact by definition.
pub const METRES_PER_INCH: f64 = 0.0254;

/// Side of the body; "left" is always the character's left. Selects limbs, and the sign of x.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Side {
    /// The character's left, at positive x.
    Left,
    /// The character's right, at negative x.
    Right,
}

impl Side {
    /// Both sides, left first.
    pub const BOTH: [Self; 2] = [Self::Left, Self::Right];

    /// Returns the opposite side.
    #[must_use]
    pub fn opposite(self) -> Self {
        match self {
            Self::Left => Self::Right,
            Self::Right => Self::Left,
        }
    }

    /// Returns the sign of x on the side: +1 for left, −1 for right.
    #[must_use]
    pub fn sign(self) -> f64 {
        match self {
            Self::Left => 1.0,
            Self::Right => -1.0,
        }
    }

    /// Returns the array index of the side: 0 for left, 1 for right.
    #[must_use]
    pub fn index(self) -> usize {
        match self {
            Self::Left => 0,
            Self::Right => 1,
        }
    }
}

/// Mirrors a vector in the sagittal plane, x to −x.
#[must_use]
pub fn mirror_vector(v: DVec3) -> DVec3 {
    DVec3::new(-v.x, v.y, v.z)
}

/// Mirrors a rotation, given in world axes, on the sagittal plane: the axis is a pseudo-vector, so
/// its x component keeps its sign and the others change it.
#[must_use]
pub fn mirror_rotation(q: DQuat) -> DQuat {
    DQuat::from_xyzw(q.x, -q.y, -q.z, q.w)
}
