//! Throat: a collar touches the neck, and no back face of cloth is visible there.

use std::collections::BTreeMap;

use raconteur_base::{DVec3, ops};

use super::models;
use crate::part::MeshPart;
use crate::torso::Regions;
use raconteur_body::skeleton::Bone;

/// Points all over a part, a few millimetres apart.
fn points_on(part: &MeshPart) -> impl Iterator<Item = DVec3> {
    const STEPS: usize = 6;
    let triangles = part.triangles_about_middles(|_| true);
    triangles.into_iter().flat_map(|[a, b, c]| {
        (0..=STEPS).flat_map(move |i| {
            (0..=STEPS - i).map(move |j| {
                let (s, t) = (i as f64 / STEPS as f64, j as f64 / STEPS as f64);
                a + (b - a) * s + (c - a) * t
            })
        })
    })
}

/// Returns the distance at which a ray first hits a triangle, and true if it hits the front.
fn met(from: DVec3, way: DVec3, [a, b, c]: &[DVec3; 3]) -> Option<(f64, bool)> {
    let (u, v) = (*b - *a, *c - *a);
    let h = way.cross(v);
    let area = u.dot(h);
    if area.abs() < 1e-15 {
        return None;
    }
    let d = from - *a;
    let s = d.dot(h) / area;
    let q = d.cross(u);
    let t = way.dot(q) / area;
    let along = v.dot(q) / area;
    (s >= 0.0 && t >= 0.0 && s + t <= 1.0 && along > 0.0).then_some((along, area > 0.0))
}

/// Triangles by the height levels that they span, to limit ray tests.
struct Levels<'a>(BTreeMap<i32, Vec<&'a [DVec3; 3]>>);

impl<'a> Levels<'a> {
    const HEIGHT_M: f64 = 0.01;

    fn level(y: f64) -> i32 {
        (y / Self::HEIGHT_M).floor() as i32
    }

    fn from_triangles(triangles: &'a [[DVec3; 3]]) -> Self {
        let mut levels: BTreeMap<i32, Vec<&[DVec3; 3]>> = BTreeMap::new();
        for t in triangles {
            let low = t.iter().map(|p| p.y).fold(f64::MAX, f64::min);
            let high = t.iter().map(|p| p.y).fold(f64::MIN, f64::max);
            for level in Self::level(low)..=Self::level(high) {
                levels.entry(level).or_default().push(t);
            }
        }
        Self(levels)
    }

    /// All triangles that reach between two heights, some twice.
    fn between(&self, low: f64, high: f64) -> impl Iterator<Item = &'a [DVec3; 3]> {
        let range = Self::level(low)..=Self::level(high);
        self.0.range(range).flat_map(|(_, all)| all.iter().copied())
    }
}

#[test]
fn a_collar_lies_against_the_neck_all_round() {
    const SECTORS: usize = 72;
    /// Maximum distance of surfaces under a collar, metres.
    const FAR_M: f64 = 0.1;
    for m in models() {
        let skin = Levels::from_triangles(&m.skin);
        let collar = m.clothes.parts.iter().find(|p| p.name == "collar");
        let middle = m.field.neck_centre(m.joints.position_of(Bone::Cervical).y);
        let mut round = vec![Vec::new(); SECTORS];
        for p in points_on(collar.unwrap()) {
            let turn = (ops::atan2(p.x, p.z - middle.z) / core::f64::consts::TAU).rem_euclid(1.0);
            round[(turn * SECTORS as f64) as usize % SECTORS].push(p);
        }
        for (k, points) in round.iter().enumerate() {
            let top = points.iter().map(|p| p.y).fold(f64::MIN, f64::max);
            let edge = points.iter().filter(|p| p.y > top - 0.005);
            // Distance to the skin, inwards or where it slopes down; points inside the skin have no
            // gap.
            let off = edge.map(|p| {
                let level = (m.field.neck_centre(p.y) - *p).normalize();
                let to = |way: DVec3| {
                    let low = p.y + (way.y * FAR_M).min(0.0);
                    let near = skin.between(low, p.y);
                    near.filter_map(move |t| met(*p, way, t))
                };
                let down = (level + DVec3::NEG_Y).normalize();
                let hits = to(level).chain(to(down)).map(|h| h.0);
                let distance = hits.fold(f64::MAX, f64::min);
                // Below its rim the skin is the body's.
                match to(-level).next() {
                    Some(_) => 0.0,
                    None if distance < FAR_M => distance,
                    None => m.field.value(*p, Regions::ALL, 1.0),
                }
            });
            let off = off.fold(f64::MAX, f64::min);
            // The thickness of a sweater's rib and a millimetre; a T-shirt falls into no hollow.
            assert!(off < 0.006, "{} at {}°: {off} m", m.name, 5 * k);
        }
    }
}

#[test]
fn nothing_is_seen_from_behind_at_the_throat() {
    /// Radius of the beam of rays of a view, at most √(0.04² + 0.064²), metres.
    const BEAM_M: f64 = 0.076;
    for m in models() {
        let y = m.joints.position_of(Bone::Cervical).y;
        let middle = m.field.neck_centre(y);
        let near = |t: &[DVec3; 3]| t.iter().any(|p| p.distance(middle) < 0.2);
        let cloth: Vec<(&str, [DVec3; 3])> = m
            .clothes
            .parts
            .iter()
            .flat_map(|p| {
                let triangles = p.triangles_about_middles(|_| true).into_iter();
                triangles.map(|t| (p.name.as_str(), t))
            })
            .filter(|(_, t)| near(t))
            .collect();
        for view in 0..15 {
            let (yaw, pitch) = (
                0.3 * (f64::from(view / 3) - 2.0),
                0.4 * (f64::from(view % 3) - 1.0),
            );
            let (up, flat) = ops::sincos(pitch);
            let (aside, ahead) = ops::sincos(yaw);
            let towards = DVec3::new(aside * flat, up, ahead * flat);
            let front = middle + DVec3::new(0.0, 0.0, m.field.neck_radius());
            // No ray of a view is farther from its middle one.
            let reached = |t: &&[DVec3; 3]| {
                let aside = t.map(|p| (p - front).reject_from_normalized(towards).length());
                let size = t[0].distance(t[1]).max(t[0].distance(t[2]));
                aside.iter().any(|d| *d < BEAM_M + size)
            };
            let skin: Vec<&[DVec3; 3]> = m.skin.iter().filter(reached).collect();
            let cloth: Vec<_> = cloth.iter().filter(|c| reached(&&c.1)).collect();
            for i in 0..231 {
                let (x, up) = (
                    0.004 * f64::from(i % 21 - 10),
                    0.008 * f64::from(i / 21 - 8),
                );
                let from = front + DVec3::new(x, up, 0.0) + towards;
                let skin = skin.iter().filter_map(|t| met(from, -towards, t));
                let skin = skin.map(|s| s.0).fold(f64::MAX, f64::min);
                let first = cloth
                    .iter()
                    .filter_map(|(name, t)| {
                        met(from, -towards, t).map(|(d, front)| (d, front, name))
                    })
                    .min_by(|a, b| a.0.total_cmp(&b.0));
                if let Some((d, front, name)) = first {
                    // Below the head's skin, the body's own is up to 11 mm below its field.
                    let inside = |along: f64| {
                        m.field.value(from - towards * along, Regions::ALL, 1.0) < -0.012
                    };
                    let steps = (d / 0.004) as usize;
                    let hidden = || (200..steps).any(|i| inside(0.004 * i as f64));
                    assert!(
                        front || d > skin || hidden(),
                        "{} {name} from {yaw}, {pitch}: {x}, {up}",
                        m.name
                    );
                }
            }
        }
    }
}
