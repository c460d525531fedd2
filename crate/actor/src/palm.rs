//! Orientation of a hand from its palm normal and an angle about that normal.
//!
//! A *hand rotation* is a rotation in world axes that carries the hand of the zero pose (fingers
//! outwards to its side, palm down) to its orientation. It is independent of bone frames, and
//! mirrors like any rotation.
//!
//! GEVH section 3.5.1 specifies the axis and a left-handed angle; the zero of the angle was in a
//! lost figure. Interpretation (designed, fits the thesis's usable examples): the base pose is the
//! arm hanging, palm to the thigh, fingers down; the smallest rotation carries its normal to the
//! requested one (half a turn about the vertical if they are opposed), then the angle turns about
//! that normal.

use core::f64::consts::{FRAC_PI_2, PI};

use raconteur_base::{DMat3, DQuat, DVec3, Length, Side, ops};

/// Returns the direction of the fingers in the zero pose, world, unit.
#[must_use]
pub fn zero_fingers(side: Side) -> DVec3 {
    DVec3::X * side.sign()
}

/// Normal out of the palm in the zero pose, world, unit.
pub const ZERO_NORMAL: DVec3 = DVec3::NEG_Y;

/// Returns the world rotation of a hand whose palm faces `normal_in_world` (the normal points out
/// of the palm; any length). `angle_rad` turns the hand about that normal by the left-hand rule, from
/// the direction of the zero pose. `None` for a zero normal.
#[must_use]
pub fn hand_rotation(side: Side, normal_in_world: DVec3, angle_rad: f64) -> Option<DQuat> {
    let normal = normal_in_world.try_normalized()?;
    if !angle_rad.is_finite() {
        return None;
    }
    let turn = DQuat::from_axis_angle(normal, -angle_rad);
    Some((turn * unturned(side, normal)).normalized())
}

/// Returns the hand rotation with this palm normal (unit) and an angle of 0 about it.
fn unturned(side: Side, normal: DVec3) -> DQuat {
    let hanging = DQuat::from_rotation_z(-side.sign() * FRAC_PI_2);
    let hanging_normal = hanging * ZERO_NORMAL;
    let carry = if hanging_normal.dot(normal) < -1.0 + 1e-12 {
        DQuat::from_rotation_y(PI)
    } else {
        DQuat::from_rotation_arc(hanging_normal, normal)
    };
    carry * hanging
}

/// Returns the palm's normal (world, unit) and the angle about it (radians, −π..π) of a hand
/// rotation; the inverse of [`hand_rotation`].
#[must_use]
pub fn normal_and_angle(side: Side, hand_in_world: DQuat) -> (DVec3, f64) {
    let normal = hand_in_world * ZERO_NORMAL;
    let turn = hand_in_world * unturned(side, normal).inverse();
    let sine = DVec3::new(turn.x, turn.y, turn.z).dot(normal);
    (normal, ops::wrap_angle(-2.0 * ops::atan2(sine, turn.w)))
}

/// Returns the hand rotation for given directions of the fingers and of the palm's normal; the
/// normal is orthogonalised to the fingers. `None` when they are parallel or zero.
#[must_use]
pub fn from_directions(side: Side, fingers: DVec3, normal: DVec3) -> Option<DQuat> {
    let columns = |fingers: DVec3, normal: DVec3| {
        let f = fingers.try_normalized()?;
        let n = (normal - f * f.dot(normal)).try_normalized()?;
        Some(DMat3::from_cols(f, n, f.cross(n)))
    };
    let zero = columns(zero_fingers(side), ZERO_NORMAL)?;
    let wanted = columns(fingers, normal)?;
    Some(DQuat::from_mat3(&(wanted * zero.transpose())).normalized())
}

#[cfg(test)]
mod tests {
    use super::*;
    use raconteur_base::{mirror_rotation, mirror_vector};

    const LEFT: DVec3 = DVec3::X;
    const RIGHT: DVec3 = DVec3::NEG_X;
    const UP: DVec3 = DVec3::Y;
    const DOWN: DVec3 = DVec3::NEG_Y;
    const FRONT: DVec3 = DVec3::Z;
    const BACK: DVec3 = DVec3::NEG_Z;

    /// Direction of the right hand's fingers at −90, 0, 90 and 180 degrees.
    const TABLE: [(DVec3, [DVec3; 4]); 6] = [
        (LEFT, [BACK, DOWN, FRONT, UP]),
        (RIGHT, [FRONT, DOWN, BACK, UP]),
        (UP, [BACK, LEFT, FRONT, RIGHT]),
        (DOWN, [BACK, RIGHT, FRONT, LEFT]),
        (FRONT, [LEFT, DOWN, RIGHT, UP]),
        (BACK, [RIGHT, DOWN, LEFT, UP]),
    ];

    #[test]
    fn fingers_point_as_the_table_of_conventions_says() {
        for (normal, fingers) in TABLE {
            for (k, expected) in fingers.into_iter().enumerate() {
                let angle = (k as f64 - 1.0) * FRAC_PI_2;
                let q = hand_rotation(Side::Right, normal, angle).unwrap_or(DQuat::IDENTITY);
                assert!(
                    (q * zero_fingers(Side::Right) - expected).length() < 1e-9,
                    "{normal} {k}"
                );
                assert!((q * ZERO_NORMAL - normal).length() < 1e-9, "{normal} {k}");
            }
        }
    }

    #[test]
    fn the_left_hand_mirrors_with_the_angle_negated() {
        for i in 0..200 {
            let r = |k| raconteur_base::noise::signed(5, k, i);
            let (normal, angle) = (DVec3::new(r(0), r(1), r(2)), r(3) * PI);
            let right = hand_rotation(Side::Right, normal, angle).unwrap_or(DQuat::IDENTITY);
            let left = hand_rotation(Side::Left, mirror_vector(normal), -angle);
            let left = left.unwrap_or(DQuat::IDENTITY);
            assert!(
                mirror_rotation(right).angle_between(left) < 1e-7,
                "the mirrored right hand is the left hand"
            );
        }
    }

    #[test]
    fn normals_and_angles_are_read_back() {
        for i in 0..200 {
            let r = |k| raconteur_base::noise::signed(6, k, i);
            let (normal, angle) = (DVec3::new(r(0), r(1), r(2)), r(3) * PI);
            let side = Side::BOTH[(i % 2) as usize];
            let hand = hand_rotation(side, normal, angle).unwrap_or(DQuat::IDENTITY);
            let (found, turned) = normal_and_angle(side, hand);
            assert!(
                found.distance(normal.normalize()) < 1e-9,
                "the palm normal round trips"
            );
            assert!(
                ops::wrap_angle(turned - angle).abs() < 1e-9,
                "{turned} {angle}"
            );
        }
    }

    #[test]
    fn the_zero_pose_is_palm_down_at_zero() {
        for side in Side::BOTH {
            let q = hand_rotation(side, DOWN, 0.0).unwrap_or(DQuat::from_rotation_x(1.0));
            assert!(
                q.angle_between(DQuat::IDENTITY) < 1e-7,
                "the zero pose has no rotation"
            );
        }
        assert!(
            hand_rotation(Side::Left, DVec3::ZERO, 0.0).is_none(),
            "a zero normal has no hand rotation"
        );
    }

    #[test]
    fn directions_are_met() {
        let q = from_directions(Side::Right, UP, FRONT).unwrap_or(DQuat::IDENTITY);
        assert!(
            (q * RIGHT - UP).length() < 1e-9 && (q * DOWN - FRONT).length() < 1e-9,
            "palm and fingers have the requested directions"
        );
        assert!(
            from_directions(Side::Left, UP, UP).is_none(),
            "parallel directions have no rotation"
        );
    }
}
