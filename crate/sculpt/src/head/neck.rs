//! Rim of the neck, the transition from the head to the body.

use raconteur_base::DVec3;

use super::cage::{Key, LAST_ROW};
use crate::person::Person;

/// Column of the cage and position on the mean adult, mm.
const RIM_MM: [(u8, DVec3); 6] = [
    (0, DVec3::new(0.0, -150.0, 33.0)),
    (4, DVec3::new(21.0, -150.0, 28.0)),
    (8, DVec3::new(47.0, -150.0, 4.0)),
    (12, DVec3::new(64.0, -150.0, -28.0)),
    (16, DVec3::new(60.0, -148.0, -64.0)),
    (20, DVec3::new(0.0, -150.0, -88.0)),
];
/// Depth of the neck's axis, about which it is scaled, mm.
const AXIS_Z_MM: f64 = -16.0;
/// Breadth and depth of a man's and of a woman's neck relative to the mean, and the deficit of a
/// child of nine. Designed: between them and the collar the surface is fitted to the body's own
/// neck.
const MAN: [f64; 2] = [0.22, 0.268];
const WOMAN: [f64; 2] = [-0.17, -0.13];
const CHILD: [f64; 2] = [-0.287, -0.272];
/// Upward and forward shift of the rim for a child of nine, mm.
const CHILD_SHIFT_MM: [f64; 2] = [12.0, 2.1];
/// Share of the difference between the sexes that a child of nine lacks.
const ALIKE: f64 = 0.8;

/// Returns the weight of the child of nine at an age: the face grows until about 18.
fn childhood(age_years: f64) -> f64 {
    ((18.0 - age_years) / 9.0).clamp(0.0, 1.12)
}

/// Returns the position of a vertex of the rim's left half in the frame of the head, mm; `None` for
/// those between the given columns, and of other rows.
pub(super) fn rim(person: &Person, key: Key) -> Option<DVec3> {
    let Key::Grid(column, LAST_ROW) = key else {
        return None;
    };
    let &(_, mean) = RIM_MM.iter().find(|(c, _)| *c == column)?;
    let child = childhood(person.age_years);
    let sex = (2.0 * person.sex - 1.0).clamp(-1.0, 1.0) * (1.0 - ALIKE * child.min(1.0));
    let own = if sex < 0.0 { MAN } else { WOMAN };
    let [wide, deep] = [0, 1].map(|axis| 1.0 + own[axis] * sex.abs() + CHILD[axis] * child);
    let [up, front] = CHILD_SHIFT_MM.map(|mm| mm * child);
    Some(DVec3::new(
        mean.x * wide,
        mean.y + up,
        AXIS_Z_MM + (mean.z - AXIS_Z_MM) * deep + front,
    ))
}
