//! Three-point light: key, fill and rim, with a soft ambient from sky and floor.

use raconteur_base::{DQuat, DVec3, Length};

/// Distant light with parallel rays.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DirectedLight {
    /// Unit vector from the scene towards the light, world.
    pub towards_light_in_world: DVec3,
    /// Linear RGB irradiance at normal incidence; 1 lights white paper to white.
    pub irradiance: [f32; 3],
}

/// All lights on the stage: key, fill and rim lamps, sky and ground.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lighting {
    /// The strongest light; it casts the shadows.
    pub key: DirectedLight,
    /// Softens the key's shadows from the other side.
    pub fill: DirectedLight,
    /// Light from behind, which separates hair and shoulders from the backdrop.
    pub rim: DirectedLight,
    /// Ambient from above, linear RGB.
    pub sky: [f32; 3],
    /// Ambient from below, linear RGB.
    pub ground: [f32; 3],
    /// Exposure before tone mapping, a factor.
    pub exposure: f32,
    /// Softness of shadow edges: 1 as from the stage's own lamps, which are large.
    pub softness: f32,
}

/// Name of a lighting preset, and its constructor.
pub type Preset = (&'static str, fn() -> Lighting);

impl Lighting {
    /// Lights by name: the stage's own, a large window on a grey day, a low warm lamp from
    /// the side with a strong rim, and a studio's even light. All designed by eye.
    pub const PRESETS: [Preset; 4] = [
        ("stage", Self::default),
        ("daylight", Self::daylight),
        ("evening", Self::evening),
        ("studio", Self::studio),
    ];

    /// Returns the lighting preset with a name in [`Self::PRESETS`]; `None` for an unknown name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        let found = Self::PRESETS.iter().find(|(n, _)| *n == name);
        found.map(|(_, light)| light())
    }

    /// Returns the lighting with its lamps rotated about the character by `turn_rad` radians,
    /// positive to its left.
    #[must_use]
    pub fn turned(mut self, turn_rad: f64) -> Self {
        let turn = DQuat::from_rotation_y(turn_rad);
        for lamp in [&mut self.key, &mut self.fill, &mut self.rim] {
            lamp.towards_light_in_world = turn * lamp.towards_light_in_world;
        }
        self
    }

    /// Lighting with a window to the character's left, 50° round and 25° up; the remaining light
    /// comes from the room.
    fn daylight() -> Self {
        Self {
            key: lamp([0.78, 0.46, 0.64], [0.82, 0.87, 0.95]),
            fill: lamp([-0.80, 0.10, 0.70], [0.20, 0.19, 0.175]),
            rim: lamp([-0.45, 0.65, -0.90], [0.22, 0.23, 0.25]),
            sky: [0.26, 0.28, 0.31],
            ground: [0.15, 0.14, 0.125],
            exposure: 1.0,
            softness: 1.0,
        }
    }

    /// Lighting with a lamp at shoulder height, 70° to the character's right, and a strong rim
    /// light opposite.
    fn evening() -> Self {
        Self {
            key: lamp([-0.94, 0.12, 0.36], [1.15, 0.82, 0.52]),
            fill: lamp([0.80, 0.30, 0.80], [0.050, 0.060, 0.085]),
            rim: lamp([0.62, 0.50, -0.80], [1.05, 0.90, 0.78]),
            sky: [0.075, 0.080, 0.105],
            ground: [0.080, 0.055, 0.038],
            exposure: 1.1,
            softness: 1.0,
        }
    }

    /// Lighting with a large soft lamp from the front and bright walls: shows colours and shapes.
    fn studio() -> Self {
        Self {
            key: lamp([-0.55, 0.60, 0.90], [0.92, 0.90, 0.86]),
            fill: lamp([0.80, 0.20, 0.80], [0.30, 0.31, 0.33]),
            rim: lamp([0.60, 0.70, -0.90], [0.60, 0.60, 0.60]),
            sky: [0.26, 0.26, 0.27],
            ground: [0.16, 0.15, 0.14],
            exposure: 1.0,
            softness: 1.0,
        }
    }
}

/// Creates a light from a direction of any length.
pub(crate) fn lamp([x, y, z]: [f64; 3], irradiance: [f32; 3]) -> DirectedLight {
    DirectedLight {
        towards_light_in_world: DVec3::new(x, y, z).normalized(),
        irradiance,
    }
}

impl Default for Lighting {
    fn default() -> Self {
        Self {
            // Key 38° to the character's right and 33° up, warm: low enough to reach into the
            // orbits. A cool rim frees hair and shoulders from the curtain. Chosen by eye.
            key: lamp([-0.62, 0.66, 0.80], [1.06, 0.92, 0.77]),
            fill: lamp([0.80, 0.12, 0.85], [0.15, 0.17, 0.21]),
            rim: lamp([0.55, 0.75, -0.95], [1.02, 1.22, 1.48]),
            sky: [0.165, 0.18, 0.215],
            ground: [0.125, 0.10, 0.082],
            exposure: 1.08,
            softness: 1.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_named_light_is_a_light() {
        for (name, light) in Lighting::PRESETS {
            assert_eq!(Lighting::named(name), Some(light()));
            let l = light();
            for lamp in [l.key, l.fill, l.rim] {
                assert!(
                    (lamp.towards_light_in_world.length() - 1.0).abs() < 1e-12,
                    "{name}"
                );
                assert!(
                    lamp.irradiance.iter().all(|c| (0.0..2.0).contains(c)),
                    "{name}"
                );
            }
            assert!(
                l.key.irradiance > l.fill.irradiance,
                "{name}: the key is strongest"
            );
        }
        assert_eq!(Lighting::named("moon"), None);
    }

    #[test]
    fn lamps_turn_about_the_character() {
        let [before, after] = [Lighting::default(), Lighting::default().turned(0.5)];
        let (a, b) = (
            before.rim.towards_light_in_world,
            after.rim.towards_light_in_world,
        );
        assert!(
            (a.y - b.y).abs() < 1e-12 && b.x < -1e-3 + a.x.abs(),
            "the lamp turns about the character"
        );
        let round = after.turned(std::f64::consts::TAU - 0.5);
        let back = round.rim.towards_light_in_world - a;
        assert!(back.length() < 1e-9, "two opposite turns restore the lamp");
    }
}
