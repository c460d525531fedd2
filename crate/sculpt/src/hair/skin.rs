//! Nearest place on the head's skin.

use std::collections::BTreeMap;

use raconteur_base::DVec3;

/// Width of a cell, metres.
const CELL: f64 = 0.012;

/// Points of a surface with their normals, in a grid.
pub(super) struct Skin {
    points: Vec<(DVec3, DVec3)>,
    cells: BTreeMap<[i32; 3], Vec<u32>>,
}

fn cell_of(p: DVec3) -> [i32; 3] {
    p.to_array().map(|x| (x / CELL).floor() as i32)
}

impl Skin {
    pub(super) fn new(points: Vec<(DVec3, DVec3)>) -> Self {
        let mut cells: BTreeMap<[i32; 3], Vec<u32>> = BTreeMap::new();
        for ((p, _), i) in points.iter().zip(0u32..) {
            cells.entry(cell_of(*p)).or_default().push(i);
        }
        Self { points, cells }
    }

    /// Height above the skin and the skin's normal, averaged over the nearest points;
    /// `None` farther away than about 4 cm.
    pub(super) fn height(&self, p: DVec3) -> Option<(f64, DVec3)> {
        const KEPT: usize = 4;
        let [cx, cy, cz] = cell_of(p);
        for reach in [1i32, 3] {
            let mut near: Vec<(f64, u32)> = Vec::new();
            for x in cx - reach..=cx + reach {
                for y in cy - reach..=cy + reach {
                    for z in cz - reach..=cz + reach {
                        let Some(cell) = self.cells.get(&[x, y, z]) else {
                            continue;
                        };
                        near.extend(
                            cell.iter()
                                .map(|&i| (self.points[i as usize].0.distance(p), i)),
                        );
                    }
                }
            }
            // Nothing beyond the searched cells can be nearer than this.
            near.retain(|n| n.0 <= f64::from(reach) * CELL);
            if near.is_empty() {
                continue;
            }
            near.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            near.truncate(KEPT);
            let (mut place, mut normal, mut sum) = (DVec3::ZERO, DVec3::ZERO, 0.0);
            for &(d, i) in &near {
                let w = 1.0 / (d + 2e-4);
                let (q, n) = self.points[i as usize];
                place += q * w;
                normal += n * w;
                sum += w;
            }
            let normal = normal.try_normalize().unwrap_or(DVec3::Y);
            return Some(((p - place / sum).dot(normal), normal));
        }
        None
    }

    /// Lifts a point to at least `height` above the skin and draws it down to that height
    /// by the share `cling` of what it is above it; also gives the normal there.
    pub(super) fn settle(&self, p: DVec3, height: f64, cling: f64) -> (DVec3, Option<DVec3>) {
        match self.height(p) {
            Some((h, n)) if h < height => (p + n * (height - h).min(0.03), Some(n)),
            Some((h, n)) => (p + n * (height - h) * cling, Some(n)),
            None => (p, None),
        }
    }
}
