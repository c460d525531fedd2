//! Body ready for clothes: its head in place, its skin down to the collar.

use raconteur_base::curve::smooth;
use raconteur_base::{DAffine3, DVec3};

use super::cloth::Neck;
use super::hair::{self, HairParams};
use super::head::{self, Head};
use super::part::MeshPart;
use super::people::FigureParams;
use super::torso::{CM, Cage, Field, Joints, Regions};
use raconteur_body::figure::MaterialKind;
use raconteur_body::skeleton::Bone;

/// Body and head of a person before clothes and hair, which are made to fit it.
pub(super) struct Mannequin {
    /// The head in its own frame.
    pub(super) head: Head,
    /// Placement of the head.
    pub(super) world_from_head: DAffine3,
    /// Parts of the head, world frame; the first is the skin.
    pub(super) head_parts: Vec<MeshPart>,
    pub(super) joints: Joints,
    pub(super) field: Field,
    pub(super) cage: Cage,
    /// Neck surface under a collar.
    pub(super) neck: Neck,
}

impl Mannequin {
    /// Builds the mannequin of a person from the parameters of a figure.
    pub(super) fn from_params(params: &FigureParams) -> Self {
        let body = params.body();
        let mut joints = Joints::place(&body);
        let head = head::build(&params.person, &params.head);
        let world_from_head = place_head(&mut joints, &head, params.person.stature_m);
        let field = Field::new(&body, &joints);
        let cage = Cage::new(&field, &joints);
        let head_parts = head_parts(&head, &params.hair, world_from_head, &field, &cage);
        let skin = head_parts[0].triangles_about_middles(|_| true);
        let neck = Neck::new(&skin, &field, joints.position_of(Bone::Skull).y);
        Self {
            head,
            world_from_head,
            head_parts,
            joints,
            field,
            cage,
            neck,
        }
    }
}

/// Puts the head's vertex at the stature and its joints on the skeleton.
fn place_head(joints: &mut Joints, head: &Head, stature_m: f64) -> DAffine3 {
    let forward = joints.position_of(Bone::Skull).z + 2.2 * CM;
    let origin = DVec3::new(0.0, stature_m - head.extent[1], forward);
    let place = DAffine3::from_translation(origin);
    joints.positions[Bone::Skull.index()] = place.transform_point3(head.skull_origin);
    joints.positions[Bone::Chin.index()] = place.transform_point3(head.jaw_hinge);
    place
}

/// Height in the frame of the head at which a face of usual length blends into the body's neck.
const NECK_FROM_M: f64 = -0.088;

/// Returns the head's parts in the world; the lower neck is fitted to the body's own neck and moves
/// with it, otherwise it would penetrate the collar when the head turns.
fn head_parts(
    head: &Head,
    hair: &HairParams,
    place: DAffine3,
    field: &Field,
    cage: &Cage,
) -> Vec<MeshPart> {
    let (throat, _) = cage.extract(|t| Cage::is_above(t, 0.798)).subdivided(1);
    let mut parts = head.parts.clone();
    hair::shade_skin(&mut parts[0], head, hair);
    // A long face keeps its chin.
    let from = NECK_FROM_M.min(head.extent[0] + 0.0045);
    for part in &mut parts {
        let is_skin = part.material.kind == MaterialKind::Skin;
        for v in &mut part.vertices {
            let below = smooth((from - v.position.y) / 0.047);
            v.position = place.transform_point3(v.position);
            if !is_skin || below <= 0.0 {
                continue;
            }
            for _ in 0..4 {
                let (d, n) = field.value_and_normal(v.position, Regions::ALL, 1.0);
                v.position -= n * d.clamp(-3.0 * CM, 3.0 * CM) * below;
            }
            let distance = |i: &usize| throat.points[*i].distance_squared(v.position);
            let near = (0..throat.points.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)));
            if let Some(near) = near {
                let own: f64 = v.weights.iter().map(|w| w.1).sum();
                for w in &mut v.weights {
                    w.1 *= (1.0 - below) / own;
                }
                let body = throat.weights[near].refs();
                v.weights
                    .extend(body.into_iter().map(|(j, w)| (j, w * below)));
            }
        }
    }
    parts
}
