//! Rounded bands that continue the edges of cloth: cuffs, neckbands, hems.
//!
//! A band follows a direction (down the arm, up the neck) and keeps its distance from the
//! body, which a strip laid on the draped edge would not.

use raconteur_base::curve::{lerp, smooth};
use raconteur_base::{DVec3, ops};

use crate::generator::torso::{CM, Field, Regions, Shell, weights::Weights};

/// Shape of a band; lengths in metres.
#[derive(Clone, Copy, Debug)]
pub struct Band {
    /// Which way it continues the cloth; unit.
    pub direction: DVec3,
    /// How far it continues.
    pub width: f64,
    /// Thickness of its cloth.
    pub thickness: f64,
    /// Distance of its inner side from the body at the far edge.
    pub ease: f64,
    /// Regions of the body that it goes round.
    pub regions: Regions,
    /// Distance between points along the edge.
    pub spacing: f64,
    /// Points in one rib; 0 for none.
    pub ribs: usize,
}

/// Share of the width and height in thicknesses of the profile's points, from under the
/// cloth's edge over the outside to the inside.
const PROFILE: [(f64, f64); 7] = [
    (-0.10, -0.4),
    (-0.06, 0.9),
    (0.05, 1.1),
    (0.5, 1.15),
    (0.93, 1.1),
    (1.0, 0.55),
    (0.9, -0.2),
];
/// The points that ribs raise and lower.
const RIBBED: core::ops::RangeInclusive<usize> = 2..=4;

/// One point of the edge.
#[derive(Clone)]
struct Station {
    place: DVec3,
    /// Distance from the body.
    off: f64,
    weights: Weights,
}

/// A band along a boundary loop of a shell.
#[must_use]
pub fn along_edge(cloth: &Shell, ring: &[u32], band: &Band, field: &Field) -> Shell {
    let stations: Vec<Station> = ring
        .iter()
        .map(|&v| {
            let place = cloth.points[v as usize];
            Station {
                place,
                off: field.value_and_normal(place, band.regions, 1.0).0,
                weights: cloth.weights[v as usize].clone(),
            }
        })
        .collect();
    let length: f64 = (0..stations.len())
        .map(|i| {
            stations[i]
                .place
                .distance(stations[(i + 1) % stations.len()].place)
        })
        .sum();
    // A whole number of ribs.
    let rib = band.ribs.max(1);
    let count = ((length / band.spacing) as usize).max(24) / rib * rib;
    let mut path = resample(&stations, length, count);
    for _ in 0..8 {
        smooth_ring(&mut path);
    }
    sweep(&path, band, field)
}

fn resample(ring: &[Station], length: f64, count: usize) -> Vec<Station> {
    let n = ring.len();
    let mut out = Vec::with_capacity(count);
    let (mut i, mut start) = (0, 0.0);
    for k in 0..count {
        let want = length * k as f64 / count as f64;
        let span_at = |i: usize| ring[i % n].place.distance(ring[(i + 1) % n].place);
        while start + span_at(i) < want && i < n {
            start += span_at(i);
            i += 1;
        }
        let (a, b, span) = (&ring[i % n], &ring[(i + 1) % n], span_at(i));
        let t = if span > 0.0 {
            ((want - start) / span).clamp(0.0, 1.0)
        } else {
            0.0
        };
        out.push(Station {
            place: a.place.lerp(b.place, t),
            off: lerp(a.off, b.off, t),
            weights: a.weights.lerp(&b.weights, t),
        });
    }
    out
}

fn smooth_ring(path: &mut [Station]) {
    let n = path.len();
    let before = path.to_vec();
    for (i, s) in path.iter_mut().enumerate() {
        let (a, b) = (&before[(i + n - 1) % n], &before[(i + 1) % n]);
        s.place = s.place * 0.5 + (a.place + b.place) * 0.25;
        s.off = s.off * 0.5 + (a.off + b.off) * 0.25;
        let near = [
            (&before[i].weights, 0.5),
            (&a.weights, 0.25),
            (&b.weights, 0.25),
        ];
        s.weights = Weights::mix(near.into_iter());
    }
}

fn sweep(path: &[Station], band: &Band, field: &Field) -> Shell {
    let mut out = Shell::default();
    for (i, s) in path.iter().enumerate() {
        let wave = if band.ribs > 0 {
            ops::cos(core::f64::consts::TAU * i as f64 / band.ribs as f64)
        } else {
            0.0
        };
        for (k, &(along, up)) in PROFILE.iter().enumerate() {
            let rib = if RIBBED.contains(&k) {
                0.07 * CM * wave
            } else {
                0.0
            };
            let off = lerp(s.off, band.ease, smooth(along / 0.5)) + up * band.thickness + rib;
            let mut p = s.place + band.direction * (along * band.width);
            for _ in 0..4 {
                let (d, n) = field.value_and_normal(p, band.regions, 1.0);
                // Across the direction only, so that the width stays.
                let across = (n - band.direction * n.dot(band.direction)).normalize_or_zero();
                p += across * (off - d).clamp(-2.0 * CM, 2.0 * CM);
            }
            out.points.push(p);
            out.weights.push(s.weights.clone());
        }
    }
    let (n, m) = (path.len(), PROFILE.len());
    for i in 0..n {
        for k in 0..m - 1 {
            let at = |i: usize, k: usize| ((i % n) * m + k) as u32;
            out.faces
                .push(vec![at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k + 1)]);
        }
    }
    face_outwards(&mut out, band, field);
    out
}

/// Turns all faces when the outer ones look inwards.
fn face_outwards(shell: &mut Shell, band: &Band, field: &Field) {
    let m = PROFILE.len();
    let agree: f64 = shell
        .normals()
        .iter()
        .zip(&shell.points)
        .skip(m / 2)
        .step_by(m)
        .map(|(n, p)| n.dot(field.value_and_normal(*p, band.regions, 1.0).1))
        .sum();
    if agree < 0.0 {
        for face in &mut shell.faces {
            face.reverse();
        }
    }
}
