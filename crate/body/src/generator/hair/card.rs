//! Strips of two columns along guide curves.

use raconteur_base::DVec3;
use raconteur_base::curve::{lerp, ramp};

use crate::figure::Material;
use crate::generator::assemble::Piece;
use crate::generator::part::{JointRef, Part, PartVertex};
use crate::skeleton::{Bone, Drive};

/// A strand's path with what its card needs.
pub(super) struct Strand {
    /// From root to tip, metres.
    pub(super) curve: Vec<DVec3>,
    /// Normal of the head at each point.
    pub(super) normals: Vec<DVec3>,
    /// Full width of the card, metres.
    pub(super) width: f64,
    /// Width at the tip over the full width.
    pub(super) tip: f64,
    /// Texture coordinate along the strand at the tip: below 1 the hair is cut there.
    pub(super) end: f64,
    /// Multiplies the hair's colour, linear.
    pub(super) tint: f64,
    /// Openness at root and tip, 0..1.
    pub(super) open: [f64; 2],
}

/// All strands as one piece, rigid with the skull.
pub(super) fn cards(name: &str, material: &Material, strands: &[Strand]) -> Piece {
    let mut part = Part {
        name: name.to_owned(),
        material: material.clone(),
        vertices: Vec::new(),
        faces: Vec::new(),
        morphs: Vec::new(),
    };
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
            let narrow = if t < 0.2 {
                lerp((0.0025 / s.width).min(0.25), 1.0, t / 0.2)
            } else {
                lerp(1.0, s.tip, ramp(0.7, 1.0, t))
            };
            let base = (part.vertices.len()) as u32;
            for (u, sign) in [(0.0, -1.0), (1.0, 1.0)] {
                let bend = face * (-0.10 * s.width * narrow);
                part.vertices.push(PartVertex {
                    position: s.curve[i] + side * (sign * 0.5 * s.width * narrow) + bend,
                    uv: [u, t * s.end],
                    color: [
                        s.tint,
                        s.tint,
                        s.tint,
                        lerp(s.open[0], s.open[1], ramp(0.0, 0.45, t)),
                    ],
                    weights: vec![(JointRef(Drive::Bone(Bone::Skull)), 1.0)],
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
