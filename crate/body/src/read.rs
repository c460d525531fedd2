//! Reads a figure from glTF 2.0 binary (`.glb`).
//!
//! Takes files whose nodes bear the names of the 54 bones (GEVH appendix A), as the
//! generator writes them. Every fault of the file is a [`ReadError`]; none panics.

mod accessor;

use std::collections::BTreeMap;

use gltf::json::validation::Checked;
use gltf::json::{Root, mesh::Semantic};
use raconteur_base::{DAffine3, DMat4, DQuat, DVec3, Side};
use serde::Deserialize;

use crate::figure::{Figure, Material, MaterialKind, Mesh, Morph};
use crate::skeleton::{Bone, FacePlaces, Skeleton};
use accessor::Source;

/// Why a file is not a figure.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReadError {
    /// The container or its JSON is not glTF 2.0 binary.
    #[error("not a glTF binary: {0}")]
    NotGlb(String),
    /// The file asks for an extension that is not understood.
    #[error("needs the glTF extension {0}")]
    Extension(String),
    /// Something refers to an element that does not exist.
    #[error("{what} refers to an element that does not exist")]
    OutOfRange {
        /// What refers.
        what: &'static str,
    },
    /// Data ends before what is claimed of it.
    #[error("the data of {what} are shorter than claimed")]
    Truncated {
        /// Whose data.
        what: &'static str,
    },
    /// An accessor has the wrong type.
    #[error("{what} have a type that is not supported")]
    Type {
        /// Whose type.
        what: &'static str,
    },
    /// A number is infinite or not a number.
    #[error("{what} hold a number that is not finite")]
    NotFinite {
        /// Whose number.
        what: &'static str,
    },
    /// Attributes of one mesh differ in length.
    #[error("{what} have another count than the positions")]
    Count {
        /// Whose count.
        what: &'static str,
    },
    /// The file would take more memory than any figure needs.
    #[error("the file holds more numbers than a figure can need")]
    TooLarge,
    /// The nodes are no forest.
    #[error("the nodes form a cycle or share a child")]
    Cycle,
    /// The bones of GEVH appendix A are not there.
    #[error("no node is named {missing}")]
    NoSkeleton {
        /// The first bone that is missing.
        missing: &'static str,
    },
    /// A skin uses a joint that is neither a bone nor a known helper.
    #[error("the skin uses an unknown joint, {0}")]
    UnknownJoint(String),
    /// There is no mesh with a skin.
    #[error("the file has no skinned mesh")]
    NoMesh,
}

/// What the scene's extras say of a figure.
#[derive(Deserialize, Default)]
#[serde(rename_all = "camelCase", default)]
struct SceneExtras {
    stature_metres: Option<f64>,
    lid_closure_radians: Option<[f64; 2]>,
}

#[derive(Deserialize, Default)]
#[serde(rename_all = "camelCase", default)]
struct MeshExtras {
    target_names: Vec<String>,
}

#[derive(Deserialize, Default)]
#[serde(default)]
struct MaterialExtras {
    kind: String,
}

/// Parses extras; foreign or absent ones give the default.
fn extras<T: for<'d> Deserialize<'d> + Default>(raw: &gltf::json::Extras) -> T {
    raw.as_ref().and_then(|r| serde_json::from_str(r.get()).ok()).unwrap_or_default()
}

/// Reads a figure; `name` becomes its name.
///
/// # Errors
/// A [`ReadError`] that names the first fault found.
pub fn read_figure(name: &str, glb: &[u8]) -> Result<Figure, ReadError> {
    // The container's own reader subtracts its header from the claimed length unchecked.
    let claimed = glb.get(8..12).map(|b| u32::from_le_bytes([b[0], b[1], b[2], b[3]]));
    if claimed.is_none_or(|n| n < 20) {
        return Err(ReadError::NotGlb("the header is incomplete".to_owned()));
    }
    let container =
        gltf::binary::Glb::from_slice(glb).map_err(|e| ReadError::NotGlb(e.to_string()))?;
    let root: Root = gltf::json::deserialize::from_slice(&container.json)
        .map_err(|e| ReadError::NotGlb(e.to_string()))?;
    if let Some(e) = root.extensions_required.iter().find(|e| *e != "KHR_mesh_quantization") {
        return Err(ReadError::Extension(e.clone()));
    }
    let bin = container.bin.as_deref().unwrap_or_default();
    let mut source = Source::new(&root, bin);

    let world_from_node = solve_nodes(&root)?;
    let scene: SceneExtras = root
        .scene
        .and_then(|s| root.scenes.get(s.value()))
        .map(|s| extras(&s.extras))
        .unwrap_or_default();
    let skeleton = skeleton(&root, &world_from_node, scene.stature_metres)?;
    let mut figure = Figure {
        name: name.to_owned(),
        inverse_bind: bind_of(&root, &world_from_node, &skeleton),
        skeleton,
        meshes: Vec::new(),
        morph_names: morph_names(&root),
        lid_closure_rad: scene
            .lid_closure_radians
            .filter(|r| r.iter().all(|x| x.is_finite()))
            .unwrap_or([0.0; 2]),
    };
    for node in &root.nodes {
        if let (Some(mesh), Some(skin)) = (node.mesh, node.skin) {
            let binding = read_skin(&mut source, skin.value(), &world_from_node, &figure.skeleton)?;
            let mesh = root
                .meshes
                .get(mesh.value())
                .ok_or(ReadError::OutOfRange { what: "a node's mesh" })?;
            for primitive in &mesh.primitives {
                let read = read_primitive(&mut source, mesh, primitive, &binding, &figure)?;
                figure.meshes.push(read);
            }
        }
    }
    if figure.meshes.is_empty() {
        return Err(ReadError::NoMesh);
    }
    Ok(figure)
}

fn morph_names(root: &Root) -> Vec<String> {
    let mut names: Vec<String> = root
        .meshes
        .iter()
        .flat_map(|m| extras::<MeshExtras>(&m.extras).target_names)
        .collect();
    names.sort();
    names.dedup();
    names
}

/// World from node for every node.
fn solve_nodes(root: &Root) -> Result<Vec<DAffine3>, ReadError> {
    let count = root.nodes.len();
    let mut parents: Vec<Option<usize>> = vec![None; count];
    for (i, node) in root.nodes.iter().enumerate() {
        for child in node.children.iter().flatten() {
            let slot = parents
                .get_mut(child.value())
                .ok_or(ReadError::OutOfRange { what: "a node's child" })?;
            if slot.replace(i).is_some() {
                return Err(ReadError::Cycle);
            }
        }
    }
    let mut world = vec![DAffine3::IDENTITY; count];
    let mut order: Vec<usize> = (0..count).filter(|&i| parents[i].is_none()).collect();
    let mut done = 0;
    while let Some(&i) = order.get(done) {
        done += 1;
        let local = local_of(&root.nodes[i])?;
        world[i] = parents[i].map_or(local, |p| world[p] * local);
        order.extend(root.nodes[i].children.iter().flatten().map(gltf::json::Index::value));
    }
    if done == count { Ok(world) } else { Err(ReadError::Cycle) }
}

fn local_of(node: &gltf::json::Node) -> Result<DAffine3, ReadError> {
    let local = if let Some(m) = node.matrix {
        DAffine3::from_mat4(DMat4::from_cols_array(&m.map(f64::from)))
    } else {
        let triple = |v: [f32; 3]| DVec3::from_array(v.map(f64::from));
        let rotation = node.rotation.map_or(DQuat::IDENTITY, |r| DQuat::from_array(r.0.map(f64::from)));
        DAffine3::from_scale_rotation_translation(
            node.scale.map_or(DVec3::ONE, triple),
            if rotation.length_squared() > 0.0 { rotation.normalize() } else { DQuat::IDENTITY },
            node.translation.map_or(DVec3::ZERO, triple),
        )
    };
    if local.is_finite() { Ok(local) } else { Err(ReadError::NotFinite { what: "a node's placement" }) }
}

/// Nodes by name; the first of a name counts.
fn node_named(root: &Root, name: &str) -> Option<usize> {
    root.nodes.iter().position(|n| n.name.as_deref() == Some(name))
}

fn skeleton(root: &Root, world: &[DAffine3], stature_m: Option<f64>) -> Result<Skeleton, ReadError> {
    let mut positions = [DVec3::ZERO; Bone::COUNT];
    let mut rotations = [DQuat::IDENTITY; Bone::COUNT];
    for bone in Bone::ALL {
        let node = node_named(root, bone.name())
            .ok_or(ReadError::NoSkeleton { missing: bone.name() })?;
        let (_, rotation, translation) = world[node].to_scale_rotation_translation();
        if !rotation.is_finite() {
            return Err(ReadError::NotFinite { what: "a bone's placement" });
        }
        positions[bone.index()] = translation;
        rotations[bone.index()] = rotation;
    }
    let skull = positions[Bone::Skull.index()];
    let eye = |side: Side| {
        let name = if side == Side::Left { "helper_l_eye" } else { "helper_r_eye" };
        node_named(root, name).map_or(skull, |n| world[n].translation)
    };
    let face = FacePlaces { eye_centres: Side::BOTH.map(eye) };
    // A file without the stature gets one from the height of the skull's joint (0.888 of
    // stature in adults).
    let stature = stature_m.filter(|s| s.is_finite() && *s > 0.0).unwrap_or(skull.y / 0.888);
    Ok(Skeleton::from_bind(&positions, &rotations, face, stature))
}

/// Joint from world in the bind pose, from the nodes' placement.
fn bind_of(root: &Root, world: &[DAffine3], skeleton: &Skeleton) -> Vec<DAffine3> {
    let mut bind: Vec<DAffine3> = Vec::with_capacity(skeleton.joints().len());
    for joint in skeleton.joints() {
        let placed = node_named(root, &joint.name).map(|n| world[n].inverse());
        // A helper that the file lacks moves no vertex; its parent's bind does.
        bind.push(placed.or_else(|| joint.parent.map(|p| bind[p])).unwrap_or(DAffine3::IDENTITY));
    }
    bind
}

/// How a skin maps the file's vertices and joints to ours.
struct Binding {
    /// Joints of the skin as indices into the skeleton's.
    joints: Vec<u16>,
    /// World from the vertices' own frame in the bind pose: undoes quantisation.
    world_from_mesh: DAffine3,
}

fn read_skin(
    source: &mut Source<'_>,
    index: usize,
    world_from_node: &[DAffine3],
    skeleton: &Skeleton,
) -> Result<Binding, ReadError> {
    let root = source.root;
    let skin = root.skins.get(index).ok_or(ReadError::OutOfRange { what: "a node's skin" })?;
    let by_name: BTreeMap<&str, usize> =
        skeleton.joints().iter().enumerate().map(|(i, j)| (j.name.as_str(), i)).collect();
    let mut joints = Vec::with_capacity(skin.joints.len());
    for joint in &skin.joints {
        let node = root
            .nodes
            .get(joint.value())
            .ok_or(ReadError::OutOfRange { what: "a skin's joint" })?;
        let name = node.name.as_deref().unwrap_or_default();
        let ours = by_name.get(name).ok_or_else(|| ReadError::UnknownJoint(name.to_owned()))?;
        joints.push(*ours as u16);
    }
    let first = skin.joints.first().ok_or(ReadError::OutOfRange { what: "a skin without joints" })?;
    let world_from_mesh = match skin.inverse_bind_matrices {
        None => world_from_node[first.value()],
        Some(accessor) => {
            let matrices: Vec<[f32; 16]> = source.floats(accessor.value(), "inverse bind matrices")?;
            if matrices.len() < joints.len() {
                return Err(ReadError::Count { what: "inverse bind matrices" });
            }
            let m = DMat4::from_cols_array(&matrices[0].map(f64::from));
            world_from_node[first.value()] * DAffine3::from_mat4(m)
        }
    };
    if !world_from_mesh.is_finite() || world_from_mesh.matrix3.determinant() == 0.0 {
        return Err(ReadError::NotFinite { what: "inverse bind matrices" });
    }
    Ok(Binding { joints, world_from_mesh })
}

fn same_count<T>(v: Vec<T>, count: usize, what: &'static str) -> Result<Vec<T>, ReadError> {
    if v.len() == count { Ok(v) } else { Err(ReadError::Count { what }) }
}

fn narrow(v: DVec3) -> [f32; 3] {
    v.to_array().map(|x| x as f32)
}

fn widen(v: [f32; 3]) -> DVec3 {
    DVec3::from_array(v.map(f64::from))
}

fn read_primitive(
    source: &mut Source<'_>,
    mesh: &gltf::json::Mesh,
    primitive: &gltf::json::mesh::Primitive,
    binding: &Binding,
    figure: &Figure,
) -> Result<Mesh, ReadError> {
    let find = |s: Semantic| primitive.attributes.get(&Checked::Valid(s)).map(gltf::json::Index::value);
    let need = |s: Semantic, what| find(s).ok_or(ReadError::OutOfRange { what });
    let to_world = binding.world_from_mesh;
    // Normals turn with the inverse transpose; the scale drops out.
    let turn = to_world.matrix3.inverse().transpose();
    let unit = |n: [f32; 3]| narrow((turn * widen(n)).try_normalize().unwrap_or(DVec3::Y));

    let raw: Vec<[f32; 3]> = source.floats(need(Semantic::Positions, "positions")?, "positions")?;
    let count = raw.len();
    let raw_normals: Vec<[f32; 3]> =
        same_count(source.floats(need(Semantic::Normals, "normals")?, "normals")?, count, "normals")?;
    let uvs = match find(Semantic::TexCoords(0)) {
        Some(a) => same_count(source.floats(a, "texture coordinates")?, count, "texture coordinates")?,
        None => vec![[0.0; 2]; count],
    };
    let colors = match find(Semantic::Colors(0)) {
        Some(a) => {
            let c: Vec<[f32; 4]> = same_count(source.floats(a, "colours")?, count, "colours")?;
            c.into_iter().map(|c| c.map(|x| (x * 255.0).round().clamp(0.0, 255.0) as u8)).collect()
        }
        None => vec![[255; 4]; count],
    };
    let joints: Vec<[u32; 4]> =
        same_count(source.integers(need(Semantic::Joints(0), "joints")?, "joints")?, count, "joints")?;
    let joints = joints
        .into_iter()
        .map(|quad| {
            let mut out = [0u16; 4];
            for (o, j) in out.iter_mut().zip(quad) {
                *o = *binding
                    .joints
                    .get(j as usize)
                    .ok_or(ReadError::OutOfRange { what: "a vertex's joint" })?;
            }
            Ok(out)
        })
        .collect::<Result<Vec<_>, ReadError>>()?;
    let weights: Vec<[f32; 4]> =
        same_count(source.floats(need(Semantic::Weights(0), "weights")?, "weights")?, count, "weights")?;
    let weights = weights
        .into_iter()
        .map(|w| {
            let sum: f32 = w.iter().sum();
            if sum > 0.0 && w.iter().all(|x| *x >= 0.0) {
                Ok(w.map(|x| x / sum))
            } else {
                Err(ReadError::NotFinite { what: "normalised weights" })
            }
        })
        .collect::<Result<Vec<_>, ReadError>>()?;

    let indices: Vec<u32> = match primitive.indices {
        Some(a) => source.integers::<1>(a.value(), "indices")?.into_iter().map(|[i]| i).collect(),
        None => (0..count as u32).collect(),
    };
    if primitive.mode != Checked::Valid(gltf::json::mesh::Mode::Triangles)
        || !indices.len().is_multiple_of(3)
    {
        return Err(ReadError::Type { what: "triangles" });
    }
    if indices.iter().any(|&i| i as usize >= count) {
        return Err(ReadError::OutOfRange { what: "a triangle" });
    }

    Ok(Mesh {
        name: mesh.name.clone().unwrap_or_default(),
        material: read_material(source.root, primitive)?,
        morphs: read_morphs(source, mesh, primitive, count, to_world, figure)?,
        positions: raw.into_iter().map(|p| narrow(to_world.transform_point3(widen(p)))).collect(),
        normals: raw_normals.into_iter().map(unit).collect(),
        uvs,
        colors,
        joints,
        weights,
        indices,
    })
}

fn read_morphs(
    source: &mut Source<'_>,
    mesh: &gltf::json::Mesh,
    primitive: &gltf::json::mesh::Primitive,
    count: usize,
    to_world: DAffine3,
    figure: &Figure,
) -> Result<Vec<Morph>, ReadError> {
    let names = extras::<MeshExtras>(&mesh.extras).target_names;
    let rotation = to_world.to_scale_rotation_translation().1;
    let mut morphs = Vec::new();
    // A target without a name cannot be driven and is left out.
    for (target, name) in primitive.targets.iter().flatten().zip(&names) {
        let (Some(positions), Some(target_index)) = (target.positions, figure.morph_index(name)) else {
            continue;
        };
        let (vertices, deltas) = source.nonzero(positions.value(), count, "a morph target")?;
        let normal_of: BTreeMap<u32, [f32; 3]> = match target.normals {
            Some(a) => {
                let (places, values) = source.nonzero(a.value(), count, "a morph's normals")?;
                places.into_iter().zip(values).collect()
            }
            None => BTreeMap::new(),
        };
        morphs.push(Morph {
            target: target_index,
            normal_deltas: vertices
                .iter()
                .map(|v| normal_of.get(v).map_or([0.0; 3], |n| narrow(rotation * widen(*n))))
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

fn read_material(
    root: &Root,
    primitive: &gltf::json::mesh::Primitive,
) -> Result<Material, ReadError> {
    let Some(index) = primitive.material else {
        return Ok(Material {
            kind: MaterialKind::Plain,
            base_color: [1.0; 4],
            roughness: 1.0,
            double_sided: false,
        });
    };
    let m = root
        .materials
        .get(index.value())
        .ok_or(ReadError::OutOfRange { what: "a mesh's material" })?;
    let kind = extras::<MaterialExtras>(&m.extras).kind;
    let pbr = &m.pbr_metallic_roughness;
    if !pbr.base_color_factor.0.iter().all(|x| x.is_finite()) || !pbr.roughness_factor.0.is_finite() {
        return Err(ReadError::NotFinite { what: "a material" });
    }
    Ok(Material {
        kind: MaterialKind::NAMES
            .into_iter()
            .find(|n| n.1 == kind)
            .map_or(MaterialKind::Plain, |n| n.0),
        base_color: pbr.base_color_factor.0,
        roughness: pbr.roughness_factor.0,
        double_sided: m.double_sided,
    })
}
