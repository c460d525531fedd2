//! Three-point light: key, fill and rim, with a soft ambient from sky and floor.

use raconteur_base::DVec3;

/// A light from far away.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DirectedLight {
    /// Unit vector from the scene towards the light, world.
    pub towards_light_in_world: DVec3,
    /// Linear RGB irradiance at normal incidence; 1 lights white paper to white.
    pub irradiance: [f32; 3],
}

/// All the light on the stage.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lighting {
    /// The strongest light; it casts the shadows.
    pub key: DirectedLight,
    /// Softens the key's shadows from the other side.
    pub fill: DirectedLight,
    /// From behind; parts hair and shoulders from the backdrop.
    pub rim: DirectedLight,
    /// Ambient from above, linear RGB.
    pub sky: [f32; 3],
    /// Ambient from below, linear RGB.
    pub ground: [f32; 3],
    /// Exposure before tone mapping, a factor.
    pub exposure: f32,
}

impl Default for Lighting {
    fn default() -> Self {
        let towards = |x: f64, y: f64, z: f64| DVec3::new(x, y, z).normalize();
        Self {
            // Key 40° to the character's right and 38° up, warm; chosen by eye.
            key: DirectedLight {
                towards_light_in_world: towards(-0.62, 0.78, 0.86),
                irradiance: [1.02, 0.90, 0.76],
            },
            fill: DirectedLight {
                towards_light_in_world: towards(0.85, 0.25, 0.75),
                irradiance: [0.13, 0.155, 0.195],
            },
            rim: DirectedLight {
                towards_light_in_world: towards(0.55, 0.75, -0.95),
                irradiance: [0.85, 0.78, 0.70],
            },
            sky: [0.17, 0.18, 0.21],
            ground: [0.105, 0.078, 0.058],
            exposure: 1.0,
        }
    }
}
