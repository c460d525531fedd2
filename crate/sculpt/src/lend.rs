//! Hair as a separate file, for a figure with any face of the model (`reshape::Lender`).

use raconteur_base::{DAffine3, DVec3};
use raconteur_body::figure::{Figure, Material, MaterialKind, TextureMaps};
use raconteur_body::skeleton::{Bone, Drive, FaceJoints};
use raconteur_tissue::Binding;

use super::assemble::{Blueprint, PartWithNormals, assemble};
use super::build::clothes_near_head;
use super::cells::Cells;
use super::cloth::{Wearer, dress};
use super::hair;
use super::levels;
use super::mannequin::Mannequin;
use super::part::{JointRef, MeshPart, PartVertex};
use super::people::FigureParams;

/// Sampling step over the skin vertices that position the hair of the scalp.
const EVERY: usize = 4;
/// Radius around a beard within which all skin vertices position it, metres: lips and chin differ
/// from one vertex to the next.
const ABOUT_BEARD_M: f64 = 0.02;
/// Name of the part that is a beard.
const BEARD: &str = "beard";
/// Nodes of the tissue that a hair of a beard follows at most.
const NODES: usize = 4;

/// Returns the hair and the beard of a person, on a skeleton, with the head's skin vertices that
/// define their position. The hair does not swing.
#[must_use]
pub fn lender(params: &FigureParams) -> Figure {
    let made = Mannequin::from_params(params);
    let place = made.world_from_head;
    let body = params.body();
    let wearer = Wearer::new(&body, &made.field, &made.cage, &made.joints, &made.neck);
    let clothes = dress(&wearer, &params.wardrobe);
    let grown = hair::hair(
        &made.head,
        &params.hair,
        &clothes_near_head(&clothes.parts, place),
    );
    let hair: Vec<PartWithNormals> = (grown.pieces.into_iter())
        .map(|p| placed(p, place))
        .collect();
    let beard: Vec<DVec3> = (hair.iter().filter(|p| p.part.name == BEARD))
        .flat_map(|p| p.part.vertices.iter().map(|v| v.position))
        .collect();
    let middle = place.transform_point3(DVec3::ZERO);
    let mut pieces: Vec<PartWithNormals> = vec![skin(&made.head_parts[0], &beard, middle).into()];
    pieces.extend(hair);
    let mut figure = assemble(&Blueprint {
        name: params.name.clone(),
        positions_in_world: made.joints.positions,
        bind_rotations: made.joints.rotations,
        face: FaceJoints {
            eye_centres: made.head.eye_centres.map(|p| place.transform_point3(p)),
        },
        stature_m: params.person.stature_m,
        lid_closure_rad: made.head.lid_closure_rad,
        pieces,
        chains: Vec::new(),
        images: Vec::new(),
    });
    for mesh in &mut figure.meshes {
        mesh.morphs.clear();
        if mesh.material.kind == MaterialKind::Hair && mesh.name != BEARD {
            levels::lighten(mesh);
        }
        if let Some(binding) = &mut mesh.binding {
            keep_heaviest(binding);
        }
    }
    figure.morph_names.clear();
    figure
}

/// Limits each vertex of a binding to its heaviest nodes, which take over the weights of the
/// others.
fn keep_heaviest(binding: &mut Binding) {
    let own = std::mem::take(binding);
    binding.starts.push(0);
    for (vertex, row) in own.vertices.iter().zip(own.starts.windows(2)) {
        let row = row[0] as usize..row[1] as usize;
        let nodes = own.nodes[row.clone()].iter().copied();
        let mut row: Vec<(u16, f32)> = nodes.zip(own.weights[row].iter().copied()).collect();
        let whole: f32 = row.iter().map(|r| r.1).sum();
        row.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
        row.truncate(NODES);
        let kept: f32 = row.iter().map(|r| r.1).sum::<f32>().max(f32::MIN_POSITIVE);
        binding.vertices.push(*vertex);
        binding.nodes.extend(row.iter().map(|r| r.0));
        let weights = row.iter().map(|r| (r.1 * whole / kept).min(1.0));
        binding.weights.extend(weights);
        binding.starts.push(binding.nodes.len() as u32);
    }
}

/// Places hair in the world; hair of the scalp follows the skull.
fn placed(mut piece: PartWithNormals, place: DAffine3) -> PartWithNormals {
    let is_beard = piece.part.name == BEARD;
    for v in &mut piece.part.vertices {
        v.position = place.transform_point3(v.position);
        if !is_beard {
            v.weights = on_skull();
        }
    }
    piece
}

fn on_skull() -> Vec<(JointRef, f64)> {
    vec![(JointRef(Drive::Bone(Bone::Skull)), 1.0)]
}

/// Returns the sampled skin positions with a single triangle that connects them. Unused vertices
/// are at the `middle` of the head.
fn skin(head: &MeshPart, beard: &[DVec3], middle: DVec3) -> MeshPart {
    let cells = Cells::new(beard, ABOUT_BEARD_M);
    let is_near = |p: DVec3| {
        let mut about = cells.neighbours(p).map(|i| beard[i as usize]);
        about.any(|b| b.distance_squared(p) < ABOUT_BEARD_M * ABOUT_BEARD_M)
    };
    let every = if beard.is_empty() { EVERY } else { 1 };
    let vertex = |v: &PartVertex| PartVertex {
        position: if beard.is_empty() || is_near(v.position) {
            v.position
        } else {
            middle
        },
        uv: [0.0; 2],
        color: [1.0; 4],
        weights: on_skull(),
    };
    let vertices: Vec<PartVertex> = head.vertices.iter().step_by(every).map(vertex).collect();
    let tells = (0..).zip(&vertices).filter(|(_, v)| v.position != middle);
    let corners: Vec<u32> = tells.map(|(i, _)| i).collect();
    let third = corners.len() / 3;
    let triangle = [0, third, 2 * third].map(|i| corners.get(i).copied().unwrap_or(0));
    MeshPart {
        name: head.name.clone(),
        material: Material {
            kind: MaterialKind::Skin,
            base_color: [1.0; 4],
            roughness: 0.5,
            double_sided: false,
            maps: TextureMaps::default(),
        },
        vertices,
        faces: vec![triangle.to_vec()],
        morphs: Vec::new(),
        bound: Vec::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::people::hair_donors;

    #[test]
    fn a_beard_is_lent_with_the_skin_that_it_stands_on() {
        let params = hair_donors::params("moustache").expect("a moustache");
        let lent = lender(&params);
        let mesh = |name: &str| lent.meshes.iter().find(|m| m.name == name);
        let vertices = Mannequin::from_params(&params).head_parts[0].vertices.len();
        let head = mesh("head").expect("a head");
        assert_eq!(head.positions.len(), vertices);
        let beard = mesh("beard").expect("a beard");
        assert!(beard.indices.len() / 3 > 300, "{}", beard.indices.len());
        assert!(beard.binding.is_some(), "it does not follow the lips");
        assert_eq!(lent.meshes.len(), 2);
    }
}
