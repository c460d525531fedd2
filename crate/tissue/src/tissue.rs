//! What a face is made of under its skin: nodes of the skin, the muscles below them, and what
//! they may not pass through. Made once for each figure by the generator, from its geometry
//! (F&H section 3.1.2), and kept in its file.

use super::Muscle;

/// A point of a muscle fibre at rest.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FibrePoint {
    /// Place in the bind pose, metres.
    pub rest: [f32; 3],
    /// Way to the skin, unit length.
    pub outwards: [f32; 3],
    /// Share of the lower jaw in where it is, 0 to 1.
    pub jaw: f32,
}

/// How the points of a fibre move when it contracts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FibreCurve {
    /// Towards the first point, the origin, along the fibre. Points lie at even distances.
    Linear,
    /// Towards a place, in the plane of the muscle: orbicularis oculi.
    Towards([f32; 3]),
    /// As a half of the ring of the mouth, from the right corner to the left: upper or lower,
    /// and how far out it lies, 0 at the red of the lips to 1.
    Oris {
        /// Whether it lies in the lower lip.
        is_lower: bool,
        /// 0 at the red of the lips to 1.
        out: f32,
    },
}

/// A fibre: a piece of a muscle's grid (F&H 3.1.2, "Building Muscles").
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fibre {
    /// Whose it is.
    pub muscle: Muscle,
    /// How it moves.
    pub course: FibreCurve,
    /// Its first point in [`Tissue::points`].
    pub first: u16,
    /// How many points it has, at least two.
    pub count: u8,
}

/// A node's hold on a fibre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Attachment {
    /// The point of the fibre before the place of the hold.
    pub point: u16,
    /// How far on to the next point, 0 to 1.
    pub on: f32,
    /// Share of the fibre's movement that the node takes.
    pub weight: f32,
}

/// Where the end of a linear fibre is grown into the ring of the mouth: the two move each
/// other (F&H 3.1.2, "Properties").
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Link {
    /// Last point of the linear fibre.
    pub end: u16,
    /// Point of the ring.
    pub ring: u16,
    /// How much of the end's movement the point of the ring takes.
    pub weight: f32,
}

/// The two lips at one place along the mouth.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Column {
    /// Nodes of the upper and of the lower lip that touch each other at rest.
    pub contact: [u16; 2],
    /// Edge of the upper teeth there, bind pose, metres; where the lower lip goes for f and v.
    pub edge: [f32; 3],
    /// How far the lower lip reaches for the teeth there: 1 in the middle, 0 at the corner.
    pub bites: f32,
}

/// A node that moves with its column when the lips are sealed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LipNode {
    /// The node.
    pub node: u16,
    /// Its column.
    pub column: u16,
    /// Share of the gap that it closes: up to −0.36 in the upper lip, 0.64 in the lower.
    pub closes: f32,
}

/// The outer face of one row of teeth with its gums: distance from an upright axis by height
/// and direction.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Arch {
    /// A point of the axis, at the height of the first row; bind pose, metres.
    pub origin: [f32; 3],
    /// Distance between rows, metres.
    pub step_m: f32,
    /// Rows, upwards.
    pub rows: u16,
    /// Columns from the right, where the direction is −1, to the left, where it is 1; see
    /// [`Arch::direction`].
    pub columns: u16,
    /// Distances from the axis, metres, row by row; 0 where there is nothing.
    pub radii: Vec<f32>,
}

impl Arch {
    /// A measure of direction about the axis without trigonometry: 0 ahead, ±1 to the sides.
    #[must_use]
    pub fn direction(x: f32, z: f32) -> f32 {
        x / (x.abs() + z.max(1e-6))
    }
}

/// The soft parts of a face. Lists have lengths as their parts say; code that reads them from
/// a file checks this once.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tissue {
    /// Size against the reference head, about 1.
    pub scale: f32,
    /// Hinge of the lower jaw, bind pose, metres.
    pub hinge: [f32; 3],
    /// Nodes of the skin at rest, bind pose, metres.
    pub rest: Vec<[f32; 3]>,
    /// Share of the lower jaw in what lies under each node, 0 to 1.
    pub jaw: Vec<f32>,
    /// Distance from each node to the bone or to what it lies on, metres.
    pub depth: Vec<f32>,
    /// How firmly each is held sideways: pretension of its connecting springs, 0 slides to 1.
    pub grip: Vec<f32>,
    /// How much blood shows in each, 0 to 1: where a face blushes.
    pub flush: Vec<f32>,
    /// Faces of the network.
    pub quads: Vec<[u16; 4]>,
    /// Fibres of the muscles.
    pub fibres: Vec<Fibre>,
    /// Their points.
    pub points: Vec<FibrePoint>,
    /// Where the attachments of each node begin; one more for the end.
    pub starts: Vec<u32>,
    /// Holds of nodes on fibres.
    pub attachments: Vec<Attachment>,
    /// Muscles grown into the ring of the mouth.
    pub links: Vec<Link>,
    /// Places along the mouth.
    pub columns: Vec<Column>,
    /// The nodes of the lips.
    pub lips: Vec<LipNode>,
    /// Pairs of nodes, above and below, that may not pass each other.
    pub pairs: Vec<[u16; 2]>,
    /// Nodes that may not pass the teeth.
    pub before_teeth: Vec<u16>,
    /// Upper and lower teeth.
    pub arches: [Arch; 2],
    /// How much of the expressive wrinkles shows while no muscle contracts, 0 to 1: lines of age. A figure's
    /// file holds it beside the tissue.
    pub lines: f32,
}
