//! Floor and backdrop.

use crate::Lighting;
use crate::light::lamp;

/// A place that the stage shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SetKind {
    /// A curtain hung in a wide curve behind a floor of boards.
    Curtain,
    /// A room with a hearth at the character's right, a rug on its wooden floor.
    Fireside,
    /// A lawn before a hedge, trees and sky.
    Garden,
    /// Grass before dark hills, under stars and a moon at the character's left.
    Night,
    /// A classroom: a blackboard behind, a teacher's desk at the character's left.
    School,
    /// An even wall that runs into the floor, as a photographer's.
    Studio,
}

/// Place and colours of the stage, linear RGB.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Set {
    /// What stands there.
    pub kind: SetKind,
    /// The floor near the figure; what is of wood in a room.
    pub floor: [f32; 3],
    /// The backdrop at the horizon.
    pub backdrop_low: [f32; 3],
    /// The backdrop above.
    pub backdrop_high: [f32; 3],
    /// The pool of light behind the figure, added around the middle of the curtain; in other
    /// places what shines there: fire, discs of sunlight, moon and stars, light from a window.
    pub glow: [f32; 3],
    /// The colour that all fades to with distance.
    pub fog: [f32; 3],
    /// How fast it does, per metre beyond the figure; 0 for clear air.
    pub fog_density: f32,
}

/// Density of the thickest fog, per metre: a third is left of a wall three metres behind.
/// Chosen by eye.
const THICKEST_FOG: f32 = 0.40;

impl Set {
    /// Places by name.
    pub const NAMES: [(&str, SetKind); 5] = [
        ("curtain", SetKind::Curtain),
        ("fireside", SetKind::Fireside),
        ("garden", SetKind::Garden),
        ("night", SetKind::Night),
        ("school", SetKind::School),
    ];

    /// The place of this name in [`Self::NAMES`].
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        let found = Self::NAMES.iter().find(|(n, _)| *n == name);
        found.map(|(_, kind)| Self::of(*kind))
    }

    /// A place in its usual colours, in clear air. All chosen by eye.
    #[must_use]
    pub fn of(kind: SetKind) -> Self {
        let [floor, backdrop_low, backdrop_high, glow] = match kind {
            // An evening stage, dark about the speaker: aubergine above, a low pool of warm light
            // behind.
            SetKind::Curtain => [
                [0.115, 0.070, 0.046],
                [0.0165, 0.0085, 0.0105],
                [0.0065, 0.0050, 0.0085],
                [0.080, 0.045, 0.032],
            ],
            SetKind::Fireside => [
                [0.115, 0.060, 0.033],
                [0.045, 0.026, 0.017],
                [0.030, 0.018, 0.013],
                [0.340, 0.118, 0.028],
            ],
            SetKind::Garden => [
                [0.075, 0.118, 0.034],
                [0.044, 0.070, 0.028],
                [0.520, 0.600, 0.660],
                [0.340, 0.320, 0.160],
            ],
            SetKind::Night => [
                [0.030, 0.044, 0.042],
                [0.030, 0.052, 0.110],
                [0.006, 0.012, 0.040],
                [0.300, 0.330, 0.400],
            ],
            SetKind::School => [
                [0.190, 0.120, 0.066],
                [0.190, 0.178, 0.128],
                [0.370, 0.340, 0.270],
                [0.100, 0.105, 0.105],
            ],
            SetKind::Studio => [[0.20; 3], [0.20; 3], [0.30; 3], [0.0; 3]],
        };
        Self {
            kind,
            floor,
            backdrop_low,
            backdrop_high,
            glow,
            fog: [0.0; 3],
            fog_density: 0.0,
        }
    }

    /// The usual lamps of the place. Designed, by eye: each is bright enough on a face's nearer
    /// side, and its rim comes from what shines in the picture.
    #[must_use]
    pub fn lighting(&self) -> Lighting {
        match self.kind {
            SetKind::Curtain => Lighting::default(),
            // The key from the hearth's side, as if a lamp stood before it.
            SetKind::Fireside => Lighting {
                key: lamp([-0.72, 0.42, 0.80], [1.12, 0.88, 0.64]),
                fill: lamp([0.80, 0.15, 0.85], [0.12, 0.115, 0.125]),
                rim: lamp([-0.70, 0.30, -0.90], [1.30, 0.70, 0.32]),
                sky: [0.135, 0.120, 0.110],
                ground: [0.130, 0.085, 0.055],
                exposure: 1.08,
                softness: 1.0,
            },
            // A high sun behind a shoulder, and the open sky before the face.
            SetKind::Garden => Lighting {
                key: lamp([-0.52, 0.74, 0.78], [1.00, 0.94, 0.82]),
                fill: lamp([0.80, 0.20, 0.85], [0.20, 0.23, 0.26]),
                rim: lamp([0.60, 0.85, -0.80], [1.30, 1.22, 0.98]),
                sky: [0.24, 0.27, 0.31],
                ground: [0.125, 0.145, 0.085],
                exposure: 1.0,
                softness: 1.0,
            },
            // A lantern's warmth on the face against the moon's cool edge.
            SetKind::Night => Lighting {
                key: lamp([-0.62, 0.55, 0.85], [0.98, 0.90, 0.82]),
                fill: lamp([0.80, 0.15, 0.85], [0.10, 0.14, 0.22]),
                rim: lamp([0.55, 0.70, -0.95], [0.85, 1.20, 1.75]),
                sky: [0.105, 0.130, 0.190],
                ground: [0.065, 0.070, 0.085],
                exposure: 1.05,
                softness: 1.0,
            },
            // White panels under a ceiling and a row of windows at one side.
            SetKind::School => Lighting {
                key: lamp([-0.62, 0.72, 0.80], [0.94, 0.93, 0.90]),
                fill: lamp([0.80, 0.25, 0.80], [0.22, 0.225, 0.23]),
                rim: lamp([0.50, 0.90, -0.85], [0.70, 0.74, 0.80]),
                sky: [0.26, 0.265, 0.27],
                ground: [0.150, 0.130, 0.105],
                exposure: 1.0,
                softness: 1.0,
            },
            SetKind::Studio => Lighting::named("studio").unwrap_or_default(),
        }
    }

    /// The place in another light: floor, backdrop and what shines times a linear colour and a
    /// factor, the air as thick as `mist` says, 0 to 1. White, 1 and 0 change no colour.
    #[must_use]
    pub fn lit(self, tint: [f32; 3], gain: f32, mist: f32) -> Self {
        let tinted = |c: [f32; 3]| std::array::from_fn(|i| c[i] * tint[i] * gain);
        let [low, high, glow]: [[f32; 3]; 3] =
            [self.backdrop_low, self.backdrop_high, self.glow].map(tinted);
        Self {
            floor: tinted(self.floor),
            backdrop_low: low,
            backdrop_high: high,
            glow,
            // What shines lights the air, too.
            fog: std::array::from_fn(|i| 0.5 * (low[i] + high[i]) + 0.12 * glow[i]),
            fog_density: THICKEST_FOG * mist.clamp(0.0, 1.0),
            ..self
        }
    }
}

impl Default for Set {
    fn default() -> Self {
        Self::of(SetKind::Curtain)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_named_place_is_there_and_its_lamps_are_lamps() {
        for (name, kind) in Set::NAMES {
            let set = Set::of(kind);
            assert_eq!(Set::named(name), Some(set));
            let light = set.lighting();
            for lamp in [light.key, light.fill, light.rim] {
                let length = lamp.towards_light_in_world.length();
                assert!((length - 1.0).abs() < 1e-12, "{name}");
                assert!(
                    lamp.irradiance.iter().all(|c| (0.0..2.0).contains(c)),
                    "{name}"
                );
            }
            assert!(light.key.irradiance > light.fill.irradiance, "{name}");
        }
        assert_eq!(Set::named("moon"), None);
        assert_eq!(Set::default().lighting(), Lighting::default());
    }

    #[test]
    fn white_light_in_clear_air_changes_no_colour() {
        for (name, kind) in Set::NAMES {
            let set = Set::of(kind);
            let lit = set.lit([1.0; 3], 1.0, 0.0);
            let fog = lit.fog;
            assert_eq!(lit, Set { fog, ..set }, "{name}");
            let blue = set.lit([0.5, 0.5, 1.0], 0.5, 2.0);
            assert!((blue.floor[0] - 0.25 * set.floor[0]).abs() < 1e-6, "{name}");
            assert!((blue.fog_density - THICKEST_FOG).abs() < 1e-6, "{name}");
        }
    }
}
