//! One person: what tells Sofia from the table's heads, in millimetres.

use raconteur_base::DVec3;

use super::cage::Key;
use super::ear::EarShape;
use super::points::{Individual, Pull};

/// A relaxed lid and a lighter smile than the table's woman has.
const SOFIAS_SHIFTS: [(Key, [f64; 3]); 37] = [
    (Key::Eye(5, 2), [0.0, -0.3, 0.0]),
    (Key::Eye(5, 3), [0.0, -0.6, 0.0]),
    (Key::Eye(5, 4), [0.0, -0.75, 0.0]),
    (Key::Eye(5, 5), [0.0, -0.65, 0.0]),
    (Key::Eye(5, 6), [0.1, -0.4, 0.0]),
    (Key::Eye(5, 7), [0.2, -0.1, 0.0]),
    (Key::Eye(5, 8), [0.3, 0.1, -0.3]),
    (Key::Eye(5, 10), [0.0, 0.15, 0.0]),
    (Key::Eye(5, 11), [0.0, 0.25, 0.0]),
    (Key::Eye(5, 12), [0.0, 0.3, 0.0]),
    (Key::Eye(5, 13), [0.0, 0.25, 0.0]),
    (Key::Eye(5, 14), [0.0, 0.15, 0.0]),
    (Key::Eye(3, 3), [0.0, -0.25, 0.0]),
    (Key::Eye(3, 4), [0.0, -0.35, 0.0]),
    (Key::Eye(3, 5), [0.0, -0.3, 0.0]),
    (Key::Grid(4, 18), [0.4, 1.0, -0.3]),
    (Key::Mouth(1, 6), [0.6, 1.0, 0.3]),
    (Key::Mouth(3, 6), [0.5, 1.0, 0.1]),
    (Key::Mouth(4, 6), [0.4, 1.0, 0.0]),
    (Key::Grid(4, 17), [0.3, 0.6, 0.0]),
    (Key::Mouth(1, 5), [0.4, 0.8, 0.2]),
    (Key::Mouth(3, 5), [0.4, 0.8, 0.2]),
    (Key::Mouth(4, 5), [0.4, 0.8, 0.2]),
    (Key::Grid(4, 19), [0.3, 0.6, 0.0]),
    (Key::Mouth(1, 7), [0.3, 0.4, -0.2]),
    (Key::Mouth(3, 7), [0.3, 0.4, -0.2]),
    (Key::Mouth(4, 7), [0.3, 0.4, -0.2]),
    (Key::Mouth(1, 4), [0.1, 0.35, 0.0]),
    (Key::Mouth(3, 4), [0.1, 0.35, 0.0]),
    (Key::Mouth(4, 4), [0.1, 0.35, 0.0]),
    (Key::Mouth(1, 8), [0.1, 0.1, 0.0]),
    (Key::Mouth(3, 8), [0.1, 0.1, 0.0]),
    (Key::Mouth(4, 8), [0.1, 0.1, 0.0]),
    // A thinner middle of the upper lip.
    (Key::Mouth(1, 0), [0.0, -0.5, -0.2]),
    (Key::Mouth(1, 1), [0.0, -0.5, -0.2]),
    (Key::Mouth(1, 2), [0.0, -0.4, -0.1]),
    (Key::Mouth(1, 3), [0.0, -0.2, 0.0]),
];

/// A woman of about 35.
pub(super) const SOFIA: Individual = Individual {
    shift_share: 1.0,
    globe_shift: DVec3::new(-0.4, 0.0, -0.2),
    pulls: &[
        // A narrower upper skull than the mean of the sexes.
        Pull::new([74.0, 56.0, 20.0], 24.0, [-3.0, 0.0, 0.0]),
        Pull::new([46.0, 118.0, -8.0], 20.0, [-2.5, 0.0, 0.0]),
        // The cheeks of a light smile.
        Pull::new([46.0, -12.0, 84.0], 11.0, [0.2, 0.7, 0.7]),
        Pull::new([66.0, 92.0, -5.0], 20.0, [-4.0, -1.0, 0.0]),
    ],
    shifts: &SOFIAS_SHIFTS,
    ear: EarShape {
        scale: 0.95,
        lobe_drop: 0.0,
        protrusion_deg: 16.0,
        tilt_deg: 10.0,
        shift: DVec3::new(-2.4, 0.5, 0.0),
    },
};

/// Differences between the halves: pulls on one side only, mm, at asymmetry 1.
pub(super) const ASYMMETRY: [Pull; 8] = [
    Pull::new([0.0, -12.0, 118.0], 14.0, [0.7, 0.0, 0.0]),
    Pull::new([30.0, 48.0, 91.0], 13.0, [0.0, 0.9, 0.2]),
    Pull::new([26.0, -48.0, 92.0], 8.0, [0.2, 0.8, 0.0]),
    Pull::new([-30.0, -48.0, 90.0], 9.0, [0.3, -0.3, 0.0]),
    Pull::new([-20.0, -86.0, 92.0], 18.0, [0.8, 0.4, 0.0]),
    Pull::new([-48.0, -20.0, 82.0], 18.0, [-0.4, -0.5, 0.4]),
    Pull::new([-31.0, 27.0, 85.0], 5.0, [0.0, -0.3, 0.0]),
    Pull::new([60.0, -60.0, 20.0], 22.0, [-0.8, 0.0, 0.0]),
];
