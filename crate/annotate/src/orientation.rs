//! Orientation of a hand as EML's palm normal and angle.
//!
//! Directions are unit vectors in EML's axes: x to the speaker's left, y up, z to the back. These
//! axes are left-handed, so the usual formula of rotation, applied to their components, turns by the
//! left hand's rule, as EML does.

use raconteur_base::{DQuat, DVec3, Side, ops};
use raconteur_eml::PalmKey;

use crate::script::rounded;

/// Direction of the fingers of the hanging arm, at angle 0.
const HANGING: DVec3 = DVec3::NEG_Y;
/// Length below which a vector has no direction.
const MIN_LENGTH: f64 = 1e-6;

/// Returns the palm key of a hand whose fingers point along a direction and whose palm faces another
/// one as closely as the first permits. `None` if a vector is zero or both are parallel.
///
/// The angle counts from the fingers of the hanging arm, turned the shortest way with the palm from
/// the thigh to the normal (GEVH D.5.4).
pub(crate) fn palm_key(side: Side, fingers: DVec3, palm: DVec3) -> Option<PalmKey> {
    let mirror = |v: DVec3| match side {
        Side::Right => v,
        Side::Left => DVec3::new(-v.x, v.y, v.z),
    };
    let fingers = unit(mirror(fingers))?;
    let normal = unit(mirror(palm))?;
    let normal = unit(normal - fingers * normal.dot(fingers))?;
    // The thigh is to the left of the right hand.
    let turn = if normal.x < MIN_LENGTH - 1.0 {
        DQuat::from_rotation_y(core::f64::consts::PI)
    } else {
        DQuat::from_rotation_arc(DVec3::X, normal)
    };
    let zero = turn * HANGING;
    let angle = ops::atan2(zero.cross(fingers).dot(normal), zero.dot(fingers));
    let axis = mirror(normal);
    Some(PalmKey {
        angle_deg: 0.0 + rounded(angle.to_degrees() * mirrored_sign(side)),
        axis: [axis.x, axis.y, axis.z].map(|x| 0.0 + rounded(x)),
    })
}

/// Returns the sign of angles: a mirrored hand turns the other way.
fn mirrored_sign(side: Side) -> f64 {
    match side {
        Side::Right => 1.0,
        Side::Left => -1.0,
    }
}

/// Returns the direction of a vector; `None` for zero.
pub(crate) fn unit(v: DVec3) -> Option<DVec3> {
    (v.length() > MIN_LENGTH).then(|| v.normalize())
}

#[cfg(test)]
mod tests {
    use super::*;

    const LEFT: DVec3 = DVec3::X;
    const UP: DVec3 = DVec3::Y;
    const BACK: DVec3 = DVec3::Z;

    /// Palm normals with the directions of a right hand's fingers at −90°, 0°, 90° and 180°, from
    /// the definition (see `docs/eml.md`, palms).
    const FINGERS: [(DVec3, [DVec3; 4]); 6] = [
        (LEFT, [BACK, DVec3::NEG_Y, DVec3::NEG_Z, UP]),
        (DVec3::NEG_X, [DVec3::NEG_Z, DVec3::NEG_Y, BACK, UP]),
        (UP, [BACK, LEFT, DVec3::NEG_Z, DVec3::NEG_X]),
        (DVec3::NEG_Y, [BACK, DVec3::NEG_X, DVec3::NEG_Z, LEFT]),
        (DVec3::NEG_Z, [LEFT, DVec3::NEG_Y, DVec3::NEG_X, UP]),
        (BACK, [DVec3::NEG_X, DVec3::NEG_Y, LEFT, UP]),
    ];

    #[test]
    fn angles_agree_with_the_definition() {
        for (normal, directions) in FINGERS {
            for (fingers, wanted) in directions.into_iter().zip([-90.0, 0.0, 90.0, 180.0]) {
                let key = palm_key(Side::Right, fingers, normal).expect("perpendicular");
                let off = (key.angle_deg - wanted).rem_euclid(360.0);
                assert!(
                    off.min(360.0 - off) < 1e-3,
                    "palm {normal}, fingers {fingers}: {key:?} instead of {wanted}"
                );
                assert!(
                    DVec3::from_array(key.axis).distance(normal) < 1e-6,
                    "the normal stays: {key:?}"
                );
                let mirror = |v: DVec3| DVec3::new(-v.x, v.y, v.z);
                let left = palm_key(Side::Left, mirror(fingers), mirror(normal));
                let left = left.expect("perpendicular");
                assert!(
                    (left.angle_deg + key.angle_deg).abs() < 1e-6,
                    "the left hand turns the other way: {left:?}"
                );
            }
        }
    }

    #[test]
    fn a_palm_is_made_perpendicular_to_the_fingers() {
        let key = palm_key(Side::Right, DVec3::NEG_Z, DVec3::new(1.0, 0.0, -1.0));
        let key = key.expect("a palm");
        assert_eq!(key.axis, [1.0, 0.0, 0.0], "the left part remains");
        assert_eq!(
            palm_key(Side::Right, UP, UP),
            None,
            "parallel vectors are no orientation"
        );
        assert_eq!(palm_key(Side::Right, UP, DVec3::ZERO), None, "zero");
    }
}
