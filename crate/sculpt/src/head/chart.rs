//! Head charts in the skin atlas, and the mean head that gives every vertex the same position on
//! all people.
//!
//! The skin is cut along the back's midline from the neck's rim over the nape to the crown, so that
//! the seam lies under hair, and mapped to a rectangle: the face in the middle, chin down. The map
//! is harmonic, therefore without overlap; then rows and columns are spread so that the face
//! receives most texels. Ears are mapped to their own hole ring by ring. All of it follows from the
//! cage and the mean head, so one texture fits every head.

use std::sync::OnceLock;

use raconteur_base::{DVec2, DVec3, Side, curve};

use super::cage::{Cage, Key, LAST_COLUMN, LAST_ROW, Zone};
use super::mean;
use super::surface::Surface;
use crate::atlas::{SIZE, even_out, harmonic, unfold};

/// The head's rectangle in the atlas, texels: left, top, right, bottom.
const RECTANGLE: [f64; 4] = [6.0, 6.0, 708.0, 1018.0];

/// Relative texels per millimetre in each column of faces, compared with the face.
const COLUMN_SHARES: [f64; LAST_COLUMN as usize] = [
    1.0, 1.0, 1.0, 1.0, 1.1, 1.25, 1.35, 1.4, 1.35, 1.1, 0.75, 0.65, 0.75, 0.75, 0.75, 0.2, 0.13,
    0.12, 0.12, 0.12,
];
/// Share of chart height that the faces of the crown above row 0 receive.
const CROWN_SHARE: f64 = 0.4;

fn row_share(row: u8) -> f64 {
    match row {
        0..=11 => 0.85,
        12..=15 => 0.75,
        16..=19 => 0.6,
        20..=21 => 1.0,
        22..=24 => 1.5,
        _ => 0.7,
    }
}

/// Radius of each ear ring from the middle of its hole, relative to the border's: the back takes
/// little, the folded front most.
const EAR_RINGS: [f64; 11] = [
    1.0, 0.94, 0.88, 0.81, 0.74, 0.64, 0.53, 0.40, 0.27, 0.15, 0.07,
];

/// Number of redistributions of the face's texels; the next constant is the depth range in front of
/// the ears over which they start, mm.
const EVENINGS: usize = 1;
const FRONT_MM: [f64; 2] = [35.0, 75.0];

/// Position on the patch, from the front, behind which the crown's midline is not cut.
const CUT_FROM: u8 = 2;

/// Texture chart of the head, shared by all people.
pub(crate) struct Chart {
    /// Faces of the rendered surface over the vertices of the chart, which are doubled along the
    /// cut.
    pub(crate) faces: Vec<Vec<u32>>,
    /// Rendered vertex of each chart vertex.
    pub(crate) source: Vec<u32>,
    /// Texture coordinates in the atlas, 0..1.
    pub(crate) uv: Vec<[f64; 2]>,
    /// Rendered vertices on the mean head, mm.
    pub(crate) mean: Vec<DVec3>,
    /// Positions on the mean head.
    pub(crate) places: Places,
}

impl Chart {
    /// Maps values of the rendered vertices to the chart's vertices.
    pub(crate) fn select<T: Copy>(&self, drawn: &[T]) -> Vec<T> {
        self.source.iter().map(|&v| drawn[v as usize]).collect()
    }
}

/// Lookup of positions on the mean head by fractional coordinates of the cage; left half, mm.
#[derive(Debug)]
pub(crate) struct Places {
    cage: Cage,
    limit: Vec<DVec3>,
}

impl Places {
    fn position_of(&self, key: Key) -> DVec3 {
        self.limit[self.cage.vertex(key, Side::Left)]
    }

    fn between(a: f64, b: f64, at: impl Fn(u8, u8) -> DVec3) -> DVec3 {
        let (i, j) = (a.floor().max(0.0), b.floor().max(0.0));
        let low = at(i as u8, j as u8).lerp(at(i as u8 + 1, j as u8), a - i);
        let high = at(i as u8, j as u8 + 1).lerp(at(i as u8 + 1, j as u8 + 1), a - i);
        low.lerp(high, b - j)
    }

    /// Returns the position at column (0..20) and row (0..31). Within a hole of the grid, the
    /// nearest vertices of its border are used.
    pub(crate) fn grid(&self, column: f64, row: f64) -> DVec3 {
        let column = column.clamp(0.0, f64::from(LAST_COLUMN) - 1e-6);
        let row = row.clamp(0.0, f64::from(LAST_ROW) - 1e-6);
        Self::between(column, row, |i, j| {
            if self.cage.has(Key::Grid(i, j)) {
                return self.position_of(Key::Grid(i, j));
            }
            // Holes are at most six wide: the nearest columns left and right that exist.
            let left = (0..i).rev().find(|&k| self.cage.has(Key::Grid(k, j)));
            let right = (i..=LAST_COLUMN).find(|&k| self.cage.has(Key::Grid(k, j)));
            match (left, right) {
                (Some(a), Some(b)) => {
                    let t = f64::from(i - a) / f64::from(b - a);
                    self.position_of(Key::Grid(a, j))
                        .lerp(self.position_of(Key::Grid(b, j)), t)
                }
                (None, Some(b)) => self.position_of(Key::Grid(b, j)),
                (Some(a), None) => self.position_of(Key::Grid(a, j)),
                (None, None) => DVec3::ZERO,
            }
        })
    }

    /// Returns the position at the eye's ring (0..8) and the position around (0..16, wraps).
    pub(crate) fn eye(&self, ring: f64, position: f64) -> DVec3 {
        Self::between(ring.clamp(0.0, 7.999), position.rem_euclid(16.0), |r, k| {
            self.position_of(Key::eye(r, usize::from(k)))
        })
    }

    /// Returns the position at the mouth's ring (0..5) and the position along it (0..12).
    pub(crate) fn mouth(&self, ring: f64, position: f64) -> DVec3 {
        Self::between(
            ring.clamp(0.0, 4.999),
            position.clamp(0.0, 11.999),
            |r, k| self.position_of(Key::mouth(r, usize::from(k))),
        )
    }
}

/// Returns the chart, computed once: it has no inputs.
pub(crate) fn chart() -> &'static Chart {
    static CHART: OnceLock<Chart> = OnceLock::new();
    CHART.get_or_init(make)
}

fn is_cut(key: Key) -> bool {
    match key {
        Key::Grid(c, _) => c == LAST_COLUMN,
        Key::Crown(p, 0) => p >= CUT_FROM,
        _ => false,
    }
}

fn make() -> Chart {
    let cage = Cage::new();
    let solved = mean::solved(&cage);
    let surface = Surface::new(&cage);

    // Vertices on the cut occur once for each half.
    let mut open = cage.clone();
    let mut source: Vec<u32> = (0..cage.len() as u32).collect();
    let mut twin = vec![u32::MAX; cage.len()];
    for (v, slot) in twin.iter_mut().enumerate() {
        if is_cut(cage.keys[v].0) {
            *slot = open.keys.len() as u32;
            open.keys.push(cage.keys[v]);
            source.push(v as u32);
        }
    }
    for face in &mut open.faces {
        if face.iter().any(|&v| cage.keys[v as usize].1 == Side::Right) {
            for v in face {
                if twin[*v as usize] != u32::MAX {
                    *v = twin[*v as usize];
                }
            }
        }
    }
    let positions: Vec<DVec3> = source
        .iter()
        .map(|&v| solved.cage_points[v as usize])
        .collect();
    let flat = unwrap(&cage, &open, &twin, &positions);

    let open_surface = Surface::new(&open);
    let mut surface_of = vec![0; open_surface.len()];
    for (a, b) in open_surface.faces.iter().zip(&surface.faces) {
        for (&u, &v) in a.iter().zip(b) {
            surface_of[u as usize] = v;
        }
    }
    let smooth: Vec<DVec3> = flat.iter().map(|p| p.extend(0.0)).collect();
    let mut uv: Vec<DVec2> = open_surface
        .apply(&smooth)
        .into_iter()
        .map(DVec3::truncate)
        .collect();
    // Hollows of ears and nostrils, where columns and rows were spread unevenly.
    let seen: Vec<[u32; 3]> = open_surface
        .faces
        .iter()
        .zip(&open_surface.zones)
        .filter(|(_, z)| !matches!(z, Zone::Mouth(5..)))
        .flat_map(|(f, _)| f[1..].windows(2).map(|w| [f[0], w[0], w[1]]))
        .collect();
    unfold(&seen, &mut uv);
    let limit = (0..cage.len())
        .map(|v| solved.limit_of(v, &solved.cage_points))
        .collect();
    Chart {
        faces: open_surface.faces.clone(),
        source: surface_of,
        uv: uv
            .iter()
            .map(|p| [p.x / SIZE as f64, p.y / SIZE as f64])
            .collect(),
        mean: surface.apply(&solved.cage_points),
        places: Places { cage, limit },
    }
}

/// Lays the cage into the rectangle; texels.
fn unwrap(cage: &Cage, open: &Cage, twin: &[u32], positions: &[DVec3]) -> Vec<DVec2> {
    let net = Net {
        cage,
        twin,
        positions,
    };
    let lengths = net.lengths();
    let (mut flat, holes) = flattened(open, positions, &net.outline(&lengths), &net.bridges());
    net.spread(&mut flat, &lengths);
    net.lay_lids(&mut flat);
    net.lay_mouth(&mut flat);
    for border in holes {
        net.lay_ear(&mut flat, &border);
    }
    flat
}

/// The cage that is laid, on the mean head.
struct Net<'a> {
    cage: &'a Cage,
    /// The second vertex of those along the cut.
    twin: &'a [u32],
    positions: &'a [DVec3],
}

/// Lengths of the edges of a row and of a column that cross no hole, and of the crown's midline, mm.
struct Lengths {
    across: Vec<f64>,
    down: Vec<f64>,
    crown: f64,
}

impl Net<'_> {
    fn vertex(&self, k: Key, side: Side) -> u32 {
        let v = self.cage.vertex(k, side);
        let right = side == Side::Right && self.twin[v] != u32::MAX;
        if right { self.twin[v] } else { v as u32 }
    }

    fn length(&self, a: Key, b: Key) -> f64 {
        let p = |k: Key| self.positions[self.cage.vertex(k, Side::Left)];
        p(a).distance(p(b))
    }

    fn lengths(&self) -> Lengths {
        let g = Key::Grid;
        Lengths {
            across: (0..LAST_COLUMN)
                .map(|c| self.length(g(c, 15), g(c + 1, 15)))
                .collect(),
            down: (0..LAST_ROW)
                .map(|r| self.length(g(4, r), g(4, r + 1)))
                .collect(),
            crown: (0..4)
                .map(|i| self.length(Key::crown(i, 4), Key::crown(i + 1, 4)))
                .sum(),
        }
    }

    /// Returns the fixed positions of the outline: on both sides, from the front of the neck round
    /// to the end of the cut.
    fn outline(&self, lengths: &Lengths) -> Vec<(u32, DVec2)> {
        let g = Key::Grid;
        let half: f64 = lengths.across.iter().sum();
        let height = lengths.crown + lengths.down.iter().sum::<f64>();
        let neck: Vec<Key> = (0..=LAST_COLUMN).map(|c| g(c, LAST_ROW)).collect();
        let back: Vec<Key> = (0..=LAST_ROW).rev().map(|r| g(LAST_COLUMN, r)).collect();
        let top: Vec<Key> = (CUT_FROM - 1..=8).rev().map(|i| Key::crown(i, 0)).collect();
        let mut held: Vec<(u32, DVec2)> = Vec::new();
        let mut side_of = |keys: &[Key], from: DVec2, to: DVec2| {
            let steps: Vec<f64> = keys.windows(2).map(|w| self.length(w[0], w[1])).collect();
            let whole: f64 = steps.iter().sum();
            let mut gone = 0.0;
            for (i, &key) in keys.iter().enumerate() {
                let place = from.lerp(to, gone / whole);
                gone += steps.get(i).copied().unwrap_or(0.0);
                for (side, sign) in [(Side::Left, 1.0), (Side::Right, -1.0)] {
                    let v = self.vertex(key, side);
                    if held.iter().all(|h| h.0 != v) {
                        held.push((v, DVec2::new(place.x * sign, place.y)));
                    }
                }
            }
        };
        side_of(&neck, DVec2::new(0.0, height), DVec2::new(half, height));
        side_of(&back, DVec2::new(half, height), DVec2::new(half, 0.0));
        side_of(&top, DVec2::new(half, 0.0), DVec2::ZERO);
        held
    }

    /// Returns the bridges between vertices: the lips are joined; the lids stay open, and their
    /// lining follows below.
    fn bridges(&self) -> Vec<(u32, u32, f64)> {
        let mut bridges = Vec::new();
        for side in Side::BOTH {
            let mouth = |k: usize| self.vertex(Key::mouth(5, k), side);
            bridges.extend((0..6).map(|k| (mouth(k), mouth(12 - k), 3.0)));
            let eye = |k: usize| self.vertex(Key::eye(6, k), side);
            bridges.extend((1..8).map(|k| (eye(k), eye(16 - k), 0.35)));
        }
        bridges
    }

    /// Spreads columns and rows over the rectangle.
    fn spread(&self, flat: &mut [DVec2], lengths: &Lengths) {
        let g = Key::Grid;
        let place = |k: Key| flat[self.cage.vertex(k, Side::Left)];
        let mut columns: Vec<[f64; 2]> = vec![[0.0; 2]];
        let mut rows: Vec<[f64; 2]> = vec![[0.0; 2]];
        let mut sum = 0.0;
        for c in 0..LAST_COLUMN {
            sum += lengths.across[usize::from(c)] * COLUMN_SHARES[usize::from(c)];
            columns.push([place(g(c + 1, 15)).x, sum]);
        }
        let mut sum = lengths.crown * CROWN_SHARE;
        rows.push([place(g(4, 0)).y, sum]);
        for r in 0..LAST_ROW {
            sum += lengths.down[usize::from(r)] * row_share(r);
            rows.push([place(g(4, r + 1)).y, sum]);
        }
        let [left, above, right, below] = RECTANGLE;
        let (wide, high) = (
            (right - left) / 2.0 / columns[columns.len() - 1][1],
            (below - above) / sum,
        );
        for p in flat {
            *p = DVec2::new(
                (left + right) / 2.0 + p.x.signum() * through(&columns, p.x.abs()) * wide,
                above + through(&rows, p.y) * high,
            );
        }
    }

    /// Lays the lining of the lids within their edges.
    fn lay_lids(&self, flat: &mut [DVec2]) {
        for side in Side::BOTH {
            for (r, share) in [(7, 0.82), (8, 0.64)] {
                for k in 0..16 {
                    let edge = |k: usize| flat[self.vertex(Key::eye(6, k), side) as usize];
                    // Towards the line between the corners.
                    let line = (edge(k) + edge(16 - k % 16)) / 2.0;
                    flat[self.vertex(Key::eye(r, k), side) as usize] =
                        line + (edge(k) - line) * share;
                }
            }
        }
    }

    /// Places the mouth cavity on the line where the lips meet.
    fn lay_mouth(&self, flat: &mut [DVec2]) {
        for side in Side::BOTH {
            for k in 0..13 {
                let edge = |k: usize| flat[self.vertex(Key::mouth(5, k), side) as usize];
                let line = (edge(k) + edge(12 - k)) / 2.0;
                // The bag behind the lips has no map, but the surface is smooth across its edge.
                for r in 6..=8 {
                    flat[self.vertex(Key::mouth(r, k), side) as usize] = line;
                }
            }
        }
    }

    /// Lays an ear into its hole, if that is one's border.
    fn lay_ear(&self, flat: &mut [DVec2], border: &[u32]) {
        let Some(side) = Side::BOTH
            .into_iter()
            .find(|&s| border.contains(&self.vertex(Key::ear(0, 0), s)))
        else {
            return;
        };
        // After the spreading of rows and columns, the whole border is visible from its own centre.
        let border: Vec<DVec2> = border.iter().map(|&v| flat[v as usize]).collect();
        let middle = border.iter().sum::<DVec2>() / border.len() as f64;
        for (r, share) in (0u8..).zip(EAR_RINGS).skip(1) {
            for k in 0..18 {
                let edge = flat[self.vertex(Key::ear(0, k), side) as usize];
                flat[self.vertex(Key::ear(r, k), side) as usize] = middle + (edge - middle) * share;
            }
        }
    }
}

/// Computes the harmonic map of the cage without lids, mouth and ears, and the borders of its
/// holes.
fn flattened(
    open: &Cage,
    positions: &[DVec3],
    held: &[(u32, DVec2)],
    bridges: &[(u32, u32, f64)],
) -> (Vec<DVec2>, Vec<Vec<u32>>) {
    let laid = |z: &Zone| !matches!(z, Zone::Mouth(5..) | Zone::Eye(6..) | Zone::Ear(_));
    let kept = open.faces.iter().zip(&open.zones).filter(|(_, z)| laid(z));
    let faces: Vec<Vec<u32>> = kept.map(|(f, _)| f.clone()).collect();
    let mut tension = vec![1.0; positions.len()];
    let (mut flat, mut holes) = harmonic(&faces, positions, held, bridges, &tension);
    // Nose and lips protrude from the face and would receive too few texels.
    let front: Vec<f64> = positions
        .iter()
        .map(|p| curve::smooth((p.z - FRONT_MM[0]) / (FRONT_MM[1] - FRONT_MM[0])))
        .collect();
    for _ in 0..EVENINGS {
        even_out(&faces, positions, &flat, &front, &mut tension);
        (flat, holes) = harmonic(&faces, positions, held, bridges, &tension);
    }
    (flat, holes)
}

/// Evaluates a piecewise linear function through knots.
fn through(knots: &[[f64; 2]], x: f64) -> f64 {
    let next = knots
        .partition_point(|k| k[0] < x)
        .clamp(1, knots.len() - 1);
    let ([a, low], [b, high]) = (knots[next - 1], knots[next]);
    low + (high - low) * ((x - a) / (b - a)).clamp(0.0, 1.0)
}
