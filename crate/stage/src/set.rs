//! Floor and backdrop.

use raconteur_base::ops;

use crate::Lighting;
use crate::light::lamp;

/// Kind of stage set: the scenery around the figure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StageSet {
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

/// A stage set as rendered: its kind, and the colours of floor and backdrop, linear RGB.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Set {
    /// Kind of scenery.
    pub kind: StageSet,
    /// Floor near the figure; in a room the wooden parts.
    pub floor: [f32; 3],
    /// The backdrop at the horizon.
    pub backdrop_low: [f32; 3],
    /// Colour of the upper backdrop, linear RGB.
    pub backdrop_high: [f32; 3],
    /// Pool of light behind the figure, added around the middle of the curtain; in other sets the
    /// light sources: fire, discs of sunlight, moon and stars, light from a window.
    pub glow: [f32; 3],
    /// The colour that all fades to with distance.
    pub fog: [f32; 3],
    /// Fog density, per metre beyond the figure; 0 for clear air.
    pub fog_density: f32,
    /// Animation time of fire and leaves, seconds; 0 where they are to be still.
    pub time_secs: f64,
}

/// Density of the thickest fog, per metre: a third is left of a wall three metres behind.
/// Chosen by eye.
const MAX_FOG: f32 = 0.40;

impl Set {
    /// Names of the stage sets in stories and options.
    pub const NAMES: [(&str, StageSet); 5] = [
        ("curtain", StageSet::Curtain),
        ("fireside", StageSet::Fireside),
        ("garden", StageSet::Garden),
        ("night", StageSet::Night),
        ("school", StageSet::School),
    ];

    /// Returns the stage set with a name in [`Self::NAMES`]; `None` for an unknown name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        let found = Self::NAMES.iter().find(|(n, _)| *n == name);
        found.map(|(_, kind)| Self::from_kind(*kind))
    }

    /// Returns a set in its usual colours, in clear air. All chosen by eye.
    #[must_use]
    pub fn from_kind(kind: StageSet) -> Self {
        let [floor, backdrop_low, backdrop_high, glow] = match kind {
            // An evening stage: velvet of a dark red, a low pool of warm light behind the speaker.
            StageSet::Curtain => [
                [0.115, 0.070, 0.046],
                [0.030, 0.0070, 0.0085],
                [0.012, 0.0045, 0.0070],
                [0.080, 0.025, 0.019],
            ],
            StageSet::Fireside => [
                [0.115, 0.060, 0.033],
                [0.045, 0.026, 0.017],
                [0.030, 0.018, 0.013],
                [0.340, 0.118, 0.028],
            ],
            StageSet::Garden => [
                [0.075, 0.118, 0.034],
                [0.044, 0.070, 0.028],
                [0.520, 0.600, 0.660],
                [0.340, 0.320, 0.160],
            ],
            StageSet::Night => [
                [0.030, 0.044, 0.042],
                [0.030, 0.052, 0.110],
                [0.006, 0.012, 0.040],
                [0.300, 0.330, 0.400],
            ],
            StageSet::School => [
                [0.190, 0.120, 0.066],
                [0.190, 0.178, 0.128],
                [0.370, 0.340, 0.270],
                [0.100, 0.105, 0.105],
            ],
            StageSet::Studio => [[0.20; 3], [0.20; 3], [0.30; 3], [0.0; 3]],
        };
        Self {
            kind,
            floor,
            backdrop_low,
            backdrop_high,
            glow,
            fog: [0.0; 3],
            fog_density: 0.0,
            time_secs: 0.0,
        }
    }

    /// Returns the usual lamps of the set. Designed, by eye: each is bright enough on a face's
    /// nearer side, and its rim comes from the visible light source.
    #[must_use]
    pub fn lighting(&self) -> Lighting {
        match self.kind {
            StageSet::Curtain => Lighting::default(),
            // From the hearth's side, as wide as its light on the walls.
            StageSet::Fireside => Lighting {
                key: lamp([-0.93, 0.12, 0.48], [1.26, 0.86, 0.53]),
                fill: lamp([0.80, 0.15, 0.85], [0.135, 0.130, 0.145]),
                rim: lamp([-0.90, 0.05, -0.70], [1.95, 0.90, 0.33]),
                sky: [0.140, 0.120, 0.108],
                ground: [0.135, 0.085, 0.052],
                exposure: 1.08,
                softness: 1.7,
            },
            // A high sun behind a shoulder, and the open sky before the face.
            StageSet::Garden => Lighting {
                key: lamp([-0.56, 0.74, 0.74], [1.00, 0.95, 0.84]),
                fill: lamp([0.80, 0.20, 0.85], [0.20, 0.23, 0.26]),
                rim: lamp([0.60, 0.85, -0.80], [1.45, 1.32, 1.02]),
                sky: [0.24, 0.27, 0.31],
                ground: [0.125, 0.145, 0.085],
                exposure: 1.0,
                softness: 1.5,
            },
            // The lantern's warmth on the face against the moon's cool edge.
            StageSet::Night => Lighting {
                key: lamp([-0.93, 0.12, 0.46], [1.30, 0.82, 0.45]),
                fill: lamp([0.80, 0.15, 0.85], [0.10, 0.14, 0.23]),
                rim: lamp([0.55, 0.70, -0.95], [0.55, 0.78, 1.15]),
                sky: [0.105, 0.130, 0.190],
                ground: [0.065, 0.070, 0.085],
                exposure: 1.08,
                softness: 1.4,
            },
            // A window at one side, and the white panels of the ceiling.
            StageSet::School => Lighting {
                key: lamp([-0.94, 0.38, 0.46], [1.10, 1.10, 1.08]),
                fill: lamp([0.80, 0.25, 0.80], [0.17, 0.168, 0.162]),
                rim: lamp([-0.65, 0.60, -0.85], [0.80, 0.84, 0.90]),
                sky: [0.25, 0.255, 0.26],
                ground: [0.150, 0.130, 0.105],
                exposure: 1.0,
                softness: 2.0,
            },
            StageSet::Studio => Lighting::named("studio").unwrap_or_default(),
        }
    }

    /// Returns the present brightness of a fire that lights the figure's edge, about 1. Its waves
    /// are of 0.9 and 1.6 Hz: nothing flashes (WCAG 2.2, success criterion 2.3.1).
    #[must_use]
    pub fn flicker(&self) -> f32 {
        if self.kind != StageSet::Fireside {
            return 1.0;
        }
        let wave = |hz: f64| ops::sincos(core::f64::consts::TAU * hz * self.time_secs).0;
        (1.0 + 0.05 * wave(0.9) + 0.04 * wave(1.6)) as f32
    }

    /// Returns the horizontal offset of the speaker that keeps the set visible: share of half the
    /// image height, positive to the right; relative to the height, so images of all widths align.
    /// Designed.
    #[must_use]
    pub fn aside(&self) -> f64 {
        match self.kind {
            // The hearth is on the left.
            StageSet::Fireside => 0.38,
            // The lantern and the window, less of the desk.
            StageSet::Night | StageSet::School => 0.28,
            // The tree is on the right.
            StageSet::Garden => -0.36,
            StageSet::Curtain | StageSet::Studio => 0.0,
        }
    }

    /// Returns the set in another light: floor, backdrop and light sources times a linear colour
    /// and a factor, with fog density from `mist`, 0 to 1. White, 1 and 0 change no colour.
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
            // Light sources also light the air.
            fog: std::array::from_fn(|i| 0.5 * (low[i] + high[i]) + 0.12 * glow[i]),
            fog_density: MAX_FOG * mist.clamp(0.0, 1.0),
            ..self
        }
    }
}

impl Default for Set {
    fn default() -> Self {
        Self::from_kind(StageSet::Curtain)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_named_place_is_there_and_its_lamps_are_lamps() {
        for (name, kind) in Set::NAMES {
            let set = Set::from_kind(kind);
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
            let set = Set::from_kind(kind);
            let lit = set.lit([1.0; 3], 1.0, 0.0);
            let fog = lit.fog;
            assert_eq!(lit, Set { fog, ..set }, "{name}");
            let blue = set.lit([0.5, 0.5, 1.0], 0.5, 2.0);
            assert!((blue.floor[0] - 0.25 * set.floor[0]).abs() < 1e-6, "{name}");
            assert!((blue.fog_density - MAX_FOG).abs() < 1e-6, "{name}");
        }
    }
}
