//! Sewn details: strips along a path, cords, buttons.

use raconteur_base::{DVec3, ops};

use crate::torso::{Shell, weights::Weights};

/// Point on a cloth surface to which strips and buttons are attached.
#[derive(Clone, Debug)]
pub struct SurfacePoint {
    /// Position of the point, world, metres.
    pub place: DVec3,
    /// Outward unit normal of the surface.
    pub normal: DVec3,
    /// Skinning weights of the surface at the point.
    pub weights: Weights,
}

/// Cloth surface with its normals, onto which the tailor projects the paths of strips, cords and
/// buttons.
#[derive(Clone, Debug)]
pub struct LayingSurface<'a> {
    shell: &'a Shell,
    normals: Vec<DVec3>,
}

impl<'a> LayingSurface<'a> {
    /// Prepares a shell as a laying surface by computing its normals.
    #[must_use]
    pub fn new(shell: &'a Shell) -> Self {
        Self {
            shell,
            normals: shell.normals(),
        }
    }

    /// Projects a point onto the surface: averages the nearest surface points and moves the point
    /// along their normal.
    #[must_use]
    pub fn project(&self, p: DVec3) -> SurfacePoint {
        self.nearest(p, |q| q.distance_squared(p))
    }

    /// Returns the height of the highest point of the surface, metres.
    #[must_use]
    pub fn top(&self) -> f64 {
        self.shell
            .points
            .iter()
            .map(|p| p.y)
            .fold(f64::MIN, f64::max)
    }

    /// Returns the point, moved out along the surface's normal if it lies less than `off` metres
    /// outside.
    #[must_use]
    pub fn pushed_outside(&self, p: DVec3, off: f64) -> DVec3 {
        let spot = self.nearest_of(|_| true, |q| q.distance_squared(p));
        let d = (p - spot.place).dot(spot.normal);
        // A point far inside has met the other side.
        if d < off && d > -0.06 {
            p + spot.normal * (off - d)
        } else {
            p
        }
    }

    /// Projects a point on the surface in frontal view (`z` above zero) or from the back; the depth
    /// of the point does not matter.
    #[must_use]
    pub fn project_along_z(&self, p: DVec3) -> SurfacePoint {
        let sign = p.z.signum();
        let spot = self.nearest_of(
            |v| self.normals[v].z * sign > 0.1,
            |q| (q.x - p.x) * (q.x - p.x) + (q.y - p.y) * (q.y - p.y),
        );
        let d = spot.place - p;
        let n = spot.normal;
        // Only the depth changes.
        let depth = d.dot(n) / if n.z.abs() < 0.15 { 0.15 * sign } else { n.z };
        SurfacePoint {
            place: DVec3::new(p.x, p.y, p.z + depth),
            ..spot
        }
    }

    /// Returns the surface point vertically below a point.
    #[must_use]
    pub fn above(&self, p: DVec3) -> SurfacePoint {
        let spot = self.nearest_of(
            |v| self.normals[v].y > 0.1,
            |q| (q.x - p.x) * (q.x - p.x) + (q.z - p.z) * (q.z - p.z),
        );
        let n = spot.normal;
        let height = (spot.place - p).dot(n) / n.y.max(0.15);
        SurfacePoint {
            place: DVec3::new(p.x, p.y + height, p.z),
            ..spot
        }
    }

    fn nearest(&self, p: DVec3, distance: impl Fn(DVec3) -> f64) -> SurfacePoint {
        let spot = self.nearest_of(|_| true, distance);
        let n = spot.normal;
        SurfacePoint {
            place: p + n * (spot.place - p).dot(n),
            ..spot
        }
    }

    fn nearest_of(
        &self,
        wanted: impl Fn(usize) -> bool,
        distance: impl Fn(DVec3) -> f64,
    ) -> SurfacePoint {
        const COUNT: usize = 6;
        let mut best: Vec<(f64, usize)> = Vec::with_capacity(COUNT + 1);
        for (v, q) in self.shell.points.iter().enumerate() {
            let d = distance(*q);
            if best.len() == COUNT && d >= best[COUNT - 1].0 {
                continue;
            }
            if !wanted(v) {
                continue;
            }
            let at = best.partition_point(|b| b.0 <= d);
            best.insert(at, (d, v));
            best.truncate(COUNT);
        }
        let share: Vec<(f64, usize)> = best
            .iter()
            .map(|&(d, v)| (1.0 / (d.sqrt() + 5e-4), v))
            .collect();
        let total: f64 = share.iter().map(|s| s.0).sum();
        let mean = |of: &dyn Fn(usize) -> DVec3| -> DVec3 {
            share.iter().map(|&(w, v)| of(v) * (w / total)).sum()
        };
        SurfacePoint {
            place: mean(&|v| self.shell.points[v]),
            normal: mean(&|v| self.normals[v])
                .try_normalize()
                .unwrap_or(DVec3::Z),
            weights: Weights::mix(
                share
                    .iter()
                    .map(|&(w, v)| (&self.shell.weights[v], w / total)),
            ),
        }
    }

    /// Returns a path on the surface through `corners`, with a point about every `spacing` metres and
    /// slightly rounded corners. A corner is projected along z onto the front if its `z` is positive,
    /// else onto the back.
    #[must_use]
    pub fn path(&self, corners: &[DVec3], spacing: f64) -> Vec<SurfacePoint> {
        let mut out = Vec::new();
        for pair in corners.windows(2) {
            let span = (pair[1] - pair[0]).truncate().length();
            let steps = (span / spacing).ceil().max(1.0) as usize;
            for i in 0..steps {
                out.push(pair[0].lerp(pair[1], i as f64 / steps as f64));
            }
        }
        out.extend(corners.last());
        let mut spots: Vec<SurfacePoint> =
            out.into_iter().map(|p| self.project_along_z(p)).collect();
        soften(&mut spots, 2);
        spots
    }
}

/// Smooths positions, normals and weights along an open path; its ends stay.
pub fn soften(path: &mut [SurfacePoint], rounds: usize) {
    for _ in 0..rounds {
        let before = path.to_vec();
        for i in 1..path.len().saturating_sub(1) {
            let (a, b) = (&before[i - 1], &before[i + 1]);
            let s = &mut path[i];
            s.place = s.place * 0.5 + (a.place + b.place) * 0.25;
            s.normal = (s.normal * 2.0 + a.normal + b.normal)
                .try_normalize()
                .unwrap_or(s.normal);
            let near = [
                (&before[i].weights, 0.5),
                (&a.weights, 0.25),
                (&b.weights, 0.25),
            ];
            s.weights = Weights::mix(near.into_iter());
        }
    }
}

/// Cross-section of a flat strip that is laid on cloth, for example a placket or a pocket edge;
/// metres.
#[derive(Clone, Copy, Debug)]
pub struct Strip {
    /// Width across the path, metres.
    pub width: f64,
    /// Height above the cloth, metres.
    pub thickness: f64,
    /// True if the path is closed.
    pub closed: bool,
}

/// Share of half the width and of the thickness: rounded edges that reach into the cloth.
const EDGE: [(f64, f64); 6] = [
    (-1.0, -0.8),
    (-1.0, 0.5),
    (-0.75, 1.0),
    (0.75, 1.0),
    (1.0, 0.5),
    (1.0, -0.8),
];

/// Builds a strip with rounded edges along a path of surface points.
#[must_use]
pub fn strip(path: &[SurfacePoint], shape: &Strip) -> Shell {
    let frames = frames(path, shape.closed);
    let rings: Vec<Vec<DVec3>> = path
        .iter()
        .zip(&frames)
        .map(|(s, across)| {
            EDGE.iter()
                .map(|&(x, y)| {
                    s.place + *across * (x * 0.5 * shape.width) + s.normal * (y * shape.thickness)
                })
                .collect()
        })
        .collect();
    let mut out = swept(path, &rings, shape.closed, false);
    orient(&mut out, path, EDGE.len(), 2);
    out
}

/// Builds a round cord along a path, lying on the cloth and closed at its ends; `radius` in metres.
#[must_use]
pub fn cord(path: &[SurfacePoint], radius: f64) -> Shell {
    const AROUND: usize = 6;
    let frames = frames(path, false);
    let last = path.len().saturating_sub(1);
    let rings: Vec<Vec<DVec3>> = path
        .iter()
        .zip(&frames)
        .enumerate()
        .map(|(i, (s, across))| {
            let r = if i == 0 || i == last { 0.35 } else { 1.0 } * radius;
            (0..AROUND)
                .map(|k| {
                    let a = core::f64::consts::TAU * k as f64 / AROUND as f64;
                    let (sin, cos) = ops::sincos(a);
                    s.place + *across * (cos * r) + s.normal * (sin * r + 0.7 * radius)
                })
                .collect()
        })
        .collect();
    let mut out = swept(path, &rings, false, true);
    orient(&mut out, path, AROUND, 1);
    out
}

/// Returns the direction across the path, in the cloth, at each point.
fn frames(path: &[SurfacePoint], closed: bool) -> Vec<DVec3> {
    let n = path.len();
    (0..n)
        .map(|i| {
            let (a, b) = if closed {
                ((i + n - 1) % n, (i + 1) % n)
            } else {
                (i.saturating_sub(1), (i + 1).min(n - 1))
            };
            let along = path[b].place - path[a].place;
            path[i]
                .normal
                .cross(along)
                .try_normalize()
                .unwrap_or(DVec3::X)
        })
        .collect()
}

fn swept(path: &[SurfacePoint], rings: &[Vec<DVec3>], closed: bool, round: bool) -> Shell {
    let mut out = Shell::default();
    for (spot, ring) in path.iter().zip(rings) {
        for p in ring {
            out.points.push(*p);
            out.weights.push(spot.weights.clone());
        }
    }
    let n = rings.len();
    let m = rings.first().map_or(0, Vec::len);
    let at = |i: usize, k: usize| ((i % n) * m + k % m) as u32;
    let spans = if closed { n } else { n.saturating_sub(1) };
    let sides = if round { m } else { m.saturating_sub(1) };
    for i in 0..spans {
        for k in 0..sides {
            out.faces
                .push(vec![at(i, k), at(i, k + 1), at(i + 1, k + 1), at(i + 1, k)]);
        }
    }
    out
}

/// Flips all faces if point `k` of the rings faces into the cloth.
fn orient(shell: &mut Shell, path: &[SurfacePoint], m: usize, k: usize) {
    let agree: f64 = shell
        .normals()
        .iter()
        .skip(k)
        .step_by(m)
        .zip(path)
        .map(|(n, s)| n.dot(s.normal))
        .sum();
    if agree < 0.0 {
        for face in &mut shell.faces {
            face.reverse();
        }
    }
}

/// Builds a button, a dished disc with a rounded rim, at a surface point; `radius` in metres.
#[must_use]
pub fn button(spot: &SurfacePoint, radius: f64) -> Shell {
    const AROUND: usize = 8;
    const PROFILE: [(f64, f64); 5] = [
        (1.0, -0.1),
        (1.03, 0.26),
        (0.86, 0.4),
        (0.6, 0.28),
        (0.03, 0.27),
    ];
    let n = spot.normal;
    let across = n.cross(DVec3::Y).try_normalize().unwrap_or(DVec3::X);
    let up = across.cross(n);
    let mut out = Shell::default();
    for (r, h) in PROFILE {
        for k in 0..AROUND {
            let (s, c) = ops::sincos(core::f64::consts::TAU * k as f64 / AROUND as f64);
            out.points
                .push(spot.place + ((across * c + up * s) * r + n * h) * radius);
            out.weights.push(spot.weights.clone());
        }
    }
    let at = |i: usize, k: usize| (i * AROUND + k % AROUND) as u32;
    for i in 0..PROFILE.len() - 1 {
        for k in 0..AROUND {
            out.faces
                .push(vec![at(i, k), at(i, k + 1), at(i + 1, k + 1), at(i + 1, k)]);
        }
    }
    orient(
        &mut out,
        core::slice::from_ref(spot),
        AROUND * PROFILE.len(),
        AROUND * 2,
    );
    out
}
