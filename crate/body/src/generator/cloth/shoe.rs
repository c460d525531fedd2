//! A plain leather shoe: a loft along the foot and a welted sole.

use raconteur_base::{DVec3, Side, ops};

use super::fade;
use crate::figure::Material;
use crate::generator::part::{Part, PartVertex};
use crate::generator::torso::{CM, Joints, Shell, weights::Weights};
use crate::skeleton::Bone;

/// Along the foot: share, half width, height, shift to the little toe (shares of the
/// half width unit, of the length, of the half width).
const PROFILE: [[f64; 4]; 11] = [
    [0.0, 0.30, 0.27, 0.0],
    [0.04, 0.60, 0.32, 0.0],
    [0.14, 0.78, 0.36, 0.0],
    [0.30, 0.78, 0.37, 0.0],
    [0.42, 0.82, 0.33, 0.02],
    [0.55, 0.94, 0.27, 0.05],
    [0.70, 1.02, 0.215, 0.06],
    [0.82, 0.95, 0.19, 0.05],
    [0.92, 0.76, 0.165, 0.02],
    [0.98, 0.48, 0.135, 0.0],
    [1.0, 0.18, 0.09, 0.0],
];
const AROUND: usize = 20;

/// Stations along the foot: close at heel and toe.
fn stations() -> Vec<[f64; 4]> {
    let mut out = Vec::new();
    for (from, to, steps) in [(0.0, 0.1, 3), (0.1, 0.88, 9), (0.88, 1.0, 5)] {
        for i in 0..steps {
            out.push(from + (to - from) * i as f64 / steps as f64);
        }
    }
    out.push(1.0);
    out.into_iter()
        .map(|t| {
            let i = PROFILE
                .partition_point(|r| r[0] <= t)
                .clamp(1, PROFILE.len() - 1)
                - 1;
            let (a, b) = (PROFILE[i], PROFILE[i + 1]);
            let s = (t - a[0]) / (b[0] - a[0]);
            // Catmull–Rom through the neighbours keeps the last round.
            let before = PROFILE[i.saturating_sub(1)];
            let after = PROFILE[(i + 2).min(PROFILE.len() - 1)];
            let value = |k: usize| {
                let slope = |p: [f64; 4], q: [f64; 4]| {
                    let dx = q[0] - p[0];
                    if dx > 0.0 {
                        (q[k] - p[k]) / dx * (b[0] - a[0])
                    } else {
                        0.0
                    }
                };
                raconteur_base::curve::hermite(a[k], slope(before, b), b[k], slope(a, after), s)
            };
            [t, value(1).max(0.05), value(2), value(3)]
        })
        .collect()
}

struct Foot {
    ankle: DVec3,
    heel_z: f64,
    length: f64,
    half_width: f64,
    sole: f64,
}

impl Foot {
    /// A ring of the upper.
    fn upper(&self, [t, w, h, shift]: [f64; 4]) -> Vec<DVec3> {
        let (w, h) = (w * self.half_width, h * self.length);
        ring(|c, s| {
            let rise = if s > 0.0 {
                ops::pow(s, 0.8) * (h - self.sole)
            } else {
                0.12 * CM * s
            };
            let narrow = 1.0 - 0.22 * s.max(0.0);
            let x = c.signum() * ops::pow(c.abs(), 0.62) * w * narrow;
            self.place(t, x + shift * w, rise + self.sole, 0.0)
        })
    }

    /// A ring of the sole: a slab that stands out by its welt.
    fn slab(&self, [t, w, _, shift]: [f64; 4]) -> Vec<DVec3> {
        let w = w * self.half_width;
        ring(|c, s| {
            let x = c.signum() * ops::pow(c.abs(), 0.35) * (w + 0.3 * CM);
            let y = if s.abs() < 0.25 {
                self.sole * (0.55 + s * 2.0)
            } else if s > 0.0 {
                self.sole * 1.12
            } else {
                0.0
            };
            self.place(t, x + shift * w, y, 0.3 * CM)
        })
    }

    fn place(&self, t: f64, x: f64, y: f64, longer: f64) -> DVec3 {
        // The toe springs up a little.
        let spring = ((t - 0.75) / 0.25).max(0.0);
        DVec3::new(
            self.ankle.x + x,
            y + spring * spring * 0.03 * self.length,
            self.heel_z - longer + t * (self.length + 2.0 * longer),
        )
    }
}

fn ring(point: impl Fn(f64, f64) -> DVec3) -> Vec<DVec3> {
    (0..AROUND)
        .map(|i| {
            let a =
                core::f64::consts::TAU * i as f64 / AROUND as f64 - core::f64::consts::FRAC_PI_2;
            let (s, c) = ops::sincos(a);
            point(c, s)
        })
        .collect()
}

/// Rings closed at both ends.
fn loft(rings: &[Vec<DVec3>], weights: impl Fn(DVec3) -> Weights) -> Shell {
    let mut out = Shell::default();
    let end = |r: &[DVec3]| r.iter().copied().sum::<DVec3>() / r.len() as f64;
    let first = vec![end(&rings[0]); AROUND];
    let last = vec![end(&rings[rings.len() - 1]); AROUND];
    for ring in core::iter::once(&first).chain(rings).chain([&last]) {
        out.points.extend(ring);
    }
    out.weights = out.points.iter().map(|p| weights(*p)).collect();
    for i in 0..rings.len() + 1 {
        for k in 0..AROUND {
            let at = |i: usize, k: usize| (i * AROUND + k % AROUND) as u32;
            out.faces
                .push(vec![at(i, k), at(i, k + 1), at(i + 1, k + 1), at(i + 1, k)]);
        }
    }
    // The volume's sign tells which way the rings run.
    let volume: f64 = out
        .faces
        .iter()
        .map(|f| {
            let [a, b, c, d] = [0, 1, 2, 3].map(|i| out.points[f[i] as usize]);
            a.dot(b.cross(c)) + a.dot(c.cross(d))
        })
        .sum();
    if volume < 0.0 {
        for face in &mut out.faces {
            face.reverse();
        }
    }
    out
}

/// Both shoes, uppers and soles.
#[must_use]
pub fn shoes(joints: &Joints, stature_m: f64, upper: &Material, sole: &Material) -> Vec<Part> {
    let ankle = joints.at(Bone::LSubtalar);
    let length = 0.152 * stature_m;
    let foot = Foot {
        ankle,
        heel_z: ankle.z - 0.036 * stature_m,
        length,
        half_width: 0.188 * length * 1.02,
        sole: 0.055 * length,
    };
    let (mid, front) = (
        joints.at(Bone::LMidtarsal).z,
        joints.at(Bone::LMetatarsal).z,
    );
    let weights = |p: DVec3| {
        Weights::bone(Bone::LSubtalar).lerp(&Weights::bone(Bone::LMidtarsal), fade(p.z, mid, front))
    };
    let stations = stations();
    let upper_rings: Vec<_> = stations.iter().map(|s| foot.upper(*s)).collect();
    let sole_rings: Vec<_> = stations.iter().map(|s| foot.slab(*s)).collect();
    let mut parts = Vec::new();
    for (name, rings, material) in [("shoe", upper_rings, upper), ("sole", sole_rings, sole)] {
        let left = loft(&rings, weights);
        for side in Side::BOTH {
            let shell = if side == Side::Left {
                left.clone()
            } else {
                left.mirrored()
            };
            parts.push(part(name, &shell, material, foot.sole));
        }
    }
    parts
}

fn part(name: &str, shell: &Shell, material: &Material, sole: f64) -> Part {
    Part {
        name: name.to_owned(),
        material: material.clone(),
        vertices: shell
            .points
            .iter()
            .zip(&shell.weights)
            .map(|(p, w)| PartVertex {
                position: *p,
                uv: [p.x, p.z],
                // Darker towards the floor.
                color: [1.0, 1.0, 1.0, 0.35 + 0.65 * fade(p.y, -sole, 3.0 * sole)],
                weights: w.refs(),
            })
            .collect(),
        faces: shell.faces.clone(),
        morphs: Vec::new(),
    }
}
