//! Beards: tufts on the skin of jaw, chin and upper lip, clear of the lips.

use raconteur_base::curve::lerp;
use raconteur_base::{DVec3, noise};
use serde::{Deserialize, Serialize};

use super::card::{STRIPS, empty};
use super::colour::Palette;
use super::cut::{BeardCut, LIPS_Y, height_of, on_lip, slope};
use super::roots::{scattered, spread};
use super::space::Sample;
use crate::assemble::PartWithNormals;
use crate::head::{Ear, Head, ScalpBinding, VertexWeights};
use crate::part::{MeshPart, PartVertex};
use raconteur_body::figure::Material;

/// Parameters of a beard: length, cut and density.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct BeardParams {
    /// Length at the chin, metres, 0.005..0.04.
    pub length_m: f64,
    /// Cut of the beard.
    #[serde(default)]
    pub cut: BeardCut,
    /// Density of the roots: 1 over a skin that also has a painted beard, 1.6 without one.
    #[serde(default = "sparse")]
    pub density: f64,
}

fn sparse() -> f64 {
    1.0
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
    /// Share of light that reaches it.
    light: f64,
}

/// Layers: short hairs near the skin, visible ones, then single hairs. Their cards are wide with
/// sparse hairs: a narrow filled card would look like a chip.
const LAYERS: [BeardLayer; 3] = [
    BeardLayer {
        spacing: 0.0075,
        length: 0.6,
        width: 0.0085,
        strips: [9, 13],
        light: 0.8,
    },
    BeardLayer {
        spacing: 0.0050,
        length: 0.85,
        width: 0.0072,
        strips: [10, 14],
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
/// Number of candidate positions.
const TRIED: usize = 12_000;
/// Additional number of candidate roots for each unit of beard density above 1.
const TRIED_DENSE: f64 = 24_000.0;
/// Beard density below which nothing grows; slightly above it, growth is partial.
const MIN_DENSITY: f64 = 0.45;
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
/// A tuft moved less than this by a morph stays, metres: its neighbours hide the rest.
const STILL: f64 = 7e-4;
/// Lift of a tuft from the skin if the beard must also fit other faces with different curvature.
const LIFT_ALONE: f64 = 0.62;
/// The shortest tuft, metres.
const MIN_LENGTH_M: f64 = 0.003;

/// Region in which a beard grows.
struct Field<'a> {
    head: &'a Head,
    lips: Vec<DVec3>,
    lips_y: f64,
    cut: BeardCut,
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
            cut: p.cut,
        }
    }

    /// Returns the position on the common head, with the lips at their common height, mm.
    fn place(&self, p: DVec3) -> DVec3 {
        let q = self.head.scalp.proportions.common(p) * 1e3;
        q - DVec3::Y * (self.lips_y - LIPS_Y) * slope(10.0, -30.0, q.y)
    }

    /// Returns the distance of a point from the lips, metres.
    fn to_lips(&self, p: DVec3) -> f64 {
        let squared = self.lips.iter().map(|l| l.distance_squared(p));
        squared.fold(f64::MAX, f64::min).sqrt()
    }

    fn density(&self, p: DVec3) -> f64 {
        let q = self.place(p);
        let edge = height_of(&EDGE, q.x.abs());
        let in_ear = |e: &Ear| {
            let reach = e.radii + DVec3::splat(0.003);
            e.radii.x > 0.0 && ((p - e.centre) / reach).length_squared() < 1.0
        };
        if self.head.scalp.ears.iter().any(in_ear) {
            return 0.0;
        }
        let lip = self.to_lips(p);
        slope(-2.0, 9.0, edge - q.y)
            * slope(-104.0, -90.0, q.y)
            * slope(-2.0, 12.0, q.z)
            * slope(0.0014, 0.0032, lip)
            * self.cut.share(q)
    }
}

/// Returns the share of the skin that the beard covers at each vertex of the head, 0..1.
pub(super) fn cover(head: &Head, p: &BeardParams) -> Vec<f64> {
    let field = Field::new(head, p);
    head.skin()
        .vertices
        .iter()
        .map(|v| field.density(v.position))
        .collect()
}

/// Returns the sag of the tip of a tuft with a normal, shares of its length, where it does not
/// rise.
fn sag(normal: DVec3, rise: f64) -> DVec3 {
    (DVec3::NEG_Y - normal * 0.15) * 0.18 + (DVec3::Y - normal * 0.1) * rise
}

/// Tuft, with its root and direction.
struct Tuft {
    root: DVec3,
    normal: DVec3,
    /// Unit.
    direction: DVec3,
    /// Metres.
    length: f64,
    /// Offset of its tip from that of a straight one, shares of the length.
    sag: DVec3,
}

impl Field<'_> {
    /// Returns the tuft at a position, if one grows there. `dice` gives numbers in 0..1.
    fn tuft(
        &self,
        at: &Sample,
        p: &BeardParams,
        layer: &BeardLayer,
        dice: impl Fn(u64) -> f64,
    ) -> Option<Tuft> {
        let (root, n) = (at.position, at.normal);
        let q = self.place(root);
        let on_lip = on_lip(q);
        let thick = self.density(root);
        // The lining of the lips faces backwards.
        let in_mouth = q.x.abs() < 33.0 && q.y > LIPS_Y - 16.0 && n.z < 0.25;
        if thick < MIN_DENSITY + 0.3 * dice(1) || in_mouth {
            return None;
        }
        let signed = |k: u64| 2.0 * dice(k) - 1.0;
        let side = if q.x < 0.0 { -1.0 } else { 1.0 };
        let combed = if on_lip {
            self.cut.lip_combed(q)
        } else {
            // Towards the point of the chin, and down.
            DVec3::new(-0.1 * side * slope(20.0, 50.0, q.x.abs()), -1.0, 0.10)
        };
        let d = combed + DVec3::new(0.30 * signed(4), 0.10 * signed(5), 0.22 * signed(6));
        let lift = if p.density > 1.0 {
            LIFT_ALONE
        } else if on_lip {
            0.12
        } else {
            0.34
        };
        let lift = lift * (0.7 + 0.6 * dice(7)) * layer.length;
        let along = (d - n * d.dot(n)).try_normalize().unwrap_or(DVec3::NEG_Y);
        let direction = (along + n * lift).normalize();
        let full = if on_lip {
            self.cut.lip_m(q)
        } else {
            p.length_m * lerp(0.55, 1.0, slope(62.0, 15.0, q.x.abs()))
        };
        let size = self.head.scalp.proportions.size();
        let edge = lerp(0.45, 1.0, slope(0.2, 0.9, thick));
        let mut length = full * (0.65 + 0.55 * dice(8)) * layer.length * edge * size;
        // No tip hangs over the lips, because it would be in the open mouth.
        let sag = sag(n, self.cut.rise(q));
        let tip = |length: f64| root + (direction + sag) * length;
        if p.density > 1.0 && on_lip && self.cut != BeardCut::Handlebar {
            // The tuft is isolated, and may reach the edge of the lip but not cover the mouth.
            length = length.min(1.1 * self.to_lips(root) + 0.0035);
        } else {
            while length > MIN_LENGTH_M && self.to_lips(tip(length)) < self.cut.lip_margin() {
                length *= 0.8;
            }
        }
        (length > MIN_LENGTH_M).then_some(Tuft {
            root,
            normal: n,
            direction,
            length,
            sag,
        })
    }
}

/// Beard under construction.
struct BeardInProgress<'a> {
    ride: ScalpBinding,
    palette: &'a Palette,
    /// Spans of a tuft.
    spans: u32,
    density: f64,
    part: MeshPart,
    normals: Vec<DVec3>,
    holds: Vec<VertexWeights>,
}

impl BeardInProgress<'_> {
    /// Adds a tuft as a card.
    fn add(&mut self, tuft: &Tuft, layer: &BeardLayer, dice: impl Fn(u64) -> f64, grey: f64) {
        let Tuft {
            root,
            normal: n,
            direction,
            length,
            sag,
        } = *tuft;
        let hold = self.ride.nearest_vertices(root, 3);
        let weights = self.ride.weights(&hold);
        let [first, last] = layer.strips;
        let strip = first + (dice(9) * f64::from(last - first)) as u32;
        let across = direction.cross(n).normalize_or_zero();
        let base = self.part.vertices.len() as u32;
        // Tufts that differ much would show as flakes.
        let tone = 0.42 + 0.18 * dice(10);
        // In a dense beard, a short tuft as wide as a long one would look like a chip.
        let (narrow, sunk) = if self.density > 1.0 {
            (lerp(0.35, 0.9, slope(0.003, 0.016, length)), 0.0002)
        } else {
            (1.0, 0.0006)
        };
        for row in 0..=self.spans {
            let t = f64::from(row) / f64::from(self.spans);
            // The tips hang.
            let middle = root - n * sunk + direction * (length * t) + sag * (length * t * t);
            let half = 0.5 * layer.width * narrow * lerp(1.0, 0.4, t);
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
        for row in 0..self.spans {
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
) -> PartWithNormals {
    let skin = head.skin();
    let ride = ScalpBinding::new(skin);
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
    let tried = TRIED + (TRIED_DENSE * (p.density - 1.0).max(0.0)) as usize;
    let places: Vec<Sample> = scattered(&triangles, tried, seed + 7).collect();
    let mut growing = BeardInProgress {
        ride,
        palette,
        spans: p.cut.spans(),
        density: p.density,
        part: empty("beard", material),
        normals: Vec::new(),
        holds: Vec::new(),
    };
    for (number, layer) in (0..).zip(&LAYERS) {
        let roots = spread(&places, |s| {
            let is_lip = on_lip(field.place(s.position));
            layer.spacing / p.density * if is_lip { p.cut.lip_spacing() } else { 1.0 }
        });
        for (i, root) in (0..).zip(roots) {
            let dice = |k: u64| noise::unit(seed + number, 200 + k, i);
            if let Some(tuft) = field.tuft(&root, p, layer, dice) {
                growing.add(&tuft, layer, dice, palette.grey_of(i ^ 5));
            }
        }
    }
    let BeardInProgress {
        ride,
        mut part,
        normals,
        holds,
        ..
    } = growing;
    part.morphs = ride.morphs(&holds, STILL);
    part.bound = ride.bound(&holds);
    PartWithNormals {
        part,
        normals: Some(normals),
    }
}
