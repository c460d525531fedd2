//! Meshes: vertices, triangles, morph targets and joint weights.

use raconteur_base::{DAffine3, DMat4, DVec3};

use super::accessor::Source;
use super::material::read_material;
use super::{ReadError, document, same_count, soft};
use crate::figure::{Figure, Mesh, Morph};
use crate::skeleton::Skeleton;

/// Mapping from the joints and vertices of a skin in the file to those of the figure.
pub(super) struct Binding {
    /// Joints of the skin as indices into the skeleton's.
    joints: Vec<u16>,
    /// World from the vertices' own frame in the bind pose: undoes quantisation.
    world_from_mesh: DAffine3,
}

pub(super) fn read_skin(
    source: &mut Source<'_>,
    index: usize,
    world_from_node: &[DAffine3],
    skeleton: &Skeleton,
) -> Result<Binding, ReadError> {
    let root = source.root;
    let skin = root.skins.get(index).ok_or(ReadError::OutOfRange {
        what: "a node's skin",
    })?;
    let mut joints = Vec::with_capacity(skin.joints.len());
    for &joint in &skin.joints {
        let node = root.nodes.get(joint).ok_or(ReadError::OutOfRange {
            what: "a skin's joint",
        })?;
        let ours = skeleton
            .joints()
            .iter()
            .position(|j| j.name == node.name)
            .ok_or_else(|| ReadError::UnknownJoint(node.name.clone()))?;
        joints.push(ours as u16);
    }
    let first = *skin.joints.first().ok_or(ReadError::OutOfRange {
        what: "a skin without joints",
    })?;
    let world_from_mesh = match skin.inverse_bind_matrices {
        None => world_from_node[first],
        Some(accessor) => {
            let matrices: Vec<[f32; 16]> = source.floats(accessor, "inverse bind matrices")?;
            if matrices.len() < joints.len() {
                return Err(ReadError::Count {
                    what: "inverse bind matrices",
                });
            }
            let m = DMat4::from_cols_array(&matrices[0].map(f64::from));
            world_from_node[first] * DAffine3::from_mat4(m)
        }
    };
    if !world_from_mesh.is_finite() || world_from_mesh.matrix3.determinant() == 0.0 {
        return Err(ReadError::NotFinite {
            what: "inverse bind matrices",
        });
    }
    Ok(Binding {
        joints,
        world_from_mesh,
    })
}

/// Coarser levels of detail that are read of a mesh; a file with more loses the coarsest.
const MAX_COARSER: usize = 7;

/// glTF's drawing mode of separate triangles.
const TRIANGLES: u64 = 4;

fn narrow(v: DVec3) -> [f32; 3] {
    v.to_array().map(|x| x as f32)
}

fn widen(v: [f32; 3]) -> DVec3 {
    DVec3::from_array(v.map(f64::from))
}

pub(super) fn read_primitive(
    source: &mut Source<'_>,
    mesh: &document::Mesh,
    primitive: &document::Primitive,
    binding: &Binding,
    figure: &Figure,
) -> Result<Mesh, ReadError> {
    let find = |name: &str| primitive.attribute(name);
    let need = |name: &str, what| find(name).ok_or(ReadError::OutOfRange { what });
    let to_world = binding.world_from_mesh;
    // Normals turn with the inverse transpose; the scale drops out.
    let turn = to_world.matrix3.inverse().transpose();
    let unit = |n: [f32; 3]| narrow((turn * widen(n)).try_normalize().unwrap_or(DVec3::Y));

    let raw: Vec<[f32; 3]> = source.floats(need("POSITION", "positions")?, "positions")?;
    let count = raw.len();
    let raw_normals: Vec<[f32; 3]> = same_count(
        source.floats(need("NORMAL", "normals")?, "normals")?,
        count,
        "normals",
    )?;
    let uvs = match find("TEXCOORD_0") {
        Some(a) => same_count(
            source.floats(a, "texture coordinates")?,
            count,
            "texture coordinates",
        )?,
        None => vec![[0.0; 2]; count],
    };
    let colors = match find("COLOR_0") {
        Some(a) => {
            let c: Vec<[f32; 4]> = same_count(source.floats(a, "colours")?, count, "colours")?;
            c.into_iter()
                .map(|c| c.map(|x| (x * 255.0).round().clamp(0.0, 255.0) as u8))
                .collect()
        }
        None => vec![[255; 4]; count],
    };
    let joints = source.integers(need("JOINTS_0", "joints")?, "joints")?;
    let joints = joints_of(same_count(joints, count, "joints")?, binding)?;
    let weights = source.floats(need("WEIGHTS_0", "weights")?, "weights")?;
    let weights = weights_of(same_count(weights, count, "weights")?)?;

    if primitive.mode != TRIANGLES {
        return Err(ReadError::Type { what: "triangles" });
    }
    let indices = match primitive.indices {
        Some(a) => read_triangles(source, a, count)?,
        None if count.is_multiple_of(3) => (0..count as u32).collect(),
        None => return Err(ReadError::Type { what: "triangles" }),
    };

    Ok(Mesh {
        name: mesh.name.clone(),
        material: read_material(source.root, primitive)?,
        morphs: read_morphs(source, mesh, primitive, count, to_world, figure)?,
        binding: soft::binding(source, mesh, count)?,
        coarser: read_coarser(source, mesh, count)?,
        positions: raw
            .into_iter()
            .map(|p| narrow(to_world.transform_point3(widen(p))))
            .collect(),
        normals: raw_normals.into_iter().map(unit).collect(),
        uvs,
        colors,
        joints,
        weights,
        indices,
    })
}

/// Converts the joint indices of vertices from the file's skin to the figure's skeleton.
fn joints_of(joints: Vec<[u32; 4]>, binding: &Binding) -> Result<Vec<[u16; 4]>, ReadError> {
    let what = "a vertex's joint";
    let of = |quad: [u32; 4]| {
        let mut out = [0u16; 4];
        for (o, j) in out.iter_mut().zip(quad) {
            let joint = binding.joints.get(j as usize);
            *o = *joint.ok_or(ReadError::OutOfRange { what })?;
        }
        Ok(out)
    };
    joints.into_iter().map(of).collect()
}

/// Weights of vertices, of which each has a sum of 1.
fn weights_of(weights: Vec<[f32; 4]>) -> Result<Vec<[f32; 4]>, ReadError> {
    let of = |w: [f32; 4]| {
        let sum: f32 = w.iter().sum();
        if sum > 0.0 && w.iter().all(|x| *x >= 0.0) {
            Ok(w.map(|x| x / sum))
        } else {
            Err(ReadError::NotFinite {
                what: "normalised weights",
            })
        }
    };
    weights.into_iter().map(of).collect()
}

/// Reads the triangles of an accessor, over `count` vertices.
fn read_triangles(
    source: &mut Source<'_>,
    accessor: usize,
    count: usize,
) -> Result<Vec<u32>, ReadError> {
    let indices: Vec<u32> = source
        .integers::<1>(accessor, "indices")?
        .into_iter()
        .map(|[i]| i)
        .collect();
    if !indices.len().is_multiple_of(3) {
        return Err(ReadError::Type { what: "triangles" });
    }
    if indices.iter().any(|&i| i as usize >= count) {
        return Err(ReadError::OutOfRange { what: "a triangle" });
    }
    Ok(indices)
}

/// Reads the triangles of a mesh's coarser levels of detail.
fn read_coarser(
    source: &mut Source<'_>,
    mesh: &document::Mesh,
    count: usize,
) -> Result<Vec<Vec<u32>>, ReadError> {
    let levels = mesh.coarser.iter().take(MAX_COARSER);
    levels
        .map(|&accessor| read_triangles(source, accessor, count))
        .collect()
}

fn read_morphs(
    source: &mut Source<'_>,
    mesh: &document::Mesh,
    primitive: &document::Primitive,
    count: usize,
    to_world: DAffine3,
    figure: &Figure,
) -> Result<Vec<Morph>, ReadError> {
    let rotation = to_world.to_scale_rotation_translation().1;
    let mut morphs = Vec::new();
    // A target without a name cannot be driven and is left out.
    for (target, name) in primitive.targets.iter().zip(&mesh.target_names) {
        let (Some(positions), Some(target_index)) = (target.positions, figure.morph_index(name))
        else {
            continue;
        };
        let (vertices, deltas) = source.nonzero(positions, count, "a morph target")?;
        // The indices are ascending, as glTF requires and the accessor has checked.
        let (places, normals) = match target.normals {
            Some(a) => source.nonzero(a, count, "a morph's normals")?,
            None => Default::default(),
        };
        morphs.push(Morph {
            target: target_index,
            normal_deltas: vertices
                .iter()
                .map(|v| {
                    let at = places.binary_search(v);
                    at.map_or([0.0; 3], |at| narrow(rotation * widen(normals[at])))
                })
                .collect(),
            position_deltas: deltas
                .into_iter()
                .map(|d| narrow(to_world.transform_vector3(widen(d))))
                .collect(),
            vertices,
        });
    }
    Ok(morphs)
}
