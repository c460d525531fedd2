//! Space of hair: distances from skin and clothes.
//!
//! Hair is described in its own frame: origin between the eyes' height plus 22 mm and the middle of
//! the skull, turned so that the skull is level, in metres of a head whose eyes are 107 mm below
//! the vertex. In this frame, one table of numbers fits every head.

use raconteur_base::curve::ramp;
use raconteur_base::{DMat3, DVec3};

use super::grid::{Grid, Lattice};
use crate::head::Head;
use raconteur_base::surface::vertex_normals;

/// Vertical distance from the eyes to the vertex (top of the skull) on the common head, metres.
const EYE_TO_VERTEX_M: f64 = 0.107;
/// Height of the origin above the eyes, metres.
const ABOVE_EYES_M: f64 = 0.022;
/// Downward pitch of the generated heads relative to the head on which hairlines were measured,
/// degrees.
const TURN_DEG: f64 = 2.6;
/// Distance of the grid's points, metres.
const PITCH_M: f64 = 0.004;
/// The grid's box, metres.
const LOW: DVec3 = DVec3::new(-0.23, -0.35, -0.19);
const HIGH: DVec3 = DVec3::new(0.23, 0.15, 0.19);
/// Ring of the ear from which it stands off the head.
const EAR_RING: f64 = 1.2;
/// A surface counts as flat within the first of these from a sample, as round beyond the second,
/// metres.
const FLAT_M: [f64; 2] = [0.012, 0.030];
/// Distance of samples within a triangle, metres.
const SAMPLE_M: f64 = 0.004;
/// Height of the bumps that ears are to growing hair, metres.
const EAR_BUMP_M: f64 = 0.0015;

/// Sampled point of a surface with its outward normal; hair keeps clear of these points.
#[derive(Clone, Copy, Debug)]
pub struct Sample {
    /// Position of the sampled point, metres.
    pub position: DVec3,
    /// Outward unit normal of the surface at the point.
    pub normal: DVec3,
}

/// Transform from the frame of the head to the frame of the hair, whose unit is a metre of the
/// common head.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    origin: DVec3,
    turn: DMat3,
    /// Size of this head relative to the common head.
    pub(super) scale: f64,
}

impl Frame {
    fn from_head(head: &Head) -> Self {
        let turn = DMat3::from_rotation_x(TURN_DEG.to_radians());
        let eyes = (head.eye_centres[0] + head.eye_centres[1]) * 0.5;
        let eyes = turn * eyes;
        let skin = || head.skin().vertices.iter().map(|v| turn * v.position);
        let top = skin().map(|p| p.y).fold(f64::MIN, f64::max);
        let scale = (top - eyes.y) / EYE_TO_VERTEX_M;
        let (back, front) = skin()
            .filter(|p| p.y > eyes.y + 0.03)
            .map(|p| p.z)
            .fold((f64::MAX, f64::MIN), |(a, b), z| (a.min(z), b.max(z)));
        let middle = DVec3::new(0.0, eyes.y + ABOVE_EYES_M * scale, 0.5 * (back + front));
        Self {
            origin: turn.transpose() * middle,
            turn,
            scale,
        }
    }

    pub(super) fn place(&self, p: DVec3) -> DVec3 {
        self.turn * (p - self.origin) / self.scale
    }

    pub(super) fn direction(&self, d: DVec3) -> DVec3 {
        self.turn * d
    }

    pub(super) fn place_back(&self, p: DVec3) -> DVec3 {
        self.origin + self.turn.transpose() * p * self.scale
    }

    pub(super) fn direction_back(&self, d: DVec3) -> DVec3 {
        self.turn.transpose() * d
    }
}

/// Skin point at which hair may grow, with its normal.
#[derive(Clone, Copy, Debug)]
pub(super) struct SkinPoint {
    pub(super) position: DVec3,
    pub(super) normal: DVec3,
}

/// Signed-distance fields about a head, along which hair is grown; frame of the hair, metres.
pub(super) struct Space {
    pub(super) frame: Frame,
    /// Distance from the skin and the clothes.
    pub(super) whole: Grid,
    /// Distance from the head without its ears.
    earless: Grid,
    /// Distance field along which hair grows: ears are low bumps in it.
    growth: Grid,
    /// Heavily blurred distance field: its gradient is the normal of the head as one smooth hull.
    hull: Grid,
    /// The skin's vertices and triangles.
    pub(super) skin: Vec<SkinPoint>,
    pub(super) triangles: Vec<[u32; 3]>,
}

impl Space {
    /// Samples the distances about a head and the `clothes` next to it, both in the frame of the
    /// head.
    pub(super) fn new(head: &Head, clothes: &[Sample]) -> Self {
        let frame = Frame::from_head(head);
        let sheet = &head.sheet;
        let faces: Vec<Vec<u32>> = sheet.triangles.iter().map(|t| t.to_vec()).collect();
        let normals = vertex_normals(&sheet.at, &faces);
        let skin: Vec<SkinPoint> = sheet
            .at
            .iter()
            .zip(normals)
            .map(|(mm, n)| SkinPoint {
                position: frame.place(*mm * 1e-3),
                normal: frame.direction(n),
            })
            .collect();
        let triangles = sheet.triangles.clone();
        let in_ear: Vec<bool> = sheet.rings.iter().map(|r| r.ear > EAR_RING).collect();
        let is_ear = |v: u32| in_ear.get(v as usize).copied().unwrap_or(false);
        let cloth: Vec<(DVec3, DVec3)> = clothes
            .iter()
            .map(|s| (frame.place(s.position), frame.direction(s.normal)))
            .collect();
        let samples = |ears: bool| {
            let between = triangles
                .iter()
                .filter(|t| ears || !t.iter().any(|&v| is_ear(v)))
                .flat_map(|t| filled(t.map(|v| skin[v as usize])));
            let mut all: Vec<(DVec3, DVec3)> = between.collect();
            all.extend_from_slice(&cloth);
            all
        };
        let lattice = Lattice {
            low: LOW,
            pitch: PITCH_M,
            size: ((HIGH - LOW) / PITCH_M).to_array().map(|n| n as usize + 1),
        };
        let whole = distances(lattice, &samples(true)).blurred(1);
        let earless = distances(lattice, &samples(false)).blurred(1);
        let round = whole.blurred(3);
        let growth = Grid::new(lattice, |i| {
            earless.values[i].min(round.values[i] + EAR_BUMP_M as f32)
        });
        let hull = whole.blurred(4);
        Self {
            frame,
            whole,
            earless,
            growth,
            hull,
            skin,
            triangles,
        }
    }

    /// Returns the vertices of the head's rendered skin.
    pub(super) fn drawn(&self, head: &Head) -> Vec<SkinPoint> {
        let part = head.skin();
        let positions: Vec<DVec3> = part.vertices.iter().map(|v| v.position).collect();
        let normals = vertex_normals(&positions, &part.faces);
        let place = |(p, n): (&DVec3, DVec3)| SkinPoint {
            position: self.frame.place(*p),
            normal: self.frame.direction(n),
        };
        positions.iter().zip(normals).map(place).collect()
    }

    /// Returns the height over the growth surface, metres.
    pub(super) fn height(&self, p: DVec3) -> f64 {
        self.growth.sample(p)
    }

    /// Returns the outward normal of the distance field along which hair grows.
    pub(super) fn normal(&self, p: DVec3) -> DVec3 {
        self.growth.slope(p)
    }

    /// Returns the outward normal of the head as one smooth hull, used to orient and light cards.
    pub(super) fn hull_normal(&self, p: DVec3) -> DVec3 {
        self.hull.slope(p)
    }

    /// Returns the height over the head without its ears, metres.
    pub(super) fn height_without_ears(&self, p: DVec3) -> f64 {
        self.earless.sample(p)
    }

    /// Moves a position out of the ear if it lies in it or nearer to it than `height`.
    pub(super) fn over_ear(&self, p: DVec3, height: f64) -> DVec3 {
        let short = height - self.whole.sample(p);
        if short > 0.0 {
            p + self.hull_normal(p) * short
        } else {
            p
        }
    }

    /// Returns the nearest position at least `height` above the growth surface.
    pub(super) fn pushed(&self, p: DVec3, height: f64) -> DVec3 {
        let short = height - self.height(p);
        if short > 0.0 {
            p + self.normal(p) * short
        } else {
            p
        }
    }
}

/// Samples within a triangle, close enough that the surface is flat between them.
fn filled([a, b, c]: [SkinPoint; 3]) -> Vec<(DVec3, DVec3)> {
    let edge = |p: SkinPoint, q: SkinPoint| p.position.distance(q.position);
    let longest = edge(a, b).max(edge(b, c)).max(edge(c, a));
    let parts = (longest / SAMPLE_M).ceil().clamp(2.0, 16.0) as usize;
    let share = |i: usize| i as f64 / parts as f64;
    let mut out = Vec::new();
    for i in 0..=parts {
        for j in 0..=parts - i {
            let (u, v) = (share(i), share(j));
            let w = 1.0 - u - v;
            let p = a.position * w + b.position * u + c.position * v;
            let n = a.normal * w + b.normal * u + c.normal * v;
            out.push((p, n.normalize_or(DVec3::Y)));
        }
    }
    out
}

/// Computes the signed distance of every point of a lattice from a sampled surface: that of the
/// nearest sample, found by sweeping (Danielsson 1980, doi:10.1016/0146-664X(80)90054-4); near the
/// surface, that of its plane.
fn distances(lattice: Lattice, samples: &[(DVec3, DVec3)]) -> Grid {
    let mut nearest = vec![u32::MAX; lattice.count()];
    let distance = |s: u32, p: DVec3| {
        samples
            .get(s as usize)
            .map_or(f64::MAX, |(q, _)| q.distance_squared(p))
    };
    for (s, (q, _)) in (0u32..).zip(samples) {
        if !lattice.contains(*q) {
            continue;
        }
        let (cell, _) = lattice.below(*q);
        for corner in 0..8usize {
            let c = [0, 1, 2].map(|k: usize| cell[k] + (corner >> k & 1));
            let slot = &mut nearest[lattice.number(c)];
            let p = lattice.place(c);
            if distance(s, p) < distance(*slot, p) {
                *slot = s;
            }
        }
    }
    sweep(lattice, &mut nearest, &distance);
    Grid::new(lattice, |i| {
        let p = lattice.place(lattice.cell(i));
        let Some((q, n)) = samples.get(nearest[i] as usize) else {
            return f32::MAX;
        };
        let (far, plane) = (q.distance(p), (p - *q).dot(*n));
        let share = ramp(FLAT_M[0], FLAT_M[1], far);
        (plane * (1.0 - share) + far * plane.signum() * share) as f32
    })
}

/// Carries the nearest sample from each point to its neighbours, forwards and backwards.
fn sweep(lattice: Lattice, nearest: &mut [u32], distance: &dyn Fn(u32, DVec3) -> f64) {
    let [nx, ny, nz] = lattice.size;
    let [sx, sy, sz] = [(ny * nz) as isize, nz as isize, 1isize];
    // The half of a point's neighbours that a forward sweep has been to.
    let before = [
        [-1, 0, 0],
        [0, -1, 0],
        [0, 0, -1],
        [-1, -1, 0],
        [-1, 1, 0],
        [-1, 0, -1],
        [-1, 0, 1],
        [0, -1, -1],
        [0, -1, 1],
    ];
    for forwards in [true, false, true, false] {
        let sign = if forwards { 1 } else { -1 };
        for k in 0..nearest.len() {
            let i = if forwards { k } else { nearest.len() - 1 - k };
            let cell = lattice.cell(i);
            let p = lattice.place(cell);
            let mut best = (distance(nearest[i], p), nearest[i]);
            for step in before {
                let inside = (0..3).all(|a| {
                    let to = cell[a] as isize + sign * step[a];
                    to >= 0 && to < [nx, ny, nz][a] as isize
                });
                if inside {
                    let at = i as isize + sign * (step[0] * sx + step[1] * sy + step[2] * sz);
                    let s = nearest[at as usize];
                    let d = distance(s, p);
                    if d < best.0 {
                        best = (d, s);
                    }
                }
            }
            nearest[i] = best.1;
        }
    }
}
