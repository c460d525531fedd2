//! Vertices bound to the tissue of a face, moved on the CPU: each by a few of some two thousand
//! nodes. The result is a separate vertex stream, so that meshes without tissue have none, and the
//! rest shape, to which the grain of the skin is attached, stays.

use crate::gpu::attribute;
use crate::options::LEVELS;
use bytemuck::{Pod, Zeroable};
use glam::Vec4;
use raconteur_body::Mesh;
use raconteur_body::face::NodeState;
use wgpu::{VertexBufferLayout, VertexFormat, VertexStepMode};

/// Largest displacement representable in the stream, metres: larger ones are clamped. A step is 4
/// µm. A jaw opens by 40 mm.
pub const REACH_M: f32 = 0.125;

/// Largest change of a unit normal in the stream, its theoretical maximum.
const TURN: f32 = 2.0;

/// Effect of the facial tissue on one vertex: displacement, change of normal, wrinkles and blush.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Pod, Zeroable)]
pub struct TissueVertex {
    /// Displacement in 32767ths of [`REACH_M`], then the normal's change, in 32767ths
    /// of 2.
    pub moved: [i16; 6],
    /// Three wrinkle strengths, 0..255; blush, 1 to 255 with 128 for none.
    pub complexion: [u8; 4],
}

impl TissueVertex {
    /// Vertex buffer layout of the tissue stream.
    pub(crate) const LAYOUT: VertexBufferLayout<'static> = VertexBufferLayout {
        array_stride: size_of::<Self>() as u64,
        step_mode: VertexStepMode::Vertex,
        attributes: &[
            attribute(VertexFormat::Snorm16x4, 0, 7),
            attribute(VertexFormat::Snorm16x2, 8, 8),
            attribute(VertexFormat::Unorm8x4, 12, 9),
        ],
    };
}

impl TissueVertex {
    /// Vertex effect of tissue at rest.
    pub const REST: Self = Self {
        moved: [0; 6],
        complexion: [0, 0, 0, 128],
    };

    /// Converts a weighted sum of nodes to the vertex format.
    fn from_node(sum: &Node) -> Self {
        // After adding one and a half times 2²³, the nearest integer is in the lowest bits. This
        // avoids a conversion with the compiler's range checks. Four at a time would be slower
        // without vector instructions, as in a page.
        const ROUND: f32 = 12_582_912.0;
        let bits = |x: f32, low: f32, high: f32| (x.clamp(low, high) + ROUND).to_bits();
        let moved = |x: f32| bits(x, -32767.0, 32767.0) as i16;
        let strength = |x: f32| bits(x, 0.0, 255.0) as u8;
        let [p, q, r] = sum;
        let blush = bits(r.y, -127.0, 127.0).wrapping_add(128) as u8;
        Self {
            moved: [p.x, p.y, p.z, p.w, q.x, q.y].map(moved),
            complexion: [strength(q.z), strength(q.w), strength(r.x), blush],
        }
    }
}

/// A node's state in the steps of [`TissueVertex`], in the order of its numbers.
type Node = [Vec4; 3];

/// Current tissue nodes of a face, scaled for the vertices that follow them.
#[derive(Clone, Debug, Default)]
pub struct Nodes {
    scaled: Vec<Node>,
}

impl Nodes {
    /// Nodes at rest, as many as the bindings of these meshes name.
    #[must_use]
    pub fn from_meshes<'m>(meshes: impl Iterator<Item = &'m Mesh>) -> Self {
        let named = meshes
            .filter_map(|m| m.binding.as_ref())
            .flat_map(|b| &b.nodes);
        let count = named.max().map_or(0, |n| usize::from(*n) + 1);
        Self {
            scaled: vec![[Vec4::ZERO; 3]; count],
        }
    }

    /// Takes the current state of the nodes and returns true if anything changed. Nodes that are
    /// missing or not finite are at rest. Allocates nothing.
    pub fn update(&mut self, states: &[NodeState]) -> bool {
        let mut changed = false;
        let mut states = states.iter();
        for slot in &mut self.scaled {
            let node = states.next().map_or([Vec4::ZERO; 3], scaled);
            changed |= *slot != node;
            *slot = node;
        }
        changed
    }
}

fn scaled(state: &NodeState) -> Node {
    let [x, y, z] = state.displacement.map(|d| d * (32767.0 / REACH_M));
    let [i, j, k] = state.normal_delta.map(|n| n * (32767.0 / TURN));
    let [a, b, c] = state.wrinkles.map(|w| w * 255.0);
    let node = [
        Vec4::new(x, y, z, i),
        Vec4::new(j, k, a, b),
        Vec4::new(c, state.blush * 127.0, 0.0, 0.0),
    ];
    if node.iter().all(|v| v.is_finite()) {
        node
    } else {
        [Vec4::ZERO; 3]
    }
}

/// Binding of a vertex to nodes.
#[derive(Clone, Copy, Debug)]
struct Row {
    /// Index within the affected range.
    vertex: u32,
    /// End of its nodes, which begin at the end of the previous row's.
    end: u32,
    /// The levels of detail that draw it, a bit each.
    levels: u32,
}

/// Vertices of a mesh that follow tissue nodes, with their nodes and weights.
#[derive(Clone, Debug)]
pub struct BoundMesh {
    /// First vertex of the affected range, in the figure's vertex buffer.
    pub first_vertex: usize,
    /// The affected range as rendered.
    pub current: Vec<TissueVertex>,
    rows: Vec<Row>,
    nodes: Vec<u16>,
    weights: Vec<f32>,
}

impl BoundMesh {
    /// Returns the bound vertices of a mesh whose vertices begin at `base` in the figure's buffer;
    /// `None` if none is bound, the binding has a [fault](raconteur_body::Mesh::binding_fault), or
    /// triangles reference other vertices.
    #[must_use]
    pub fn new(mesh: &Mesh, base: usize) -> Option<Self> {
        let b = mesh.binding.as_ref()?;
        if mesh.binding_fault().is_some() {
            return None;
        }
        let (low, high) = (*b.vertices.first()?, *b.vertices.last()?);
        let ends = b.starts.iter().skip(1);
        let mut levels = vec![0; mesh.positions.len()];
        for level in 0..LEVELS {
            for &vertex in mesh.triangles_at(level) {
                *levels.get_mut(vertex as usize)? |= 1 << level;
            }
        }
        Some(Self {
            first_vertex: base + low as usize,
            current: vec![TissueVertex::REST; (high - low) as usize + 1],
            rows: b
                .vertices
                .iter()
                .zip(ends)
                .map(|(&v, &end)| Row {
                    vertex: v - low,
                    end,
                    levels: levels[v as usize],
                })
                .collect(),
            nodes: b.nodes.clone(),
            weights: b.weights.clone(),
        })
    }

    /// Updates the part of `current` rendered at a level of detail to the nodes, which are [those
    /// of](Nodes::from_meshes) this mesh among others; parts of other levels are unchanged. Allocates
    /// nothing.
    pub fn apply(&mut self, nodes: &Nodes, level: usize) {
        let mut start = 0;
        for own in &self.rows {
            let row = start..own.end as usize;
            start = row.end;
            if own.levels >> level & 1 == 0 {
                continue;
            }
            let mut sum = [Vec4::ZERO; 3];
            for (&node, &weight) in self.nodes[row.clone()].iter().zip(&self.weights[row]) {
                if let Some(node) = nodes.scaled.get(usize::from(node)) {
                    sum[0] += node[0] * weight;
                    sum[1] += node[1] * weight;
                    sum[2] += node[2] * weight;
                }
            }
            self.current[own.vertex as usize] = TissueVertex::from_node(&sum);
        }
    }
}
