//! Joins the parts of a figure on one skeleton.

use std::collections::BTreeMap;

use raconteur_base::{DAffine3, DQuat, DVec3, Side};

use super::part::{MeshPart, PartVertex};
use super::springs::{self, HairChain};
use raconteur_base::surface::vertex_normals;
use raconteur_body::figure::{Figure, Image, Material, MaterialKind, Mesh, Morph, TextureMaps};
use raconteur_body::skeleton::{Bone, FaceJoints, Skeleton};
use raconteur_body::springs::Springs;
use raconteur_body::write::weights_in_255ths;
use raconteur_tissue::Binding;

/// Mesh part of a figure under construction, with optional explicit normals.
#[derive(Clone, Debug)]
pub struct PartWithNormals {
    /// Mesh part; its normals may be overridden.
    pub part: MeshPart,
    /// One unit normal for each vertex; `None` computes them from the faces. Strand cards have
    /// their own, which follow the head's volume rather than the card.
    pub normals: Option<Vec<DVec3>>,
}

impl From<MeshPart> for PartWithNormals {
    fn from(part: MeshPart) -> Self {
        Self {
            part,
            normals: None,
        }
    }
}

/// Construction data of a figure (bones, parts, hair chains, images) in the bind pose, world frame,
/// metres.
#[derive(Clone, Debug)]
pub struct Blueprint {
    /// Name of the figure.
    pub name: String,
    /// Origins of the bones.
    pub positions_in_world: [DVec3; Bone::COUNT],
    /// Bind rotations of the bones, world from bone.
    pub bind_rotations: [DQuat; Bone::COUNT],
    /// Centres of the eyes.
    pub face: FaceJoints,
    /// Standing height of the figure, metres.
    pub stature_m: f64,
    /// Upper-lid rotation that closes the eye, radians, left and right.
    pub lid_closure_rad: [f64; 2],
    /// Parts, in drawing order.
    pub pieces: Vec<PartWithNormals>,
    /// Chains that hang on the skull.
    pub chains: Vec<HairChain>,
    /// Images referenced by materials.
    pub images: Vec<Image>,
}

/// Joins the parts: one mesh for each surface, four weights a vertex, triangles, normals
/// and the change of normals under each morph.
#[must_use]
pub fn assemble(blueprint: &Blueprint) -> Figure {
    let mut skeleton = Skeleton::from_bind(
        &blueprint.positions_in_world,
        &blueprint.bind_rotations,
        blueprint.face,
        blueprint.stature_m,
    );
    let frames = bind_frames(blueprint, &skeleton);
    springs::hang(&blueprint.chains, &mut skeleton, &frames);
    let mut morph_names: Vec<String> = blueprint
        .pieces
        .iter()
        .flat_map(|p| p.part.morphs.iter().map(|m| m.name.clone()))
        .collect();
    morph_names.sort();
    morph_names.dedup();

    let mut meshes: Vec<Mesh> = Vec::new();
    for piece in &blueprint.pieces {
        let slot = meshes
            .iter()
            .position(|m| m.material == piece.part.material);
        let mesh = match slot {
            Some(i) => &mut meshes[i],
            None => {
                meshes.push(empty_mesh(&piece.part.name, &piece.part.material));
                let last = meshes.len() - 1;
                &mut meshes[last]
            }
        };
        append(mesh, piece, &skeleton, &morph_names);
    }
    meshes.retain(|m| !m.indices.is_empty());
    let inverse_bind = bind_frames(blueprint, &skeleton)
        .iter()
        .map(DAffine3::inverse)
        .collect();
    Figure {
        name: blueprint.name.clone(),
        skeleton,
        inverse_bind,
        meshes,
        morph_names,
        lid_closure_rad: blueprint.lid_closure_rad,
        sex: None,
        dominant_hand: Side::Right,
        tissue: None,
        springs: Springs::default(),
        images: blueprint.images.clone(),
    }
}

/// Returns the world-from-joint transforms of the bind pose: bones as given; a helper takes the
/// rotation of its parent only, so that it is at rest with the bone that it helps.
fn bind_frames(blueprint: &Blueprint, skeleton: &Skeleton) -> Vec<DAffine3> {
    let mut frames: Vec<DAffine3> = Vec::with_capacity(skeleton.joints().len());
    for (i, joint) in skeleton.joints().iter().enumerate() {
        let frame = match joint.parent {
            _ if i < Bone::COUNT => DAffine3::from_rotation_translation(
                blueprint.bind_rotations[i],
                blueprint.positions_in_world[i],
            ),
            Some(p) => {
                // In the bind pose a share or twist carries that share of its bone's turn
                // from the zero pose.
                let turn = joint.drive.bone().map_or(DQuat::IDENTITY, |b| {
                    let own =
                        blueprint.bind_rotations[p].inverse() * blueprint.bind_rotations[b.index()];
                    joint.zero_rotation.inverse() * own
                });
                frames[p] * skeleton.local(joint, joint.drive.of_turn(turn), turn)
            }
            None => DAffine3::IDENTITY,
        };
        frames.push(frame);
    }
    frames
}

fn empty_mesh(name: &str, material: &Material) -> Mesh {
    Mesh {
        name: name.to_owned(),
        material: material.clone(),
        positions: Vec::new(),
        normals: Vec::new(),
        uvs: Vec::new(),
        colors: Vec::new(),
        joints: Vec::new(),
        weights: Vec::new(),
        indices: Vec::new(),
        morphs: Vec::new(),
        coarser: Vec::new(),
        binding: None,
    }
}

fn narrow(v: DVec3) -> [f32; 3] {
    v.to_array().map(|x| x as f32)
}

fn append(mesh: &mut Mesh, piece: &PartWithNormals, skeleton: &Skeleton, morph_names: &[String]) {
    let part = &piece.part;
    let base = mesh.positions.len() as u32;
    let positions: Vec<DVec3> = part.vertices.iter().map(|v| v.position).collect();
    let seams = Seams::find(part, &positions);
    let normals = piece
        .normals
        .clone()
        .unwrap_or_else(|| seams.normals(&positions, &part.faces));
    for (vertex, normal) in part.vertices.iter().zip(&normals) {
        mesh.positions.push(narrow(vertex.position));
        mesh.normals
            .push(narrow(normal.try_normalize().unwrap_or(DVec3::Y)));
        let uv = if has_coordinates(&part.material) {
            vertex.uv
        } else {
            [0.0; 2]
        };
        mesh.uvs.push(uv.map(|x| x as f32));
        mesh.colors.push(
            vertex
                .color
                .map(|x| (x * 255.0).round().clamp(0.0, 255.0) as u8),
        );
        let (joints, weights) = four_weights(vertex, skeleton);
        mesh.joints.push(joints);
        mesh.weights.push(weights);
    }
    for face in &part.faces {
        mesh.indices.extend(
            triangles(face, &positions)
                .into_iter()
                .flatten()
                .map(|i| i + base),
        );
    }
    append_morphs(mesh, base, part, &seams, &positions, morph_names);
    if !part.bound.is_empty() {
        let binding = mesh.binding.get_or_insert_with(|| Binding {
            starts: vec![0],
            ..Binding::default()
        });
        bind(binding, base, &part.bound);
    }
    mesh.morphs.retain(|m| !m.vertices.is_empty());
    mesh.morphs.sort_by_key(|m| m.target);
}

/// Adds the morphs of a part whose vertices begin at `base`.
fn append_morphs(
    mesh: &mut Mesh,
    base: u32,
    part: &MeshPart,
    seams: &Seams,
    positions: &[DVec3],
    morph_names: &[String],
) {
    for morph in &part.morphs {
        let Ok(target) = morph_names.binary_search(&morph.name) else {
            continue;
        };
        let mut moved = positions.to_vec();
        for &(v, d) in &morph.deltas {
            moved[v as usize] += d;
        }
        let turned = seams.normals(&moved, &part.faces);
        let rest = seams.normals(positions, &part.faces);
        let slot = mesh
            .morphs
            .iter()
            .position(|m| m.target == target)
            .unwrap_or_else(|| {
                mesh.morphs.push(Morph {
                    target,
                    vertices: Vec::new(),
                    position_deltas: Vec::new(),
                    normal_deltas: Vec::new(),
                });
                mesh.morphs.len() - 1
            });
        let out = &mut mesh.morphs[slot];
        for v in 0..positions.len() {
            let d = moved[v] - positions[v];
            // Hairs are lit by the head's roundness, which no expression turns.
            let n = if is_hair(part.material.kind) {
                DVec3::ZERO
            } else {
                turned[v] - rest[v]
            };
            // A seventh of a millimetre and a turn below five degrees are negligible.
            if d.length() > 1.4e-4 || n.length() > 0.09 {
                out.vertices.push(base + v as u32);
                out.position_deltas.push(narrow(d));
                out.normal_deltas.push(narrow(n));
            }
        }
    }
}

/// Nodes that one vertex follows at most: those of the smallest weights are left out.
const NODES: usize = 12;

/// Adds rows for the vertices of a part.
fn bind(binding: &mut Binding, base: u32, bound: &[(u32, Vec<(u32, f64)>)]) {
    for (vertex, row) in bound {
        let mut row = row.clone();
        let whole: f64 = row.iter().map(|r| r.1).sum();
        row.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
        row.truncate(NODES);
        let kept: f64 = row.iter().map(|r| r.1).sum();
        binding.vertices.push(base + vertex);
        for (node, weight) in row {
            binding.nodes.push(node as u16);
            binding.weights.push((weight * whole / kept) as f32);
        }
        binding.starts.push(binding.nodes.len() as u32);
    }
}

/// Returns true if the shading of a material reads texture coordinates; for the other kinds they
/// would only take space.
fn has_coordinates(material: &Material) -> bool {
    use MaterialKind::{Cornea, Eye, Hair, Lash};
    let textured = material.maps != TextureMaps::default();
    let woven = material.kind.weave().is_some();
    textured || woven || matches!(material.kind, Eye | Cornea | Hair | Lash)
}

/// Kinds made of cards.
fn is_hair(kind: MaterialKind) -> bool {
    matches!(kind, MaterialKind::Hair | MaterialKind::Lash)
}

/// Vertices of a part at the same position (texture seams): they share one normal.
struct Seams {
    /// First vertex at the position of each vertex.
    first: Vec<u32>,
}

impl Seams {
    fn find(part: &MeshPart, positions: &[DVec3]) -> Self {
        let alone = is_hair(part.material.kind);
        let mut places: BTreeMap<[i64; 3], u32> = BTreeMap::new();
        let first = positions
            .iter()
            .zip(0u32..)
            .map(|(p, i)| {
                if alone {
                    return i;
                }
                // A hundredth of a millimetre.
                let key = p.to_array().map(|x| (x * 1e5).round() as i64);
                *places.entry(key).or_insert(i)
            })
            .collect();
        Self { first }
    }

    fn normals(&self, positions: &[DVec3], faces: &[Vec<u32>]) -> Vec<DVec3> {
        let joined: Vec<Vec<u32>> = faces
            .iter()
            .map(|f| f.iter().map(|&v| self.first[v as usize]).collect())
            .collect();
        let normals = vertex_normals(positions, &joined);
        self.first.iter().map(|&i| normals[i as usize]).collect()
    }
}

/// Splits a polygon of three or four corners into triangles; a quad is split along its shorter
/// diagonal, and triangles without area are omitted.
pub(super) fn triangles(face: &[u32], positions: &[DVec3]) -> Vec<[u32; 3]> {
    let p = |i: usize| positions[face[i] as usize];
    let mut out = Vec::with_capacity(2);
    if face.len() == 4 && p(0).distance_squared(p(2)) > p(1).distance_squared(p(3)) {
        out.push([face[1], face[2], face[3]]);
        out.push([face[1], face[3], face[0]]);
    } else {
        for i in 1..face.len().saturating_sub(1) {
            out.push([face[0], face[i], face[i + 1]]);
        }
    }
    out.retain(|t| {
        let [a, b, c] = t.map(|i| positions[i as usize]);
        (b - a).cross(c - a).length_squared() > 1e-20
    });
    out
}

/// Returns the four largest weights in 255ths (the stored format), largest first.
fn four_weights(vertex: &PartVertex, skeleton: &Skeleton) -> ([u16; 4], [f32; 4]) {
    let mut sums: BTreeMap<u16, f64> = BTreeMap::new();
    for (joint, weight) in &vertex.weights {
        let index = skeleton.joints().iter().position(|j| j.drive == joint.0);
        if let Some(i) = index {
            *sums.entry(i as u16).or_insert(0.0) += weight.max(0.0);
        }
    }
    let mut sorted: Vec<(u16, f64)> = sums.into_iter().filter(|s| s.1 > 0.0).collect();
    // With more than four joints, helpers that turn almost like another joint of the same bone are
    // merged into it first.
    let drive = |s: &(u16, f64)| skeleton.joints()[usize::from(s.0)].drive;
    let alike = |s: &(u16, f64), t: &(u16, f64)| {
        let (s, t) = (drive(s), drive(t));
        s.bone().is_some() && s.bone() == t.bone() && (s.share() - t.share()).abs() < 0.7
    };
    while sorted.len() > 4 {
        let least = (0..sorted.len())
            .filter(|&i| {
                sorted
                    .iter()
                    .any(|t| t.0 != sorted[i].0 && alike(t, &sorted[i]))
            })
            .min_by(|&a, &b| sorted[a].1.total_cmp(&sorted[b].1));
        let Some(least) = least else { break };
        let gone = sorted.remove(least);
        if let Some(heir) = sorted.iter_mut().find(|t| alike(t, &gone)) {
            heir.1 += gone.1;
        }
    }
    sorted.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
    sorted.truncate(4);
    let total: f64 = sorted.iter().map(|s| s.1).sum();
    let mut joints = [0u16; 4];
    let mut weights = [0f32; 4];
    if total <= 0.0 {
        return (joints, [1.0, 0.0, 0.0, 0.0]);
    }
    for (i, (joint, weight)) in sorted.into_iter().enumerate() {
        joints[i] = joint;
        weights[i] = (weight / total) as f32;
    }
    let stored = weights_in_255ths(weights);
    for i in 0..4 {
        weights[i] = f32::from(stored[i]) / 255.0;
        // A joint without weight is joint 0, as glTF requires.
        if stored[i] == 0 {
            joints[i] = 0;
        }
    }
    (joints, weights)
}

#[cfg(test)]
mod tests;
