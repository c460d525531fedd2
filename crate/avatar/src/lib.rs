//! Avatar import: converts any humanoid glTF, GLB or VRM to a [`Figure`].
//!
//! Scope: the crate finds the bones by VRM's table or by their names, aligns the avatar with
//! generated figures, determines the difference between its rest pose and the zero pose, binds its
//! skin to the joints, and makes the face channels from its morph targets. Parts that cannot be
//! kept are a [`Diagnostic`], unusable files an [`ImportError`]; no file causes a panic or
//! unbounded memory use. [`face_file`] writes a figure with a face of a face model.
//! [`convert_animation`] makes clips of a file's animations.
//! Out of scope: spring bones, cameras, lights and image decoding.
//!
//! A page loads this crate separately from the player and passes the output of [`convert`] to the
//! player.

mod align;
mod animation;
mod bind;
#[cfg(target_arch = "wasm32")]
pub mod bindings;
mod container;
mod duplicates;
mod error;
mod face;
mod file;
mod frames;
mod geometry;
mod humanoid;
mod material;
mod names;
mod packed;
mod tree;
mod unposed;

use raconteur_base::{DVec3, Side};

pub use animation::convert_animation;
use error::DiagnosticSink;
pub use error::{Diagnostic, ImportError};
pub use file::{FaceFile, FileError, face_file};
use raconteur_body::figure::Figure;
use raconteur_body::read::accessor::Source;
use raconteur_body::read::{ReadError, read_figure, solve_nodes};
use raconteur_body::skeleton::Bone;
use raconteur_body::write::to_glb;

/// Maximum count of numbers read from a file; several views may share a range of bytes.
const MAX_NUMBERS: usize = 1 << 25;

/// Imported figure and the diagnostics of the import.
///
/// # Examples
///
/// ```no_run
/// use raconteur_avatar::open_figure;
///
/// # fn example() -> Result<(), Box<dyn std::error::Error>> {
/// let imported = open_figure("robot", &std::fs::read("robot.vrm")?)?;
/// for diagnostic in &imported.diagnostics {
///     println!("{diagnostic:?}");
/// }
/// println!("{} meshes", imported.figure.meshes.len());
/// # Ok(())
/// # }
/// ```
#[derive(Debug)]
pub struct Imported {
    /// Figure converted to the engine's skeleton.
    pub figure: Figure,
    /// Degraded features; empty for Raconteur figures.
    pub diagnostics: Vec<Diagnostic>,
}

/// Reads a figure of any origin: Raconteur figures directly, others through [`import_figure`].
///
/// # Errors
/// Returns an [`ImportError`] that describes the problem.
pub fn open_figure(name: &str, bytes: &[u8]) -> Result<Imported, ImportError> {
    match read_figure(name, bytes) {
        Ok(figure) => Ok(Imported {
            figure,
            diagnostics: Vec::new(),
        }),
        // A file that the figure reader does not accept may still be an avatar.
        Err(ReadError::NotGlb(_) | ReadError::Extension(_) | ReadError::NoSkeleton { .. }) => {
            import_figure(name, bytes)
        }
        Err(fault) => Err(fault.into()),
    }
}

/// Turns any humanoid glTF, GLB or VRM into a figure.
///
/// # Errors
/// Returns an [`ImportError`] that describes the problem.
pub fn import_figure(name: &str, bytes: &[u8]) -> Result<Imported, ImportError> {
    let container = container::Container::open(bytes)?;
    let json = &container.root;
    let root = container.document()?;
    let mut notes = DiagnosticSink::default();
    let world = solve_nodes(&root)?;
    if world.iter().any(|w| !w.is_finite()) {
        return Err(ReadError::NotFinite {
            what: "a node's placement",
        }
        .into());
    }
    let mut tree = tree::Tree::new(&root, world);
    let mut humanoid = humanoid::Humanoid::find(json, &tree, &mut notes)?;
    humanoid.twins = duplicates::find(&humanoid, &tree, &mut notes);
    let mut source = Source::with_budget(&root, MAX_NUMBERS);
    // VRM guarantees that its nodes are in a T-pose.
    if !humanoid::has_vrm_table(json)
        && let Some(world) = unposed::world(&tree, &humanoid, &mut source)?
    {
        tree.world = world;
    }
    let stance = align::RestStance::find(&tree, &mut humanoid, &mut notes)?;

    let has_jaw = humanoid.get(Bone::Chin).is_some();
    let has_eyes = humanoid.eyes.iter().all(Option::is_some);
    let face = face::ImportedFace::find(json, &root, has_jaw, has_eyes, &mut notes);
    let pictures = material::ImageTable::read(json, &mut source)?;
    let reader = geometry::Reader::new(json, &tree, &mut source, &pictures, &face, &mut notes);
    let geometries = reader.read()?;

    let points = || {
        geometries
            .iter()
            .flat_map(|g| &g.positions)
            .map(|p| stance.turn * *p)
    };
    let low = points().fold(DVec3::MAX, DVec3::min);
    let high = points().fold(DVec3::MIN, DVec3::max);
    let alignment = stance.align(&tree, &humanoid, low, high, &mut notes)?;
    let rest = frames::rest(&tree, &humanoid, &alignment);
    let binding = bind::Binding::new(&tree, &humanoid, &rest, !face.opens_by_morph);
    let mut morph_names: Vec<String> = geometries
        .iter()
        .flat_map(|g| &g.shapes)
        .map(|s| s.name.to_owned())
        .collect();
    morph_names.sort();
    morph_names.dedup();
    let mut meshes: Vec<_> = geometries
        .into_iter()
        .map(|g| binding.mesh(g, &alignment, &morph_names))
        .collect();
    let images = pictures.keep_used(meshes.iter_mut().map(|m| &mut m.material));
    report_lost(json, &mut notes);
    Ok(Imported {
        figure: Figure {
            name: name.to_owned(),
            skeleton: rest.skeleton,
            inverse_bind: rest.inverse_bind,
            meshes,
            morph_names,
            // Foreign lids are moved by morph targets.
            lid_closure_rad: [0.0; 2],
            sex: None,
            dominant_hand: Side::Right,
            tissue: None,
            springs: raconteur_body::Springs::default(),
            images,
        },
        diagnostics: notes.into_list(),
    })
}

/// Converts an avatar into a figure file that `read_figure` accepts.
///
/// # Errors
/// Returns an [`ImportError`] that describes the problem.
pub fn convert(name: &str, bytes: &[u8]) -> Result<(Vec<u8>, Vec<Diagnostic>), ImportError> {
    let imported = open_figure(name, bytes)?;
    Ok((to_glb(&imported.figure), imported.diagnostics))
}

/// Reports content of the file that a figure does not support.
fn report_lost(json: &serde_json::Value, notes: &mut DiagnosticSink) {
    let vrm = &json["extensions"];
    let springs = vrm["VRMC_springBone"]["springs"]
        .as_array()
        .is_some_and(|l| !l.is_empty())
        || vrm["VRM"]["secondaryAnimation"]["boneGroups"]
            .as_array()
            .is_some_and(|l| !l.is_empty());
    if springs {
        notes.add(
            "springs-stiff",
            "hair and cloth that would swing are stiff",
            "",
        );
    }
}
