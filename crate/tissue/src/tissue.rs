//! Tissue of a face: nodes of the skin, the muscles below them, and their obstacles. The generator
//! makes it once for each figure, from its geometry (F&H section 3.1.2), and stores it in the
//! figure's file.

use super::Muscle;

/// Point of a muscle fibre at rest.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FibrePoint {
    /// Position in the bind pose, metres.
    pub rest: [f32; 3],
    /// Direction to the skin, unit length.
    pub outwards: [f32; 3],
    /// Share of the lower jaw in where it is, 0 to 1.
    pub jaw: f32,
}

/// Path along which the points of a fibre move on contraction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FibreCurve {
    /// Towards the first point, the origin, along the fibre. Points are evenly spaced.
    Linear,
    /// Towards a point, in the plane of the muscle: orbicularis oculi.
    Towards([f32; 3]),
    /// Half of the ring of the mouth, from the right corner to the left: upper or lower, and its
    /// outward position, 0 at the vermilion to 1.
    Oris {
        /// True if it lies in the lower lip.
        is_lower: bool,
        /// 0 at the red of the lips to 1.
        out: f32,
    },
}

/// Muscle fibre, a piece of a muscle's grid (F&H 3.1.2, "Building Muscles").
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fibre {
    /// Muscle of the fibre.
    pub muscle: Muscle,
    /// Path of the movement on contraction.
    pub course: FibreCurve,
    /// Index of the fibre's first point in [`Tissue::points`].
    pub first: u16,
    /// Number of points, at least two.
    pub count: u8,
}

/// Attachment of a skin node to a muscle fibre, through which the fibre moves the skin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Attachment {
    /// Point of the fibre before the attachment.
    pub point: u16,
    /// Fraction of the segment to the next point, 0 to 1.
    pub on: f32,
    /// Share of the fibre's movement that the node follows.
    pub weight: f32,
}

/// Attachment of the end of a linear fibre to the ring of the mouth: the two move each other (F&H
/// 3.1.2, "Properties").
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Link {
    /// Last point of the linear fibre.
    pub end: u16,
    /// Point of the ring.
    pub ring: u16,
    /// Share of the end's movement that the point of the ring follows.
    pub weight: f32,
}

/// Both lips at one position along the mouth, with the data for closing them.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Column {
    /// Nodes of the upper and of the lower lip that touch each other at rest.
    pub contact: [u16; 2],
    /// Edge of the upper teeth there, bind pose, metres; target of the lower lip for f and v.
    pub edge: [f32; 3],
    /// Reach of the lower lip for the teeth there: 1 in the middle, 0 at the corner.
    pub bites: f32,
}

/// Node that moves with its column when the lips are sealed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LipNode {
    /// Index of the node.
    pub node: u16,
    /// Index of its column in the mouth.
    pub column: u16,
    /// Share of the gap that it closes: up to −0.36 in the upper lip, 0.64 in the lower.
    pub closes: f32,
}

/// Outer face of one row of teeth with its gums, for collisions of the lips: distance from an
/// upright axis by height and direction.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Arch {
    /// A point of the axis, at the height of the first row; bind pose, metres.
    pub origin: [f32; 3],
    /// Distance between rows, metres.
    pub step_m: f32,
    /// Number of rows, upwards.
    pub rows: u16,
    /// Columns from the right, where the direction is −1, to the left, where it is 1; see
    /// [`Arch::direction`].
    pub columns: u16,
    /// Distances from the axis, metres, row by row; 0 if empty.
    pub radii: Vec<f32>,
}

impl Arch {
    /// Returns a measure of direction about the axis without trigonometry: 0 ahead, ±1 to the
    /// sides.
    #[must_use]
    pub fn direction(x: f32, z: f32) -> f32 {
        x / (x.abs() + z.max(1e-6))
    }
}

/// Soft tissue of a face: skin nodes, muscle fibres and their connections. The lengths of the lists
/// depend on each other; code that reads them from a file checks this once.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tissue {
    /// Size against the reference head, about 1.
    pub scale: f32,
    /// Hinge of the lower jaw, bind pose, metres.
    pub hinge: [f32; 3],
    /// Nodes of the skin at rest, bind pose, metres.
    pub rest: Vec<[f32; 3]>,
    /// Weight of the lower jaw in the layer under each node, 0 to 1.
    pub jaw: Vec<f32>,
    /// Distance from each node to the bone or the layer under it, metres.
    pub depth: Vec<f32>,
    /// Lateral stiffness of each node: pretension of its connecting springs, 0 (slides) to 1.
    pub grip: Vec<f32>,
    /// Visible blood at each node when the face blushes, 0 to 1.
    pub flush: Vec<f32>,
    /// Faces of the network.
    pub quads: Vec<[u16; 4]>,
    /// Fibres of the muscles.
    pub fibres: Vec<Fibre>,
    /// Points of all fibres.
    pub points: Vec<FibrePoint>,
    /// Start of each node's attachments, plus one entry for the end.
    pub starts: Vec<u32>,
    /// Attachments of nodes to fibres.
    pub attachments: Vec<Attachment>,
    /// Muscles grown into the ring of the mouth.
    pub links: Vec<Link>,
    /// Columns along the mouth.
    pub columns: Vec<Column>,
    /// The nodes of the lips.
    pub lips: Vec<LipNode>,
    /// Pairs of nodes, above and below, that may not pass each other.
    pub pairs: Vec<[u16; 2]>,
    /// Nodes that may not pass the teeth.
    pub before_teeth: Vec<u16>,
    /// Upper and lower teeth.
    pub arches: [Arch; 2],
    /// Visible share of the expressive wrinkles without contraction, 0 to 1: age lines. A figure's
    /// file stores it next to the tissue.
    pub lines: f32,
}
