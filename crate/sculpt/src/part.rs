//! Output of a generator region: polygons with colours, weights and morph targets.

use raconteur_base::DVec3;

use raconteur_body::figure::Material;

/// Name of the part that lines the mouth behind the lips.
pub(crate) const MOUTH_BAG: &str = "mouth_bag";
/// Name of the part that has the teeth of both jaws.
pub(crate) const TEETH: &str = "teeth";
/// Name of the part that has the gums of both jaws.
pub(crate) const GUMS: &str = "gums";

/// Vertex of a mesh part in the bind pose.
#[derive(Clone, Debug)]
pub struct PartVertex {
    /// Position in the bind pose, world, metres.
    pub position: DVec3,
    /// Texture coordinates; meaning by [`raconteur_body::figure::MaterialKind`].
    pub uv: [f64; 2],
    /// Linear RGB 0..1 and ambient occlusion (1 = open).
    pub color: [f64; 4],
    /// Joint names with weights; any number, any sum above zero. The assembly keeps the four
    /// largest and normalises.
    pub weights: Vec<(JointRef, f64)>,
}

/// Reference to a joint by its drive, usable before the skeleton exists.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointRef(pub raconteur_body::skeleton::Drive);

/// Share of a mesh part in one morph target: displacements of its vertices.
#[derive(Clone, Debug)]
pub struct PartMorph {
    /// ARKit's name where one fits, for example `mouthPucker`.
    pub name: String,
    /// Moved vertices and their displacements at weight 1, metres.
    pub deltas: Vec<(u32, DVec3)>,
}

/// Mesh with one material, for example the skin of the head; the parts are assembled to a figure.
#[derive(Clone, Debug)]
pub struct MeshPart {
    /// Name, for example `head`.
    pub name: String,
    /// Material of the surface.
    pub material: Material,
    /// Vertices of the mesh.
    pub vertices: Vec<PartVertex>,
    /// Polygons of three or four corners, counter-clockwise from outside.
    pub faces: Vec<Vec<u32>>,
    /// Displacements of the vertices for each morph target.
    pub morphs: Vec<PartMorph>,
    /// Vertices that follow the tissue, rising, each with the nodes and weights it follows.
    pub bound: Vec<(u32, Vec<(u32, f64)>)>,
}

impl MeshPart {
    /// Triangulates the surface; quads are split around their centre: unlike a split along a
    /// diagonal, this is mirror-symmetric.
    pub(crate) fn triangles_about_middles(
        &self,
        own: impl Fn(&PartVertex) -> bool,
    ) -> Vec<[DVec3; 3]> {
        let mut out = Vec::new();
        let vertex = |v: &u32| &self.vertices[*v as usize];
        for face in &self.faces {
            if !face.iter().all(|v| own(vertex(v))) {
                continue;
            }
            let corners: Vec<DVec3> = face.iter().map(|v| vertex(v).position).collect();
            if let [a, b, c] = corners[..] {
                out.push([a, b, c]);
                continue;
            }
            let middle = corners.iter().sum::<DVec3>() / corners.len() as f64;
            for (k, &a) in corners.iter().enumerate() {
                out.push([a, corners[(k + 1) % corners.len()], middle]);
            }
        }
        out
    }
}
