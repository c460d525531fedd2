//! Closure of a solved head's lips, so that almost no tooth is visible at rest and neither lip
//! penetrates the other.
//!
//! Lip positions are specified on the rings of the cage; half a ring before the contact line, each
//! lip bulges, in proportion to its fullness. The gap is therefore measured there, on the surface.

use std::collections::BTreeMap;

use raconteur_base::{DVec3, Side};

use super::cage::Cage;
use super::soft::{LipPlace, lip_places};
use crate::subdivide::{Stencil, Subdivided, limit_stencils, subdivide};

/// Distance between the lips at rest, mm. Designed: with less, lips of random people intersect.
const TOUCH_MM: f64 = 0.4;
/// Rings of the cage subdivided once between which lips are closest.
const CONTACT_RINGS: core::ops::RangeInclusive<u8> = 8..=10;
/// Middle of the lower lip, in half steps of the cage from that of the upper one.
const LAST: u8 = 24;
/// Rounds; each leaves a small share of the gap, as a vertex of the cage moves its neighbours too.
const ROUNDS: usize = 5;

/// Returns the weight with which a ring follows the line where the lips meet.
fn follows(ring: u8) -> f64 {
    match ring {
        0 | 1 => 0.0,
        2 => 0.15,
        3 => 0.5,
        _ => 1.0,
    }
}

/// A column of the lips: half steps from the middle, and side.
type Column = (u8, Side);

/// Data for measuring the gap between the lips of a cage.
struct Lips {
    once: Subdivided,
    limit: Vec<Stencil>,
    /// Vertices of the cage subdivided once, by lip position.
    nodes: BTreeMap<LipPlace, usize>,
}

impl Lips {
    fn from_cage(cage: &Cage) -> Self {
        let once = subdivide(&cage.faces, cage.len(), 1);
        let limit = limit_stencils(&once.faces, once.stencils.len());
        let nodes = lip_places(cage)
            .filter(|(_, lip)| CONTACT_RINGS.contains(&lip.ring))
            .map(|(v, lip)| (lip, v))
            .collect();
        Self { once, limit, nodes }
    }

    /// Computes the height of the smallest gap between the lips in each column of the surface, mm.
    fn gaps(&self, points: &[DVec3]) -> BTreeMap<Column, f64> {
        let at = self.once.apply(points);
        let height = |v: usize| -> f64 {
            let row = self.limit[v].iter();
            row.map(|&(i, w)| at[i as usize].y * w).sum()
        };
        let mut gaps: BTreeMap<Column, f64> = BTreeMap::new();
        for (lip, &above) in self.nodes.iter().filter(|(lip, _)| lip.position < LAST / 2) {
            let across = LipPlace {
                position: LAST - lip.position,
                ..*lip
            };
            if let Some(&below) = self.nodes.get(&across) {
                let gap = gaps.entry((lip.position, lip.side)).or_insert(f64::MAX);
                *gap = gap.min(height(above) - height(below));
            }
        }
        gaps
    }
}

/// Closes the lips of a cage's surface, millimetres.
pub(super) fn seal(cage: &Cage, points: &mut [DVec3]) {
    let lips = Lips::from_cage(cage);
    for _ in 0..ROUNDS {
        let gaps = lips.gaps(points);
        for (p, &(key, side)) in points.iter_mut().zip(&cage.keys) {
            let Some((ring, k)) = key.mouth_position().filter(|(_, k)| *k != 6) else {
                continue;
            };
            let own = if key.on_midline() { Side::Left } else { side };
            let half = 2 * k.min(12 - k) as u8;
            let near = (half.saturating_sub(1)..=half + 1)
                .filter_map(|h| gaps.get(&(h, if h == 0 { Side::Left } else { own })));
            let gap = near.copied().reduce(f64::min).unwrap_or(TOUCH_MM);
            let towards = if k < 6 { -0.5 } else { 0.5 };
            p.y += towards * follows(ring) * (gap - TOUCH_MM);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::head::Shape;
    use crate::people;

    #[test]
    fn lips_of_everyone_touch() {
        for name in people::NAMES {
            let params = people::preset(name).unwrap();
            let shape = Shape::build(&params.person, &params.head.bound, params.head.asymmetry);
            let gaps = Lips::from_cage(&shape.cage).gaps(&shape.solved.cage_points);
            assert_eq!(gaps.len(), 23);
            for (column, gap) in gaps {
                assert!(
                    (0.75 * TOUCH_MM..2.5 * TOUCH_MM).contains(&gap),
                    "{name}: {gap} mm at {column:?}"
                );
            }
        }
    }
}
