//! Directions, palms and places of HamNoSys.
//!
//! Directions are in EML's axes: x to the signer's left, y up, z to the back. Values are those of the
//! right, dominant hand.

use raconteur_base::{DQuat, DVec3};

use crate::orientation::unit;

/// Front, away from the signer.
const FRONT: DVec3 = DVec3::NEG_Z;
/// Deviation below which a component counts as zero.
const MIN_COMPONENT: f64 = 1e-6;

/// Returns the direction of letters: u up, d down, l left, r right, o out (away from the signer), i
/// in; together the direction between. `None` for other letters, and if they cancel out.
pub(super) fn direction(letters: &str) -> Option<DVec3> {
    if letters.len() > 6 {
        return None;
    }
    let mut sum = DVec3::ZERO;
    for letter in letters.chars() {
        sum += match letter {
            'u' => DVec3::Y,
            'd' => DVec3::NEG_Y,
            'l' => DVec3::X,
            'r' => DVec3::NEG_X,
            'o' => FRONT,
            'i' => DVec3::Z,
            _ => return None,
        };
    }
    unit(sum)
}

/// Returns the direction in which a palm faces.
///
/// HamNoSys writes palms as they are with the fingers to the front, where they are literal. Other
/// fingers carry the palm along the shortest way: with the fingers up, `d` faces away from the
/// signer and `u` the signer; with the fingers to the left, `l` faces the signer. Fingers towards
/// the signer are carried from those straight to the signer, where palms are literal too. The
/// standard only shows examples (Hanke 2004); the rule for the remaining directions is *designed*.
pub(super) fn palm(letters: DVec3, fingers: DVec3) -> DVec3 {
    let from = if fingers.z > MIN_COMPONENT {
        DVec3::Z
    } else {
        FRONT
    };
    DQuat::from_rotation_arc(from, fingers) * letters
}

/// Place on the body, its surface in the middle.
#[derive(Clone, Copy, Debug)]
pub(super) struct BodyPlace {
    /// Speaker coordinates, skeleton units.
    pub(super) position: DVec3,
    /// Half of its width, skeleton units.
    pub(super) half_width: f64,
    /// True if it exists on both sides only.
    pub(super) is_paired: bool,
}

/// Places of HamNoSys with height, depth, half width, and whether they are paired. Skeleton units
/// from the pelvis, *measured* by eye on the shipped figures, whose shoulders are at 24.7.
const PLACES: [(&str, [f64; 3], bool); 28] = [
    ("head", [36.0, -5.0, 3.5], false),
    ("headtop", [41.5, -0.5, 3.5], false),
    ("forehead", [38.0, -5.0, 3.0], false),
    ("eyebrows", [36.6, -5.0, 2.0], false),
    ("eyes", [35.6, -4.8, 2.0], false),
    ("nose", [34.3, -6.0, 1.0], false),
    ("nostrils", [33.8, -5.8, 1.0], false),
    ("ear", [34.8, 0.0, 3.6], true),
    ("earlobe", [33.4, 0.0, 3.5], true),
    ("cheek", [33.6, -4.2, 2.6], true),
    ("lips", [32.7, -5.4, 1.5], false),
    ("tongue", [32.6, -5.8, 1.0], false),
    ("teeth", [32.7, -5.4, 1.0], false),
    ("chin", [31.0, -5.0, 1.5], false),
    ("underchin", [30.2, -4.2, 1.5], false),
    ("neck", [28.5, -3.0, 2.5], false),
    ("shouldertop", [26.5, 0.5, 6.5], true),
    ("shoulders", [24.0, -3.5, 7.0], false),
    ("chest", [20.0, -5.5, 6.0], false),
    ("stomach", [13.0, -5.5, 5.5], false),
    ("belowstomach", [6.0, -5.5, 5.5], false),
    ("neutralspace", [15.0, -14.0, 6.0], false),
    ("upperarm", [18.0, -2.5, 9.0], true),
    ("elbow", [12.0, -1.0, 10.5], true),
    ("elbowinside", [12.0, -4.0, 9.5], true),
    ("lowerarm", [10.0, -7.0, 9.0], true),
    ("eyelid", [35.6, -4.8, 2.0], false),
    ("lowerlip", [32.3, -5.4, 1.5], false),
];

/// Names of the places, for hints.
pub(super) fn place_names() -> impl Iterator<Item = &'static str> + Clone {
    PLACES.iter().map(|(name, ..)| *name)
}

/// Returns the place of a name.
pub(super) fn place(name: &str) -> Option<BodyPlace> {
    let found = PLACES.iter().find(|(known, ..)| *known == name)?;
    let [y, z, half_width] = found.1;
    Some(BodyPlace {
        position: DVec3::new(0.0, y, z),
        half_width,
        is_paired: found.2,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn named(letters: &str) -> DVec3 {
        direction(letters).expect("a direction")
    }

    #[test]
    fn letters_are_directions() {
        assert_eq!(named("u"), DVec3::Y, "up");
        assert_eq!(named("o"), DVec3::NEG_Z, "away from the signer");
        let between = named("ul");
        assert!((between.x - between.y).abs() < 1e-12, "{between}");
        for wrong in ["", "x", "ud", "uuuuuuuuuu", "é"] {
            assert_eq!(direction(wrong), None, "{wrong}");
        }
    }

    #[test]
    fn fingers_carry_the_palm() {
        for (fingers, letters, wanted) in [
            ("o", "d", "d"),
            ("o", "l", "l"),
            ("u", "d", "o"),
            ("u", "u", "i"),
            ("u", "l", "l"),
            ("d", "d", "i"),
            ("l", "l", "i"),
            ("l", "r", "o"),
            ("l", "d", "d"),
            ("r", "l", "o"),
            ("i", "l", "l"),
            ("il", "r", "ir"),
        ] {
            let found = palm(named(letters), named(fingers));
            assert!(
                found.distance(named(wanted)) < 1e-9,
                "fingers {fingers}, palm {letters}: {found}, not {wanted}"
            );
        }
    }

    #[test]
    fn palms_are_perpendicular_if_they_are_so_in_front() {
        for fingers in ["ul", "ol", "il", "do", "di", "uo", "d", "i"] {
            for letters in ["u", "ur", "r", "dr", "d", "dl", "l", "ul"] {
                let fingers = named(fingers);
                let found = palm(named(letters), fingers);
                assert!(
                    found.dot(fingers).abs() < 1e-9,
                    "{found} is perpendicular to {fingers}"
                );
            }
        }
    }
}
