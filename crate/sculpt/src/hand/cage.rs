//! Coarse quad cage: topology, and positions sufficient for projection.
//!
//! A sleeve of 20 columns runs from the forearm to just beyond the knuckles. Fingers are tubes of 8
//! columns; the side columns of adjacent fingers start in one shared web vertex. The thumb grows
//! out of a hole of 2 × 2 faces in the radial side.

use raconteur_base::{DVec3, ops};

use super::anatomy::{Anatomy, FINGER_COUNT};
use super::field::Field;
use super::nail::Nail;
use crate::subdivide::edge_faces;

/// Cage of the hand: a coarse quad control mesh that is subdivided and projected onto the hand's
/// solids. [`super`] documents the frame.
pub(super) struct Cage {
    pub(super) positions: Vec<DVec3>,
    pub(super) faces: Vec<Vec<u32>>,
    /// Weight of each vertex in each finger's tube, 0 to 1.
    pub(super) ownership: Vec<[f64; FINGER_COUNT]>,
}

/// Columns of the sleeve: 0–8 dorsal from the radial to the ulnar edge, 9 the ulnar side,
/// 10–18 palmar back to the radial edge, 19 the radial side.
const COLUMNS: usize = 20;
const DORSAL_EDGE: usize = 0;
const ULNAR_EDGE: usize = 8;
const ULNAR_SIDE: usize = 9;
const PALMAR_ULNAR_EDGE: usize = 10;
const PALMAR_EDGE: usize = 18;
const RADIAL_SIDE: usize = 19;

/// Rows of the sleeve: y on the forearm, mm …
const FOREARM_ROWS: [f64; 8] = [-95.0, -72.0, -52.0, -36.0, -24.0, -14.0, -6.0, 2.0];
/// Palm rows as fractions of the distance to the knuckles.
const PALM_ROWS: [f64; 8] = [0.10, 0.20, 0.42, 0.66, 0.80, 0.91, 1.0, 1.10];
const ROWS: usize = FOREARM_ROWS.len() + PALM_ROWS.len();

/// First row of the thumb's hole, which spans three.
const HOLE: usize = 9;

/// Sections of a finger's ring: dorsal L, M, R, side R, palmar R, M, L, side L, as
/// fractions of half width and height; L is radial.
const RING: [(f64, f64); 8] = [
    (0.72, -0.78),
    (0.0, -1.0),
    (-0.72, -0.78),
    (-1.0, 0.02),
    (-0.74, 0.76),
    (0.0, 1.0),
    (0.74, 0.76),
    (1.0, 0.02),
];
/// Ring next to the nail, where the back is wider.
const NAIL_RING: [(f64, f64); 8] = [
    (0.93, -0.45),
    (0.0, -1.0),
    (-0.93, -0.45),
    (-1.0, 0.25),
    (-0.7, 0.8),
    (0.0, 1.0),
    (0.7, 0.8),
    (1.0, 0.25),
];

/// Joint coordinates of the rings: three around every joint.
const STATIONS: [f64; 13] = [
    0.60, 0.76, 0.88, 1.0, 1.13, 1.34, 1.62, 1.83, 2.0, 2.16, 2.30, 2.62, 2.92,
];
const THUMB_STATIONS: [f64; 13] = [
    0.45, 0.68, 0.84, 1.05, 1.22, 1.44, 1.70, 1.86, 2.0, 2.14, 2.28, 2.62, 2.92,
];
/// The thumb's first rings lean with the web: joint coordinate of each of the 8 vertices.
const THUMB_TILT: [[f64; 8]; 4] = [
    [0.50, 0.45, 0.50, 0.66, 0.84, 0.93, 0.84, 0.66],
    [0.74, 0.70, 0.74, 0.82, 0.93, 1.0, 0.93, 0.82],
    [0.92, 0.90, 0.92, 0.96, 1.02, 1.05, 1.02, 0.96],
    [1.04, 1.04, 1.04, 1.07, 1.1, 1.12, 1.1, 1.07],
];
/// Ring (counting the web ring as 0) at which the nail's patch of 2 × 2 faces starts.
const NAIL_RING_START: usize = 11;

/// Vertices around the thumb's hole are placed on the surface by hand: row beyond
/// [`HOLE`], column, position.
const THUMB_LOOP: [(usize, usize, [f64; 3]); 9] = [
    (0, RADIAL_SIDE, [29.0, 8.0, 4.0]),
    (0, PALMAR_EDGE, [25.0, 9.0, 20.0]),
    (1, PALMAR_EDGE, [25.0, 30.0, 31.0]),
    (2, PALMAR_EDGE, [27.0, 50.0, 22.0]),
    (2, RADIAL_SIDE, [34.0, 56.0, 12.0]),
    (2, DORSAL_EDGE, [30.0, 56.0, -2.0]),
    (1, DORSAL_EDGE, [31.0, 33.0, -6.0]),
    (0, DORSAL_EDGE, [28.0, 13.0, -6.0]),
    (3, RADIAL_SIDE, [34.0, 70.0, 4.0]),
];

/// Returns the dorsal column above or below a column of the sleeve, 0–8.
fn dorsal_column(column: usize) -> usize {
    match column {
        ULNAR_SIDE => ULNAR_EDGE,
        RADIAL_SIDE => DORSAL_EDGE,
        c if c > ULNAR_SIDE => PALMAR_EDGE - c,
        c => c,
    }
}

/// Returns the side of a column of the sleeve: −1 on the back, 1 on the palm, 0 at the edges.
fn face_side(column: usize) -> f64 {
    match column {
        ULNAR_SIDE | RADIAL_SIDE => 0.0,
        c if c < ULNAR_SIDE => -1.0,
        _ => 1.0,
    }
}

struct Builder<'a> {
    anatomy: &'a Anatomy,
    positions: Vec<DVec3>,
    faces: Vec<Vec<u32>>,
    ownership: Vec<[f64; FINGER_COUNT]>,
    sleeve: [[Option<u32>; COLUMNS]; ROWS],
}

impl Builder<'_> {
    fn add(&mut self, p: DVec3, ownership: [f64; FINGER_COUNT]) -> u32 {
        self.positions.push(p);
        self.ownership.push(ownership);
        self.positions.len() as u32 - 1
    }

    fn add_owned(&mut self, finger: usize, share: f64, p: DVec3) -> u32 {
        let mut ownership = [0.0; FINGER_COUNT];
        ownership[finger] = share;
        self.add(p, ownership)
    }

    fn knuckle(&self, column: usize) -> DVec3 {
        let joint = |f: usize| self.anatomy.fingers[f].origin;
        match column {
            DORSAL_EDGE => joint(1) + DVec3::X * 11.0,
            ULNAR_EDGE => joint(4) - DVec3::X * 10.0,
            c if c % 2 == 1 => joint(c.div_ceil(2)),
            c => (joint(c / 2) + joint(c / 2 + 1)) / 2.0 + DVec3::Y * 2.0,
        }
    }

    fn forearm_point(&self, column: usize, y: f64) -> DVec3 {
        let a = self.anatomy;
        let side = face_side(column);
        let width = a.forearm_half_width.sample(y);
        let height = if side < 0.0 {
            a.forearm_dorsal.sample(y)
        } else {
            a.forearm_palmar.sample(y)
        };
        let c = dorsal_column(column);
        let u = if side == 0.0 {
            if c == DORSAL_EDGE { 1.0 } else { -1.0 }
        } else {
            ops::cos(core::f64::consts::PI * (c as f64 + 0.6) / 9.2)
        };
        let rest = (1.0 - ops::pow(u.abs(), 2.4)).max(0.02);
        DVec3::new(
            1.0 + width * u * 1.02,
            y,
            side * height * ops::pow(rest, 0.9),
        )
    }

    fn palm_point(&self, column: usize, fraction: f64, field: &Field<'_>) -> DVec3 {
        let side = face_side(column);
        let aside = match column {
            RADIAL_SIDE => 2.0,
            ULNAR_SIDE => -2.0,
            _ => 0.0,
        };
        let end = self.knuckle(dorsal_column(column)) + DVec3::new(aside, 0.0, side * 11.5 + 1.0);
        if fraction > 1.0 {
            return self.project_onto(end + DVec3::Y * (fraction - 1.0) * 75.0, side, field);
        }
        let p = self.forearm_point(column, 2.0).lerp(end, fraction);
        self.project_onto(p, side, field)
    }

    /// Moves a vertex of back or palm onto the field from outside along z: started inside
    /// a fold, the projection would find the wrong wall.
    fn project_onto(&self, p: DVec3, side: f64, field: &Field<'_>) -> DVec3 {
        if side == 0.0 {
            return p;
        }
        (0..114)
            .map(|i| DVec3::new(p.x, p.y, side * (45.0 - 0.5 * f64::from(i))))
            .find(|q| field.distance(*q) < 0.0)
            .unwrap_or(p)
    }

    fn build_sleeve(&mut self, field: &Field<'_>) {
        for row in 0..ROWS {
            for column in 0..COLUMNS {
                if row == HOLE + 1 && column == RADIAL_SIDE {
                    continue;
                }
                let by_hand = THUMB_LOOP
                    .iter()
                    .find(|l| l.0 + HOLE == row && l.1 == column);
                let p = match by_hand {
                    Some(placed) => DVec3::from_array(placed.2),
                    None if row < FOREARM_ROWS.len() => {
                        self.forearm_point(column, FOREARM_ROWS[row])
                    }
                    None => self.palm_point(column, PALM_ROWS[row - FOREARM_ROWS.len()], field),
                };
                self.sleeve[row][column] = Some(self.add(p, [0.0; FINGER_COUNT]));
            }
        }
        for row in 0..ROWS - 1 {
            for column in 0..COLUMNS {
                let next = (column + 1) % COLUMNS;
                let corners = [
                    self.sleeve[row][column],
                    self.sleeve[row][next],
                    self.sleeve[row + 1][next],
                    self.sleeve[row + 1][column],
                ];
                if let [Some(a), Some(b), Some(c), Some(d)] = corners {
                    self.faces.push(vec![a, b, c, d]);
                }
            }
        }
    }

    /// Returns the index of a sleeve vertex that is not in the thumb's hole.
    fn vertex(&self, row: usize, column: usize) -> u32 {
        // The only missing vertex is the middle of the hole, which no caller names.
        self.sleeve[row][column].unwrap_or(0)
    }

    fn on_finger(&self, f: usize, q: f64, lateral: f64, palmar: f64) -> DVec3 {
        let finger = &self.anatomy.fingers[f];
        let along = finger.along(q);
        let section = finger.section(along);
        let height = if palmar < 0.0 {
            section.dorsal
        } else {
            section.palmar
        };
        finger.point(DVec3::new(
            lateral * section.half_width,
            along,
            palmar * height,
        ))
    }

    /// Adds the rings at which the tubes of the fingers leave the palm.
    fn first_rings(&mut self) -> [[u32; 8]; FINGER_COUNT] {
        let mut rings = [[0; 8]; FINGER_COUNT];
        for f in 1..FINGER_COUNT {
            for k in 0..8 {
                rings[f][k] = if k == 7 && f > 1 {
                    rings[f - 1][3]
                } else if k == 3 && f < 4 {
                    let here = self.on_finger(f, 0.37, -1.0, 0.1);
                    let there = self.on_finger(f + 1, 0.37, 1.0, 0.1);
                    let mut shared = [0.0; FINGER_COUNT];
                    shared[f] = 0.3;
                    shared[f + 1] = 0.3;
                    self.add((here + there) / 2.0 + DVec3::Y, shared)
                } else {
                    let q = if (4..=6).contains(&k) { 0.39 } else { 0.35 };
                    let p = self.on_finger(f, q, RING[k].0, RING[k].1);
                    self.add_owned(f, 0.7, p)
                };
            }
        }
        rings[0] = [
            (0, PALMAR_EDGE),
            (0, RADIAL_SIDE),
            (0, DORSAL_EDGE),
            (1, DORSAL_EDGE),
            (2, DORSAL_EDGE),
            (2, RADIAL_SIDE),
            (2, PALMAR_EDGE),
            (1, PALMAR_EDGE),
        ]
        .map(|(row, column)| self.vertex(HOLE + row, column));
        rings
    }

    /// Faces between the sleeve's last row and the web rings.
    fn join_fingers(&mut self, rings: &[[u32; 8]; FINGER_COUNT]) {
        let last = ROWS - 1;
        for f in 1..FINGER_COUNT {
            let r = rings[f];
            let dorsal = |c: usize| self.vertex(last, c);
            let palmar = |c: usize| self.vertex(last, PALMAR_EDGE - c);
            let (before, mid, after) = (2 * f - 2, 2 * f - 1, 2 * f);
            let mut quads = vec![
                [dorsal(before), dorsal(mid), r[1], r[0]],
                [dorsal(mid), dorsal(after), r[2], r[1]],
                [palmar(after), palmar(mid), r[5], r[4]],
                [palmar(mid), palmar(before), r[6], r[5]],
            ];
            if f < 4 {
                let next = rings[f + 1];
                quads.push([dorsal(after), next[0], r[3], r[2]]);
                quads.push([palmar(after), r[4], r[3], next[6]]);
            }
            self.faces.extend(quads.iter().map(|q| q.to_vec()));
        }
        let at = |c: usize| self.vertex(last, c);
        let (index, little) = (rings[1], rings[4]);
        let sides = [
            [at(RADIAL_SIDE), at(DORSAL_EDGE), index[0], index[7]],
            [at(PALMAR_EDGE), at(RADIAL_SIDE), index[7], index[6]],
            [at(ULNAR_EDGE), at(ULNAR_SIDE), little[3], little[2]],
            [at(ULNAR_SIDE), at(PALMAR_ULNAR_EDGE), little[4], little[3]],
        ];
        self.faces.extend(sides.iter().map(|q| q.to_vec()));
    }

    fn build_tube(&mut self, f: usize, first: [u32; 8]) {
        let stations = if f == 0 { THUMB_STATIONS } else { STATIONS };
        let mut rings = vec![first];
        for (j, q) in stations.into_iter().enumerate() {
            let shape = if (9..=12).contains(&j) {
                NAIL_RING
            } else {
                RING
            };
            let narrow = match j {
                12 => 0.62,
                11 => 0.97,
                _ => 1.0,
            };
            rings.push(core::array::from_fn(|k| {
                let q = if f == 0 && j < THUMB_TILT.len() {
                    THUMB_TILT[j][k]
                } else {
                    q
                };
                let p = self.on_finger(f, q, shape[k].0 * narrow, shape[k].1 * narrow);
                self.add_owned(f, 1.0, p)
            }));
        }
        let nail_rows = NAIL_RING_START..NAIL_RING_START + 2;
        for (j, pair) in rings.windows(2).enumerate() {
            for k in 0..8 {
                if nail_rows.contains(&j) && k < 2 {
                    continue;
                }
                let next = (k + 1) % 8;
                self.faces
                    .push(vec![pair[0][k], pair[0][next], pair[1][next], pair[1][k]]);
            }
        }
        let end = rings[rings.len() - 1];
        for [a, b, c, d] in [[7, 0, 1, 2], [7, 2, 3, 6], [6, 3, 4, 5]] {
            self.faces.push(vec![end[a], end[b], end[c], end[d]]);
        }
        let [low, mid, high] = [0, 1, 2].map(|i| rings[NAIL_RING_START + i]);
        let around = [
            low[0], low[1], low[2], mid[2], high[2], high[1], high[0], mid[0],
        ];
        self.build_nail_bed(f, around, mid[1]);
    }

    /// Builds two loops inside the nail's patch along the outline of the plate, so that the fold
    /// around it has vertices to stand on. Towards the free edge, which has no fold, they stay
    /// behind and within the end of the finger.
    fn build_nail_bed(&mut self, f: usize, around: [u32; 8], centre: u32) {
        let nail = Nail::for_finger(f);
        let middle = (nail.root + nail.end) / 2.0;
        let (r, m, e) = (nail.root, middle, nail.end);
        let q = [r, r, r, m, e, e, e, m];
        let x = [1.0, 0.0, -1.0, -1.0, -1.0, 0.0, 1.0, 1.0];
        let mut outer = around;
        for (widen, lengthen) in [(1.08, 0.06), (0.90, -0.05)] {
            let inner: [u32; 8] = core::array::from_fn(|k| {
                let (beyond, narrow) = if q[k] == m {
                    (0.0, 1.0)
                } else if q[k] < m {
                    (-lengthen, 1.0)
                } else {
                    (lengthen - 0.11, 0.75)
                };
                let depth = if k == 1 || k == 5 { -0.92 } else { -0.72 };
                let p = self.on_finger(f, q[k] + beyond, x[k] * nail.width * widen * narrow, depth);
                self.add_owned(f, 1.0, p)
            });
            for k in 0..8 {
                let next = (k + 1) % 8;
                self.faces
                    .push(vec![outer[k], outer[next], inner[next], inner[k]]);
            }
            outer = inner;
        }
        for k in [0, 2, 4, 6] {
            self.faces.push(vec![
                outer[k],
                outer[(k + 1) % 8],
                centre,
                outer[(k + 7) % 8],
            ]);
        }
    }

    /// Orients the faces consistently, with the whole surface facing outwards.
    fn orient(&mut self) {
        let edges = edge_faces(&self.faces);
        let mut done = vec![false; self.faces.len()];
        let mut open = vec![0_usize];
        done[0] = true;
        while let Some(i) = open.pop() {
            let face = self.faces[i].clone();
            for k in 0..4 {
                let (a, b) = (face[k], face[(k + 1) % 4]);
                let sides = edges
                    .get(&(a.min(b), a.max(b)))
                    .map_or(&[][..], Vec::as_slice);
                for &j in sides {
                    let j = j as usize;
                    if done[j] {
                        continue;
                    }
                    done[j] = true;
                    let other = &mut self.faces[j];
                    let same_way = (0..4).any(|m| other[m] == a && other[(m + 1) % 4] == b);
                    if same_way {
                        other.reverse();
                    }
                    open.push(j);
                }
            }
        }
        let volume: f64 = self
            .faces
            .iter()
            .flat_map(|f| [[f[0], f[1], f[2]], [f[0], f[2], f[3]]])
            .map(|t| {
                let [a, b, c] = t.map(|i| self.positions[i as usize]);
                a.dot(b.cross(c))
            })
            .sum();
        if volume < 0.0 {
            for face in &mut self.faces {
                face.reverse();
            }
        }
    }
}

/// Builds the cage around the field.
pub(super) fn build(anatomy: &Anatomy, field: &Field<'_>) -> Cage {
    let mut builder = Builder {
        anatomy,
        positions: Vec::new(),
        faces: Vec::new(),
        ownership: Vec::new(),
        sleeve: [[None; COLUMNS]; ROWS],
    };
    builder.build_sleeve(field);
    let rings = builder.first_rings();
    builder.join_fingers(&rings);
    for (f, ring) in rings.into_iter().enumerate() {
        builder.build_tube(f, ring);
    }
    builder.orient();
    Cage {
        positions: builder.positions,
        faces: builder.faces,
        ownership: builder.ownership,
    }
}
