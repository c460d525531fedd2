//! Brows and lashes: slender tapering cards that ride on the skin, each a tuft of hairs.

use raconteur_base::{DVec3, Side, mirror_vector, noise, ops};
use serde::{Deserialize, Serialize};

use super::ride::{Holds, Ride};
use super::rig::smooth;
use super::surface::nearest;
use crate::part::{MeshPart, PartVertex};
use raconteur_body::figure::{Maps, Material, MaterialKind};

/// Hairs of brows and lashes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct BrowParams {
    /// Colour of the brows, linear RGB; lashes are darker.
    pub colour: [f64; 3],
    /// How many hairs a brow has against the usual, 0.3..1.6.
    pub density: f64,
    /// Length of its hairs against the usual, 0.5..2.
    pub length: f64,
    /// Height of the brow against the usual, 0.6..1.5.
    pub height: f64,
    /// How far hairs stray from their direction, 0..1.
    pub unruly: f64,
    /// How far the two brows differ, 0..1.
    pub asymmetry: f64,
    /// Length of the lashes against the usual, 0.4..1.3.
    pub lash_length: f64,
    /// Lightness of the lashes against the brows.
    pub lash_tone: f64,
}

impl Default for BrowParams {
    fn default() -> Self {
        Self {
            colour: [0.11, 0.062, 0.038],
            density: 1.0,
            length: 1.0,
            height: 1.0,
            unruly: 0.35,
            asymmetry: 0.5,
            lash_length: 1.0,
            lash_tone: 0.35,
        }
    }
}

/// One card: a parabola from the root, tapering to the tip.
struct Card {
    root: DVec3,
    direction: DVec3,
    /// Sideways displacement of the tips, mm.
    bend: DVec3,
    length: f64,
    half_width: f64,
    /// Outward direction, which the card faces.
    facing: DVec3,
    shade: f64,
}

/// Middle line of the left brow on the unshifted head, mm, from its inner end; half width.
const BROW: [[f64; 4]; 8] = [
    [12.0, 43.2, 95.5, 3.0],
    [17.5, 45.4, 95.2, 3.6],
    [24.0, 47.0, 93.6, 3.6],
    [31.0, 48.4, 91.2, 3.3],
    [38.0, 49.0, 88.0, 2.8],
    [45.5, 47.8, 82.8, 2.1],
    [52.0, 45.0, 77.5, 1.5],
    [56.0, 43.0, 72.5, 0.9],
];
/// The brow's middle line and half width at t in 0..7, warped to the person.
#[derive(Clone, Debug)]
pub(crate) struct BrowLine {
    knots: Vec<(DVec3, f64)>,
}

/// How far above the crest of the brow its hairs have their middle, mm.
const ABOVE_CREST_MM: f64 = 2.0;

/// A place on a polyline by the share of its length.
fn along(line: &[DVec3], share: f64) -> DVec3 {
    let total: f64 = line.windows(2).map(|w| w[0].distance(w[1])).sum();
    let mut left = share * total;
    for w in line.windows(2) {
        let step = w[0].distance(w[1]);
        if left <= step {
            return w[0].lerp(w[1], left / step.max(1e-9));
        }
        left -= step;
    }
    line.last().copied().unwrap_or_default()
}

impl BrowLine {
    /// Above a crest, given from its inner end.
    pub(crate) fn above(crest: &[DVec3]) -> Self {
        let mut line = crest.to_vec();
        if let [inner, next, ..] = &mut line[..] {
            // The crest begins nearer to the midline than hair does.
            let (y, z) = (0.7 * next.y + 0.3 * inner.y, 0.7 * next.z + 0.3 * inner.z);
            *inner = DVec3::new(next.x + 0.35 * (inner.x - next.x), y, z);
        }
        let at = |i: usize| DVec3::new(BROW[i][0], BROW[i][1], BROW[i][2]);
        let whole: Vec<DVec3> = (0..BROW.len()).map(at).collect();
        let length = |part: &[DVec3]| -> f64 { part.windows(2).map(|w| w[0].distance(w[1])).sum() };
        let knots = BROW
            .iter()
            .enumerate()
            .map(|(i, &[.., w])| {
                let share = length(&whole[..=i]) / length(&whole);
                let up = DVec3::Y * ABOVE_CREST_MM;
                (along(&line, 0.02 + 0.98 * share) + up, w * 1.05)
            })
            .collect();
        Self { knots }
    }

    /// Catmull–Rom through the knots.
    fn at(&self, t: f64) -> (DVec3, f64) {
        let last = self.knots.len() - 1;
        let i = (t.floor().max(0.0) as usize).min(last - 1);
        let f = t - i as f64;
        let k = |j: isize| self.knots[j.clamp(0, last as isize) as usize];
        let i = i as isize;
        let (a, b, c, d) = (k(i - 1), k(i), k(i + 1), k(i + 2));
        let p = b.0 * 2.0
            + (c.0 - a.0) * f
            + (a.0 * 2.0 - b.0 * 5.0 + c.0 * 4.0 - d.0) * (f * f)
            + (b.0 * 3.0 - a.0 - c.0 * 3.0 + d.0) * (f * f * f);
        (p / 2.0, b.1 + (c.1 - b.1) * f)
    }

    /// How much the brow's shadow of short hairs tints the skin at a place, 0..1.
    pub(crate) fn stain(&self, p: DVec3) -> f64 {
        let q = DVec3::new(p.x.abs(), p.y, p.z);
        if q.z < 45.0 || (q.y - self.knots[4].0.y).abs() > 20.0 {
            return 0.0;
        }
        let mut best = 0.0_f64;
        for i in 0..=56 {
            let t = f64::from(i) / 8.0;
            let (c, w) = self.at(t);
            let d = (c - q).truncate().length() / w;
            let ends = smooth(-0.8, 1.2, t) * smooth(6.9, 4.8, t);
            best = best.max(ops::exp(-d * d * 1.5) * ends);
        }
        best
    }
}

/// Seeded numbers of one hair.
struct Dice {
    seed: u64,
    hair: u64,
    next: i64,
}

impl Dice {
    fn unit(&mut self) -> f64 {
        self.next += 1;
        noise::unit(self.seed, self.hair, self.next)
    }

    fn signed(&mut self) -> f64 {
        2.0 * self.unit() - 1.0
    }

    /// Roughly normal with standard deviation 1.
    fn normal(&mut self) -> f64 {
        (self.unit() + self.unit() + self.unit() + self.unit() - 2.0) * 1.732
    }
}

fn tangent_to(d: DVec3, n: DVec3, lift: f64) -> DVec3 {
    (d - n * d.dot(n)).normalize() + n * lift
}

/// Hairs of a usual brow.
const HAIRS_PER_BROW: f64 = 150.0;

fn brow(ride: &Ride, line: &BrowLine, side: Side, seed: u64, p: &BrowParams) -> Vec<Card> {
    // Roots are laid on the skin by its nearest vertices in the front view.
    let front: Vec<u32> = (0..ride.positions.len() as u32)
        .filter(|&v| {
            let p = ride.positions[v as usize] * 1e3;
            p.z > 45.0 && p.x * side.sign() > 4.0 && p.y > 34.0 && p.y < 66.0
        })
        .collect();
    let at = |v: u32| ride.positions[v as usize] * 1e3;
    let flat: Vec<DVec3> = front.iter().map(|&v| at(v).with_z(0.0)).collect();
    let count = (HAIRS_PER_BROW * p.density.clamp(0.1, 2.0)) as u64;
    // One brow sits a little higher and thicker than the other.
    let own = 0.5 * p.asymmetry * side.sign() * (noise::unit(seed, 91, 0) + 0.5);
    (0..count)
        .map(|hair| {
            let mut dice = Dice {
                seed: seed ^ side.index() as u64,
                hair,
                next: 0,
            };
            let layer = hair % 3;
            let t = (hair as f64 + dice.unit()) / count as f64 * 6.9 - 0.1;
            let off = (0.52 * dice.normal() + [-0.15, 0.0, 0.2][layer as usize]).clamp(-1.2, 1.2);
            let (c, w) = line.at(t);
            let w = w * p.height * (1.0 + 0.16 * own);
            let along = line.at(t + 0.05).0 - line.at(t - 0.05).0;
            let place = DVec3::new(c.x, c.y + off * w * 0.85 + 0.7 * own, 0.0);
            let turn = |d: DVec3| {
                if side == Side::Left {
                    d
                } else {
                    mirror_vector(d)
                }
            };
            let (place, along) = (turn(place), turn(along.normalize()));
            let near = nearest(&flat, place, 4, 0.1);
            let (mut root, mut n) = (DVec3::ZERO, DVec3::ZERO);
            for &(i, s) in &near {
                root += at(front[i as usize]) * s;
                n += ride.normals[front[i as usize] as usize] * s;
            }
            let n = n.normalize();
            root.x = place.x;
            root.y = place.y;
            // Inner hairs stand, outer ones lie; the upper row leans down to meet the lower.
            let stand = 1.1 - 0.95 * smooth(-0.2, 2.6, t) - 0.22 * smooth(3.0, 7.0, t);
            let meet = 0.55 * off.max(0.0) * smooth(0.8, 2.2, t);
            let stray = p.unruly * dice.normal();
            let up = stand - meet + 0.36 * stray;
            let lift = 0.14 + 0.06 * dice.unit() + 0.22 * p.unruly * dice.unit();
            let direction = tangent_to(along + DVec3::Y * up, n, lift);
            let length = (4.4 + 3.2 * smooth(0.0, 2.5, t) - 3.2 * smooth(4.5, 7.0, t))
                * (0.55 + 0.55 * dice.unit())
                * p.length;
            Card {
                root: root - n * 0.15,
                direction: direction.normalize(),
                bend: along * 0.10 * length
                    - n * 0.14 * length
                    - DVec3::Y * (0.06 + 0.10 * p.unruly * dice.unit()) * length,
                length,
                half_width: 0.20,
                facing: n,
                shade: 0.72 + 0.5 * dice.unit(),
            }
        })
        .collect()
}

/// Lashes along a lid's edge given as points from the inner to the outer corner.
fn lashes(
    edge: &[DVec3],
    globe: DVec3,
    upper: bool,
    side: Side,
    seed: u64,
    p: &BrowParams,
) -> Vec<Card> {
    let (count, length, half_width) = if upper {
        (48, 8.0 * p.lash_length, 0.30)
    } else {
        (22, 3.4 * p.lash_length, 0.22)
    };
    let sign = if upper { 1.0 } else { -1.0 };
    (0..count)
        .map(|hair| {
            let id = hair + 1000 * u64::from(upper) + 5000 * side.index() as u64;
            let mut dice = Dice {
                seed: seed ^ 77,
                hair: id,
                next: 0,
            };
            let s = ((hair as f64 + 0.5 + 0.35 * dice.signed()) / count as f64).clamp(0.0, 1.0);
            let s = 0.06 + 0.92 * s;
            let x = s * (edge.len() - 1) as f64;
            let i = (x.floor() as usize).min(edge.len() - 2);
            let root = edge[i].lerp(edge[i + 1], x - i as f64);
            let out = (root - globe).normalize();
            // Lashes fan out, the outer ones most, and gather in loose tufts.
            let fan = (s - 0.42) * 1.5 + 0.10 * ops::sin(s * 40.0) + 0.07 * dice.signed();
            let down = if upper { -0.30 } else { -0.42 };
            let direction = DVec3::new(
                out.x * 0.55 + fan * 0.62 * side.sign(),
                out.y * 0.9 + down,
                out.z * 0.95,
            ) + DVec3::new(0.0, 0.06 * dice.signed(), 0.06 * dice.signed());
            let ends = smooth(-0.25, 0.4, s) * (1.0 - 0.22 * smooth(0.85, 1.0, s));
            let length = length * (0.72 + 0.4 * dice.unit()) * ends;
            Card {
                root: root - out * 0.1,
                direction: direction.normalize(),
                bend: DVec3::Y * (sign * if upper { 0.52 } else { 0.18 } * length),
                length,
                half_width,
                facing: if upper { DVec3::Y } else { DVec3::Z },
                // The lower row is finer and lighter.
                shade: (0.75 + 0.4 * dice.unit()) * if upper { 1.0 } else { 2.2 },
            }
        })
        .collect()
}

/// Rows of a card from root to tip.
const STEPS: [f64; 3] = [0.0, 0.55, 1.0];

/// Movements of a hair below this are left out, metres.
const STILL: f64 = 1.2e-4;

fn part(name: String, cards: &[Card], ride: &Ride, near: usize, color: [f64; 3]) -> MeshPart {
    let mut part = MeshPart {
        name,
        material: Material {
            kind: MaterialKind::Lash,
            base_color: [1.0; 4],
            roughness: 0.55,
            double_sided: true,
            maps: Maps::default(),
        },
        vertices: Vec::new(),
        faces: Vec::new(),
        morphs: Vec::new(),
        bound: Vec::new(),
    };
    let mut roots: Vec<Holds> = Vec::new();
    for card in cards {
        let base = part.vertices.len() as u32;
        let holds = ride.holds(card.root * 1e-3, near);
        let weights = ride.weights(&holds);
        let across = card.direction.cross(card.facing).normalize();
        let [r, g, b] = color.map(|c| (c * card.shade).clamp(0.0, 1.0));
        for &t in &STEPS {
            let middle = card.root + card.direction * (card.length * t) + card.bend * (t * t);
            // The tip is one vertex.
            let sides: &[f64] = if t < 1.0 { &[-1.0, 1.0] } else { &[0.0] };
            for &s in sides {
                let aside = across * (s * card.half_width * (1.0 - 0.6 * t));
                part.vertices.push(PartVertex {
                    position: (middle + aside) * 1e-3,
                    uv: [0.5 + 0.5 * s, t],
                    color: [r, g, b, 1.0],
                    weights: weights.clone(),
                });
                roots.push(holds.clone());
            }
        }
        let quads = STEPS.len() as u32 - 2;
        for q in 0..quads {
            let a = base + 2 * q;
            part.faces.push(vec![a, a + 1, a + 3, a + 2]);
        }
        let a = base + 2 * quads;
        part.faces.push(vec![a, a + 1, a + 2]);
    }
    part.morphs = ride.morphs(&roots, STILL);
    part.bound = ride.bound(&roots);
    part
}

/// Brow and lashes of one side. `edges` are the lash edges of the upper and the lower lid
/// from the inner to the outer corner.
#[allow(clippy::too_many_arguments, reason = "each is a thing of its own")]
pub(crate) fn hairs(
    ride: &Ride,
    line: &BrowLine,
    edges: &[Vec<DVec3>; 2],
    globe: DVec3,
    side: Side,
    seed: u64,
    p: &BrowParams,
) -> Vec<MeshPart> {
    let color = p.colour;
    let letter = if side == Side::Left { "left" } else { "right" };
    let brow = brow(ride, line, side, seed, p);
    let mut lash = lashes(&edges[0], globe, true, side, seed, p);
    lash.extend(lashes(&edges[1], globe, false, side, seed, p));
    vec![
        part(format!("brow_{letter}"), &brow, ride, 3, color),
        part(
            format!("lash_{letter}"),
            &lash,
            ride,
            2,
            color.map(|c| c * p.lash_tone),
        ),
    ]
}
