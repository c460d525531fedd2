//! Closed-form solution of two bones and the hinge between them, shared by arms and legs.

use raconteur_base::{DMat3, DQuat, DVec3, Length, ops};

/// Chain of two bones with a hinge between them (arm or leg), solved in closed form; holds the
/// lengths and directions that do not depend on the pose.
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
    /// Creates a chain whose lower bone flexes about `axis` (lower frame) from 0 to
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

    /// Returns the distance from the chain's base to its end at a flexion of the hinge, metres.
    #[must_use]
    pub fn distance_m(&self, flexion_rad: f64) -> f64 {
        let (s, c) = ops::sincos(flexion_rad);
        let dot = self.parts.x * c + self.parts.y * s + self.parts.z;
        (self.upper.length_squared() + self.lower.length_squared() + 2.0 * dot)
            .max(0.0)
            .sqrt()
    }

    /// Returns the position of the hinge in the upper bone's frame, metres.
    #[must_use]
    pub fn hinge(&self) -> DVec3 {
        self.upper
    }

    /// Returns the position of the end in the lower bone's frame, metres.
    #[must_use]
    pub fn lower(&self) -> DVec3 {
        self.lower
    }

    /// Returns the hinge axis in the lower bone's frame, unit.
    #[must_use]
    pub fn axis(&self) -> DVec3 {
        self.axis
    }

    /// Returns the length of the stretched chain from base to end, metres.
    #[must_use]
    pub fn reach_m(&self) -> f64 {
        self.distance_m(0.0)
    }

    /// Returns a distance eased towards the chain's reach within its last `spare_m`, metres. This
    /// avoids a snap of the stretching hinge, whose angle changes ever faster near full reach.
    #[must_use]
    pub fn eased_m(&self, distance_m: f64, spare_m: f64) -> f64 {
        let over = distance_m - (self.reach_m() - spare_m);
        if over <= 0.0 || spare_m <= 0.0 {
            distance_m
        } else {
            distance_m - over + spare_m * (1.0 - ops::exp(-over / spare_m))
        }
    }

    /// Returns the flexion that puts the end at a distance from the base, radians, clamped to the
    /// limits.
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

    /// Returns the shortest and longest distance from the base to the end, metres: within the
    /// limits, or without limits.
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

    /// Returns the flexion, radians, of a local rotation of the lower bone as returned by
    /// [`TwoBone::flexed`].
    #[must_use]
    pub fn flexion_of(&self, lower: DQuat) -> f64 {
        let sine = DVec3::new(lower.x, lower.y, lower.z).dot(self.axis);
        ops::wrap_angle(2.0 * ops::atan2(sine, lower.w))
    }

    /// Returns the hinge axis in the upper bone's frame, unit; a positive rotation flexes.
    #[must_use]
    pub fn axis_in_upper(&self) -> DVec3 {
        self.zero * self.axis
    }

    /// Returns the rotation from the lower to the upper bone in the zero pose.
    #[must_use]
    pub fn zero(&self) -> DQuat {
        self.zero
    }

    /// Returns the same chain with another maximum flexion.
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

    /// Returns the local rotation of the lower bone at a flexion of the hinge.
    #[must_use]
    pub fn flexed(&self, flexion_rad: f64) -> DQuat {
        DQuat::from_axis_angle(self.axis, flexion_rad)
    }

    /// Returns the world rotation of the upper bone that points the end along `direction` with the
    /// hinge on the side of `pole` (both world; `direction` unit, `pole` of any length).
    #[must_use]
    pub fn aim(&self, flexion_rad: f64, direction: DVec3, pole: DVec3) -> DQuat {
        let end = self.end_in_upper(flexion_rad);
        let own = frame(end, (self.zero * self.axis).cross(end));
        // The end swings towards axis × end, so the hinge is on the other side.
        let world = frame(direction, -pole);
        DQuat::from_mat3(&(world * own.transpose())).normalized()
    }
}

/// Returns an orthonormal basis as columns: x along `along`, y in the half-plane of `towards`.
fn frame(along: DVec3, towards: DVec3) -> DMat3 {
    let x = along.try_normalized().unwrap_or(DVec3::X);
    let y = (towards - x * x.dot(towards))
        .try_normalized()
        .unwrap_or_else(|| x.any_orthonormal_vector());
    DMat3::from_cols(x, y, x.cross(y))
}
