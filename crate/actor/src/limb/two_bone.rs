//! Two bones and the hinge between them, solved in closed form: what arms and legs share.

use raconteur_base::{DMat3, DQuat, DVec3, Length, ops};

/// A chain of two bones with a hinge between them: all lengths and directions that do not
/// change with the pose.
#[derive(Clone, Copy, Debug)]
pub struct TwoBone {
    /// Hinge in the upper bone's frame, metres.
    upper: DVec3,
    /// End in the lower bone's frame, metres.
    lower: DVec3,
    /// Upper from lower in the zero pose.
    zero: DQuat,
    /// Hinge axis in the lower bone's frame, unit.
    axis: DVec3,
    /// Largest flexion, radians.
    max_flexion_rad: f64,
    /// cos, sin and constant parts of `upper · end(flexion)`.
    parts: DVec3,
    /// Flexion at which the end is farthest from the base; about 0.
    straight_rad: f64,
}

impl TwoBone {
    /// A chain whose lower bone turns about `axis` (lower frame) from 0 to
    /// `max_flexion_rad`.
    #[must_use]
    pub fn new(upper: DVec3, lower: DVec3, zero: DQuat, axis: DVec3, max_flexion_rad: f64) -> Self {
        let along = axis * axis.dot(lower);
        let upper_in_lower = zero.inverse() * upper;
        let parts = DVec3::new(
            upper_in_lower.dot(lower - along),
            upper_in_lower.dot(axis.cross(lower)),
            upper_in_lower.dot(along),
        );
        Self {
            upper,
            lower,
            zero,
            axis,
            max_flexion_rad,
            parts,
            straight_rad: ops::atan2(parts.y, parts.x),
        }
    }

    /// Distance from the chain's base to its end at a flexion, metres.
    #[must_use]
    pub fn distance_m(&self, flexion_rad: f64) -> f64 {
        let (s, c) = ops::sincos(flexion_rad);
        let dot = self.parts.x * c + self.parts.y * s + self.parts.z;
        (self.upper.length_squared() + self.lower.length_squared() + 2.0 * dot)
            .max(0.0)
            .sqrt()
    }

    /// The hinge in the upper bone's frame, metres.
    #[must_use]
    pub fn hinge(&self) -> DVec3 {
        self.upper
    }

    /// The end in the lower bone's frame, metres.
    #[must_use]
    pub fn lower(&self) -> DVec3 {
        self.lower
    }

    /// Hinge axis in the lower bone's frame, unit.
    #[must_use]
    pub fn axis(&self) -> DVec3 {
        self.axis
    }

    /// Longest distance within the limits: stretched.
    #[must_use]
    pub fn reach_m(&self) -> f64 {
        self.distance_m(0.0)
    }

    /// A distance eased towards the reach within the last `spare_m` of it, metres: a stretching
    /// hinge would otherwise snap, since its angle changes ever faster up to the end of the reach.
    #[must_use]
    pub fn eased_m(&self, distance_m: f64, spare_m: f64) -> f64 {
        let over = distance_m - (self.reach_m() - spare_m);
        if over <= 0.0 || spare_m <= 0.0 {
            distance_m
        } else {
            distance_m - over + spare_m * (1.0 - ops::exp(-over / spare_m))
        }
    }

    /// Flexion that puts the end at a distance from the base. Clamped to the limits.
    #[must_use]
    pub fn flexion_for(&self, distance_m: f64) -> f64 {
        self.flexions_for(distance_m)[0].clamp(0.0, self.max_flexion_rad)
    }

    /// Returns both flexions that put the end at a distance from the base, ignoring limits: bent
    /// the natural way and the other. An unreachable distance gives the nearest reachable one.
    #[must_use]
    pub fn flexions_for(&self, distance_m: f64) -> [f64; 2] {
        let amplitude = (self.parts.x * self.parts.x + self.parts.y * self.parts.y).sqrt();
        let wanted = 0.5
            * (distance_m * distance_m - self.upper.length_squared() - self.lower.length_squared())
            - self.parts.z;
        let ratio = if amplitude > 0.0 {
            wanted / amplitude
        } else {
            0.0
        };
        let bent = ops::acos_clamped(ratio);
        [self.straight_rad + bent, self.straight_rad - bent]
    }

    /// Shortest and longest distance from the base to the end, metres: within the limits, or
    /// of the chain without limits.
    #[must_use]
    pub fn distances_m(&self, within_limits: bool) -> [f64; 2] {
        let (straight, folded) = (self.straight_rad, self.straight_rad + core::f64::consts::PI);
        if within_limits {
            let straightest = straight.clamp(0.0, self.max_flexion_rad);
            [self.max_flexion_rad, straightest].map(|f| self.distance_m(f))
        } else {
            [folded, straight].map(|f| self.distance_m(f))
        }
    }

    /// The flexion of a rotation of the lower bone that [`TwoBone::flexed`] gave.
    #[must_use]
    pub fn flexion_of(&self, lower: DQuat) -> f64 {
        let sine = DVec3::new(lower.x, lower.y, lower.z).dot(self.axis);
        ops::wrap_angle(2.0 * ops::atan2(sine, lower.w))
    }

    /// Hinge axis in the upper bone's frame, unit; a positive turn flexes.
    #[must_use]
    pub fn axis_in_upper(&self) -> DVec3 {
        self.zero * self.axis
    }

    /// Upper from lower bone in the zero pose.
    #[must_use]
    pub fn zero(&self) -> DQuat {
        self.zero
    }

    /// The same chain with another limit.
    #[must_use]
    pub fn with_limit(self, max_flexion_rad: f64) -> Self {
        Self {
            max_flexion_rad,
            ..self
        }
    }

    /// Returns the position of the end in the upper bone's frame at a flexion.
    #[must_use]
    pub fn end_in_upper(&self, flexion_rad: f64) -> DVec3 {
        self.upper + self.zero * (self.flexed(flexion_rad) * self.lower)
    }

    /// Local rotation of the lower bone at a flexion.
    #[must_use]
    pub fn flexed(&self, flexion_rad: f64) -> DQuat {
        DQuat::from_axis_angle(self.axis, flexion_rad)
    }

    /// World rotation of the upper bone that points the end along `direction` with the
    /// hinge on the side of `pole` (both world; `direction` unit, `pole` of any length).
    #[must_use]
    pub fn aim(&self, flexion_rad: f64, direction: DVec3, pole: DVec3) -> DQuat {
        let end = self.end_in_upper(flexion_rad);
        let own = frame(end, (self.zero * self.axis).cross(end));
        // The end swings towards axis × end, so the hinge stands on the other side.
        let world = frame(direction, -pole);
        DQuat::from_mat3(&(world * own.transpose())).normalized()
    }
}

/// Orthonormal columns: x along `along`, y in the half-plane of `towards`.
fn frame(along: DVec3, towards: DVec3) -> DMat3 {
    let x = along.try_normalized().unwrap_or(DVec3::X);
    let y = (towards - x * x.dot(towards))
        .try_normalized()
        .unwrap_or_else(|| x.any_orthonormal_vector());
    DMat3::from_cols(x, y, x.cross(y))
}
