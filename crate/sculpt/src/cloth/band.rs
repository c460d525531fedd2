//! Rounded bands that continue the edges of cloth: cuffs, neckbands, hems.
//!
//! A band follows a direction (down the arm, up the neck) and keeps its distance from the body; a
//! strip on the draped edge would not.

use raconteur_base::curve::{lerp, smooth};
use raconteur_base::{DVec3, ops};

use super::neck::Neck;
use crate::torso::{CM, Field, Regions, Shell, weights::Weights};

/// Surface around which a band runs: regions of the body, or the neck.
#[derive(Clone, Copy, Debug)]
pub enum BandPath<'a> {
    /// Regions of the body.
    Body(&'a Field, Regions),
    /// The neck.
    Neck(&'a Neck),
}

impl BandPath<'_> {
    /// Returns the distance from the skin, metres, and the outward unit normal.
    fn value_and_normal(&self, p: DVec3) -> (f64, DVec3) {
        match self {
            Self::Body(field, regions) => field.value_and_normal(p, *regions, 1.0),
            Self::Neck(neck) => neck.value_and_normal(p),
        }
    }
}

/// Shape of a rounded band that continues an edge of cloth, such as a cuff, neckband or hem;
/// lengths in metres.
#[derive(Clone, Copy, Debug)]
pub struct Band<'a> {
    /// Direction in which the band continues the cloth; unit vector.
    pub direction: DVec3,
    /// Width of the band.
    pub width: f64,
    /// Thickness of its cloth.
    pub thickness: f64,
    /// Distance of its inner side from the body at the far edge.
    pub ease: f64,
    /// Path that the band follows.
    pub round: BandPath<'a>,
    /// Uneven billow of its middle, so that soft cloth never looks like a pipe.
    pub billow: f64,
    /// Number of edge points per point of the band; 1 keeps them all.
    pub every: usize,
}

/// Share of the width and height in thicknesses of the profile's points, from under the
/// cloth's edge over the outside to the inside.
const PROFILE: [(f64, f64); 6] = [
    (-0.10, 0.3),
    (0.05, 1.15),
    (0.5, 1.1),
    (0.94, 1.0),
    (1.0, 0.45),
    (0.85, -0.2),
];

/// Point of the cloth's edge at which a band starts.
#[derive(Clone)]
struct Station {
    place: DVec3,
    /// Distance from the body.
    off: f64,
    weights: Weights,
}

/// Builds a band along a boundary loop of a cloth surface.
#[must_use]
pub fn along_edge(cloth: &Shell, ring: &[u32], band: &Band<'_>) -> Shell {
    let stations: Vec<Station> = ring
        .iter()
        .map(|&v| {
            let place = cloth.points[v as usize];
            Station {
                place,
                off: band.round.value_and_normal(place).0,
                weights: cloth.weights[v as usize].clone(),
            }
        })
        .collect();
    let mut path: Vec<Station> = stations.into_iter().step_by(band.every.max(1)).collect();
    for _ in 0..6 {
        smooth_ring(&mut path);
    }
    sweep(&path, band)
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

fn sweep(path: &[Station], band: &Band<'_>) -> Shell {
    let mut out = Shell::default();
    for (i, s) in path.iter().enumerate() {
        let turn = core::f64::consts::TAU * i as f64 / path.len() as f64;
        let uneven = 0.6 * ops::sin(3.0 * turn + 0.7) + 0.4 * ops::sin(5.0 * turn + 2.1);
        for (k, &(along, up)) in PROFILE.iter().enumerate() {
            // The far side of a neckband must not sink into the neck.
            let inner = k + 1 == PROFILE.len();
            let off = lerp(s.off, band.ease, smooth(along / 0.5))
                + if inner { 0.0 } else { up * band.thickness };
            let middle = (4.0 * along * (1.0 - along)).max(0.0);
            let off = off + band.billow * middle * (1.0 + 0.5 * uneven);
            // The free edge rises and sinks with it.
            let along = along * (1.0 + uneven * band.billow / band.width * smooth(along));
            let mut p = s.place + band.direction * (along * band.width);
            for _ in 0..4 {
                let (d, n) = band.round.value_and_normal(p);
                // Only across the direction, so that the width is preserved.
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
    face_outwards(&mut out, band);
    out
}

/// Flips all faces if the outer ones face inwards.
fn face_outwards(shell: &mut Shell, band: &Band<'_>) {
    let m = PROFILE.len();
    let agree: f64 = shell
        .normals()
        .iter()
        .zip(&shell.points)
        .skip(m / 2)
        .step_by(m)
        .map(|(n, p)| n.dot(band.round.value_and_normal(*p).1))
        .sum();
    if agree < 0.0 {
        for face in &mut shell.faces {
            face.reverse();
        }
    }
}
