//! Lines, veins and spots of the hand, derived from its sheet.

use raconteur_base::noise;

use super::SkinParams;
use super::marks::{Marks, Pen};
use crate::hand::{HandLine, HandSheet};

/// Draws lines with their strength scaled.
pub(super) fn draw(lines: &[HandLine], scale: f64, seed: u64) -> Marks {
    let mut marks = Marks::default();
    for (i, line) in (0u64..).zip(lines) {
        let pen = Pen {
            strength: line.strength * scale,
            width: line.width,
            wander: 0.25 + 0.4 * line.width,
            broken: line.broken,
            unsteady: 0.45,
            seed: seed.wrapping_mul(0x9E37).wrapping_add(i),
        };
        marks.line(&line.through, pen);
    }
    marks.finish()
}

/// Returns age spots and freckles of the back; positions on the palm are left to the painter.
pub(super) fn spots(sheet: &HandSheet, skin: &SkinParams) -> Marks {
    let mut marks = Marks::default();
    let aged = skin.sun * skin.since(40.0);
    for (i, p) in (0u64..).zip(&sheet.at) {
        let chance = |k: i64| noise::unit(skin.seed ^ 0x5407, i, k);
        // A vertex represents about 12 mm².
        if sheet.normals[i as usize].z < 0.0 && chance(0) < 0.05 * aged {
            marks.spot(
                *p,
                0.35 + 0.5 * chance(1),
                1.0 + 2.2 * chance(2) * chance(2),
            );
        } else if chance(3) < 0.03 * skin.freckles {
            marks.spot(*p, 0.3 + 0.3 * chance(1), 0.5 + 0.4 * chance(2));
        }
    }
    marks.finish()
}
