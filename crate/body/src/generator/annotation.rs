//! Names on the mesh: landmarks and segments of the face.

/// A named point of the surface.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Landmark {
    /// Craniofacial name, for example `n` (nasion) or `ex_l` (left exocanthion).
    pub name: String,
    /// Index into the figure's meshes.
    pub mesh: usize,
    /// Vertex of that mesh.
    pub vertex: u32,
}

/// What a figure's meshes are annotated with.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Annotations {
    /// Named points.
    pub landmarks: Vec<Landmark>,
}
