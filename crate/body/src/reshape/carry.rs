//! How parts of a head go along with its skin.

use std::collections::BTreeMap;

use raconteur_base::DVec3;

use super::{narrow, wide};
use crate::figure::{MaterialKind, Mesh};

/// Vertices of the skin that a place goes along with.
const COUNT: usize = 6;
/// Vertices that are nearer are at one place, metres.
const SAME_M: f64 = 1e-6;
/// What is so far behind a place is not the skin that it stands on, metres.
const BEHIND_M: f64 = 0.0025;
/// Side of a cell, metres.
const CELL_M: f64 = 0.008;
/// Cells about a place that are looked through before all vertices are.
const MOST_RINGS: i64 = 3;

/// A place near the skin: vertices and how much it goes with each.
#[derive(Clone, Debug, Default)]
pub(super) struct Near(Vec<(u32, f64)>);

impl Near {
    /// By how much the place moves.
    pub(super) fn of(&self, moved: &[DVec3]) -> DVec3 {
        let parts = self.0.iter();
        parts.map(|&(v, weight)| moved[v as usize] * weight).sum()
    }
}

type Cell = [i64; 3];

fn cell(p: DVec3) -> Cell {
    p.to_array().map(|x| (x / CELL_M).floor() as i64)
}

/// The vertices of a skin, to be found by place.
pub(super) struct Skin<'a> {
    places: &'a [DVec3],
    cells: BTreeMap<Cell, Vec<u32>>,
    /// A few of all, for what is far away.
    few: Vec<u32>,
}

impl<'a> Skin<'a> {
    pub(super) fn new(places: &'a [DVec3]) -> Self {
        let mut cells: BTreeMap<Cell, Vec<u32>> = BTreeMap::new();
        for (v, p) in (0..).zip(places) {
            cells.entry(cell(*p)).or_default().push(v);
        }
        Self {
            places,
            cells,
            few: (0..places.len() as u32).step_by(20).collect(),
        }
    }

    /// The vertices near a place.
    pub(super) fn near(&self, p: DVec3) -> Near {
        let mut found = self.about(p);
        if found.len() < COUNT {
            found.clone_from(&self.few);
        }
        self.weighted(p, found)
    }

    /// The vertices near a place on the side of the skin that its normal looks to: not those of the mouth
    /// behind a lip.
    pub(super) fn near_outside(&self, p: DVec3, normal: DVec3) -> Near {
        let mut found = self.about(p);
        let out = |v: u32| (self.places[v as usize] - p).dot(normal);
        let most = found
            .iter()
            .map(|v| out(*v))
            .fold(f64::MIN, f64::max)
            .min(0.0);
        found.retain(|v| out(*v) > most - BEHIND_M);
        if found.len() < COUNT {
            return self.near(p);
        }
        self.weighted(p, found)
    }

    /// The nearest of some vertices.
    fn weighted(&self, p: DVec3, found: Vec<u32>) -> Near {
        let distance = |v: u32| self.places[v as usize].distance_squared(p);
        let mut far: Vec<(f64, u32)> = found.into_iter().map(|v| (distance(v), v)).collect();
        far.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        far.truncate(COUNT);
        // A seam with the skin stays one.
        if far.first().is_some_and(|f| f.0 < SAME_M * SAME_M) {
            far.truncate(1);
        }
        // As much as it is near, against the farthest of them.
        let most = far.last().map_or(0.0, |f| f.0) + 1e-12;
        let weight = |d: f64| (1.0 - d / most).max(1e-6) / (d + 1e-7);
        let all: f64 = far.iter().map(|f| weight(f.0)).sum();
        Near(far.iter().map(|&(d, v)| (v, weight(d) / all)).collect())
    }

    /// Vertices in cells about a place: rings of cells are added until there are enough, and one more.
    fn about(&self, p: DVec3) -> Vec<u32> {
        let own = cell(p);
        let mut found = Vec::new();
        let mut last = MOST_RINGS;
        for ring in 0..=MOST_RINGS {
            for x in -ring..=ring {
                for y in -ring..=ring {
                    for z in -ring..=ring {
                        if x.abs().max(y.abs()).max(z.abs()) < ring {
                            continue;
                        }
                        let at = [own[0] + x, own[1] + y, own[2] + z];
                        found.extend(self.cells.get(&at).into_iter().flatten());
                    }
                }
            }
            if ring >= last {
                break;
            }
            if found.len() >= COUNT {
                last = last.min(ring + 1);
            }
        }
        found
    }
}

/// The first of all vertices at the place of each, to a hundredth of a millimetre.
pub(super) fn firsts(places: &[DVec3]) -> Vec<u32> {
    let mut first: BTreeMap<[i64; 3], u32> = BTreeMap::new();
    let one = |(v, p): (u32, &DVec3)| {
        let key = p.to_array().map(|x| (x * 1e5).round() as i64);
        *first.entry(key).or_insert(v)
    };
    (0..).zip(places).map(one).collect()
}

/// How the vertices of a part go along.
#[derive(Clone, Debug)]
pub(super) enum Carried {
    /// With the skin near each.
    Skin(Vec<Near>),
    /// With the eye of their side.
    Eyes,
    /// With the middle of the lips.
    Lips,
}

impl Carried {
    /// That of a mesh; none for what does not go along.
    pub(super) fn of(mesh: &Mesh, skin: &Skin<'_>) -> Option<Self> {
        use MaterialKind::{Cornea, Eye, Hair, Lash, Mouth, Teeth};
        let near = || {
            let places = mesh.positions.iter();
            Self::Skin(places.map(|&p| skin.near(wide(p))).collect())
        };
        match mesh.material.kind {
            Eye | Cornea => Some(Self::Eyes),
            Teeth => Some(Self::Lips),
            // The inside of the cheeks is skin; gums and tongue are not.
            Mouth if mesh.name == "mouth_bag" => Some(near()),
            Mouth if mesh.name.starts_with("caruncle") => Some(Self::Eyes),
            Mouth => Some(Self::Lips),
            Hair | Lash => Some(near()),
            _ => None,
        }
    }

    pub(super) fn carry(
        &self,
        positions: &mut [[f32; 3]],
        moved: &[DVec3],
        eyes: [DVec3; 2],
        lips: DVec3,
    ) {
        for (i, p) in positions.iter_mut().enumerate() {
            let by = match self {
                Self::Skin(near) => near.get(i).map_or(DVec3::ZERO, |n| n.of(moved)),
                Self::Eyes => eyes[usize::from(p[0] < 0.0)],
                Self::Lips => lips,
            };
            *p = narrow(wide(*p) + by);
        }
    }
}

/// Multiplies the colours of a mesh, the first vertices by factors of their own. What is brighter than
/// a vertex can be goes into the colour of the material.
pub(super) fn tint(mesh: &mut Mesh, own: &[[f64; 3]], others: [f64; 3]) {
    let factor = |v: usize| own.get(v).copied().unwrap_or(others);
    let bright = |v: usize, colour: &[u8; 4], i: usize| f64::from(colour[i]) * factor(v)[i];
    let most: [f64; 3] = core::array::from_fn(|i| {
        let all = mesh.colors.iter().enumerate();
        all.map(|(v, colour)| bright(v, colour, i))
            .fold(1e-6, f64::max)
    });
    let tinted = |(v, colour): (usize, &[u8; 4])| {
        let part = |i: usize| (255.0 * bright(v, colour, i) / most[i]).round() as u8;
        [part(0), part(1), part(2), colour[3]]
    };
    let colors = mesh.colors.iter().enumerate().map(tinted).collect();
    mesh.colors = colors;
    for (base, most) in mesh.material.base_color.iter_mut().zip(most) {
        *base *= (most / 255.0) as f32;
    }
}

/// Gives a mesh another mean colour, linear; what differs from it within the mesh still does.
pub(super) fn recolour(mesh: &mut Mesh, rgb: [f64; 3]) {
    let count = mesh.colors.len().max(1) as f64;
    let factors = core::array::from_fn(|i| {
        let sum: f64 = mesh.colors.iter().map(|c| f64::from(c[i])).sum();
        let mean = sum / count / 255.0 * f64::from(mesh.material.base_color[i]);
        rgb[i].clamp(0.0, 1.0) / mean.max(1e-3)
    });
    tint(mesh, &[], factors);
}
