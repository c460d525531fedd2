//! Shoes: an upper lofted along the foot, its cap and laces, and a sole with a welt.

use raconteur_base::{DVec3, Side, ops};

use super::fade;
use super::finish::{Fabric, plain_part};
use super::strip::{LayingSurface, SurfacePoint, cord};
use super::wearer::Wearer;
use crate::part::MeshPart;
use crate::torso::{CM, Joints, Shell, weights::Weights};
use raconteur_body::skeleton::Bone;

/// Style of a shoe: leather shoe or sneaker.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ShoeStyle {
    /// Plain leather, a narrow sole with a heel.
    Leather,
    /// Canvas with a thick rubber sole, a toe cap and laces.
    Sneaker,
}

/// Cut of a pair of shoes for one wearer: style, materials and width.
#[derive(Clone, Copy, Debug)]
pub struct ShoeCut {
    /// Style of the shoes.
    pub style: ShoeStyle,
    /// Material of the upper.
    pub upper: Fabric,
    /// Sole, and a sneaker's cap.
    pub sole: Fabric,
    /// Material of the laces.
    pub lace: Fabric,
    /// Width against an average shoe.
    pub width: f64,
}

/// Along the foot: share, half width, height, shift to the little toe (shares of the
/// half width unit, of the length, of the half width).
const LEATHER: [[f64; 4]; 11] = [
    [0.0, 0.30, 0.30, 0.0],
    [0.04, 0.60, 0.36, 0.0],
    [0.14, 0.76, 0.40, 0.0],
    [0.28, 0.76, 0.41, 0.0],
    [0.40, 0.80, 0.35, 0.02],
    [0.55, 0.92, 0.265, 0.05],
    [0.70, 1.00, 0.205, 0.06],
    [0.82, 0.92, 0.175, 0.03],
    [0.92, 0.70, 0.150, -0.02],
    [0.98, 0.42, 0.125, -0.05],
    [1.0, 0.16, 0.09, -0.05],
];
const SNEAKER: [[f64; 4]; 11] = [
    [0.0, 0.34, 0.34, 0.0],
    [0.04, 0.64, 0.40, 0.0],
    [0.14, 0.82, 0.44, 0.0],
    [0.28, 0.82, 0.45, 0.0],
    [0.40, 0.86, 0.38, 0.02],
    [0.55, 0.98, 0.295, 0.05],
    [0.70, 1.06, 0.235, 0.06],
    [0.82, 1.00, 0.205, 0.05],
    [0.92, 0.82, 0.185, 0.02],
    [0.98, 0.54, 0.155, 0.0],
    [1.0, 0.20, 0.10, 0.0],
];
const AROUND: usize = 16;

/// Stations along the foot: close at heel and toe.
fn stations(profile: &[[f64; 4]; 11]) -> Vec<[f64; 4]> {
    let mut out = Vec::new();
    for (from, to, steps) in [(0.0, 0.1, 3), (0.1, 0.88, 10), (0.88, 1.0, 5)] {
        for i in 0..steps {
            out.push(from + (to - from) * i as f64 / steps as f64);
        }
    }
    out.push(1.0);
    out.into_iter()
        .map(|t| {
            let i = profile
                .partition_point(|r| r[0] <= t)
                .clamp(1, profile.len() - 1)
                - 1;
            let (a, b) = (profile[i], profile[i + 1]);
            let s = (t - a[0]) / (b[0] - a[0]);
            // Catmull–Rom interpolation keeps the last round.
            let before = profile[i.saturating_sub(1)];
            let after = profile[(i + 2).min(profile.len() - 1)];
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
    style: ShoeStyle,
    unit: f64,
}

impl Foot {
    /// Returns a ring of points of the shoe's upper.
    fn upper(&self, [t, w, h, shift]: [f64; 4]) -> Vec<DVec3> {
        let (w, h) = (w * self.half_width, h * self.length);
        // The instep is a ridge, the toe a dome.
        let ridge = 0.20 + 0.22 * fade(t, 0.75, 0.45) * fade(t, 0.2, 0.4);
        ring(|c, s| {
            let rise = if s > 0.0 {
                ops::pow(s, 0.8) * (h - self.sole)
            } else {
                0.12 * CM * s
            };
            let narrow = 1.0 - ridge * s.max(0.0);
            let x = c.signum() * ops::pow(c.abs(), 0.62) * w * narrow;
            let mut p = self.place(t, x + shift * w, rise + self.sole, 0.0);
            if self.style == ShoeStyle::Leather {
                // The vamp bends in behind the toes; the quarter's edge steps over it.
                p.y -= 0.10 * self.unit * s.max(0.0) * ops::exp(-ops::pow((t - 0.66) / 0.035, 2.0));
                p.y += 0.12 * self.unit * s.max(0.0) * fade(t, 0.52, 0.49);
            } else {
                // The rubber cap covers the toes.
                let cap = fade(t, 0.80, 0.83);
                p.y += 0.16 * self.unit * cap * s.max(0.0);
                p.x += c.signum() * 0.12 * self.unit * cap;
            }
            p
        })
    }

    /// Returns a ring of the sole: a slab that protrudes by its welt.
    fn slab(&self, [t, w, _, shift]: [f64; 4]) -> Vec<DVec3> {
        let w = w * self.half_width;
        let welt = if self.style == ShoeStyle::Leather {
            0.28 * self.unit
        } else {
            0.42 * self.unit
        };
        // A heel below, an arch before it.
        let arch = if self.style == ShoeStyle::Leather {
            0.5 * self.sole * fade(t, 0.27, 0.31) * fade(t, 0.62, 0.42)
        } else {
            0.0
        };
        ring(|c, s| {
            let x = c.signum() * ops::pow(c.abs(), 0.35) * (w + welt);
            let y = if s.abs() < 0.25 {
                self.sole * (0.55 + s * 2.0)
            } else if s > 0.0 {
                self.sole
                    * if self.style == ShoeStyle::Leather {
                        1.12
                    } else {
                        1.35
                    }
            } else {
                0.0
            };
            self.place(t, x + shift * w, y.max(arch), welt)
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
    for ring in rings {
        out.points.extend(ring);
    }
    let (heel, toe) = (out.points.len() as u32, out.points.len() as u32 + 1);
    out.points.push(end(&rings[0]));
    out.points.push(end(&rings[rings.len() - 1]));
    out.weights = out.points.iter().map(|p| weights(*p)).collect();
    let at = |i: usize, k: usize| (i * AROUND + k % AROUND) as u32;
    let last = rings.len() - 1;
    for k in 0..AROUND {
        out.faces.push(vec![heel, at(0, k + 1), at(0, k)]);
        out.faces.push(vec![toe, at(last, k), at(last, k + 1)]);
        for i in 0..last {
            out.faces
                .push(vec![at(i, k), at(i, k + 1), at(i + 1, k + 1), at(i + 1, k)]);
        }
    }
    // The sign of the volume gives the direction of the rings.
    let volume: f64 = out
        .faces
        .iter()
        .flat_map(|f| (1..f.len() - 1).map(move |i| [f[0], f[i], f[i + 1]]))
        .map(|t| {
            let [a, b, c] = t.map(|v| out.points[v as usize]);
            a.dot(b.cross(c))
        })
        .sum();
    if volume < 0.0 {
        for face in &mut out.faces {
            face.reverse();
        }
    }
    out
}

/// Builds both shoes.
#[must_use]
pub fn shoes(wearer: &Wearer<'_>, cut: &ShoeCut) -> Vec<MeshPart> {
    let joints = wearer.joints;
    let length = 0.152 * wearer.stature_m;
    let ankle = joints.position_of(Bone::LSubtalar);
    let foot = Foot {
        ankle,
        heel_z: ankle.z - 0.036 * wearer.stature_m,
        length,
        half_width: 0.188 * length * cut.width,
        sole: if cut.style == ShoeStyle::Leather {
            0.055
        } else {
            0.075
        } * length,
        style: cut.style,
        unit: CM * wearer.scale,
    };
    let weights = foot_weights(joints);
    let stations = stations(match cut.style {
        ShoeStyle::Leather => &LEATHER,
        ShoeStyle::Sneaker => &SNEAKER,
    });
    let rings = |ring: &dyn Fn([f64; 4]) -> Vec<DVec3>| -> Vec<Vec<DVec3>> {
        stations.iter().map(|s| ring(*s)).collect()
    };
    let upper = loft(&rings(&|s| foot.upper(s)), weights);
    let sole = loft(&rings(&|s| foot.slab(s)), weights);
    let laces = laces(&upper, &foot, cut.style);
    let cap_from = foot.heel_z + 0.81 * foot.length;
    let mut parts = Vec::new();
    for side in Side::BOTH {
        let of = |shell: &Shell| {
            if side == Side::Left {
                shell.clone()
            } else {
                shell.mirrored()
            }
        };
        let mut part = plain_part("shoe", &of(&upper), wearer.field, cut.upper);
        if cut.style == ShoeStyle::Sneaker {
            for v in part.vertices.iter_mut().filter(|v| v.position.z > cap_from) {
                v.color[..3].copy_from_slice(&cut.sole.dye);
            }
        }
        ground(&mut part, foot.sole);
        parts.push(part);
        let mut part = plain_part("sole", &of(&sole), wearer.field, cut.sole);
        ground(&mut part, foot.sole);
        parts.push(part);
        for lace in &laces {
            parts.push(plain_part("lace", &of(lace), wearer.field, cut.lace));
        }
    }
    parts
}

/// Darkens the vertices of a shoe towards the floor.
fn ground(part: &mut MeshPart, sole: f64) {
    for v in &mut part.vertices {
        v.color[3] = 0.40 + 0.60 * fade(v.position.y, -sole, 3.0 * sole);
    }
}

fn foot_weights(joints: &Joints) -> impl Fn(DVec3) -> Weights + Copy {
    let (mid, front) = (
        joints.position_of(Bone::LMidtarsal).z,
        joints.position_of(Bone::LMetatarsal).z,
    );
    move |p: DVec3| {
        Weights::bone(Bone::LSubtalar).lerp(&Weights::bone(Bone::LMidtarsal), fade(p.z, mid, front))
    }
}

/// Bars of lace across the instep.
fn laces(upper: &Shell, foot: &Foot, style: ShoeStyle) -> Vec<Shell> {
    let lay = LayingSurface::new(upper);
    let (from, to, count, half_cm) = match style {
        ShoeStyle::Leather => (0.47, 0.59, 3, 1.3),
        ShoeStyle::Sneaker => (0.42, 0.68, 5, 1.9),
    };
    let mut out = Vec::new();
    for i in 0..count {
        let t = from + (to - from) * i as f64 / (count - 1) as f64;
        let z = foot.heel_z + t * foot.length;
        // The far end climbs: laces cross.
        let path: Vec<SurfacePoint> = (0..7)
            .map(|k| {
                let x = (k as f64 / 3.0 - 1.0) * half_cm * foot.unit;
                let high = DVec3::new(foot.ankle.x + x, 0.45 * foot.length, z);
                lay.above(high)
            })
            .collect();
        out.push(cord(&path, 0.16 * foot.unit));
    }
    out
}
