//! Strips of two columns along guide curves, and the cap under them.

use raconteur_base::DVec3;
use raconteur_base::curve::{lerp, ramp};

use super::colour::Palette;
use super::cut::Weave;
use crate::assemble::Piece;
use crate::head::Head;
use crate::part::{JointRef, MeshPart, PartVertex};
use raconteur_body::figure::Material;
use raconteur_body::skeleton::{Bone, Drive};

/// A strand's path with what its card needs.
pub(super) struct Strand {
    /// From root to tip, metres.
    pub(super) curve: Vec<DVec3>,
    /// Normal of the head at each point.
    pub(super) normals: Vec<DVec3>,
    /// Full width of the card, metres.
    pub(super) width: f64,
    /// Width at the root over the full width.
    pub(super) root: f64,
    /// Width at the tip over the full width.
    pub(super) tip: f64,
    /// How the card is filled.
    pub(super) weave: Weave,
    /// Chooses among cards of one weave, 0..1.
    pub(super) dice: f64,
    /// Multiplies the material's colour.
    pub(super) colour: [f64; 3],
    /// Openness at root and tip, 0..1.
    pub(super) open: [f64; 2],
}

/// The renderer knows 64 columns of cards side by side in u: 0–39 dense, 40–53 loose,
/// 54–62 single hairs, 63 the cap.
const COLUMNS: f64 = 64.0;

fn column(weave: Weave, dice: f64) -> f64 {
    let (first, count) = match weave {
        Weave::Dense => (0.0, 40.0),
        Weave::Loose => (40.0, 14.0),
        Weave::Wisp => (54.0, 9.0),
        Weave::Cap => (63.0, 1.0),
    };
    first + (dice * count).floor()
}

/// u at a side of a card of this weave: `across` is 0 or 1.
pub(super) fn across(weave: Weave, dice: f64, across: f64) -> f64 {
    (column(weave, dice) + lerp(0.02, 0.98, across)) / COLUMNS
}

/// An empty part of hair.
pub(super) fn empty(name: &str, material: &Material) -> MeshPart {
    MeshPart {
        name: name.to_owned(),
        material: material.clone(),
        vertices: Vec::new(),
        faces: Vec::new(),
        morphs: Vec::new(),
        bound: Vec::new(),
    }
}

/// All strands as one piece; `hang` gives the joints that carry a place.
pub(super) fn cards(
    name: &str,
    material: &Material,
    strands: &[Strand],
    hang: &dyn Fn(DVec3) -> Vec<(JointRef, f64)>,
) -> Piece {
    let mut part = empty(name, material);
    let mut normals = Vec::new();
    for s in strands {
        let n = s.curve.len();
        for i in 0..n {
            let along = (s.curve[(i + 1).min(n - 1)] - s.curve[i.saturating_sub(1)])
                .try_normalize()
                .unwrap_or(DVec3::NEG_Y);
            let side = along
                .cross(s.normals[i])
                .try_normalize()
                .unwrap_or(DVec3::X);
            let face = side.cross(along);
            let t = i as f64 / (n - 1) as f64;
            let narrow = lerp(s.root, 1.0, ramp(0.0, 0.3, t)) * lerp(1.0, s.tip, ramp(0.6, 1.0, t));
            let base = part.vertices.len() as u32;
            let weights = hang(s.curve[i]);
            let open = lerp(s.open[0], s.open[1], ramp(0.0, 0.5, t));
            let [r, g, b] = s.colour;
            for (u, sign) in [(0.0, -1.0), (1.0, 1.0)] {
                let bend = face * (-0.10 * s.width * narrow);
                part.vertices.push(PartVertex {
                    position: s.curve[i] + side * (sign * 0.5 * s.width * narrow) + bend,
                    uv: [across(s.weave, s.dice, u), t],
                    color: [r, g, b, open],
                    weights: weights.clone(),
                });
                // Normals between the card's and the head's round the whole volume.
                let n = face * 0.45 + s.normals[i] * 0.7 + side * (0.3 * sign);
                normals.push(n.try_normalize().unwrap_or(DVec3::Y));
            }
            if i + 1 < n {
                part.faces.push(vec![base, base + 1, base + 3, base + 2]);
            }
        }
    }
    Piece {
        part,
        normals: Some(normals),
    }
}

/// Height of the cap over the scalp, metres.
const CAP_HEIGHT: f64 = 0.0005;

/// Short hair on the scalp itself: no skin shines through. v is the share covered.
pub(super) fn cap(material: &Material, head: &Head, cover: &[f64], palette: &Palette) -> Piece {
    let mut part = empty("scalp", material);
    let mut normals = Vec::new();
    let scalp = &head.scalp;
    let mut index = vec![u32::MAX; scalp.points.len()];
    let grey = palette.lock(0, 0, 0.0);
    for t in &scalp.triangles {
        if t.iter().all(|&v| cover[v as usize] < 0.02) {
            continue;
        }
        let face = t.map(|v| {
            let slot = &mut index[v as usize];
            if *slot == u32::MAX {
                *slot = part.vertices.len() as u32;
                let s = &scalp.points[v as usize];
                let share = cover[v as usize];
                part.vertices.push(PartVertex {
                    position: s.position + s.normal * CAP_HEIGHT,
                    uv: [across(Weave::Cap, 0.0, 0.5), share],
                    color: [grey[0], grey[1], grey[2], lerp(1.0, 0.65, share)],
                    weights: vec![(JointRef(Drive::Bone(Bone::Skull)), 1.0)],
                });
                normals.push(s.normal);
            }
            *slot
        });
        part.faces.push(face.to_vec());
    }
    Piece {
        part,
        normals: Some(normals),
    }
}
