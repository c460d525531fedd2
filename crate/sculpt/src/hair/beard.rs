//! Beards: tufts that ride on the skin of jaw, chin and upper lip, clear of the lips.

use raconteur_base::curve::lerp;
use raconteur_base::{DVec3, noise};
use serde::{Deserialize, Serialize};

use super::card::{STRIPS, empty};
use super::colour::Palette;
use super::roots::{scattered, spread};
use super::space::Sample;
use crate::assemble::Piece;
use crate::head::{Ear, Head, Holds, Ride};
use crate::part::{MeshPart, PartVertex};
use raconteur_body::figure::Material;

/// A beard.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct BeardParams {
    /// Length at the chin, metres, 0.005..0.04.
    pub length_m: f64,
    /// Whether the upper lip is covered too.
    pub moustache: bool,
}

/// Tufts of one kind.
struct BeardLayer {
    /// Distance of the roots, metres.
    spacing: f64,
    /// Share of the full length.
    length: f64,
    /// Width of a tuft, metres.
    width: f64,
    /// Strips of the atlas, the second one excluded.
    strips: [u32; 2],
    /// Share of light that comes to it.
    light: f64,
}

/// Short ones near the skin, then those that show, then single hairs. They are wide and hold single
/// hairs: a narrow card that is filled would look like a chip.
const LAYERS: [BeardLayer; 3] = [
    BeardLayer {
        spacing: 0.0075,
        length: 0.6,
        width: 0.0095,
        strips: [5, 10],
        light: 0.8,
    },
    BeardLayer {
        spacing: 0.0050,
        length: 0.85,
        width: 0.0072,
        strips: [9, 13],
        light: 0.95,
    },
    BeardLayer {
        spacing: 0.0110,
        length: 1.05,
        width: 0.0065,
        strips: [13, 16],
        light: 1.0,
    },
];
/// Spans of a tuft.
const SPANS: u32 = 1;
/// Places that are tried.
const TRIED: usize = 12_000;
/// How much nearer the roots of a moustache are.
const LIP_SPACING: f64 = 0.6;
/// Where a beard is thinner than this nothing grows, and not everything where it is little thicker.
const LEAST_DENSITY: f64 = 0.45;
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
const LIP_MARGIN: f64 = 0.0055;
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

/// How far the tip of a tuft with a normal hangs, shares of its length.
fn sag(normal: DVec3) -> DVec3 {
    (DVec3::NEG_Y - normal * 0.15) * 0.18
}

/// A tuft: where it is rooted and how it lies.
struct Tuft {
    root: DVec3,
    normal: DVec3,
    /// Unit.
    direction: DVec3,
    /// Metres.
    length: f64,
}

impl Field<'_> {
    /// The tuft that grows at a place, if one does. `dice` gives numbers in 0..1.
    fn tuft(
        &self,
        at: &Sample,
        p: &BeardParams,
        layer: &BeardLayer,
        dice: impl Fn(u64) -> f64,
    ) -> Option<Tuft> {
        let (root, n) = (at.position, at.normal);
        let q = self.place(root);
        let on_lip = self.on_lip(q);
        let thick = self.density(root);
        // The lips' lining looks backwards.
        let in_mouth = q.x.abs() < 33.0 && q.y > LIPS_Y - 16.0 && n.z < 0.25;
        if thick < LEAST_DENSITY + 0.3 * dice(1) || in_mouth {
            return None;
        }
        let signed = |k: u64| 2.0 * dice(k) - 1.0;
        let side = if q.x < 0.0 { -1.0 } else { 1.0 };
        let combed = if on_lip {
            DVec3::new(side * slope(0.0, 9.0, q.x.abs()) * 1.1, -0.85, 0.0)
        } else {
            // Towards the point of the chin, and down.
            DVec3::new(-0.1 * side * slope(20.0, 50.0, q.x.abs()), -1.0, 0.10)
        };
        let d = combed + DVec3::new(0.30 * signed(4), 0.10 * signed(5), 0.22 * signed(6));
        let lift = if on_lip { 0.12 } else { 0.34 } * (0.7 + 0.6 * dice(7)) * layer.length;
        let along = (d - n * d.dot(n)).try_normalize().unwrap_or(DVec3::NEG_Y);
        let direction = (along + n * lift).normalize();
        let full = if on_lip {
            0.0105 * (0.75 + 0.35 * slope(4.0, 20.0, q.x.abs()))
        } else {
            p.length_m * lerp(0.55, 1.0, slope(62.0, 15.0, q.x.abs()))
        };
        let size = self.head.scalp.proportions.size();
        let edge = lerp(0.45, 1.0, slope(0.2, 0.9, thick));
        let mut length = full * (0.65 + 0.55 * dice(8)) * layer.length * edge * size;
        // No tip hangs over the lips, or it would stand in the open mouth.
        let tip = |length: f64| root + (direction + sag(n)) * length;
        while length > SHORTEST && self.to_lips(tip(length)) < LIP_MARGIN {
            length *= 0.8;
        }
        (length > SHORTEST).then_some(Tuft {
            root,
            normal: n,
            direction,
            length,
        })
    }
}

/// What is made of a beard so far.
struct Growing<'a> {
    ride: Ride,
    palette: &'a Palette,
    part: MeshPart,
    normals: Vec<DVec3>,
    holds: Vec<Holds>,
}

impl Growing<'_> {
    /// Adds a tuft as a card of two spans.
    fn add(&mut self, tuft: &Tuft, layer: &BeardLayer, dice: impl Fn(u64) -> f64, grey: f64) {
        let Tuft {
            root,
            normal: n,
            direction,
            length,
        } = *tuft;
        let hold = self.ride.holds(root, 3);
        let weights = self.ride.weights(&hold);
        let [first, last] = layer.strips;
        let strip = first + (dice(9) * f64::from(last - first)) as u32;
        let across = direction.cross(n).normalize_or_zero();
        let base = self.part.vertices.len() as u32;
        let tone = 0.3 + 0.4 * dice(10);
        for row in 0..=SPANS {
            let t = f64::from(row) / f64::from(SPANS);
            // The tips hang.
            let middle = root - n * 0.0006 + direction * (length * t) + sag(n) * (length * t * t);
            let half = 0.5 * layer.width * lerp(1.0, 0.6, t);
            let [r, g, b] = self.palette.shade(0.35 + 0.4 * t, tone, grey);
            let light = lerp(0.72, 1.0, t) * layer.light;
            for (u, sign) in [(0.02, -1.0), (0.98, 1.0)] {
                self.part.vertices.push(PartVertex {
                    position: middle + across * (sign * half),
                    uv: [(f64::from(strip) + u) / STRIPS, t],
                    color: [r, g, b, light],
                    weights: weights.clone(),
                });
                let round = n * 0.8 + DVec3::NEG_Y * (0.2 * t) + across * (0.3 * sign);
                self.normals.push(round.try_normalize().unwrap_or(n));
                self.holds.push(hold.clone());
            }
        }
        for row in 0..SPANS {
            let at = base + 2 * row;
            self.part.faces.push(vec![at, at + 1, at + 3, at + 2]);
        }
    }
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
    let triangles: Vec<[Sample; 3]> = skin
        .faces
        .iter()
        .flat_map(|f| f[1..].windows(2).map(|w| [f[0], w[0], w[1]]))
        .filter(|t| t.iter().any(|&v| density[v as usize] > 0.0))
        .map(|t| {
            t.map(|v| Sample {
                position: ride.positions[v as usize],
                normal: ride.normals[v as usize],
            })
        })
        .collect();
    let places: Vec<Sample> = scattered(&triangles, TRIED, seed + 7).collect();
    let mut growing = Growing {
        ride,
        palette,
        part: empty("beard", material),
        normals: Vec::new(),
        holds: Vec::new(),
    };
    for (number, layer) in (0..).zip(&LAYERS) {
        let roots = spread(&places, |s| {
            let on_lip = field.on_lip(field.place(s.position));
            layer.spacing * if on_lip { LIP_SPACING } else { 1.0 }
        });
        for (i, root) in (0..).zip(roots) {
            let dice = |k: u64| noise::unit(seed + number, 200 + k, i);
            if let Some(tuft) = field.tuft(&root, p, layer, dice) {
                growing.add(&tuft, layer, dice, palette.grey_of(i ^ 5));
            }
        }
    }
    let Growing {
        ride,
        mut part,
        normals,
        holds,
        ..
    } = growing;
    part.morphs = ride.morphs(&holds, STILL);
    part.bound = ride.bound(&holds);
    Piece {
        part,
        normals: Some(normals),
    }
}
