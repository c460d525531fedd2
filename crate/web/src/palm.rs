//! Palm direction for the gesture editing page: the normal and angle of EML as directions of the
//! hand, and back (`actor::palm`; GEVH section 3.5.1).

use raconteur_player::Units;
use raconteur_player::actor::palm::{hand_rotation, zero_fingers};
use raconteur_player::base::{DVec3, Side, ops};
use wasm_bindgen::prelude::*;

const fn side(left: bool) -> Side {
    if left { Side::Left } else { Side::Right }
}

/// Returns the directions of the palm's outward normal and of the fingers (world, unit; 6 numbers)
/// for a normal and an angle of EML (its axes, degrees). Empty for a normal without direction.
#[wasm_bindgen(js_name = handDirections)]
pub fn hand_directions(left: bool, x: f64, y: f64, z: f64, angle_deg: f64) -> Vec<f64> {
    let normal = Units::axis([x, y, z]).normalize_or_zero();
    hand_rotation(side(left), normal, angle_deg.to_radians()).map_or_else(Vec::new, |rotation| {
        let fingers = rotation * zero_fingers(side(left));
        [normal.to_array(), fingers.to_array()].concat()
    })
}

/// Returns the normal (EML's axes, unit) and the angle (-180 to 180 degrees; 4 numbers together) of
/// directions as returned by `handDirections`. Empty for invalid input.
#[wasm_bindgen(js_name = palmOf)]
pub fn palm_of(left: bool, directions: &[f64]) -> Vec<f64> {
    let &[nx, ny, nz, fx, fy, fz] = directions else {
        return Vec::new();
    };
    let normal = DVec3::new(nx, ny, nz).normalize_or_zero();
    let fingers = DVec3::new(fx, fy, fz);
    hand_rotation(side(left), normal, 0.0).map_or_else(Vec::new, |rotation| {
        let zero = rotation * zero_fingers(side(left));
        // By the left-hand rule, from the direction at no angle to the fingers.
        let angle_rad = -ops::atan2(zero.cross(fingers).dot(normal), zero.dot(fingers));
        // EML's z points to the back.
        vec![normal.x, normal.y, -normal.z, angle_rad.to_degrees()]
    })
}
