//! Fixed cage of quads, ring by ring, shrink-wrapped on the field.
//!
//! The trunk has 25 rows × 24 columns; the armhole is a loop of 16 of its points and is the arm's
//! first ring; the legs' first rings share three points of the crotch. Three rings lie close around
//! elbow and knee.

mod labels;
mod wrap;

use std::collections::BTreeMap;

use raconteur_base::curve::{lerp, smooth};
use raconteur_base::{DVec3, Side, mirror_vector, ops};

use self::labels::weights;
use self::wrap::{wind, wrap};
use super::field::{Field, Regions};
use super::shape::{CM, Joints};
use super::shell::Shell;
use super::weights::Weights;
use raconteur_body::skeleton::Bone;

/// Heights of the trunk's rows over an adult's stature.
const ROWS: [f64; 25] = [
    0.492, 0.506, 0.521, 0.536, 0.551, 0.566, 0.582, 0.598, 0.614, 0.630, 0.646, 0.662, 0.678,
    0.694, 0.710, 0.726, 0.742, 0.762, 0.78, 0.798, 0.815, 0.828, 0.842, 0.860, 0.885,
];
/// Downward shift of a child's rows, share of stature: the head takes a larger share.
const CHILD_DROP: f64 = 0.0185;
/// Columns of the trunk; 0 is the front, 6 the left side, 12 the back.
pub const COLUMNS: usize = 24;
/// First and last trunk row of the armhole.
pub const HOLE: (usize, usize) = (16, 20);
/// Number of points in a ring of a limb.
pub const RING: usize = 16;
/// Rings of the arm: 0 shoulder, 1 elbow, 2 wrist.
const ARM_RINGS: [f64; 24] = [
    0.10, 0.18, 0.27, 0.36, 0.45, 0.54, 0.63, 0.71, 0.79, 0.86, 0.92, 0.97, 1.02, 1.08, 1.15, 1.23,
    1.32, 1.42, 1.52, 1.62, 1.72, 1.81, 1.90, 2.0,
];
/// Rings of the leg: 0 hip, 1 knee, 2 ankle.
const LEG_RINGS: [f64; 20] = [
    0.10, 0.24, 0.38, 0.52, 0.66, 0.78, 0.88, 0.96, 1.03, 1.10, 1.18, 1.28, 1.39, 1.50, 1.61, 1.71,
    1.80, 1.88, 1.95, 2.03,
];

/// Position of a cage vertex in the rings of trunk, arms and legs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Key {
    /// Row and column; column 0 is the front, 6 the left side, 12 the back.
    Trunk(usize, usize),
    /// Point on the midline between the legs, counted from the front.
    Crotch(usize),
    /// Ring and its point: 0 up, 4 front, 8 down, 12 back.
    Arm(Side, usize, usize),
    /// Ring and its point: 2 front, 6 outside, 10 back, 14 inside.
    Leg(Side, usize, usize),
}

impl Key {
    fn mirrored(self) -> Self {
        match self {
            Self::Trunk(r, q) => Self::Trunk(r, (COLUMNS - q) % COLUMNS),
            Self::Crotch(_) => self,
            Self::Arm(s, j, k) => Self::Arm(s.opposite(), j, k),
            Self::Leg(s, j, k) => Self::Leg(s.opposite(), j, k),
        }
    }

    fn is_right(self) -> bool {
        match self {
            Self::Trunk(_, q) => q > 12,
            Self::Crotch(_) => false,
            Self::Arm(s, ..) | Self::Leg(s, ..) => s == Side::Right,
        }
    }

    fn is_midline(self) -> bool {
        matches!(self, Self::Trunk(_, 0 | 12) | Self::Crotch(_))
    }

    /// Returns the regions of the field that a vertex may lie on: an arm must not snap to a thigh.
    fn regions(self) -> Regions {
        match self {
            Self::Trunk(..) | Self::Crotch(_) => Regions::ALL,
            Self::Arm(..) => Regions::UPPER,
            Self::Leg(..) => Regions::LOWER,
        }
    }

    /// Returns true if relaxation may slide the vertex: only where the template is crude.
    fn slides(self) -> bool {
        match self {
            Self::Trunk(r, _) => (HOLE.0 - 3..ROWS.len() - 1).contains(&r) || r < 4,
            Self::Crotch(_) => true,
            Self::Arm(_, j, _) => j < 6,
            Self::Leg(_, j, _) => j < 4,
        }
    }
}

/// Ring to which a face of the body's cage belongs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tag {
    /// Between a trunk row and the next.
    Trunk(usize),
    /// Face that ends at this ring of an arm.
    Arm(usize),
    /// Face that ends at this ring of a leg.
    Leg(usize),
}

/// Cage (coarse control mesh) of a body, wrapped onto its distance field.
#[derive(Clone, Debug)]
pub struct Cage {
    /// Points, weights and quads of the cage.
    pub shell: Shell,
    /// Tag of each face.
    pub tags: Vec<Tag>,
    /// Key of each point: its place in the rings of the torso, arms and legs.
    pub keys: Vec<Key>,
    /// Heights of the trunk's rows, metres.
    heights: Vec<f64>,
}

/// Template vertices in insertion order.
#[derive(Default)]
struct Template {
    keys: Vec<Key>,
    points: Vec<DVec3>,
}

impl Template {
    fn put(&mut self, key: Key, p: DVec3) {
        self.keys.push(key);
        self.points.push(p);
        if key.mirrored() != key {
            self.keys.push(key.mirrored());
            self.points.push(mirror_vector(p));
        }
    }
}

/// Returns row and column of the armhole's points, in the order of an arm's ring (up, front, down,
/// back).
#[must_use]
pub fn armhole() -> [(usize, usize); RING] {
    let (low, high) = HOLE;
    [
        (high, 6),
        (high, 5),
        (high, 4),
        (high - 1, 4),
        (high - 2, 4),
        (high - 3, 4),
        (low, 4),
        (low, 5),
        (low, 6),
        (low, 7),
        (low, 8),
        (low + 1, 8),
        (low + 2, 8),
        (low + 3, 8),
        (high, 8),
        (high, 7),
    ]
}

impl Cage {
    /// Builds the cage of a body.
    #[must_use]
    pub fn new(field: &Field, joints: &Joints) -> Self {
        let mut template = Template::default();
        let hole = hole_points(field, joints);
        let heights: Vec<f64> = ROWS
            .iter()
            .map(|share| (share - CHILD_DROP * field.child) * field.stature_m)
            .collect();
        trunk(&mut template, field, &heights, &hole);
        arms(&mut template, field);
        legs(&mut template, field);
        let index: BTreeMap<Key, u32> = template.keys.iter().copied().zip(0u32..).collect();
        let (faces, tags) = faces(&index);
        let mut shell = Shell {
            weights: vec![Weights::default(); template.points.len()],
            points: template.points,
            faces,
        };
        wrap(&mut shell, &template.keys, &index, field);
        wind(&mut shell, field);
        shell.weights = weights(&shell, &template.keys, &heights, joints);
        Self {
            shell,
            tags,
            keys: template.keys,
            heights,
        }
    }

    /// Returns the faces accepted by `keep` as a separate shell.
    #[must_use]
    pub fn extract(&self, keep: impl Fn(Tag) -> bool) -> Shell {
        self.shell.select(|f| keep(self.tags[f]))
    }

    /// Returns the height of a trunk row, metres.
    #[must_use]
    pub fn row_height(&self, row: usize) -> f64 {
        self.heights[row]
    }

    /// Returns the first trunk row at or above a share of an adult's stature; a child's row is the
    /// same part of the body.
    #[must_use]
    pub fn row_at(share: f64) -> usize {
        ROWS.iter()
            .position(|s| *s >= share)
            .unwrap_or(ROWS.len() - 1)
    }

    /// Returns the last ring of an arm at or before a parameter (1 elbow, 2 wrist).
    #[must_use]
    pub fn arm_ring_at(t: f64) -> usize {
        ARM_RINGS.iter().rposition(|s| *s <= t).unwrap_or(0)
    }

    /// Returns the last ring of a leg at or before a parameter (1 knee, 2 ankle).
    #[must_use]
    pub fn leg_ring_at(t: f64) -> usize {
        LEG_RINGS.iter().rposition(|s| *s <= t).unwrap_or(0)
    }

    /// Returns true if a face belongs to the neck and its root, from a share of stature upwards.
    #[must_use]
    pub fn is_above(tag: Tag, share: f64) -> bool {
        matches!(tag, Tag::Trunk(r) if r >= Self::row_at(share))
    }
}

/// Returns two directions in the armhole's frame: outwards, and up along the shoulder.
fn armhole_up() -> (DVec3, DVec3) {
    let a = 14f64.to_radians();
    let outwards = DVec3::new(ops::cos(a), -ops::sin(a), 0.0);
    (outwards, DVec3::new(-outwards.y, outwards.x, 0.0))
}

fn hole_points(field: &Field, joints: &Joints) -> BTreeMap<(usize, usize), DVec3> {
    let (outwards, up) = armhole_up();
    let centre = joints.position_of(Bone::LShoulder) - outwards * 1.4 * CM * field.stature_m / 1.75;
    let radius = field.arm.sections.sample(0.27)[0] * 1.25 * CM;
    armhole()
        .into_iter()
        .enumerate()
        .map(|(k, place)| {
            let (s, c) = ops::sincos(core::f64::consts::TAU * k as f64 / RING as f64);
            let lift = if c > 0.0 { 1.0 } else { 1.25 };
            (place, centre + (up * c * lift + DVec3::Z * s) * radius)
        })
        .collect()
}

fn trunk(
    out: &mut Template,
    field: &Field,
    heights: &[f64],
    hole: &BTreeMap<(usize, usize), DVec3>,
) {
    let (low, high) = HOLE;
    for (r, &y) in heights.iter().enumerate() {
        let [half, front, back, centre, n] = field.trunk.sample(y / field.stature_m);
        for q in 0..=12 {
            let in_hole = (low..=high).contains(&r) && (5..8).contains(&q);
            if let Some(&p) = hole.get(&(r, q)) {
                out.put(Key::Trunk(r, q), p);
                continue;
            }
            if in_hole {
                continue;
            }
            let (sin, cos) = ops::sincos(core::f64::consts::PI * q as f64 / 12.0);
            let depth = if cos > 0.0 { front } else { back };
            let power = ops::pow((sin / half).abs(), n) + ops::pow((cos / depth).abs(), n);
            let mut radius = ops::pow(power, -1.0 / n) * CM;
            let mut centre_z = centre * CM;
            if r > high {
                let g = smooth((r - high) as f64 / 3.0);
                radius = lerp(radius, field.neck.radius, g);
                centre_z = lerp(centre_z, field.neck.centre_z(y), g);
            }
            let mut p = DVec3::new(sin * radius, y, centre_z + cos * radius);
            if (low..=high).contains(&r) {
                // Columns spread evenly between the midline and the armhole's edge.
                let (edge, sign, t) = if q < 4 {
                    (hole[&(r, 4)], 1.0, q as f64 / 4.0)
                } else {
                    (hole[&(r, 8)], -1.0, (12 - q) as f64 / 4.0)
                };
                let middle = DVec3::new(0.0, y, centre_z + sign * depth * CM);
                p = middle.lerp(edge, t);
                p.z += sign * 2.0 * CM * ops::sin(core::f64::consts::PI * t);
            }
            if r == 0 {
                p.y -= (1.0 - sin.abs()) * 1.5 * CM;
            }
            out.put(Key::Trunk(r, q), p);
        }
    }
    for (k, z) in [4.5, 0.0, -4.5f64].into_iter().enumerate() {
        let y = lerp(0.468, 0.450, field.child) * field.stature_m + 0.08 * z.abs() * CM;
        out.put(
            Key::Crotch(k),
            DVec3::new(0.0, y, z * CM * field.stature_m / 1.75 * 0.9),
        );
    }
}

/// Radius of an elliptic ring with four radii towards (a, b).
fn ring_radius(a: f64, b: f64, [plus_a, minus_a, plus_b, minus_b, _]: [f64; 5]) -> f64 {
    let x = a / if a > 0.0 { plus_a } else { minus_a };
    let y = b / if b > 0.0 { plus_b } else { minus_b };
    CM / (x * x + y * y).sqrt()
}

fn arms(out: &mut Template, field: &Field) {
    let (_, hole_up) = armhole_up();
    for (j, &t) in ARM_RINGS.iter().enumerate() {
        let section = field.arm.sections.sample(t);
        // Rings lean from the armhole's plane to the arm's own.
        let up = hole_up.lerp(field.arm.up, smooth(t / 0.55)).normalize();
        for k in 0..RING {
            let (s, c) = ops::sincos(core::f64::consts::TAU * k as f64 / RING as f64);
            let p = field.arm.origin
                + field.arm.axis * field.arm.along(t)
                + (up * c + DVec3::Z * s) * ring_radius(c, s, section);
            out.put(Key::Arm(Side::Left, j, k), p);
        }
    }
}

fn legs(out: &mut Template, field: &Field) {
    for (j, &t) in LEG_RINGS.iter().enumerate() {
        let section = field.leg.sections.sample(t);
        for k in 0..RING {
            // From medial through front, lateral, back.
            let (s, c) = ops::sincos((45.0 + 22.5 * k as f64).to_radians());
            let (a, b) = (-c, s);
            let r = ring_radius(a, b, section);
            let mut p = field.leg.origin
                + field.leg.axis * field.leg.along(t)
                + field.leg.up * a * r
                + DVec3::Z * b * r;
            p.x = p.x.max(0.25 * CM);
            out.put(Key::Leg(Side::Left, j, k), p);
        }
    }
}

fn faces(index: &BTreeMap<Key, u32>) -> (Vec<Vec<u32>>, Vec<Tag>) {
    let (low, high) = HOLE;
    let trunk = |r: usize, q: usize| index[&Key::Trunk(r, q % COLUMNS)];
    let mut faces = Vec::new();
    let mut tags = Vec::new();
    for r in 0..ROWS.len() - 1 {
        for q in 0..COLUMNS {
            let from_front = q.min(COLUMNS - 1 - q);
            if (low..high).contains(&r) && (4..8).contains(&from_front) {
                continue;
            }
            faces.push(vec![
                trunk(r, q),
                trunk(r, q + 1),
                trunk(r + 1, q + 1),
                trunk(r + 1, q),
            ]);
            tags.push(Tag::Trunk(r));
        }
    }
    let hole = armhole();
    for side in Side::BOTH {
        let on_side = |q: usize| {
            if side == Side::Left {
                q
            } else {
                (COLUMNS - q) % COLUMNS
            }
        };
        let mut arm: Vec<Vec<u32>> =
            vec![hole.iter().map(|&(r, q)| trunk(r, on_side(q))).collect()];
        arm.extend(
            (0..ARM_RINGS.len()).map(|j| (0..RING).map(|k| index[&Key::Arm(side, j, k)]).collect()),
        );
        let mut first_leg: Vec<u32> = (0..13).map(|q| trunk(0, on_side(q))).collect();
        first_leg.extend([2, 1, 0].map(|k| index[&Key::Crotch(k)]));
        let mut leg = vec![first_leg];
        leg.extend(
            (0..LEG_RINGS.len()).map(|j| (0..RING).map(|k| index[&Key::Leg(side, j, k)]).collect()),
        );
        for (rings, is_arm) in [(arm, true), (leg, false)] {
            for (j, pair) in rings.windows(2).enumerate() {
                for k in 0..RING {
                    let next = (k + 1) % RING;
                    faces.push(vec![pair[0][k], pair[1][k], pair[1][next], pair[0][next]]);
                    tags.push(if is_arm { Tag::Arm(j) } else { Tag::Leg(j) });
                }
            }
        }
    }
    (faces, tags)
}
