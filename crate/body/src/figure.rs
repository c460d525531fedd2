//! Runtime figure: skeleton, meshes and morph targets.

use raconteur_base::{DAffine3, Side};

use crate::face::{Binding, Tissue};
use crate::skeleton::Skeleton;
use crate::springs::Springs;

/// Jaw angle at which the full morph target `mouthClose` just closes the lips, radians; a contract
/// between figures and their drivers. Designed.
pub const MOUTH_CLOSE_RAD: f64 = 0.2;

/// Jaw angle represented by the full morph target `jawOpen`, radians. ARKit gives no angle; its
/// full opening looks like 20° on a face of usual build. Designed.
pub const JAW_OPEN_RAD: f64 = 0.35;

/// Shading model of a surface. For these kinds the renderer uses its own models instead of glTF's.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum MaterialKind {
    /// Skin; vertex colour carries the tone, its alpha the occlusion.
    Skin,
    /// Sclera, iris and pupil on one ball; uv is the position on the front hemisphere,
    /// (0.5, 0.5) at the corneal apex, radius 0.5 at the equator.
    Eye,
    /// Transparent wet layer over the eye (cornea, tear line).
    Cornea,
    /// Teeth.
    Teeth,
    /// Gums, tongue, mouth bag.
    Mouth,
    /// Strand cards: u across the card, v from root (0) to tip (1).
    Hair,
    /// Lashes and brows: as hair, thinner.
    Lash,
    /// Plain knitted cloth; uv in metres on the cloth, as for all cloth.
    Cloth,
    /// Shoes, belts.
    Leather,
    /// Finger and toe nails.
    Nail,
    /// Anything else: plain metallic-roughness.
    Plain,
    /// Ribbed knit: cuffs, hems, socks.
    Rib,
    /// Plain weave: shirts, trousers, canvas.
    Woven,
    /// Twill with white weft: jeans.
    Denim,
    /// Cut pile in wales.
    Corduroy,
    /// Soft jersey: sweatshirts.
    Fleece,
}

impl MaterialKind {
    /// All kinds with their names in glTF (`extras.kind`).
    pub const NAMES: [(Self, &'static str); 16] = [
        (Self::Skin, "skin"),
        (Self::Eye, "eye"),
        (Self::Cornea, "cornea"),
        (Self::Teeth, "teeth"),
        (Self::Mouth, "mouth"),
        (Self::Hair, "hair"),
        (Self::Lash, "lash"),
        (Self::Cloth, "cloth"),
        (Self::Leather, "leather"),
        (Self::Nail, "nail"),
        (Self::Plain, "plain"),
        (Self::Rib, "rib"),
        (Self::Woven, "woven"),
        (Self::Denim, "denim"),
        (Self::Corduroy, "corduroy"),
        (Self::Fleece, "fleece"),
    ];

    /// Returns the weave of a kind of cloth, numbered as in the cloth shader; `None` for other
    /// materials.
    #[must_use]
    pub fn weave(self) -> Option<u8> {
        match self {
            Self::Cloth => Some(0),
            Self::Rib => Some(1),
            Self::Woven => Some(2),
            Self::Denim => Some(3),
            Self::Corduroy => Some(4),
            Self::Fleece => Some(5),
            _ => None,
        }
    }
}

/// Textures of a material, as indices into [`Figure::images`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct TextureMaps {
    /// sRGB colour and alpha; multiplies the vertex colour and the base colour.
    pub base_color: Option<usize>,
    /// Normals in tangent space as glTF has them: +y along growing −v.
    pub normal: Option<usize>,
    /// Heights of expressive wrinkles, one kind in each of red, green and blue: 128 is the surface,
    /// a step of a 127th is [`WRINKLE_HEIGHT_M`] / 127.
    /// [`NodeState::wrinkles`](crate::face::NodeState::wrinkles) gives the visible amount of each.
    ///
    /// Red: lines across the forehead (frontalis). Green: lines between the brows (corrugator),
    /// crow's feet (orbicularis oculi), the furrows next to the nose and mouth and on the cheek
    /// (zygomaticus, levators). Blue: lines across the root of the nose and on its sides (procerus,
    /// nasalis), lines around the lips (orbicularis oris), dimples of the chin (mentalis).
    pub wrinkles: Option<usize>,
}

/// Height represented by the brightest texel of a wrinkle map, metres. Designed: twice the depth
/// that profilometry finds in deep lines of old faces.
pub const WRINKLE_HEIGHT_M: f32 = 0.001;

/// Compressed image in a figure file. The host of the renderer decodes it, since browsers have
/// better decoders.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Image {
    /// Media type of the image: `image/png` or `image/jpeg`.
    pub mime_type: String,
    /// Contents of the image file.
    pub bytes: Vec<u8>,
}

/// Material of a mesh: shading model, colour, roughness and textures.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// Shading model of the surface.
    pub kind: MaterialKind,
    /// Linear RGB and alpha, each 0..1; multiplies the vertex colour.
    pub base_color: [f32; 4],
    /// Perceptual roughness of the surface, 0..1.
    pub roughness: f32,
    /// Enables rendering of both sides.
    pub double_sided: bool,
    /// Textures of the material.
    pub maps: TextureMaps,
}

/// Sparse morph target data of one mesh: changed vertices with position and normal deltas.
#[derive(Clone, Debug, PartialEq)]
pub struct Morph {
    /// Index of the morph target in [`Figure::morph_names`].
    pub target: usize,
    /// Indices of the vertices that the morph moves.
    pub vertices: Vec<u32>,
    /// Displacement of each at weight 1, bind pose, metres.
    pub position_deltas: Vec<[f32; 3]>,
    /// Change of each normal at weight 1.
    pub normal_deltas: Vec<[f32; 3]>,
}

/// Drawable part of a figure with one material, in the bind pose, world frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    /// Name, for example `head`.
    pub name: String,
    /// Material of the mesh.
    pub material: Material,
    /// Vertex positions, bind pose, world frame, metres.
    pub positions: Vec<[f32; 3]>,
    /// Unit normals of the vertices.
    pub normals: Vec<[f32; 3]>,
    /// Texture coordinates; meaning by [`MaterialKind`].
    pub uvs: Vec<[f32; 2]>,
    /// Linear RGB and occlusion, 0..255.
    pub colors: Vec<[u8; 4]>,
    /// Up to four joints per vertex, as indices into the skeleton's joints.
    pub joints: Vec<[u16; 4]>,
    /// Their weights, summing to 1.
    pub weights: Vec<[f32; 4]>,
    /// Triangles, counter-clockwise from outside.
    pub indices: Vec<u32>,
    /// Coarser triangles over the same vertices, a list for each level of detail after the
    /// first, each shorter than the one before it; empty where the mesh has one level.
    pub coarser: Vec<Vec<u32>>,
    /// Morph targets that touch this mesh.
    pub morphs: Vec<Morph>,
    /// Binding of its vertices to the tissue of the face, if any.
    pub binding: Option<Binding>,
}

impl Mesh {
    /// Returns the triangles at a level of detail, 0 the finest; a mesh with fewer levels returns
    /// its last.
    #[must_use]
    pub fn triangles_at(&self, level: usize) -> &[u32] {
        match level.min(self.coarser.len()) {
            0 => &self.indices,
            n => &self.coarser[n - 1],
        }
    }

    /// Removes vertices that belong to no triangle and renumbers the rest. Morph targets are not
    /// renumbered: do not call it on a mesh that has some.
    pub fn drop_unused(&mut self) {
        const GONE: u32 = u32::MAX;
        let mut to = vec![GONE; self.positions.len()];
        for &v in self.indices.iter().chain(self.coarser.iter().flatten()) {
            to[v as usize] = 0;
        }
        let used = to.iter_mut().filter(|t| **t != GONE);
        for (count, t) in (0..).zip(used) {
            *t = count;
        }
        fn pick<T: Copy>(all: &mut Vec<T>, to: &[u32]) {
            let mut at = to.iter();
            all.retain(|_| at.next().is_some_and(|&t| t != GONE));
        }
        pick(&mut self.positions, &to);
        pick(&mut self.normals, &to);
        pick(&mut self.uvs, &to);
        pick(&mut self.colors, &to);
        pick(&mut self.joints, &to);
        pick(&mut self.weights, &to);
        for v in std::iter::once(&mut self.indices)
            .chain(&mut self.coarser)
            .flatten()
        {
            *v = to[*v as usize];
        }
        if let Some(binding) = &mut self.binding {
            let own = std::mem::take(binding);
            binding.starts.push(0);
            for (&v, row) in own.vertices.iter().zip(own.starts.windows(2)) {
                if to[v as usize] == GONE {
                    continue;
                }
                let row = row[0] as usize..row[1] as usize;
                binding.vertices.push(to[v as usize]);
                binding.nodes.extend(&own.nodes[row.clone()]);
                binding.weights.extend(&own.weights[row]);
                binding.starts.push(binding.nodes.len() as u32);
            }
        }
    }

    /// Returns the fault of the mesh's binding. `None` if there is no binding, or if its vertices
    /// are the mesh's and ascending, its rows in order, and its weights 0..1. Node indices can only
    /// be checked against a tissue.
    #[must_use]
    pub fn binding_fault(&self) -> Option<&'static str> {
        let b = self.binding.as_ref()?;
        let rises = |v: &[u32]| v.windows(2).all(|w| w[0] < w[1]);
        if b.starts.len() != b.vertices.len() + 1 || b.weights.len() != b.nodes.len() {
            Some("its binding's lists differ in length")
        } else if !rises(&b.vertices)
            || b.vertices
                .last()
                .is_some_and(|&v| v as usize >= self.positions.len())
        {
            Some("its binding's vertices do not rise within the mesh")
        } else if b.starts.first() != Some(&0)
            || b.starts.windows(2).any(|w| w[0] > w[1])
            || b.starts.last().map(|&end| end as usize) != Some(b.nodes.len())
        {
            Some("its binding's rows are not in order")
        } else if b.weights.iter().any(|w| !(0.0..=1.0).contains(w)) {
            Some("its binding has a weight beyond 0 to 1")
        } else {
            None
        }
    }
}

/// Figure ready to be posed and rendered: skeleton, meshes, morph targets, facial tissue, spring
/// chains and textures.
#[derive(Clone, Debug)]
pub struct Figure {
    /// Name, for example `sofia`.
    pub name: String,
    /// Skeleton with all joints.
    pub skeleton: Skeleton,
    /// Joint from world in the bind pose, one for each joint of the skeleton.
    pub inverse_bind: Vec<DAffine3>,
    /// Drawable parts of the figure.
    pub meshes: Vec<Mesh>,
    /// Names of the morph targets: ARKit's where one fits (`mouthPucker`, `browInnerUp` …).
    pub morph_names: Vec<String>,
    /// Upper-lid rotation that closes the eye, radians, left and right.
    pub lid_closure_rad: [f64; 2],
    /// Sex of the body, 0 male to 1 female, if the file specifies it; it selects joint limits.
    pub sex: Option<f64>,
    /// Dominant hand; right if the file does not specify it.
    pub dominant_hand: Side,
    /// Tissue under the skin of its face, if the file has it.
    pub tissue: Option<Tissue>,
    /// Spring chains: hair, hanging cloth.
    pub springs: Springs,
    /// Images of the materials.
    pub images: Vec<Image>,
}

impl Figure {
    /// Returns the index of a morph target by name; `None` if the figure lacks it.
    #[must_use]
    pub fn morph_index(&self, name: &str) -> Option<usize> {
        self.morph_names.iter().position(|n| n == name)
    }
}
