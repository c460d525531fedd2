//! A bob to the jaw with a side parting, combed clear of the face.

use raconteur_base::curve::ramp;
use serde::{Deserialize, Serialize};
use raconteur_base::{DVec3, noise, ops};

use super::card::{Strand, cards};
use super::skin::Skin;
use crate::figure::{Maps, Material, MaterialKind};
use crate::generator::assemble::Piece;
use crate::generator::head::{Head, ScalpPoint};
use crate::generator::subdivide::vertex_normals;

/// A bob's measures; frame of the head, metres.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct BobParams {
    /// Colour, linear RGB.
    pub colour: [f64; 3],
    /// Where the hair is parted, to the left.
    pub parting_x: f64,
    /// Height of the ends (the chin lies at −0.089).
    pub hem_y: f64,
    /// Width of the waves to either side.
    pub wave: f64,
    /// Seed of all that is scattered.
    pub seed: u64,
}

/// Cards of one height above the scalp.
struct Layer {
    cards: usize,
    /// Spans of a card.
    spans: usize,
    height: f64,
    width: f64,
    /// Openness at the roots and the tips.
    open: [f64; 2],
    /// Length against the full one.
    length: f64,
    /// Longest card, metres.
    longest: f64,
    /// Where it is rooted.
    roots: Roots,
}

/// Where a layer's cards are rooted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Roots {
    All,
    Hairline,
    Parting,
}

const LAYERS: [Layer; 6] = [
    layer(60, 0.0035, 0.030, [0.40, 0.50], 1.0),
    layer(100, 0.0070, 0.022, [0.55, 0.70], 0.99),
    layer(135, 0.0105, 0.017, [0.70, 0.95], 0.97),
    layer(75, 0.0130, 0.012, [0.80, 1.0], 0.95),
    // Fine hair along the hairline hides where the others begin.
    Layer {
        cards: 130,
        spans: 5,
        height: 0.0030,
        width: 0.009,
        open: [0.75, 0.9],
        length: 0.6,
        longest: 0.075,
        roots: Roots::Hairline,
    },
    // And fine hair along the parting.
    Layer {
        cards: 170,
        spans: 6,
        height: 0.0080,
        width: 0.008,
        open: [0.8, 1.0],
        length: 0.8,
        longest: 0.11,
        roots: Roots::Parting,
    },
];

const fn layer(cards: usize, height: f64, width: f64, open: [f64; 2], length: f64) -> Layer {
    Layer {
        cards,
        spans: 10,
        height,
        width,
        open,
        length,
        longest: 0.5,
        roots: Roots::All,
    }
}

const MM: f64 = 1e-3;
/// Steps of growth for one span of a card.
const FINER: usize = 4;

/// Makes the hair of a head, in the head's frame.
#[must_use]
pub fn bob(head: &Head, p: &BobParams) -> Piece {
    let skin = skin_of(head);
    let mut strands = Vec::new();
    for (l, layer) in LAYERS.iter().enumerate() {
        for (i, root) in roots(head, p, layer, l as u64).into_iter().enumerate() {
            let id = (l * 1000 + i) as i64;
            strands.extend(strand(&skin, p, layer, root, id));
        }
    }
    let [r, g, b] = p.colour.map(|x| x as f32);
    let material = Material {
        kind: MaterialKind::Hair,
        base_color: [r, g, b, 1.0],
        roughness: 0.45,
        double_sided: true,
        maps: Maps::default(),
    };
    cards("hair", &material, &strands)
}

fn skin_of(head: &Head) -> Skin {
    let part = &head.parts[0];
    let positions: Vec<DVec3> = part.vertices.iter().map(|v| v.position).collect();
    let normals = vertex_normals(&positions, &part.faces);
    let smooth_part = |p: DVec3| {
        let ear = p.x.abs() > 66.0 * MM
            && p.y.abs() < 40.0 * MM
            && (-45.0 * MM..15.0 * MM).contains(&p.z);
        // Below the skull's base the neck is the body's.
        p.y > -0.10 && !ear
    };
    Skin::new(
        positions
            .into_iter()
            .zip(normals)
            .filter(|(p, _)| smooth_part(*p))
            .collect(),
    )
}

/// How far hair stands off the head to pass over an ear: a smooth bump in its place.
fn over_ear(p: DVec3) -> f64 {
    let (y, z) = (
        (p.y - 8.0 * MM) / (46.0 * MM),
        (p.z + 16.0 * MM) / (40.0 * MM),
    );
    24.0 * MM * ramp(45.0 * MM, 65.0 * MM, p.x.abs()) * ops::exp(-y * y - z * z)
}

/// Roots spread over the scalp by area and density, denser along the parting.
fn roots(head: &Head, p: &BobParams, layer: &Layer, number: u64) -> Vec<ScalpPoint> {
    let count = layer.cards;
    let scalp = &head.scalp;
    let corner = |t: &[u32; 3]| t.map(|i| scalp.points[i as usize]);
    let mut total = 0.0;
    let sums: Vec<f64> = scalp
        .triangles
        .iter()
        .map(|t| {
            let [a, b, c] = corner(t);
            let area = (b.position - a.position)
                .cross(c.position - a.position)
                .length();
            let middle = (a.position + b.position + c.position) / 3.0;
            let off = (middle.x - p.parting_x) / (9.0 * MM);
            let on_top = middle.y > 60.0 * MM && middle.z > -60.0 * MM;
            let parting = if on_top {
                3.0 * ops::exp(-off * off)
            } else {
                0.0
            };
            let density = (a.density + b.density + c.density) / 3.0;
            let wanted = match layer.roots {
                Roots::All => density * (1.0 + parting),
                Roots::Hairline if middle.z > -20.0 * MM => 4.0 * density * (1.0 - density),
                Roots::Hairline => 0.0,
                Roots::Parting => density * parting,
            };
            total += area * wanted;
            total
        })
        .collect();
    (0..count)
        .filter_map(|i| {
            let id = |k: u64| k + 8 * number;
            let jitter = noise::unit(p.seed, id(1), i as i64);
            let want = (i as f64 + jitter) / count as f64 * total;
            let t = scalp.triangles.get(sums.partition_point(|s| *s < want))?;
            let [a, b, c] = corner(t);
            let (mut u, mut v) = (
                noise::unit(p.seed, id(2), i as i64),
                noise::unit(p.seed, id(3), i as i64),
            );
            if u + v > 1.0 {
                (u, v) = (1.0 - u, 1.0 - v);
            }
            let w = 1.0 - u - v;
            let mix = |f: fn(&ScalpPoint) -> DVec3| f(&a) * w + f(&b) * u + f(&c) * v;
            Some(ScalpPoint {
                position: mix(|s| s.position),
                normal: mix(|s| s.normal).try_normalize()?,
                density: a.density * w + b.density * u + c.density * v,
            })
        })
        .collect()
}

/// Which way a strand leaves its root.
fn comb(root: &ScalpPoint, p: &BobParams) -> DVec3 {
    let q = root.position;
    let off = q.x - p.parting_x;
    let sign = if off < 0.0 { -1.0 } else { 1.0 };
    let top = ramp(55.0 * MM, 100.0 * MM, q.y);
    let front = ramp(-10.0 * MM, 50.0 * MM, q.z);
    let d = if q.z < -30.0 * MM {
        DVec3::new(0.35 * sign * top, -1.0, -0.35)
    } else {
        DVec3::new(sign * (0.15 + top), -0.75 + 0.5 * top, -0.25 - 0.75 * front)
    };
    let n = root.normal;
    let tangent = (d - n * d.dot(n)).try_normalize().unwrap_or(DVec3::NEG_Y);
    // Hair stands up a little at the parting before it falls.
    tangent + n * (0.10 + 0.06 * top * ops::exp(-off.abs() / (30.0 * MM)))
}

/// Grows one strand; `None` when it would stray from the head.
fn strand(skin: &Skin, p: &BobParams, layer: &Layer, root: ScalpPoint, id: i64) -> Option<Strand> {
    let q = match layer.roots {
        // Fine hair stands in a line where the hair divides.
        Roots::Parting => {
            let q = root.position;
            let x = p.parting_x + 0.3 * (q.x - p.parting_x);
            skin.settle(q.with_x(x), 0.0, 1.0).0
        }
        Roots::All | Roots::Hairline => root.position,
    };
    let top = ramp(55.0 * MM, 100.0 * MM, q.y);
    let random = |k: u64| noise::signed(p.seed, 100 + k, id);
    let fall = (q.y - p.hem_y).clamp(0.05, 0.6);
    let length =
        ((fall + 0.008 + 0.045 * top) * layer.length).min(layer.longest) * (1.0 + 0.02 * random(1));
    let steps = layer.spans * FINER;
    let step = length / steps as f64;
    let mut at = q - root.normal * 0.5 * MM;
    let mut direction = comb(&root, p).normalize();
    let mut normal = root.normal;
    let mut curve = vec![at];
    let mut normals = vec![normal];
    for i in 1..=steps {
        let t = i as f64 / steps as f64;
        let gravity = 0.34 * (0.35 + 0.65 * t) / FINER as f64;
        direction = (direction * (1.0 - gravity) + DVec3::NEG_Y * gravity).normalize();
        // What hangs in front of the ears is combed back.
        let below_crown = ((95.0 * MM - at.y) / (55.0 * MM)).clamp(0.0, 1.0);
        let before_ear = ramp(14.0 * MM, 44.0 * MM, at.z) * below_crown;
        direction = (direction + DVec3::NEG_Z * (0.55 / FINER as f64) * before_ear).normalize();
        let height = 1.0 * MM + layer.height * ramp(-0.012, 0.04, i as f64 * step) + over_ear(at);
        // It clings to the head down to the ears and hangs free below.
        let cling = 0.16 * ramp(-40.0 * MM, 20.0 * MM, at.y);
        let (pushed, _) = skin.settle(at + direction * step, height, cling);
        direction = (direction * 0.7 + (pushed - at).try_normalize().unwrap_or(direction) * 0.3)
            .normalize();
        let (pushed, found) = skin.settle(at + direction * step, height, cling);
        at = pushed;
        normal = found.unwrap_or(normal);
        curve.push(at);
        normals.push(normal);
    }
    wave(&mut curve, &normals, p, layer, q, step, random(2));
    for c in curve.iter_mut().skip(1) {
        *c = skin.settle(*c, 1.5 * MM + 0.8 * over_ear(*c), 0.0).0;
    }
    let (curve, normals) = thinned(&curve, &normals, layer.spans);
    let strays = |c: &DVec3| {
        c.y > -30.0 * MM
            && skin
                .height(*c)
                .is_none_or(|(h, _)| h > layer.height + over_ear(*c) + 16.0 * MM)
    };
    // Nor may it grow through an ear or hang before it.
    let pierces = |c: &DVec3| {
        (62.0 * MM..87.0 * MM).contains(&c.x.abs())
            && (-30.0 * MM..26.0 * MM).contains(&c.y)
            && (-26.0 * MM..28.0 * MM).contains(&c.z)
    };
    if curve.iter().any(|c| strays(c) || pierces(c)) {
        return None;
    }
    Some(Strand {
        curve,
        normals,
        width: layer.width * (1.0 + 0.25 * random(3)),
        tip: if layer.roots == Roots::All { 0.9 } else { 0.5 },
        // Cut hair ends bluntly; the fine hair at the line runs out.
        end: if layer.roots == Roots::All { 0.84 } else { 1.0 },
        tint: 0.62 * (1.0 + 0.14 * random(4)),
        open: layer.open,
    })
}

/// The path without its corners, at the card's own points: closer together near the root,
/// where hair bends over the crown.
fn thinned(curve: &[DVec3], normals: &[DVec3], spans: usize) -> (Vec<DVec3>, Vec<DVec3>) {
    let mut smooth = curve.to_vec();
    for _ in 0..4 {
        let before = smooth.clone();
        for i in 1..before.len() - 1 {
            smooth[i] = before[i] * 0.5 + (before[i - 1] + before[i + 1]) * 0.25;
        }
    }
    let last = curve.len() - 1;
    (0..=spans)
        .map(|i| {
            let t = ops::pow(i as f64 / spans as f64, 1.3) * last as f64;
            let k = (t as usize).min(last - 1);
            let f = t - k as f64;
            (
                smooth[k].lerp(smooth[k + 1], f),
                normals[k]
                    .lerp(normals[k + 1], f)
                    .try_normalize()
                    .unwrap_or(normals[k]),
            )
        })
        .unzip()
}

/// Gentle waves, in step between neighbours, and ends that turn in.
fn wave(
    curve: &mut [DVec3],
    normals: &[DVec3],
    p: &BobParams,
    layer: &Layer,
    root: DVec3,
    step: f64,
    random: f64,
) {
    let azimuth = ops::atan2(root.x, root.z);
    let phase = 1.5 * ops::sin(azimuth * 5.0) + 0.25 * random + layer.height * 80.0;
    let n = curve.len();
    let straight = curve.to_vec();
    for i in 1..n {
        let along = (straight[(i + 1).min(n - 1)] - straight[i - 1]).normalize_or_zero();
        let side = along.cross(normals[i]).normalize_or_zero();
        let arc = i as f64 * step;
        let amount = p.wave * ramp(0.05, 0.16, arc);
        let turn = arc / 0.095 * core::f64::consts::TAU + phase;
        let t = i as f64 / (n - 1) as f64;
        let curl = (t - 0.72).max(0.0);
        curve[i] += side * (amount * ops::sin(turn))
            + normals[i] * (amount * 0.7 * (ops::cos(turn) + 0.5) - 0.16 * curl * curl);
    }
}
