//! The hand: skin with the end of the forearm, five nails, weights and colours.
//!
//! The coarse quad cage gives only the topology; an analytic field gives the shape. The cage is
//! subdivided once and projected onto the field; relief follows along the normal. A hand of the
//! mean adult's size, with the marks of sex and age, is built in millimetres and scaled to length
//! and breadth.
//!
//! # For the assembly
//!
//! **Hand frame.** Positions are metres from the wrist joint. The axes are the world's while the
//! wrist is in the zero pose: y up from the back of the hand, z to the thumb's side (front), x to
//! the character's left; so the left fingers run along +x and the right ones along −x. For a wrist
//! bone with bind orientation `b` (world from bone), place the hand by the rotation `b *
//! zero_frames()[wrist].inverse()` and the translation to the wrist's bind position.
//!
//! **Bind pose.** The fingers are straight and splayed, the thumb as in table A.1: [`BIND_ANGLES`].
//! `BIND_ANGLES.rotations(side)` are the local rotations of the finger bones, for a
//! [`raconteur_body::Pose`]; [`Hand::bind_in_wrist`] gives the same orientations as wrist bone from
//! finger bone, so that `bind_rotations[bone] = b * bind_in_wrist`.
//!
//! **Rim.** The skin is open on the forearm: [`Hand::wrist_rim`] lists the vertices of the first
//! part in order around it. They lie in a plane perpendicular to [`Hand::forearm_direction`].

mod anatomy;
mod cage;
mod chart;
mod color;
mod crease;
mod field;
mod nail;
mod sheet;
pub mod skeleton;
mod surface;
mod weights;

use raconteur_base::{DQuat, DVec3, Side, curve, mirror_rotation};
use serde::{Deserialize, Serialize};

use self::anatomy::{Anatomy, HandBuild};
use self::field::Field;
pub(crate) use self::sheet::{HandLine, HandRegion, HandSheet};
use self::surface::Skin;
use self::weights::Influence;
use super::part::{MeshPart, PartVertex};
use super::person::Person;
use raconteur_body::figure::{Material, MaterialKind, TextureMaps};
use raconteur_body::hand_shape::HandAngles;
use raconteur_body::skeleton::{Bone, zero_frames};

/// Joint angles of the hand's bind pose.
pub const BIND_ANGLES: HandAngles = anatomy::BIND_ANGLES;

/// Size of a hand relative to the mean for its owner's sex, age and stature; 1 is the mean.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct HandProportions {
    /// Length relative to the mean.
    pub length: f64,
    /// Breadth relative to the mean.
    pub breadth: f64,
}

impl Default for HandProportions {
    fn default() -> Self {
        Self {
            length: 1.0,
            breadth: 1.0,
        }
    }
}

/// Measures and appearance of a hand, from which [`build`] makes it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HandParams {
    /// 0 male to 1 female.
    pub sex: f64,
    /// Years, 8 to 80.
    pub age_years: f64,
    /// Length from the wrist crease to the tip of the middle finger, metres.
    pub length_m: f64,
    /// Across the knuckles without the thumb, metres.
    pub breadth_m: f64,
    /// Distance from elbow to wrist, metres; it determines how the rim of the hand's skin follows
    /// the twist of the wrist.
    pub forearm_length_m: f64,
    /// Linear RGB of the skin, which shines through the nails.
    pub skin_color: [f64; 3],
}

/// Shares of stature and of length at an age of about nine: hand 148 mm long and 65.5 mm
/// broad, forearm 197 mm, at 1.34 m (recalled from Snyder et al. 1977, "Anthropometry of
/// infants, children, and youths to age 18 for product safety design", UM-HSRI-77-17; not
/// read again).
const CHILD: [f64; 3] = [0.1105, 0.0489, 0.147];
/// Hand length, hand breadth and forearm length of women relative to stature, from ANSUR II: hand
/// 181.1 × 78.2 mm, radiale to stylion 239 mm, at 1.63 m.
const WOMAN: [f64; 3] = [0.1811 / 1.63, 0.0782 / 1.63, 0.239 / 1.63];
/// Hand length, hand breadth and forearm length of men relative to stature, from ANSUR II: hand
/// 193.3 × 88.3 mm, radiale to stylion 268 mm, at 1.756 m.
const MAN: [f64; 3] = [0.1933 / 1.756, 0.0883 / 1.756, 0.268 / 1.756];

impl HandParams {
    /// Returns the measures of a person's hand from sex, age, stature and the proportions of the
    /// hand.
    #[must_use]
    pub fn from_person(
        person: &Person,
        proportions: &HandProportions,
        skin_color: [f64; 3],
    ) -> Self {
        let child = 1.0 - curve::smooth((person.age_years - 8.0) / 10.0);
        let [length, breadth, forearm] = core::array::from_fn(|i| {
            let adult = curve::lerp(MAN[i], WOMAN[i], person.sex);
            curve::lerp(adult, CHILD[i], child) * person.stature_m
        });
        Self {
            sex: person.sex,
            age_years: person.age_years,
            length_m: length * proportions.length,
            breadth_m: breadth * proportions.breadth,
            forearm_length_m: forearm,
            skin_color,
        }
    }
}

/// Returns the measures of the mean hand for a sex, an age in years and a stature in metres.
#[cfg(test)]
pub(super) fn mean_hand(
    sex: f64,
    age_years: f64,
    stature_m: f64,
    skin_color: [f64; 3],
) -> HandParams {
    let person = Person {
        sex,
        age_years,
        stature_m,
        build: 0.0,
    };
    HandParams::from_person(&person, &HandProportions::default(), skin_color)
}

/// Built hand, ready for rigging: skin, nails and joints in the hand frame (see the
/// [module](self)).
#[derive(Clone, Debug)]
pub struct Hand {
    /// Skin first, then nails.
    pub parts: Vec<MeshPart>,
    /// Bind positions of the finger bones in the order of
    /// [`raconteur_body::hand_shape::finger_bones`], metres.
    pub joints: [(Bone, DVec3); 15],
    /// Wrist bone from finger bone in the bind pose, in the same order.
    pub bind_in_wrist: [(Bone, DQuat); 15],
    /// The skin for the baking of its maps.
    pub(crate) sheet: HandSheet,
    /// Vertices of [`Hand::skin`] around the open end, in order.
    pub wrist_rim: Vec<u32>,
    /// Unit vector from the wrist towards the elbow.
    pub forearm_direction: DVec3,
}

impl Hand {
    /// Returns the skin, the first of the parts.
    pub fn skin(&self) -> &MeshPart {
        &self.parts[0]
    }
}

/// Transform from the frame of [`anatomy`] (right hand: radial, distal, palmar; mm) to the hand
/// frame of one side, with the scales of breadth and length.
struct Placement {
    side: Side,
    length_scale: f64,
    breadth_scale: f64,
}

impl Placement {
    fn new(params: &HandParams, side: Side, skin: &Skin) -> Self {
        let (length, breadth) = measure(skin);
        Self {
            side,
            length_scale: params.length_m / length,
            breadth_scale: params.breadth_m / breadth,
        }
    }

    fn position(&self, p: DVec3) -> DVec3 {
        DVec3::new(
            self.side.sign() * p.y * self.length_scale,
            -p.z * self.breadth_scale,
            p.x * self.breadth_scale,
        )
    }

    /// Returns the faces with the winding of one side: the left hand is a mirror image, so its
    /// faces are reversed.
    fn faces(&self, faces: &[Vec<u32>]) -> Vec<Vec<u32>> {
        let turned = |f: &Vec<u32>| match self.side {
            Side::Right => f.clone(),
            Side::Left => f.iter().rev().copied().collect(),
        };
        faces.iter().map(turned).collect()
    }
}

/// Distance from the wrist joint back to the crease from which hand length is measured, mm.
const CREASE_MM: f64 = 8.0;

/// Breadth is measured from here to the webs, beyond the web of the thumb, mm.
const KNUCKLES_FROM_MM: f64 = 72.0;

/// Measures length and breadth of the unscaled skin, mm.
fn measure(skin: &Skin) -> (f64, f64) {
    let tip = skin
        .positions
        .iter()
        .zip(&skin.ownership)
        .filter(|(_, owned)| owned[2] > 0.5)
        .map(|(p, _)| p.y)
        .fold(f64::NEG_INFINITY, f64::max);
    let (mut ulnar, mut radial) = (f64::INFINITY, f64::NEG_INFINITY);
    for (p, owned) in skin.positions.iter().zip(&skin.ownership) {
        if p.y > KNUCKLES_FROM_MM && p.y < 95.0 && owned[0] < 0.1 {
            ulnar = ulnar.min(p.x);
            radial = radial.max(p.x);
        }
    }
    (tip + CREASE_MM, radial - ulnar)
}

/// Builds the skin and the nails of one hand.
#[must_use]
pub fn build(params: &HandParams, side: Side) -> Hand {
    let anatomy = Anatomy::new(HandBuild::from_sex_and_age(params.sex, params.age_years));
    let field = Field::new(&anatomy);
    let cage = cage::build(&anatomy, &field);
    let skin = surface::build(&anatomy, &field, &cage);
    let place = Placement::new(params, side, &skin);

    let base = DVec3::from_array(params.skin_color);
    let open = color::openness(&field, &skin);
    let chart = chart::chart();
    let weights = weights::weights(
        &anatomy,
        &skin,
        params.forearm_length_m / place.length_scale,
    );
    let joints_of =
        |row: &[(Influence, f64)]| row.iter().map(|(i, w)| (i.joint(side), *w)).collect();
    let vertices = chart
        .source
        .iter()
        .zip(&chart.uv)
        .map(|(&i, &uv)| {
            let i = i as usize;
            PartVertex {
                position: place.position(skin.positions[i]),
                uv,
                // The map has the colour.
                color: [1.0, 1.0, 1.0, open[i]],
                weights: joints_of(&weights[i]),
            }
        })
        .collect();
    let letter = if side == Side::Left { "l" } else { "r" };
    let skin_part = MeshPart {
        name: format!("{letter}_hand"),
        material: Material {
            kind: MaterialKind::Skin,
            base_color: [1.0; 4],
            roughness: 0.48,
            double_sided: false,
            maps: TextureMaps::default(),
        },
        vertices,
        faces: place.faces(&chart.faces),
        morphs: Vec::new(),
        bound: Vec::new(),
    };

    let world = BIND_ANGLES.left_world();
    let wrist = if side == Side::Left {
        Bone::LWrist
    } else {
        Bone::RWrist
    };
    let bone_from_hand = zero_frames()[wrist.index()].inverse();
    let joints = core::array::from_fn(|i| {
        // `hand_shape` counts the thumb last.
        let (f, k) = ((i / 3 + 1) % 5, i % 3);
        let finger = &anatomy.fingers[f];
        let p = finger.point(DVec3::new(0.0, finger.joints()[k], 0.0));
        (weights::finger_bone(side, f, k), place.position(p))
    });
    let bind_in_wrist = core::array::from_fn(|i| {
        let in_hand = match side {
            Side::Left => world[i],
            // The mirrored frame's z axis is negated, as in the skeleton's zero frames.
            Side::Right => mirror_rotation(world[i]) * DQuat::from_xyzw(0.0, 1.0, 0.0, 0.0),
        };
        let bone: (Bone, DVec3) = joints[i];
        (bone.0, bone_from_hand * in_hand)
    });
    Hand {
        parts: vec![skin_part, nails(&anatomy, &place, base, letter)],
        joints,
        bind_in_wrist,
        sheet: sheet::sheet(&anatomy, &skin, chart),
        wrist_rim: skin.rim,
        forearm_direction: DVec3::new(-side.sign(), 0.0, 0.0),
    }
}

/// Builds the five nail plates as one part.
fn nails(anatomy: &Anatomy, place: &Placement, base: DVec3, letter: &str) -> MeshPart {
    let mut vertices = Vec::new();
    let mut faces = Vec::new();
    for (f, finger) in anatomy.fingers.iter().enumerate() {
        let plate = nail::plate(finger, f, anatomy.look.free_edge_mm);
        let first = vertices.len() as u32;
        let joint = Influence::Finger(f, 2).joint(place.side);
        for (p, &(across, along)) in plate.positions.iter().zip(&plate.parameters) {
            let c = color::nail_color(base, f, across, along);
            vertices.push(PartVertex {
                position: place.position(*p),
                uv: [0.5 + 0.5 * across, along],
                color: [c.x, c.y, c.z, 1.0],
                weights: vec![(joint, 1.0)],
            });
        }
        let moved = plate
            .faces
            .iter()
            .map(|q| q.iter().map(|v| v + first).collect());
        faces.extend(moved);
    }
    MeshPart {
        name: format!("{letter}_nails"),
        material: Material {
            kind: MaterialKind::Nail,
            base_color: [1.0; 4],
            roughness: 0.27,
            double_sided: false,
            maps: TextureMaps::default(),
        },
        vertices,
        faces: place.faces(&faces),
        morphs: Vec::new(),
        bound: Vec::new(),
    }
}

#[cfg(test)]
mod contact;
#[cfg(test)]
mod tests;
