//! Tailored folds: strokes that raise a ridge with a valley below it. They are part of the cloth's
//! rest shape, so that the drape keeps and settles them.

use raconteur_base::{DVec3, noise, ops};

use super::fade;

/// Fold of a garment, put into the rest shape of its cloth before draping.
#[derive(Clone, Copy, Debug)]
pub enum Fold {
    /// Round an axis.
    Ring(Ring),
    /// Along a bowed line.
    Line(Line),
}

/// Fold around a limb or the trunk: a ridge at a position along an axis; lengths in metres, angles
/// in radians.
#[derive(Clone, Copy, Debug)]
pub struct Ring {
    /// A point of the axis.
    pub origin: DVec3,
    /// Unit, away from the trunk or down.
    pub axis: DVec3,
    /// Unit; the angle is counted from here.
    pub front: DVec3,
    /// Position along the axis.
    pub along: f64,
    /// Middle of the fold.
    pub angle: f64,
    /// Half of the angle that the fold spans, radians; from π on it runs all round.
    pub span: f64,
    /// Climb along the axis per radian.
    pub tilt: f64,
    /// Half width of the ridge, metres.
    pub width: f64,
    /// Height of the ridge, metres.
    pub height: f64,
}

/// Fold along a curved line; lengths in metres.
#[derive(Clone, Copy, Debug)]
pub struct Line {
    /// Start point of the fold, metres.
    pub from: DVec3,
    /// End point of the fold, metres.
    pub to: DVec3,
    /// Offset of its middle from the straight line.
    pub bow: DVec3,
    /// Half width of the ridge, metres.
    pub width: f64,
    /// Height of the ridge, metres.
    pub height: f64,
}

impl Fold {
    /// Returns the displacement of the cloth by the fold at a point, metres.
    #[must_use]
    pub fn lift(&self, p: DVec3) -> f64 {
        match self {
            Self::Ring(r) => r.lift(p),
            Self::Line(l) => l.lift(p),
        }
    }
}

impl Ring {
    fn lift(&self, p: DVec3) -> f64 {
        let d = p - self.origin;
        let along = d.dot(self.axis);
        if (along - self.along).abs() > 5.0 * self.width + self.tilt.abs() * 3.2 {
            return 0.0;
        }
        let side = self.axis.cross(self.front);
        let turn = ops::wrap_angle(ops::atan2(d.dot(side), d.dot(self.front)) - self.angle);
        let taper = if self.span >= core::f64::consts::PI {
            1.0
        } else if turn.abs() >= self.span {
            return 0.0;
        } else {
            let c = ops::cos(core::f64::consts::FRAC_PI_2 * turn / self.span);
            c * (2.0 - c)
        };
        let x = (along - self.along - self.tilt * turn) / self.width;
        let valley = (x - 1.6) / 0.9;
        self.height * taper * (ops::exp(-x * x) - 0.55 * ops::exp(-valley * valley))
    }
}

impl Line {
    fn lift(&self, p: DVec3) -> f64 {
        const STEPS: usize = 10;
        let at = |t: f64| self.from.lerp(self.to, t) + self.bow * (4.0 * t * (1.0 - t));
        let mut best = (f64::MAX, 0.0);
        let mut a = self.from;
        for i in 1..=STEPS {
            let b = at(i as f64 / STEPS as f64);
            let d = b - a;
            let t = ((p - a).dot(d) / d.length_squared().max(1e-12)).clamp(0.0, 1.0);
            let distance = p.distance(a + d * t);
            if distance < best.0 {
                best = (distance, (i as f64 - 1.0 + t) / STEPS as f64);
            }
            a = b;
        }
        let x = best.0 / self.width;
        if x > 4.0 {
            return 0.0;
        }
        let taper = fade(best.1, 0.0, 0.25) * fade(best.1, 1.0, 0.6);
        self.height * taper * (1.0 - 0.9 * x * x) * ops::exp(-x * x)
    }
}

/// Source of seeded random numbers in ±1 that vary the folds of one garment.
#[derive(Clone, Copy, Debug)]
pub struct SeededRandom(pub u64);

impl SeededRandom {
    /// Returns the `n`th random number of an item, −1 to 1.
    #[must_use]
    pub fn sample(self, thing: u64, n: usize) -> f64 {
        noise::signed(self.0, 100 + thing, n as i64)
    }
}

/// Displaces points along their normals by all the folds; `wanted` selects the points that a fold
/// may affect, by the fold's and the point's index.
pub fn crease(
    points: &mut [DVec3],
    normals: &[DVec3],
    folds: &[Fold],
    wanted: impl Fn(usize, usize) -> bool,
) {
    for (v, p) in points.iter_mut().enumerate() {
        let at = *p;
        let lift: f64 = folds
            .iter()
            .enumerate()
            .filter(|(f, _)| wanted(*f, v))
            .map(|(_, fold)| fold.lift(at))
            .sum();
        *p += normals[v] * lift;
    }
}
