//! Motion of a head's parts with its skin.

use std::collections::BTreeMap;

use raconteur_base::DVec3;

use super::{narrow, wide};
use raconteur_body::figure::{MaterialKind, Mesh};

/// Number of skin vertices that a position follows.
const COUNT: usize = 6;
/// Distance below which vertices count as coincident, metres.
const SAME_M: f64 = 1e-6;
/// Depth behind a position beyond which skin does not count as the skin under it, metres.
const BEHIND_M: f64 = 0.0025;
/// Side of a cell, metres.
const CELL_M: f64 = 0.008;
/// Maximum number of grid cells along one axis.
const MAX_CELLS: i64 = 256;
/// Maximum number of cell rings searched around a position before all vertices are searched.
const MAX_RINGS: i64 = 3;

/// Anchor of a position to the skin: vertices and their weights; the position follows them onto
/// another face.
#[derive(Clone, Debug, Default)]
pub(super) struct SkinAnchor(Vec<(u32, f64)>);

impl SkinAnchor {
    /// Returns the displacement of the position.
    pub(super) fn evaluate(&self, moved: &[DVec3]) -> DVec3 {
        let parts = self.0.iter();
        parts.map(|&(v, weight)| moved[v as usize] * weight).sum()
    }
}

/// Vertices of a skin in a spatial grid, for lookup by position.
pub(super) struct Skin<'a> {
    places: &'a [DVec3],
    low: DVec3,
    counts: [i64; 3],
    /// Start of each cell's vertices in `all`; one entry more than there are cells.
    starts: Vec<u32>,
    all: Vec<u32>,
    /// Sparse subset of the vertices, for distant positions.
    few: Vec<u32>,
}

/// The nearest of those that were offered, by distance and then by number.
struct Nearest {
    found: [(f64, u32); COUNT],
    count: usize,
}

impl Nearest {
    fn new() -> Self {
        Self {
            found: [(f64::INFINITY, u32::MAX); COUNT],
            count: 0,
        }
    }

    fn offer(&mut self, distance: f64, vertex: u32) {
        let last = self.found[COUNT - 1];
        let is_nearer = |of: (f64, u32)| distance < of.0 || distance == of.0 && vertex < of.1;
        self.count += 1;
        if !is_nearer(last) {
            return;
        }
        let at = self.found.iter().position(|f| is_nearer(*f)).unwrap_or(0);
        self.found.copy_within(at..COUNT - 1, at + 1);
        self.found[at] = (distance, vertex);
    }

    fn weights(&self) -> &[(f64, u32)] {
        &self.found[..self.count.min(COUNT)]
    }
}

impl<'a> Skin<'a> {
    pub(super) fn new(places: &'a [DVec3]) -> Self {
        let low = places.iter().copied().fold(DVec3::INFINITY, DVec3::min);
        let high = places.iter().copied().fold(DVec3::NEG_INFINITY, DVec3::max);
        let size = if places.is_empty() {
            DVec3::ZERO
        } else {
            high - low
        };
        // A human skin never exceeds the limit of cells.
        let count = |x: f64| ((x / CELL_M).floor() as i64 + 1).min(MAX_CELLS);
        let mut skin = Self {
            places,
            low,
            counts: size.to_array().map(count),
            starts: Vec::new(),
            all: vec![0; places.len()],
            few: (0..places.len() as u32).step_by(20).collect(),
        };
        let cells: Vec<usize> = places
            .iter()
            .map(|p| skin.number(skin.cell(*p)).unwrap_or(0))
            .collect();
        skin.starts = vec![0; skin.counts.iter().product::<i64>() as usize + 1];
        for cell in &cells {
            skin.starts[cell + 1] += 1;
        }
        for cell in 1..skin.starts.len() {
            skin.starts[cell] += skin.starts[cell - 1];
        }
        let mut next = skin.starts.clone();
        for (v, cell) in (0..).zip(cells) {
            skin.all[next[cell] as usize] = v;
            next[cell] += 1;
        }
        skin
    }

    fn cell(&self, p: DVec3) -> [i64; 3] {
        let cell = ((p - self.low) / CELL_M).floor();
        cell.to_array().map(|x| x.clamp(-1e6, 1e6) as i64)
    }

    fn number(&self, [x, y, z]: [i64; 3]) -> Option<usize> {
        let [xs, ys, zs] = self.counts;
        let is_in = (0..xs).contains(&x) && (0..ys).contains(&y) && (0..zs).contains(&z);
        is_in.then_some(((x * ys + y) * zs + z) as usize)
    }

    /// Returns the anchor of a position from the vertices near it.
    pub(super) fn anchor(&self, p: DVec3) -> SkinAnchor {
        self.weighted(p, |_| true)
    }

    /// Returns the anchor of a position from the vertices on the outer side of the skin, by its
    /// normal: not those of the mouth behind a lip.
    pub(super) fn near_outside(&self, p: DVec3, normal: DVec3) -> SkinAnchor {
        let out = |v: u32| (self.places[v as usize] - p).dot(normal);
        let mut most = f64::MIN;
        self.about(p, |v| most = most.max(out(v)));
        let least = most.min(0.0) - BEHIND_M;
        let mut count = 0;
        self.about(p, |v| count += usize::from(out(v) > least));
        if count < COUNT {
            return self.anchor(p);
        }
        self.weighted(p, |v| out(v) > least)
    }

    /// Returns the anchor from the nearest accepted vertices around a position.
    fn weighted(&self, p: DVec3, wanted: impl Fn(u32) -> bool) -> SkinAnchor {
        let distance = |v: u32| self.places[v as usize].distance_squared(p);
        let mut nearest = Nearest::new();
        self.about(p, |v| {
            if wanted(v) {
                nearest.offer(distance(v), v);
            }
        });
        if nearest.count < COUNT {
            nearest = Nearest::new();
            self.few.iter().for_each(|&v| nearest.offer(distance(v), v));
        }
        let mut far = nearest.weights();
        // A seam with the skin stays one.
        if far.first().is_some_and(|f| f.0 < SAME_M * SAME_M) {
            far = &far[..1];
        }
        // As much as it is near, against the farthest of them.
        let most = far.last().map_or(0.0, |f| f.0) + 1e-12;
        let weight = |d: f64| (1.0 - d / most).max(1e-6) / (d + 1e-7);
        let all: f64 = far.iter().map(|f| weight(f.0)).sum();
        SkinAnchor(far.iter().map(|&(d, v)| (v, weight(d) / all)).collect())
    }

    /// Calls a function for the vertices in cells around a position. Rings of cells are added until
    /// there are enough, plus one more.
    fn about(&self, p: DVec3, mut tell: impl FnMut(u32)) {
        let own = self.cell(p);
        let mut found = 0;
        let mut last = MAX_RINGS;
        for ring in 0..=MAX_RINGS {
            for x in -ring..=ring {
                for y in -ring..=ring {
                    let is_shell = x.abs().max(y.abs()) == ring;
                    let step = if is_shell { 1 } else { (2 * ring).max(1) };
                    for z in (-ring..=ring).step_by(step as usize) {
                        let Some(cell) = self.number([own[0] + x, own[1] + y, own[2] + z]) else {
                            continue;
                        };
                        let range = self.starts[cell] as usize..self.starts[cell + 1] as usize;
                        found += range.len();
                        self.all[range].iter().for_each(|&v| tell(v));
                    }
                }
            }
            if ring >= last {
                break;
            }
            if found >= COUNT {
                last = last.min(ring + 1);
            }
        }
    }
}

/// Returns the first vertex at the position of each vertex, to a hundredth of a millimetre.
pub(super) fn firsts(places: &[DVec3]) -> Vec<u32> {
    let mut first: BTreeMap<[i64; 3], u32> = BTreeMap::new();
    let one = |(v, p): (u32, &DVec3)| {
        let key = p.to_array().map(|x| (x * 1e5).round() as i64);
        *first.entry(key).or_insert(v)
    };
    (0..).zip(places).map(one).collect()
}

/// Rule by which the vertices of a mesh follow the skin onto another face.
#[derive(Clone, Debug)]
pub(super) enum CarriedMesh {
    /// Each vertex follows the skin near it.
    Skin(Vec<SkinAnchor>),
    /// Each vertex follows the eye on its side.
    Eyes,
    /// All vertices follow the midpoint of the lips.
    Lips,
}

impl CarriedMesh {
    /// Binds a mesh to the skin; `None` for a mesh that does not follow it.
    pub(super) fn bind(mesh: &Mesh, skin: &Skin<'_>) -> Option<Self> {
        use MaterialKind::{Cornea, Eye, Hair, Lash, Mouth, Teeth};
        let near = || {
            let places = mesh.positions.iter();
            Self::Skin(places.map(|&p| skin.anchor(wide(p))).collect())
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
                Self::Skin(near) => near.get(i).map_or(DVec3::ZERO, |n| n.evaluate(moved)),
                Self::Eyes => eyes[usize::from(p[0] < 0.0)],
                Self::Lips => lips,
            };
            *p = narrow(wide(*p) + by);
        }
    }
}

/// Multiplies the colours of a mesh, the first vertices by their own factors. Brightness beyond the
/// range of vertex colours goes into the material colour.
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

/// Changes the mean colour of a mesh, linear; variations within the mesh stay.
pub(super) fn recolour(mesh: &mut Mesh, rgb: [f64; 3]) {
    let count = mesh.colors.len().max(1) as f64;
    let factors = core::array::from_fn(|i| {
        let sum: f64 = mesh.colors.iter().map(|c| f64::from(c[i])).sum();
        let mean = sum / count / 255.0 * f64::from(mesh.material.base_color[i]);
        rgb[i].clamp(0.0, 1.0) / mean.max(1e-3)
    });
    tint(mesh, &[], factors);
}
