//! Shape of the hand as an approximate signed distance: a smooth union of anatomical solids,
//! negative inside. The cage gives only the topology; its vertices are moved onto the zero set of
//! this field.

use raconteur_base::{DMat3, DVec3, ops};

use super::anatomy::{Anatomy, Finger};

/// Smooth union of two distances that rounds the seam over a width `k` (quadratic polynomial smooth
/// minimum).
fn union(a: f64, b: f64, k: f64) -> f64 {
    let h = (k - (a - b).abs()).max(0.0) / k;
    a.min(b) - h * h * k / 4.0
}

fn to_segment(p: DVec3, a: DVec3, b: DVec3) -> (f64, f64) {
    let ab = b - a;
    let t = ((p - a).dot(ab) / ab.length_squared()).clamp(0.0, 1.0);
    ((p - a - ab * t).length(), t)
}

fn capsule(p: DVec3, a: DVec3, b: DVec3, radius_a: f64, radius_b: f64) -> f64 {
    let (d, t) = to_segment(p, a, b);
    d - (radius_a + (radius_b - radius_a) * t)
}

struct Ellipsoid {
    centre: DVec3,
    /// Rows: the axes.
    axes: DMat3,
    radii: DVec3,
}

impl Ellipsoid {
    /// Creates an ellipsoid; `along` is the first axis, `up` the third, made perpendicular to it.
    fn new(centre: DVec3, along: DVec3, up: DVec3, radii: DVec3) -> Self {
        let d = along.try_normalize().unwrap_or(DVec3::Y);
        let u = (up - d * up.dot(d)).try_normalize().unwrap_or(DVec3::Z);
        Self {
            centre,
            axes: DMat3::from_cols(d, u.cross(d), u).transpose(),
            radii,
        }
    }

    fn distance(&self, p: DVec3) -> f64 {
        let q = self.axes * (p - self.centre);
        let k0 = (q / self.radii).length() + 1e-9;
        let k1 = (q / (self.radii * self.radii)).length() + 1e-9;
        k0 * (k0 - 1.0) / k1
    }
}

/// A triangle thickened by a radius.
struct Web {
    corners: [DVec3; 3],
    normal: DVec3,
    radius: f64,
}

impl Web {
    fn new(corners: [DVec3; 3], radius: f64) -> Self {
        let [a, b, c] = corners;
        let normal = (b - a).cross(c - a).try_normalize().unwrap_or(DVec3::Z);
        Self {
            corners,
            normal,
            radius,
        }
    }

    fn distance(&self, p: DVec3) -> f64 {
        let mut inside = true;
        let mut nearest = f64::INFINITY;
        for i in 0..3 {
            let (u, v) = (self.corners[i], self.corners[(i + 1) % 3]);
            inside &= (p - u).dot(self.normal.cross(v - u)) > 0.0;
            nearest = nearest.min(to_segment(p, u, v).0);
        }
        let d = if inside {
            (p - self.corners[0]).dot(self.normal).abs()
        } else {
            nearest
        };
        d - self.radius
    }
}

/// Returns |x|^1.25 and |x|^2.25, computed with square roots, which are exact and fast.
fn fifth_quarters(x: f64) -> (f64, f64) {
    let x = x.abs();
    let low = x * x.sqrt().sqrt();
    (low, low * x)
}

/// Returns the distance from a tube with superelliptic cross-sections (exponent 2.25) and rounded
/// ends.
fn tube(finger: &Finger, cap_from: f64, p: DVec3) -> f64 {
    let local = finger.local(p);
    let (x, along, z) = (local.x, local.y, local.z);
    let section = finger.section(along);
    let width = section.half_width;
    let height = if z < 0.0 {
        section.dorsal
    } else {
        section.palmar
    };
    let tip = finger.along(2.62);
    let (t, cap) = if along > tip {
        let cap = finger.along(3.0) - tip;
        ((along - tip) / cap, cap)
    } else if along < cap_from {
        ((along - cap_from) / 12.0, 12.0)
    } else {
        (0.0, 12.0)
    };
    let (gx, px) = fifth_quarters(x / width);
    let (gz, pz) = fifth_quarters(z / height);
    let (gt, pt) = fifth_quarters(t);
    let k = ops::pow(px + pz + pt + 1e-12, 1.0 / 2.25);
    let (gx, gz, gt) = (gx / width, gz / height, gt / cap);
    (k - 1.0) * fifth_quarters(k).0 / (gx * gx + gz * gz + gt * gt + 1e-12).sqrt()
}

/// Distance field of the hand, with the solids of the palm that are the same for all points
/// precomputed.
pub(super) struct Field<'a> {
    anatomy: &'a Anatomy,
    pads: [Ellipsoid; 3],
    hypothenar: Ellipsoid,
    interosseous: Ellipsoid,
    thenar: Ellipsoid,
    first_web: Web,
}

impl<'a> Field<'a> {
    pub(super) fn new(anatomy: &'a Anatomy) -> Self {
        let v = DVec3::new;
        let pad = |a: usize| {
            let mid = (anatomy.fingers[a].origin + anatomy.fingers[a + 1].origin) / 2.0;
            Ellipsoid::new(
                mid + v(0.0, 3.0, 7.5),
                DVec3::Y,
                DVec3::Z,
                v(10.5, 8.0, 6.3),
            )
        };
        let thumb = &anatomy.fingers[0];
        let beyond_metacarpal = thumb.origin + thumb.frame.y_axis * 38.0;
        Self {
            anatomy,
            pads: [pad(1), pad(2), pad(3)],
            hypothenar: Ellipsoid::new(
                v(-25.5, 33.0, 8.0),
                v(-0.28, 1.0, 0.02),
                DVec3::Z,
                v(34.0, 13.0, 14.0),
            ),
            interosseous: Ellipsoid::new(
                v(27.0, 40.0, 5.0),
                v(0.35, 0.9, 0.1),
                v(0.5, 0.0, -1.0),
                v(24.0, 9.0, 9.0),
            ),
            thenar: Ellipsoid::new(
                v(24.5, 27.0, 18.0),
                v(0.6, 0.75, 0.3),
                v(-0.35, 0.0, 1.0),
                v(30.0, 16.0, 14.5),
            ),
            first_web: Web::new(
                [
                    v(16.0, 20.0, 6.0),
                    beyond_metacarpal + v(-3.0, 3.0, -2.0),
                    v(22.0, 70.0, 3.0),
                ],
                6.0,
            ),
        }
    }

    fn forearm(&self, p: DVec3) -> f64 {
        let a = self.anatomy;
        let width = a.forearm_half_width.sample(p.y);
        let height = if p.z < 0.0 {
            a.forearm_dorsal.sample(p.y)
        } else {
            a.forearm_palmar.sample(p.y)
        };
        let t = ((p.y - 18.0) / 10.0).max(0.0);
        // A fuller section than the fingers': exponent 2.4.
        let x = ((p.x - 1.0) / width).abs();
        let z = (p.z / height).abs();
        let (gx, gz, gt) = (ops::pow(x, 1.4), ops::pow(z, 1.4), ops::pow(t, 1.4));
        let k = ops::pow(gx * x + gz * z + gt * t, 1.0 / 2.4);
        let (gx, gz, gt) = (gx / width, gz / height, gt / 10.0);
        (k - 1.0) * ops::pow(k, 1.4) / (gx * gx + gz * gz + gt * gt + 1e-12).sqrt()
    }

    fn finger(&self, f: usize, p: DVec3) -> f64 {
        let finger = &self.anatomy.fingers[f];
        // Far away only the order of magnitude matters: no blend reaches 20 mm.
        let tip = finger.point(DVec3::new(0.0, finger.joints()[3], 0.0));
        let far = to_segment(p, finger.origin, tip).0 - 13.0;
        if far > 20.0 {
            return far;
        }
        tube(finger, if f == 0 { finger.along(0.15) } else { -6.0 }, p)
    }

    /// Returns the signed distance from the surface of the hand, mm; approximate away from the
    /// surface.
    pub(super) fn distance(&self, p: DVec3) -> f64 {
        let v = DVec3::new;
        let fingers = &self.anatomy.fingers;
        let mut d = self.forearm(p);

        let mut slab = f64::INFINITY;
        for (f, (base, finger)) in self
            .anatomy
            .metacarpal_base
            .iter()
            .zip(&fingers[1..])
            .enumerate()
        {
            let ray = capsule(
                p,
                *base + v(0.0, 0.0, 1.0),
                finger.origin + v(0.0, -4.0, 1.5),
                11.5,
                if f == 3 { 9.75 } else { 10.6 },
            );
            slab = if f == 0 { ray } else { union(slab, ray, 9.0) };
        }
        d = union(d, slab, 12.0);
        for finger in &fingers[1..] {
            let head = finger.origin + v(0.0, 0.0, -3.2);
            let radius = (8.4 + self.anatomy.look.heads_mm) * finger.girth;
            d = union(
                d,
                capsule(p, head - v(0.0, 2.0, 0.0), head, radius, radius),
                5.0,
            );
        }
        for pad in &self.pads {
            d = union(d, pad.distance(p), 6.0);
        }
        d = union(d, self.hypothenar.distance(p), 10.0);

        // Small blends leave folds between the fingers; wide ones make webbed feet.
        let mut rays = self.finger(1, p);
        for f in 2..5 {
            rays = union(rays, self.finger(f, p), 3.0);
        }
        d = union(d, rays, 5.5);

        let web = union(
            self.first_web.distance(p),
            self.interosseous.distance(p),
            8.0,
        );
        d = union(d, web, 14.0);
        d = union(d, self.thenar.distance(p), 12.0);
        d = union(d, self.finger(0, p), 12.0);

        // Scaphoid and tendons towards the thumb, head of the ulna, styloid, pisiform.
        d = union(
            d,
            capsule(p, v(21.0, -14.0, 3.0), v(23.0, 10.0, 7.0), 7.0, 8.5),
            12.0,
        );
        d = union(
            d,
            capsule(p, v(-18.5, -12.0, -10.0), v(-19.0, -24.0, -8.5), 7.6, 7.0),
            10.0,
        );
        d = union(
            d,
            capsule(p, v(23.0, -4.0, -1.0), v(22.0, -12.0, -1.0), 7.0, 7.0),
            6.0,
        );
        union(
            d,
            capsule(p, v(-17.0, 6.0, 11.0), v(-18.0, 9.0, 11.0), 5.5, 5.5),
            7.0,
        )
    }

    fn gradient(&self, p: DVec3) -> DVec3 {
        const H: f64 = 0.05;
        let along = |e: DVec3| (self.distance(p + e * H) - self.distance(p - e * H)) / (2.0 * H);
        DVec3::new(along(DVec3::X), along(DVec3::Y), along(DVec3::Z))
    }

    /// Moves a point to the surface in Newton steps, each at most 4 mm (`damping` 1 is the full
    /// step).
    pub(super) fn project(&self, mut p: DVec3, steps: usize, damping: f64) -> DVec3 {
        for _ in 0..steps {
            let d = self.distance(p);
            if d.abs() < 1e-4 {
                break;
            }
            let g = self.gradient(p);
            p -= g * (damping * (d / g.length_squared().max(0.2)).clamp(-4.0, 4.0));
        }
        p
    }
}
