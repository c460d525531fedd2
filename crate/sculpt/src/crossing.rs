//! Skin of a figure as one surface, for the detection of self-intersections.

use std::collections::BTreeMap;

use raconteur_base::DVec3;
#[cfg(test)]
use raconteur_base::mirror_vector;
use raconteur_body::figure::{Figure, MaterialKind};

/// Skin of a figure, including the mouth cavity, with coincident vertices merged; input of the
/// search for self-intersections.
#[derive(Clone, Debug, Default)]
pub struct Skin {
    /// Positions of the merged vertices, metres.
    pub points: Vec<DVec3>,
    /// Triangles over [`Self::points`], counter-clockwise from outside.
    pub triangles: Vec<[u32; 3]>,
}

impl Skin {
    /// Collects the skin of a figure in the bind pose.
    #[must_use]
    pub fn from_figure(figure: &Figure) -> Self {
        let mut places: BTreeMap<[u32; 3], u32> = BTreeMap::new();
        let mut skin = Self::default();
        let is_skin = |m: &&raconteur_body::Mesh| {
            m.material.kind == MaterialKind::Skin || m.name == crate::part::MOUTH_BAG
        };
        for mesh in figure.meshes.iter().filter(is_skin) {
            let mut at = |v: u32| {
                let p = mesh.positions[v as usize];
                *places.entry(p.map(f32::to_bits)).or_insert_with(|| {
                    skin.points.push(DVec3::from_array(p.map(f64::from)));
                    skin.points.len() as u32 - 1
                })
            };
            let triangles = mesh.indices.chunks_exact(3);
            skin.triangles
                .extend(triangles.map(|t| [at(t[0]), at(t[1]), at(t[2])]));
        }
        skin.triangles
            .retain(|t| t[0] != t[1] && t[1] != t[2] && t[2] != t[0]);
        skin
    }
}

/// Returns the largest distance between a point's mirror image and the nearest point, and that
/// point. `cell` is the search length, at least the tolerance; beyond it the distance counts as
/// infinite.
#[cfg(test)]
pub(super) fn farthest_from_mirrored(points: &[DVec3], cell: f64) -> (f64, DVec3) {
    let index = |p: DVec3| (p / cell).round().to_array().map(|x| x as i64);
    let mut cells: BTreeMap<[i64; 3], Vec<DVec3>> = BTreeMap::new();
    for &p in points {
        cells.entry(index(p)).or_default().push(p);
    }
    let mut far = (0.0, DVec3::ZERO);
    for &p in points {
        let q = mirror_vector(p);
        let [x, y, z] = index(q);
        let mut nearest = f64::INFINITY;
        for (i, j, k) in (0..27).map(|n| (n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1)) {
            for r in cells.get(&[x + i, y + j, z + k]).into_iter().flatten() {
                nearest = nearest.min(r.distance(q));
            }
        }
        if nearest > far.0 {
            far = (nearest, p);
        }
    }
    far
}
