//! How eyes and head turn to what is looked at.

use raconteur_base::{DAffine3, DQuat, DVec3, ops};

/// Largest turn of an eye, radians (some 35° before the head must follow).
const EYE_MAX_RAD: f64 = 0.6;
/// Share of a direction that head and neck take. Designed.
pub const HEAD_SHARE: f64 = 0.55;

/// Yaw (left) and pitch (down) of a direction in axes x left, y up, z front, radians.
#[must_use]
pub fn angles_of(direction: DVec3) -> [f64; 2] {
    let flat = ops::hypot(direction.x, direction.z);
    [
        ops::atan2(direction.x, direction.z),
        -ops::atan2(direction.y, flat),
    ]
}

/// Rotation of one eye in the skull's zero axes that looks at a point, turned by `away`,
/// within the eye's range; and its pitch (positive down), radians.
#[must_use]
pub fn eye_towards(
    world_from_skull_axes: &DAffine3,
    eye_in_world: DVec3,
    target_in_world: DVec3,
    away: [f64; 2],
) -> (DQuat, f64) {
    let to = world_from_skull_axes.matrix3.transpose() * (target_in_world - eye_in_world);
    let [yaw, pitch] = if to.length() > 1e-6 {
        angles_of(to)
    } else {
        [0.0; 2]
    };
    let yaw = soft(yaw + away[0]);
    let pitch = soft(pitch + away[1]);
    (
        DQuat::from_rotation_y(yaw) * DQuat::from_rotation_x(pitch),
        pitch,
    )
}

/// Approaches [`EYE_MAX_RAD`] instead of passing it.
fn soft(angle: f64) -> f64 {
    let free = 0.8 * EYE_MAX_RAD;
    let over = angle.abs() - free;
    let rest = EYE_MAX_RAD - free;
    if over <= 0.0 {
        angle
    } else {
        angle.signum() * (free + rest * over / (over + rest))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_eye_looks_at_its_target() {
        let eye = DVec3::new(0.03, 1.6, 0.08);
        for target in [DVec3::new(0.4, 1.5, 2.0), DVec3::new(-0.7, 1.9, 2.5)] {
            let (q, _) = eye_towards(&DAffine3::IDENTITY, eye, target, [0.0; 2]);
            assert!((q * DVec3::Z).angle_between(target - eye) < 1e-6);
        }
        let (q, pitch) = eye_towards(&DAffine3::IDENTITY, eye, eye - DVec3::Z, [0.0; 2]);
        assert!(q.is_finite() && pitch.abs() <= EYE_MAX_RAD);
    }
}
