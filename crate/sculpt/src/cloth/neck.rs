//! Neck skin under collars. Above the shoulders it is the head's own, which is slimmer than the
//! body's field there and follows the person's neck.

use raconteur_base::curve::lerp;
use raconteur_base::{DVec3, ops};

use crate::torso::{CM, Field, Regions};

/// Directions round the neck, from the front over the left.
const SECTORS: usize = 72;
/// Distance of two rows, metres.
const STEP: f64 = 0.002;
/// Depth below the head's own skin to which the neck is sampled, metres.
const BELOW: f64 = 6.0 * CM;
/// Maximum distance of a query from the axis, metres; shoulders and chin continue beyond it.
const MAX_RADIUS_M: f64 = 0.16;

/// Skin of the neck, as distance from its axis by height and direction, for collars. It is
/// symmetric like clothes: the larger distance of both halves counts.
#[derive(Clone, Debug)]
pub struct Neck {
    low: f64,
    rows: Vec<Row>,
}

/// A level cut.
#[derive(Clone, Debug)]
struct Row {
    /// Depth of the axis, metres.
    axis_z: f64,
    /// Distance of the skin in each sector, metres.
    radii: [f64; SECTORS],
}

impl Row {
    fn radius(&self, turn: f64) -> f64 {
        let at = turn * SECTORS as f64;
        let k = at.floor() as usize;
        lerp(
            self.radii[k % SECTORS],
            self.radii[(k + 1) % SECTORS],
            at - at.floor(),
        )
    }
}

impl Neck {
    /// Builds the neck from the head's placed skin, triangles in world coordinates, and the body
    /// below it up to the height `high`, metres.
    #[must_use]
    pub fn new(skin: &[[DVec3; 3]], field: &Field, high: f64) -> Self {
        let rim = skin.iter().flatten().map(|p| p.y).fold(f64::MAX, f64::min);
        let low = rim - BELOW;
        let count = ((high - low) / STEP).ceil().max(1.0) as usize + 1;
        let mut rows: Vec<Row> = (0..count)
            .map(|i| cross_section(skin, field, low + STEP * i as f64))
            .collect();
        upright(&mut rows);
        rows.iter_mut().for_each(bridge);
        Self { low, rows }
    }

    /// Radius and depth of the axis at an angle from the front to the left and a height.
    fn radius_at(&self, angle_rad: f64, y: f64) -> (f64, f64) {
        let turn = (angle_rad / core::f64::consts::TAU).rem_euclid(1.0);
        let last = self.rows.len() - 1;
        let row = ((y - self.low) / STEP).clamp(0.0, last as f64);
        let i = row.floor() as usize;
        let (a, b) = (&self.rows[i], &self.rows[(i + 1).min(last)]);
        let share = row - row.floor();
        (
            lerp(a.radius(turn), b.radius(turn), share),
            lerp(a.axis_z, b.axis_z, share),
        )
    }

    /// Returns the point `off` metres outside the skin, measured horizontally, at a height and an
    /// angle from the front to the left.
    #[must_use]
    pub fn point(&self, angle_rad: f64, y: f64, off: f64) -> DVec3 {
        let (radius, axis_z) = self.radius_at(angle_rad, y);
        let (s, c) = ops::sincos(angle_rad);
        DVec3::new(s * (radius + off), y, axis_z + c * (radius + off))
    }

    /// Returns the horizontal distance of a point outside the skin, metres.
    fn level_off(&self, p: DVec3) -> f64 {
        let (_, axis_z) = self.radius_at(0.0, p.y);
        let (radius, _) = self.radius_at(ops::atan2(p.x, p.z - axis_z), p.y);
        (p.x * p.x + (p.z - axis_z) * (p.z - axis_z)).sqrt() - radius
    }

    /// Returns the approximate distance from the skin, metres, and the outward unit normal.
    #[must_use]
    pub fn value_and_normal(&self, p: DVec3) -> (f64, DVec3) {
        // Over as much as cloth bridges.
        const E: f64 = 2e-3;
        let slope = |way: DVec3| (self.level_off(p + way) - self.level_off(p - way)) / (2.0 * E);
        let g = DVec3::new(
            slope(DVec3::X * E),
            slope(DVec3::Y * E),
            slope(DVec3::Z * E),
        );
        let length = g.length().max(1e-3);
        (self.level_off(p) / length, g / length)
    }
}

fn cross_section(skin: &[[DVec3; 3]], field: &Field, y: f64) -> Row {
    let axis = field.neck_centre(y);
    let mut found = [f64::MAX; SECTORS];
    for triangle in skin {
        if let Some((p, q)) = crossing(triangle, y) {
            record_distance(&mut found, p - axis, q - axis);
        }
    }
    for (k, radius) in found.iter_mut().enumerate() {
        if *radius > MAX_RADIUS_M {
            *radius = body_radius(field, axis, direction(k));
        }
    }
    let mut radii = found;
    for (k, radius) in radii.iter_mut().enumerate() {
        *radius = radius.max(found[(SECTORS - k) % SECTORS]);
    }
    Row {
        axis_z: axis.z,
        radii,
    }
}

/// Makes cloth stand upright where the throat slopes forward to the chin; the skin may take part of
/// its thickness there.
fn upright(rows: &mut [Row]) {
    const THICKNESS: f64 = 0.004;
    let mut least = [f64::MAX; SECTORS];
    for row in rows {
        for (radius, least) in row.radii.iter_mut().zip(&mut least) {
            *least = least.min(*radius);
            *radius = least.max(*radius - THICKNESS);
        }
    }
}

/// Spans hollows narrower than about 30 degrees in a straight line.
fn bridge(row: &mut Row) {
    for _ in 0..8 {
        let before = row.radii;
        for (k, radius) in row.radii.iter_mut().enumerate() {
            let beside = before[(k + 1) % SECTORS] + before[(k + SECTORS - 1) % SECTORS];
            *radius = radius.max(0.5 * beside);
        }
    }
}

/// Returns the unit direction of a sector around the neck; sector 0 faces the front.
fn direction(k: usize) -> DVec3 {
    let (s, c) = ops::sincos(core::f64::consts::TAU * k as f64 / SECTORS as f64);
    DVec3::new(s, 0.0, c)
}

/// Returns the segment in which a triangle crosses a height.
fn crossing(triangle: &[DVec3; 3], y: f64) -> Option<(DVec3, DVec3)> {
    let mut ends = (0..3).filter_map(|k| {
        let (a, b) = (triangle[k], triangle[(k + 1) % 3]);
        ((a.y > y) != (b.y > y)).then(|| a.lerp(b, (y - a.y) / (b.y - a.y)))
    });
    Some((ends.next()?, ends.next()?))
}

/// Notes the nearest distance at which a level line is met in each sector.
fn record_distance(found: &mut [f64; SECTORS], p: DVec3, q: DVec3) {
    for (k, radius) in found.iter_mut().enumerate() {
        let way = direction(k);
        let side = |v: DVec3| v.x * way.z - v.z * way.x;
        let (a, b) = (side(p), side(q));
        if (a > 0.0) == (b > 0.0) {
            continue;
        }
        let along = p.lerp(q, a / (a - b)).dot(way);
        if along > 0.0 {
            *radius = radius.min(along);
        }
    }
}

/// Returns the distance from the axis to the body's own skin in a direction.
fn body_radius(field: &Field, axis: DVec3, way: DVec3) -> f64 {
    let outside = |r: f64| field.value(axis + way * r, Regions::ALL, 1.0) > 0.0;
    let (mut inner, mut outer) = (0.0, MAX_RADIUS_M);
    if !outside(outer) {
        return outer;
    }
    for _ in 0..20 {
        let middle = 0.5 * (inner + outer);
        if outside(middle) {
            outer = middle;
        } else {
            inner = middle;
        }
    }
    outer
}
