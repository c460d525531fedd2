//! Inner structure: skull, mandible, spine, ribs, girdles, limbs, hands and feet as low-poly
//! solids, each rigid to a bone of the skeleton.
//!
//! Bones lie inside the skin of their figure. They are not part of a shipped figure; [`layered`]
//! adds them or shows them separately. Shapes are designed after plain anatomy: long bones are
//! shafts with heads, flat bones plates.

mod body;
mod head_skin;
mod limbs;
mod skull;
#[cfg(test)]
mod tests;

use raconteur_base::{DQuat, DVec3, Side};

pub(crate) use self::head_skin::hit;
use super::assemble::{Blueprint, PartWithNormals, assemble};
use super::built::AnnotatedFigure;
use super::hand::skeleton;
use super::part::{JointRef, MeshPart, PartVertex};
use super::people::FigureParams;
use super::solid::Solid;
use super::torso::{BodyParams, Field, Joints, Regions};
use raconteur_body::figure::{Figure, Material, MaterialKind, TextureMaps};
use raconteur_body::skeleton::{Bone, Drive, FaceJoints, zero_frames};

/// Layers contained in an exported figure: skin, bones or both.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Layer {
    /// The figure as it ships.
    Skin,
    /// Bones only.
    Bones,
    /// Skin and bones.
    All,
}

/// Positions and directions of the skeleton in the bind pose, and the body's distance field.
struct Frame {
    positions: [DVec3; Bone::COUNT],
    rotations: [DQuat; Bone::COUNT],
    field: Field,
    /// Stature relative to the adult for whom lengths in this module are given.
    scale: f64,
}

/// Reference stature for lengths, metres.
const REFERENCE_STATURE_M: f64 = 1.70;

/// Thickness of skin and fat over a bone just below the skin, metres (elbow, shin, collarbone:
/// designed, 4 mm).
const COVER_M: f64 = 0.004;

impl Frame {
    fn new(params: &FigureParams, figure: &Figure) -> Self {
        let bind: [(DVec3, DQuat); Bone::COUNT] = core::array::from_fn(|i| {
            let (_, q, p) = figure.inverse_bind[i]
                .inverse()
                .to_scale_rotation_translation();
            (p, q)
        });
        // The chest's wall lies under the bust.
        let chest = BodyParams {
            bust: 0.0,
            ..params.body()
        };
        Self {
            positions: bind.map(|b| b.0),
            rotations: bind.map(|b| b.1),
            field: Field::new(&chest, &Joints::place(&params.body())),
            scale: params.person.stature_m / REFERENCE_STATURE_M,
        }
    }

    fn position_of(&self, bone: Bone) -> DVec3 {
        self.positions[bone.index()]
    }

    /// Returns the distance at which a ray from inside leaves the body, metres from its start; at
    /// most half a metre.
    fn exit(&self, from: DVec3, direction: DVec3, regions: Regions) -> f64 {
        let mut t = 0.0;
        while t < 0.5 {
            let d = self.field.value(from + direction * t, regions, 1.0);
            if d > -2e-4 {
                break;
            }
            t += (-d * 0.8).max(5e-4);
        }
        t
    }

    /// Moves a point inwards until it lies at least [`COVER_M`] below the skin.
    fn inside(&self, mut p: DVec3, regions: Regions) -> DVec3 {
        for _ in 0..6 {
            let (d, n) = self.field.value_and_normal(p, regions, 1.0);
            if d <= -COVER_M {
                break;
            }
            p -= n * (d + COVER_M).min(0.02);
        }
        p
    }
}

fn material() -> Material {
    Material {
        kind: MaterialKind::Plain,
        base_color: [1.0; 4],
        roughness: 0.62,
        double_sided: false,
        maps: TextureMaps::default(),
    }
}

/// Linear RGB of dry bone, by eye.
const IVORY: [f64; 4] = [0.68, 0.60, 0.46, 1.0];

/// Builds a part with the joint weights that `joint` returns for each position.
fn build_part(name: &str, solid: Solid, joint: impl Fn(DVec3) -> Vec<(JointRef, f64)>) -> MeshPart {
    let vertices = solid
        .points
        .iter()
        .map(|&p| PartVertex {
            position: p,
            uv: [0.0; 2],
            color: IVORY,
            weights: joint(p),
        })
        .collect();
    MeshPart {
        name: name.to_owned(),
        material: material(),
        vertices,
        faces: solid.faces,
        morphs: Vec::new(),
        bound: Vec::new(),
    }
}

/// Creates a mesh part rigidly attached to a bone.
fn rigid(name: &str, solid: Solid, bone: Bone) -> MeshPart {
    build_part(name, solid, |_| vec![(JointRef(Drive::Bone(bone)), 1.0)])
}

/// Builds all bones of a figure, in the bind pose, world frame, metres.
#[must_use]
pub fn build(params: &FigureParams, built: &AnnotatedFigure) -> Vec<MeshPart> {
    let frame = Frame::new(params, &built.figure);
    let mut parts = skull::parts(&built.figure);
    parts.extend(body::parts(&frame));
    parts.extend(limbs::parts(&frame));
    for side in Side::BOTH {
        parts.extend(hand_parts(params, &frame, side));
    }
    parts
}

/// Builds skull and lower jaw of a figure, in the bind pose, world frame, metres.
pub(crate) fn of_head(figure: &Figure) -> Vec<MeshPart> {
    skull::parts(figure)
}

/// Builds the 27 bones of a hand, aligned with the hand's skin.
fn hand_parts(params: &FigureParams, frame: &Frame, side: Side) -> Vec<MeshPart> {
    let wrist = Bone::on(side, "wrist");
    let turn = frame.rotations[wrist.index()] * zero_frames()[wrist.index()].inverse();
    skeleton::bones(&params.hands(), side)
        .into_iter()
        .map(|b| {
            let solid = b.solid.mapped(|p| frame.position_of(wrist) + turn * p);
            build_part(&b.name, solid, |_| vec![(b.joint, 1.0)])
        })
        .collect()
}

/// Builds a figure with its skin, its bones, or both. Bones without skin have no face morphs.
#[must_use]
pub fn layered(params: &FigureParams, built: &AnnotatedFigure, layer: Layer) -> Figure {
    if layer == Layer::Skin {
        return built.figure.clone();
    }
    let skin = &built.figure;
    let frame = Frame::new(params, skin);
    let eye = |side: Side| {
        let joints = skin.skeleton.joints();
        let index = joints.iter().position(|j| j.drive == Drive::Eye(side));
        index.map_or(frame.position_of(Bone::Skull), |i| {
            skin.inverse_bind[i].inverse().translation
        })
    };
    let bones = assemble(&Blueprint {
        name: skin.name.clone(),
        positions_in_world: frame.positions,
        bind_rotations: frame.rotations,
        face: FaceJoints {
            eye_centres: Side::BOTH.map(eye),
        },
        stature_m: skin.skeleton.stature_m(),
        lid_closure_rad: skin.lid_closure_rad,
        pieces: build(params, built)
            .into_iter()
            .map(PartWithNormals::from)
            .collect(),
        chains: Vec::new(),
        images: Vec::new(),
    });
    match layer {
        Layer::All => {
            let mut both = skin.clone();
            both.meshes.extend(bones.meshes);
            both
        }
        // Swinging joints come after all others, and bones use none of them.
        Layer::Bones | Layer::Skin => Figure {
            skeleton: skin.skeleton.clone(),
            inverse_bind: skin.inverse_bind.clone(),
            ..bones
        },
    }
}
