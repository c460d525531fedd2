//! Reader of figures from glTF 2.0 binary (`.glb`).
//!
//! It accepts files whose nodes have the names of the 54 bones (GEVH appendix A), as written by the
//! generator. Every fault of the file is a [`ReadError`]; none causes a panic.

pub mod accessor;
#[allow(missing_docs, reason = "the fields are those of glTF")]
pub mod document;
mod material;
mod mesh;
pub mod packed;
mod soft;
mod springs;

use raconteur_base::{DAffine3, DMat4, DQuat, DVec3, Side};

use crate::face::Tissue;
use crate::face::file::TissueError;
use crate::figure::{Figure, Image};
use crate::skeleton::{Bone, FaceJoints, Skeleton};
use accessor::Source;
use document::Document;
use mesh::{read_primitive, read_skin};

/// Error returned when a glTF file cannot be read as a figure.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReadError {
    /// The container or its JSON is not glTF 2.0 binary.
    #[error("not a glTF binary: {0}")]
    NotGlb(String),
    /// The file requires an unsupported extension.
    #[error("needs the glTF extension {0}")]
    Extension(String),
    /// A reference to an element that does not exist.
    #[error("{what} refers to an element that does not exist")]
    OutOfRange {
        /// The referring item.
        what: &'static str,
    },
    /// Data is shorter than declared.
    #[error("the data of {what} are shorter than claimed")]
    Truncated {
        /// The affected data.
        what: &'static str,
    },
    /// Compressed data are not a stream of the declared length and kind.
    #[error("the compressed data of {what} cannot be unpacked")]
    Packed {
        /// The affected data.
        what: &'static str,
    },
    /// An accessor has the wrong type.
    #[error("{what} have a type that is not supported")]
    Type {
        /// The item with the invalid type.
        what: &'static str,
    },
    /// A number is infinite or not a number.
    #[error("{what} hold a number that is not finite")]
    NotFinite {
        /// The item with the invalid number.
        what: &'static str,
    },
    /// Attributes of one mesh differ in length.
    #[error("{what} have another count than the positions")]
    Count {
        /// The item with the invalid count.
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
    /// The tissue under the skin of the face cannot be read.
    #[error("the tissue of the face cannot be read: {0}")]
    Tissue(#[from] TissueError),
    /// The file has no mesh with a skin.
    #[error("the file has no skinned mesh")]
    NoMesh,
}

/// Reads a figure from glTF binary; `name` becomes its name.
///
/// # Errors
/// Returns a [`ReadError`] that describes the first problem found.
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
    let springs = springs::hang(&root, &world_from_node, &mut skeleton);
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

/// Returns the transform from node to world for every node of a document.
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
    let face = FaceJoints {
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

/// Returns the transform from world to joint in the bind pose, from the transforms of the nodes.
fn bind_of(root: &Document<'_>, world: &[DAffine3], skeleton: &Skeleton) -> Vec<DAffine3> {
    let mut bind: Vec<DAffine3> = Vec::with_capacity(skeleton.joints().len());
    for joint in skeleton.joints() {
        let placed = node_named(root, &joint.name).map(|n| world[n].inverse());
        // A missing helper joint moves no vertex; the bind matrix of its parent suffices.
        bind.push(
            placed
                .or_else(|| joint.parent.map(|p| bind[p]))
                .unwrap_or(DAffine3::IDENTITY),
        );
    }
    bind
}

fn same_count<T>(v: Vec<T>, count: usize, what: &'static str) -> Result<Vec<T>, ReadError> {
    if v.len() == count {
        Ok(v)
    } else {
        Err(ReadError::Count { what })
    }
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
