//! Mouth interior: two rows of teeth on gums, and the tongue.
//!
//! Widths and heights of the crowns after the means in Ash and Nelson, Wheeler's Dental Anatomy
//! (*paper*, rounded); the arches are ellipses chosen by eye.

use core::f64::consts::TAU;

use raconteur_base::{DVec3, ops};

use super::rig::smooth;
use crate::part::{GUMS, JointRef, MeshPart, PartMorph, PartVertex, TEETH};
use raconteur_body::figure::{Material, MaterialKind, TextureMaps};
use raconteur_body::skeleton::{Bone, Drive};

/// Crowns from the midline backwards: width, height, thickness at the gum, at the edge (mm), and
/// the narrowing of the edge (1: none).
type Crown = [f64; 5];

const UPPER: [Crown; 7] = [
    [8.5, 10.0, 6.8, 1.6, 0.96],
    [6.6, 9.0, 6.0, 1.5, 0.92],
    [7.5, 9.8, 7.6, 1.8, 0.48],
    [7.0, 8.2, 8.6, 6.4, 0.78],
    [6.8, 7.8, 8.6, 6.8, 0.80],
    [10.0, 7.2, 10.4, 9.2, 0.92],
    [9.4, 6.8, 10.2, 9.0, 0.92],
];
const LOWER: [Crown; 7] = [
    [5.2, 8.8, 5.8, 1.3, 0.98],
    [5.7, 8.8, 6.0, 1.3, 0.96],
    [6.8, 9.6, 7.2, 1.7, 0.52],
    [7.0, 8.2, 7.6, 5.4, 0.76],
    [7.1, 7.8, 8.0, 6.6, 0.82],
    [10.8, 7.2, 10.0, 9.0, 0.92],
    [10.4, 6.8, 9.8, 8.8, 0.92],
];

/// Distance of each crown's edge from the row's level, towards its gums, mm: lateral incisors are
/// shorter, and behind the canines the upper row rises as the smile does. Designed.
const EDGES: [f64; 7] = [0.0, 0.8, 0.1, 0.5, 0.7, 1.0, 1.3];

/// Row of teeth: position of the incisors' front face and edge, the ellipse, direction of the gums.
struct Arch {
    front: DVec3,
    half_width: f64,
    depth: f64,
    /// +1 for the upper row, whose gums are above.
    up: f64,
    joint: Drive,
}

/// Returns a point on the arch at an arc length from the midline, mm: position, tangent (outwards
/// to the side), outward normal.
fn station(arch: &Arch, length: f64) -> (DVec3, DVec3, DVec3) {
    let at = |t: f64| {
        DVec3::new(
            arch.half_width * ops::sin(t),
            0.0,
            -arch.depth * (1.0 - ops::cos(t)),
        )
    };
    let (mut t, mut walked) = (0.0, 0.0);
    let step = 0.004;
    while walked < length.abs() && t < 2.0 {
        walked += (at(t + step) - at(t)).length();
        t += step;
    }
    let sign = if length < 0.0 { -1.0 } else { 1.0 };
    let tangent = (at(t + 0.01) - at(t - 0.01)).normalize();
    let flip = |v: DVec3| DVec3::new(v.x * sign, v.y, v.z);
    let normal = DVec3::new(-tangent.z, 0.0, tangent.x);
    (arch.front + flip(at(t)), flip(tangent), flip(normal))
}

fn empty(name: &str, kind: MaterialKind, roughness: f32) -> MeshPart {
    MeshPart {
        name: name.to_owned(),
        material: Material {
            kind,
            base_color: [1.0; 4],
            roughness,
            double_sided: false,
            maps: TextureMaps::default(),
        },
        vertices: Vec::new(),
        faces: Vec::new(),
        morphs: Vec::new(),
        bound: Vec::new(),
    }
}

fn push(part: &mut MeshPart, p: DVec3, color: [f64; 4], weights: &[(JointRef, f64)]) -> u32 {
    part.vertices.push(PartVertex {
        position: p * 1e-3,
        uv: [0.0, 0.0],
        color,
        weights: weights.iter().copied().filter(|w| w.1 > 0.0).collect(),
    });
    part.vertices.len() as u32 - 1
}

/// Joins consecutive closed rings of `n` vertices and caps the last with a fan. The rings must run
/// counter-clockwise as seen from the cap's side.
fn tube(part: &mut MeshPart, base: u32, rings: u32, n: u32, cap: u32) {
    for r in 0..rings - 1 {
        for s in 0..n {
            let (a, b) = (base + r * n, base + (r + 1) * n);
            let next = (s + 1) % n;
            part.faces.push(vec![a + s, a + next, b + next, b + s]);
        }
    }
    let last = base + (rings - 1) * n;
    for s in 0..n {
        part.faces.push(vec![last + s, last + (s + 1) % n, cap]);
    }
}

/// Returns the light that reaches a position in the mouth: less the further behind the lips,
/// because of cheeks and corners.
fn light(p: DVec3, lips_z: f64) -> f64 {
    0.08 + 0.74 * smooth(27.0, 3.0, lips_z - p.z)
}

/// Returns the remaining light at a position of a crown, by its share of the distance from gum to
/// edge and by its turn towards the neighbour, 0 in front to 1: lips shade its neck and crowns the
/// gaps between them. Designed.
fn between(rise: f64, aside: f64) -> f64 {
    (0.64 + 0.36 * smooth(0.0, 0.8, rise)) * (1.0 - 0.6 * smooth(0.55, 1.0, aside))
}

/// Dentine through enamel: linear RGB of a crown's front in its middle; neck and edge are relative
/// to it. Neither is white (shade A2 of the usual guides, measured by eye).
const CROWN: [f64; 3] = [0.70, 0.625, 0.49];
const NECK: [f64; 3] = [0.82, 0.76, 0.66];
const EDGE: [f64; 3] = [0.90, 0.95, 1.02];
/// Tint of teeth behind the front ones by the light of the mouth's walls.
const FLUSHED: [f64; 3] = [0.95, 0.74, 0.66];
/// The canine is the darkest of the front.
const CANINE: [f64; 3] = [0.93, 0.89, 0.82];

const AROUND: u32 = 12;
/// Heights of a crown's rings: −0.25 is inside the gum, 1 at the edge.
const LEVELS: [f64; 6] = [-0.25, 0.05, 0.35, 0.65, 0.9, 1.0];

fn tooth(part: &mut MeshPart, arch: &Arch, (crown, back): (Crown, f64), middle: f64, lips_z: f64) {
    let [width, height, gum, edge, narrow] = crown;
    let (foot, along, out) = station(arch, middle);
    let foot = foot + DVec3::Y * (arch.up * back);
    let height = height - back;
    let molar = edge > 4.0;
    let weights = [(JointRef(arch.joint), 1.0)];
    let base = part.vertices.len() as u32;
    let mut cap = DVec3::ZERO;
    for (n, &h) in LEVELS.iter().enumerate() {
        let rise = h.max(0.0);
        let mut half = 0.5 * width * (0.80 + 0.21 * smooth(0.0, 0.6, rise));
        half *= 1.0 - (1.0 - narrow) * smooth(0.55, 1.0, rise);
        let mut thick = gum + (edge - gum) * ops::pow(rise, if molar { 2.0 } else { 0.8 });
        if n + 1 == LEVELS.len() {
            half *= 0.86;
            thick *= if molar { 0.72 } else { 0.55 };
        }
        // The front face stays nearly upright, fullest at a third of its height.
        let bulge = 0.7 * ops::sin((rise * 0.85 + 0.12) * core::f64::consts::PI) - 0.5 * rise;
        let centre = foot + out * (bulge - thick / 2.0) + DVec3::Y * (arch.up * height * (1.0 - h));
        for s in 0..AROUND {
            let turn = TAU * f64::from(s) / f64::from(AROUND) * -arch.up * along_sign(along, out);
            // Superellipse: squarer than round.
            let square = |c: f64| c.signum() * ops::pow(c.abs(), 0.72);
            let p = centre
                + along * (half * square(ops::cos(turn)))
                + out * (thick / 2.0 * square(ops::sin(turn)));
            let (neck, tip) = (smooth(0.55, 0.0, rise), smooth(0.75, 1.0, rise));
            let canine = smooth(0.7, 0.5, narrow);
            let [r, g, b] = [0, 1, 2].map(|i| {
                let own = 1.0 + (CANINE[i] - 1.0) * canine;
                let along = (1.0 + (NECK[i] - 1.0) * neck) * (1.0 + (EDGE[i] - 1.0) * tip);
                // Light that reaches this depth was reflected by red tissue.
                let flushed = 1.0 + (FLUSHED[i] - 1.0) * smooth(8.0, 24.0, lips_z - p.z);
                CROWN[i] * own * along * flushed
            });
            let lit = light(p, lips_z) * between(rise, ops::cos(turn).abs());
            push(part, p, [r, g, b, lit], &weights);
        }
        cap = centre - DVec3::Y * (arch.up * if molar { -0.3 } else { 0.15 });
    }
    let [r, g, b] = CROWN;
    let tip = push(part, cap, [r, g, b, light(cap, lips_z)], &weights);
    tube(part, base, LEVELS.len() as u32, AROUND, tip);
}

/// Returns +1 if (along, out, up) is left-handed seen from below, so that rings run the same way on
/// both halves.
fn along_sign(along: DVec3, out: DVec3) -> f64 {
    if along.cross(out).y > 0.0 { 1.0 } else { -1.0 }
}

fn gums(part: &mut MeshPart, arch: &Arch, crowns: &[Crown; 7], lips_z: f64) {
    let weights = [(JointRef(arch.joint), 1.0)];
    let total: f64 = crowns.iter().map(|c| c[0]).sum();
    let stations = 57;
    let base = part.vertices.len() as u32;
    for i in 0..stations {
        let s = (f64::from(i) / f64::from(stations - 1) * 2.0 - 1.0) * total;
        // The tooth at this position, and the distance from its middle.
        let (mut start, mut crown) = (0.0, crowns[6]);
        for c in crowns {
            if s.abs() <= start + c[0] {
                crown = *c;
                break;
            }
            start += c[0];
        }
        let across = ((s.abs() - start) / crown[0] * 2.0 - 1.0).clamp(-1.0, 1.0);
        // Papillae reach down between the crowns.
        let margin = crown[1] - 1.5 * across * across * across.abs();
        let (foot, _, out) = station(arch, s);
        let profile = [
            [0.15, margin],
            [1.0, margin + 1.6],
            [1.3, crown[1] + 4.5],
            [-1.5, crown[1] + 9.0],
            [-crown[2] - 1.0, crown[1] + 4.0],
            [-crown[2] - 0.2, margin + 0.4],
        ];
        for [n, u] in profile {
            let p = foot + out * n + DVec3::Y * (arch.up * u);
            push(
                part,
                p,
                [0.50, 0.23, 0.20, light(p, lips_z) * 0.7],
                &weights,
            );
        }
    }
    let n = 6;
    for i in 0..stations - 1 {
        for k in 0..n - 1 {
            let (a, b) = (base + (i * n + k) as u32, base + ((i + 1) * n + k) as u32);
            let quad = vec![a, b, b + 1, a + 1];
            part.faces.push(if arch.up > 0.0 {
                quad
            } else {
                quad.into_iter().rev().collect()
            });
        }
    }
}

/// Builds teeth, gums and tongue. `contact` is the midpoint where the lips meet, mm.
pub(crate) fn mouth(contact: DVec3) -> Vec<MeshPart> {
    let lips_z = contact.z;
    let rows = [
        (
            Arch {
                front: contact + DVec3::new(0.0, -2.4, -5.2),
                half_width: 29.0,
                depth: 44.0,
                up: 1.0,
                joint: Drive::Bone(Bone::Skull),
            },
            &UPPER,
        ),
        (
            Arch {
                front: contact + DVec3::new(0.0, -0.8, -7.9),
                half_width: 27.2,
                depth: 42.0,
                up: -1.0,
                joint: Drive::Bone(Bone::Chin),
            },
            &LOWER,
        ),
    ];
    let mut teeth = empty(TEETH, MaterialKind::Teeth, 0.22);
    let mut soft = empty(GUMS, MaterialKind::Mouth, 0.35);
    for (arch, crowns) in &rows {
        let mut start = 0.0;
        for (&crown, back) in crowns.iter().zip(EDGES) {
            let middle = start + crown[0] / 2.0;
            start += crown[0];
            for side in [1.0, -1.0] {
                tooth(&mut teeth, arch, (crown, back), middle * side, lips_z);
            }
        }
        gums(&mut soft, arch, crowns, lips_z);
    }
    vec![teeth, soft, tongue(contact)]
}

/// Rows of the tongue from root to tip: distance behind the lips, height of the back's
/// middle against the lips, half width, thickness; mm.
const TONGUE: [[f64; 4]; 10] = [
    [56.0, -9.0, 17.0, 22.0],
    [49.0, -2.5, 19.0, 20.0],
    [42.0, 0.0, 19.8, 17.0],
    [35.0, 0.6, 19.6, 14.5],
    [29.0, 0.0, 18.8, 12.5],
    [24.0, -1.2, 17.6, 10.5],
    [20.0, -2.6, 15.8, 8.6],
    [16.5, -4.0, 13.0, 6.8],
    [13.8, -5.2, 9.2, 4.8],
    [12.4, -6.2, 4.6, 2.6],
];

fn tongue(contact: DVec3) -> MeshPart {
    let mut part = empty("tongue", MaterialKind::Mouth, 0.32);
    let n = 16;
    let base = part.vertices.len() as u32;
    let (mut up, mut out) = (Vec::new(), Vec::new());
    let mut note = |index: u32, s: f64| {
        // The blade bends from its middle on; the whole body slides when it protrudes.
        let tip = smooth(0.35, 1.0, s);
        up.push((index, DVec3::new(0.0, 8.6 * tip, 1.2 * tip) * 1e-3));
        let slide = smooth(0.0, 0.9, s);
        out.push((index, DVec3::new(0.0, 3.2 * tip, 17.0 * slide) * 1e-3));
    };
    for (row, &[back, top, half, thick]) in TONGUE.iter().enumerate() {
        let s = row as f64 / (TONGUE.len() - 1) as f64;
        let jaw = 0.55 + 0.45 * smooth(0.0, 0.3, s);
        let weights = [
            (JointRef(Drive::Bone(Bone::Chin)), jaw),
            (JointRef(Drive::Bone(Bone::Skull)), 1.0 - jaw),
        ];
        for k in 0..n {
            let turn = TAU * f64::from(k) / f64::from(n);
            let (c, sn) = (ops::cos(turn), ops::sin(turn));
            // Flat above with a groove along the middle, rounder below.
            let groove = 0.9 * ops::exp(-(c * half / 3.0) * (c * half / 3.0)) * sn.max(0.0);
            let y = thick / 2.0 * sn.signum() * ops::pow(sn.abs(), 0.7) - groove;
            let p = contact + DVec3::new(half * c, top - thick / 2.0 + y, -back);
            let rough = 1.0 + 0.05 * crate::texture::space_noise(21, p / 1.3);
            let color = [
                0.50 * rough,
                0.19 * rough,
                0.17 * rough,
                light(p, contact.z) * (0.7 + 0.3 * sn.max(0.0)),
            ];
            let index = push(&mut part, p, color, &weights);
            note(index, s);
        }
    }
    let end = contact + DVec3::new(0.0, -7.4, -11.6);
    let weights = [(JointRef(Drive::Bone(Bone::Chin)), 1.0)];
    let tip = push(&mut part, end, [0.5, 0.2, 0.18, 0.7], &weights);
    note(tip, 1.0);
    // Rings run counter-clockwise from the front: x to y.
    tube(&mut part, base, TONGUE.len() as u32, n as u32, tip);
    part.morphs = vec![
        PartMorph {
            name: "tongueUp".to_owned(),
            deltas: up,
        },
        PartMorph {
            name: "tongueOut".to_owned(),
            deltas: out,
        },
    ];
    part
}
