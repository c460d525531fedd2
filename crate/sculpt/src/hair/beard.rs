//! Beards: tufts that ride on the skin of jaw, chin and upper lip, clear of the lips.

use raconteur_base::curve::lerp;
use raconteur_base::{DVec3, noise};
use serde::{Deserialize, Serialize};

use super::card::{STRIPS, empty};
use super::colour::Palette;
use crate::assemble::Piece;
use crate::head::{Ear, Head, Holds, Ride};
use crate::part::PartVertex;
use raconteur_body::figure::Material;

/// A beard.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct BeardParams {
    /// Length at the chin, metres, 0.005..0.04.
    pub length_m: f64,
    /// Whether the upper lip is covered too.
    pub moustache: bool,
}

/// Tufts, their share of the full length and their width in metres: short ones near the
/// skin, then those that show. They are wide and hold single hairs: a narrow card that is
/// filled would look like a chip.
const TUFTS: [(usize, f64, f64); 2] = [(150, 0.62, 0.0095), (330, 0.85, 0.0080)];
/// Upper edge of a beard by distance from the middle, on the common head, mm: under the
/// nose, the mouth's corner, the cheek, before the ear. Chosen by eye.
const EDGE: [[f64; 2]; 7] = [
    [0.0, -26.0],
    [16.0, -26.0],
    [30.0, -40.0],
    [38.0, -46.0],
    [52.0, -34.0],
    [66.0, -27.0],
    [76.0, -20.0],
];
/// Height of the lips' middle on the common head, mm.
const LIPS_Y: f64 = -46.0;
/// A tuft moved less than this by a morph stays, metres: its neighbours hide the rest.
const STILL: f64 = 7e-4;
/// How clear of the lips tips stay, and the shortest tuft, metres.
const LIP_MARGIN: f64 = 0.004;
const SHORTEST: f64 = 0.003;

/// 0 at `from` and beyond, 1 at `to` and beyond, whichever is greater.
fn slope(from: f64, to: f64, x: f64) -> f64 {
    ((x - from) / (to - from)).clamp(0.0, 1.0)
}

/// Where a beard grows.
struct Field<'a> {
    head: &'a Head,
    lips: Vec<DVec3>,
    lips_y: f64,
    moustache: bool,
}

impl<'a> Field<'a> {
    fn new(head: &'a Head, p: &BeardParams) -> Self {
        let scalp = &head.scalp;
        let (low, high) = scalp
            .lips
            .iter()
            .map(|l| scalp.proportions.common(*l).y * 1e3)
            .fold((f64::MAX, f64::MIN), |(a, b), y| (a.min(y), b.max(y)));
        Self {
            head,
            lips: scalp.lips.iter().step_by(3).copied().collect(),
            lips_y: if low < high {
                0.5 * (low + high)
            } else {
                LIPS_Y
            },
            moustache: p.moustache,
        }
    }

    /// A place on the common head with the lips at their common height, mm.
    fn place(&self, p: DVec3) -> DVec3 {
        let q = self.head.scalp.proportions.common(p) * 1e3;
        q - DVec3::Y * (self.lips_y - LIPS_Y) * slope(10.0, -30.0, q.y)
    }

    /// Distance from the lips, metres.
    fn to_lips(&self, p: DVec3) -> f64 {
        let squared = self.lips.iter().map(|l| l.distance_squared(p));
        squared.fold(f64::MAX, f64::min).sqrt()
    }

    fn on_lip(&self, q: DVec3) -> bool {
        q.y > LIPS_Y && q.x.abs() < 33.0
    }

    fn density(&self, p: DVec3) -> f64 {
        let q = self.place(p);
        let x = q.x.abs();
        let next = EDGE.iter().position(|e| e[0] >= x).unwrap_or(6).max(1);
        let ([a, low], [b, high]) = (EDGE[next - 1], EDGE[next]);
        let edge = lerp(low, high, ((x - a) / (b - a)).clamp(0.0, 1.0));
        let in_ear = |e: &Ear| {
            let reach = e.radii + DVec3::splat(0.003);
            e.radii.x > 0.0 && ((p - e.centre) / reach).length_squared() < 1.0
        };
        if (!self.moustache && self.on_lip(q)) || self.head.scalp.ears.iter().any(in_ear) {
            return 0.0;
        }
        let lip = self.to_lips(p);
        slope(-2.0, 9.0, edge - q.y)
            * slope(-104.0, -90.0, q.y)
            * slope(-2.0, 12.0, q.z)
            * slope(0.0014, 0.0032, lip)
    }
}

/// Share of each vertex of the head's skin that a beard covers, 0..1.
pub(super) fn cover(head: &Head, p: &BeardParams) -> Vec<f64> {
    let field = Field::new(head, p);
    head.skin()
        .vertices
        .iter()
        .map(|v| field.density(v.position))
        .collect()
}

/// Makes a beard, in the head's frame.
pub(super) fn beard(
    head: &Head,
    p: &BeardParams,
    material: &Material,
    palette: &Palette,
    seed: u64,
) -> Piece {
    let skin = head.skin();
    let ride = Ride::new(skin);
    let field = Field::new(head, p);
    let density: Vec<f64> = ride.positions.iter().map(|q| field.density(*q)).collect();
    let triangles: Vec<[u32; 3]> = skin
        .faces
        .iter()
        .flat_map(|f| f[1..].windows(2).map(|w| [f[0], w[0], w[1]]))
        .filter(|t| t.iter().any(|&v| density[v as usize] > 0.0))
        .collect();
    let mut total = 0.0;
    let sums: Vec<f64> = triangles
        .iter()
        .map(|t| {
            let [a, b, c] = t.map(|v| ride.positions[v as usize]);
            let share: f64 = t.iter().map(|&v| density[v as usize]).sum();
            let thick = if field.on_lip(field.place((a + b + c) / 3.0)) {
                4.0
            } else {
                1.0
            };
            total += thick * (b - a).cross(c - a).length() * share;
            total
        })
        .collect();
    let mut part = empty("beard", material);
    let mut normals = Vec::new();
    let mut holds: Vec<Holds> = Vec::new();
    for (layer, &(count, share, width)) in TUFTS.iter().enumerate() {
        for i in 0..count {
            let id = (layer * 10_000 + i) as i64;
            let dice = |k: u64| noise::unit(seed, 200 + k, id);
            let want = (i as f64 + dice(1)) / count as f64 * total;
            let Some(t) = triangles.get(sums.partition_point(|s| *s < want)) else {
                continue;
            };
            let (u, v) = (dice(2).sqrt(), dice(3));
            let mix = |of: &[DVec3]| {
                let [a, b, c] = t.map(|v| of[v as usize]);
                a * (1.0 - u) + b * (u * (1.0 - v)) + c * (u * v)
            };
            let (root, n) = (mix(&ride.positions), mix(&ride.normals).normalize_or_zero());
            if field.density(root) < 0.6 || n == DVec3::ZERO {
                continue;
            }
            let q = field.place(root);
            let on_lip = field.on_lip(q);
            // The lips' lining looks backwards.
            if q.x.abs() < 33.0 && q.y > LIPS_Y - 16.0 && n.z < 0.25 {
                continue;
            }
            let signed = |k: u64| 2.0 * dice(k) - 1.0;
            let side = if q.x < 0.0 { -1.0 } else { 1.0 };
            let d = if on_lip {
                DVec3::new(side * slope(0.0, 9.0, q.x.abs()) * 1.1, -0.85, 0.0)
            } else {
                // Towards the point of the chin, and down.
                DVec3::new(-0.1 * side * slope(20.0, 50.0, q.x.abs()), -1.0, 0.10)
            };
            let d = d + DVec3::new(0.30 * signed(4), 0.10 * signed(5), 0.22 * signed(6));
            let lift = if on_lip { 0.12 } else { 0.34 } * (0.7 + 0.6 * dice(7)) * share;
            let along = (d - n * d.dot(n)).try_normalize().unwrap_or(DVec3::NEG_Y);
            let direction = (along + n * lift).normalize();
            let chin = slope(62.0, 15.0, q.x.abs());
            let mut length = if on_lip {
                0.0105 * (0.75 + 0.35 * slope(4.0, 20.0, q.x.abs()))
            } else {
                p.length_m * lerp(0.55, 1.0, chin)
            } * (0.75 + 0.4 * dice(8))
                * share
                * lerp(0.55, 1.0, slope(0.2, 0.9, field.density(root)))
                * head.scalp.proportions.size();
            // No tip hangs over the lips, or it would stand in the open mouth.
            while length > SHORTEST && field.to_lips(root + direction * length) < LIP_MARGIN {
                length *= 0.8;
            }
            if length <= SHORTEST {
                continue;
            }
            let hold = ride.holds(root, 3);
            let weights = ride.weights(&hold);
            let grey = palette.grey_of(id ^ 5);
            let strip = 6 + 3 * layer as u32 + (dice(9) * 4.0) as u32;
            let base = part.vertices.len() as u32;
            let across_it = direction.cross(n).normalize_or_zero();
            for t in [0.0, 1.0] {
                // The tips hang.
                let middle = root - n * 0.0006
                    + direction * (length * t)
                    + (DVec3::NEG_Y - n * 0.15) * (0.18 * length * t * t);
                let half = 0.5 * width * lerp(1.0, if layer == 0 { 0.7 } else { 0.5 }, t);
                let [r, g, b] = palette.shade(0.45 + 0.3 * t, 0.4 + 0.2 * dice(10), grey);
                for (u, sign) in [(0.02, -1.0), (0.98, 1.0)] {
                    part.vertices.push(PartVertex {
                        position: middle + across_it * (sign * half),
                        uv: [(f64::from(strip) + u) / STRIPS, t],
                        color: [
                            r,
                            g,
                            b,
                            lerp(0.93, 1.0, t) * if layer == 0 { 0.95 } else { 1.0 },
                        ],
                        weights: weights.clone(),
                    });
                    let round = n * 0.8 + DVec3::NEG_Y * (0.2 * t) + across_it * (0.3 * sign);
                    normals.push(round.try_normalize().unwrap_or(n));
                    holds.push(hold.clone());
                }
            }
            part.faces.push(vec![base, base + 1, base + 3, base + 2]);
        }
    }
    part.morphs = ride.morphs(&holds, STILL);
    part.bound = ride.bound(&holds);
    Piece {
        part,
        normals: Some(normals),
    }
}
