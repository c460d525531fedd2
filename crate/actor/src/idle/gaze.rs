//! Rotation of eyes and head to the gaze target.

use core::f64::consts::PI;

use raconteur_base::curve::smooth;
use raconteur_base::{DAffine3, DQuat, DVec3, Length, ops};

/// Largest turn of an eye, radians (some 35° before the head must follow).
const EYE_MAX_RAD: f64 = 0.6;
/// Share of a gaze direction taken by head and neck. Designed.
pub const HEAD_SHARE: f64 = 0.55;

/// Yaw beyond which a target behind the back is not followed, radians.
const ASIDE_RAD: f64 = 1.4;
/// Share of a direction's length below which it is overhead or below the feet, and has no side.
const OVERHEAD: f64 = 0.3;

/// Returns yaw (left) and pitch (down) of a gaze direction in axes x left, y up, z front, radians.
/// Directions that pass behind the back, overhead or below the feet switch sides: the yaw is 0
/// there, so no small step turns the head around.
#[must_use]
pub fn angles_of(direction: DVec3) -> [f64; 2] {
    let flat = ops::hypot(direction.x, direction.z);
    let yaw = ops::atan2(direction.x, direction.z);
    let behind = smooth((yaw.abs() - ASIDE_RAD) / (PI - ASIDE_RAD));
    let sideways = smooth(flat / (OVERHEAD * direction.magnitude().max(1e-12)));
    [
        yaw * (1.0 - behind) * sideways,
        -ops::atan2(direction.y, flat),
    ]
}

/// Returns the rotation of one eye in the skull's zero axes that looks at a point, turned by
/// `away`, within the eye's range; and its pitch (positive down), radians.
#[must_use]
pub fn eye_towards(
    world_from_skull_axes: &DAffine3,
    eye_in_world: DVec3,
    target_in_world: DVec3,
    away: [f64; 2],
) -> (DQuat, f64) {
    let to = world_from_skull_axes.matrix3.transpose() * (target_in_world - eye_in_world);
    let [yaw, pitch] = if to.magnitude() > 1e-6 {
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
    fn what_goes_round_is_followed_without_a_jump() {
        // Round the figure, and over its head a little aside.
        for tilt in [0.0, 0.3, 1.2, 1.5] {
            let around = DQuat::from_rotation_z(tilt);
            let at = |i: i32| {
                let (s, c) = ops::sincos(f64::from(i) * 1e-3);
                angles_of(around * DVec3::new(s, 0.0, c))
            };
            for i in 0..6300 {
                let ([yaw, pitch], [next_yaw, next_pitch]) = (at(i), at(i + 1));
                assert!(
                    (next_yaw - yaw).abs() < 0.02,
                    "{tilt} {i}: {yaw} {next_yaw}"
                );
                assert!(
                    (next_pitch - pitch).abs() < 0.02,
                    "the pitch follows the circling target without a jump"
                );
            }
        }
    }

    #[test]
    fn an_eye_looks_at_its_target() {
        let eye = DVec3::new(0.03, 1.6, 0.08);
        for target in [DVec3::new(0.4, 1.5, 2.0), DVec3::new(-0.7, 1.9, 2.5)] {
            let (q, _) = eye_towards(&DAffine3::IDENTITY, eye, target, [0.0; 2]);
            assert!(
                (q * DVec3::Z).angle_between(target - eye) < 1e-6,
                "the eye points at its target"
            );
        }
        let (q, pitch) = eye_towards(&DAffine3::IDENTITY, eye, eye - DVec3::Z, [0.0; 2]);
        assert!(
            q.is_finite() && pitch.abs() <= EYE_MAX_RAD,
            "the eye rotation is finite and within its limit"
        );
    }
}
