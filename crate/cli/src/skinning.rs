//! Vertex positions of a posed figure, for output without a device.

use raconteur_base::{DAffine3, DMat3, DVec3, NodeState};
use raconteur_body::{Bone, Figure, Mesh};

/// Vertices of one mesh in the world after skinning.
pub(crate) struct Skinned {
    /// Metres.
    pub(crate) positions: Vec<DVec3>,
    /// Unit length.
    pub(crate) normals: Vec<DVec3>,
}

/// Returns the skinning matrices from bind pose to a posed figure, one per joint.
pub(crate) fn world_from_bind(figure: &Figure, world_from_joint: &[DAffine3]) -> Vec<DAffine3> {
    world_from_joint
        .iter()
        .zip(&figure.inverse_bind)
        .map(|(world, bind)| *world * *bind)
        .collect()
}

/// Applies morphs and tissue, then linear blend skinning, like the renderer. There is a weight for
/// each of the figure's morphs, and a state for each node of its tissue or none.
pub(crate) fn skin(
    mesh: &Mesh,
    world_from_bind: &[DAffine3],
    morph_weights: &[f32],
    tissue: &[NodeState],
) -> Skinned {
    let wide = |v: &[f32; 3]| DVec3::from_array(v.map(f64::from));
    let mut positions: Vec<DVec3> = mesh.positions.iter().map(wide).collect();
    let mut normals: Vec<DVec3> = mesh.normals.iter().map(wide).collect();
    for morph in &mesh.morphs {
        let weight = f64::from(morph_weights.get(morph.target).copied().unwrap_or(0.0));
        if weight == 0.0 {
            continue;
        }
        let deltas = morph.position_deltas.iter().zip(&morph.normal_deltas);
        for (&v, (position, normal)) in morph.vertices.iter().zip(deltas) {
            positions[v as usize] += wide(position) * weight;
            normals[v as usize] += wide(normal) * weight;
        }
    }
    // Vertices bound to the tissue receive the jaw's turn from it.
    let mut is_bound = vec![false; positions.len()];
    if let Some(binding) = mesh.binding.as_ref().filter(|_| !tissue.is_empty()) {
        for (v, moved, turned) in binding.apply(tissue) {
            positions[v] += wide(&moved);
            normals[v] += wide(&turned);
            is_bound[v] = true;
        }
    }
    let places = positions.iter_mut().zip(&mut normals).zip(is_bound);
    for (((position, normal), is_bound), (joints, weights)) in
        places.zip(mesh.joints.iter().zip(&mesh.weights))
    {
        let mut blend = DAffine3 {
            matrix3: DMat3::ZERO,
            translation: DVec3::ZERO,
        };
        for (&joint, &weight) in joints.iter().zip(weights) {
            let joint = if is_bound && usize::from(joint) == Bone::Chin.index() {
                Bone::Skull.index()
            } else {
                usize::from(joint)
            };
            let matrix = &world_from_bind[joint];
            blend.matrix3 += matrix.matrix3 * f64::from(weight);
            blend.translation += matrix.translation * f64::from(weight);
        }
        *position = blend.transform_point3(*position);
        *normal = blend.transform_vector3(*normal).normalize_or(DVec3::Y);
    }
    Skinned { positions, normals }
}
