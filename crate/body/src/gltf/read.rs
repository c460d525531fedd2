//! Reads a figure from glTF 2.0 binary (`.glb`).
//!
//! Takes files whose nodes bear the names of the 54 bones (GEVH appendix A), as the
//! generator writes them. Every fault of the file is a [`ReadError`]; none panics.

pub mod accessor;
#[allow(missing_docs, reason = "the fields are those of glTF")]
pub mod document;
mod hung;
pub mod packed;
mod soft;

use raconteur_base::{DAffine3, DMat4, DQuat, DVec3, Side};

use crate::face::Tissue;
use crate::face::file::TissueError;
use crate::figure::{Figure, Image, Maps, Material, MaterialKind, Mesh, Morph};
use crate::skeleton::{Bone, FacePlaces, Skeleton};
use accessor::Source;
use document::Document;

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
    /// Data is shorter than its description says.
    #[error("the data of {what} are shorter than claimed")]
    Truncated {
        /// Whose data.
        what: &'static str,
    },
    /// Compressed data are no stream of the length and kind that their description says.
    #[error("the compressed data of {what} cannot be unpacked")]
    Packed {
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
    /// What moves under the skin of the face cannot be read.
    #[error("the tissue of the face cannot be read: {0}")]
    Tissue(#[from] TissueError),
    /// There is no mesh with a skin.
    #[error("the file has no skinned mesh")]
    NoMesh,
}

/// Reads a figure; `name` becomes its name.
///
/// # Errors
/// A [`ReadError`] that names the first fault found.
pub fn read_figure(name: &str, glb: &[u8]) -> Result<Figure, ReadError> {
    let root = Document::read(glb)?;
    if let Some(e) = root
        .extensions_required
        .iter()
        .find(|e| ![packed::EXTENSION, "KHR_mesh_quantization"].contains(&e.as_str()))
    {
        return Err(ReadError::Extension(e.clone()));
    }
    let mut source = Source::new(&root);

    let world_from_node = solve_nodes(&root)?;
    let mut skeleton = skeleton(&root, &world_from_node)?;
    let springs = hung::hang(&root, &world_from_node, &mut skeleton);
    let mut figure = Figure {
        name: name.to_owned(),
        inverse_bind: bind_of(&root, &world_from_node, &skeleton),
        skeleton,
        meshes: Vec::new(),
        morph_names: morph_names(&root),
        lid_closure_rad: root.lid_closure_rad.unwrap_or([0.0; 2]),
        sex: root.sex,
        dominant_hand: if root.is_left_handed {
            Side::Left
        } else {
            Side::Right
        },
        tissue: soft::tissue(&mut source)?.map(|tissue| Tissue {
            lines: root.lines as f32,
            ..tissue
        }),
        springs,
        images: read_images(&mut source)?,
    };
    for node in &root.nodes {
        if let (Some(mesh), Some(skin)) = (node.mesh, node.skin) {
            let binding = read_skin(&mut source, skin, &world_from_node, &figure.skeleton)?;
            let mesh = root.meshes.get(mesh).ok_or(ReadError::OutOfRange {
                what: "a node's mesh",
            })?;
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

fn morph_names(root: &Document<'_>) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for name in root.meshes.iter().flat_map(|m| &m.target_names) {
        if let Err(place) = names.binary_search(name) {
            names.insert(place, name.clone());
        }
    }
    names
}

/// World from node for every node.
pub fn solve_nodes(root: &Document<'_>) -> Result<Vec<DAffine3>, ReadError> {
    let count = root.nodes.len();
    let mut parents: Vec<Option<usize>> = vec![None; count];
    for (i, node) in root.nodes.iter().enumerate() {
        for &child in &node.children {
            let slot = parents.get_mut(child).ok_or(ReadError::OutOfRange {
                what: "a node's child",
            })?;
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
        order.extend(&root.nodes[i].children);
    }
    if done == count {
        Ok(world)
    } else {
        Err(ReadError::Cycle)
    }
}

fn local_of(node: &document::Node) -> Result<DAffine3, ReadError> {
    let local = if let Some(m) = node.matrix {
        DAffine3::from_mat4(DMat4::from_cols_array(&m))
    } else {
        let rotation = node.rotation.map_or(DQuat::IDENTITY, DQuat::from_array);
        DAffine3::from_scale_rotation_translation(
            node.scale.map_or(DVec3::ONE, DVec3::from_array),
            if rotation.length_squared() > 0.0 {
                rotation.normalize()
            } else {
                DQuat::IDENTITY
            },
            node.translation.map_or(DVec3::ZERO, DVec3::from_array),
        )
    };
    if local.is_finite() {
        Ok(local)
    } else {
        Err(ReadError::NotFinite {
            what: "a node's placement",
        })
    }
}

/// Nodes by name; the first of a name counts.
fn node_named(root: &Document<'_>, name: &str) -> Option<usize> {
    root.nodes.iter().position(|n| n.name == name)
}

fn skeleton(root: &Document<'_>, world: &[DAffine3]) -> Result<Skeleton, ReadError> {
    let mut positions = [DVec3::ZERO; Bone::COUNT];
    let mut rotations = [DQuat::IDENTITY; Bone::COUNT];
    for bone in Bone::ALL {
        let node = node_named(root, bone.name()).ok_or(ReadError::NoSkeleton {
            missing: bone.name(),
        })?;
        let (_, rotation, translation) = world[node].to_scale_rotation_translation();
        if !rotation.is_finite() {
            return Err(ReadError::NotFinite {
                what: "a bone's placement",
            });
        }
        positions[bone.index()] = translation;
        rotations[bone.index()] = rotation;
    }
    let skull = positions[Bone::Skull.index()];
    let eye = |side: Side| {
        let name = if side == Side::Left {
            "helper_l_eye"
        } else {
            "helper_r_eye"
        };
        node_named(root, name).map_or(skull, |n| world[n].translation)
    };
    let face = FacePlaces {
        eye_centres: Side::BOTH.map(eye),
    };
    // A file without the stature gets one from the height of the skull's joint (0.888 of
    // stature in adults).
    let stature = root
        .stature_m
        .filter(|s| s.is_finite() && *s > 0.0)
        .unwrap_or(skull.y / 0.888);
    Ok(Skeleton::from_bind(&positions, &rotations, face, stature))
}

/// Joint from world in the bind pose, from the nodes' placement.
fn bind_of(root: &Document<'_>, world: &[DAffine3], skeleton: &Skeleton) -> Vec<DAffine3> {
    let mut bind: Vec<DAffine3> = Vec::with_capacity(skeleton.joints().len());
    for joint in skeleton.joints() {
        let placed = node_named(root, &joint.name).map(|n| world[n].inverse());
        // A helper that the file lacks moves no vertex; its parent's bind does.
        bind.push(
            placed
                .or_else(|| joint.parent.map(|p| bind[p]))
                .unwrap_or(DAffine3::IDENTITY),
        );
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

fn same_count<T>(v: Vec<T>, count: usize, what: &'static str) -> Result<Vec<T>, ReadError> {
    if v.len() == count {
        Ok(v)
    } else {
        Err(ReadError::Count { what })
    }
}

fn narrow(v: DVec3) -> [f32; 3] {
    v.to_array().map(|x| x as f32)
}

fn widen(v: [f32; 3]) -> DVec3 {
    DVec3::from_array(v.map(f64::from))
}

fn read_primitive(
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

/// The figure's joints of vertices, of those of the file's skin.
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

/// The triangles of an accessor, over `count` vertices.
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

/// The triangles of a mesh's coarser levels of detail.
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
        // Places are ascending, as glTF asks and the source has checked.
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

fn read_images(source: &mut Source<'_>) -> Result<Vec<Image>, ReadError> {
    let mut images = Vec::new();
    for i in &source.root.images {
        images.push(Image {
            mime_type: i.mime_type.clone(),
            bytes: source.view_bytes(i.view, "a picture")?.into_owned(),
        });
    }
    Ok(images)
}

/// The image behind a texture.
fn map_of(root: &Document<'_>, texture: Option<usize>) -> Result<Option<usize>, ReadError> {
    let Some(texture) = texture else {
        return Ok(None);
    };
    let image = root.texture_images.get(texture).copied();
    image
        .filter(|&i| i < root.images.len())
        .map(Some)
        .ok_or(ReadError::OutOfRange {
            what: "a material's texture",
        })
}

fn read_material(
    root: &Document<'_>,
    primitive: &document::Primitive,
) -> Result<Material, ReadError> {
    let Some(index) = primitive.material else {
        return Ok(Material {
            kind: MaterialKind::Plain,
            base_color: [1.0; 4],
            roughness: 1.0,
            double_sided: false,
            maps: Maps::default(),
        });
    };
    let m = root.materials.get(index).ok_or(ReadError::OutOfRange {
        what: "a mesh's material",
    })?;
    Ok(Material {
        kind: MaterialKind::NAMES
            .into_iter()
            .find(|n| n.1 == m.kind)
            .map_or(MaterialKind::Plain, |n| n.0),
        base_color: m.base_color.map(|x| x as f32),
        roughness: m.roughness as f32,
        double_sided: m.double_sided,
        maps: Maps {
            base_color: map_of(root, m.base_color_texture)?,
            normal: map_of(root, m.normal_texture)?,
            wrinkles: map_of(root, m.wrinkle_texture)?,
        },
    })
}
