//! Room around the figure, as soft light from every direction.

use raconteur_base::{DVec3, ops};
use raconteur_stage::{Lighting, Set};

/// Directions that the room is sampled in.
const SAMPLES: u32 = 96;

/// Returns the radiance of the room in a direction: matt walls, sky and floor colours, the lit
/// backdrop and two panels that soften key and fill. Chosen by eye.
fn room_radiance(d: DVec3, light: &Lighting, set: &Set) -> [f64; 3] {
    let ramp = |low: f64, high: f64, x: f64| ((x - low) / (high - low)).clamp(0.0, 1.0);
    // Steeper than the irradiance, which blurs it: a factor of 3/2 preserves its slope.
    let upwards = (0.5 + 0.75 * d.y).clamp(0.0, 1.0);
    let behind = 2.4 * ramp(0.2, 0.9, -d.z);
    let key = 0.16 * ramp(0.55, 0.95, d.dot(unit(light.key.towards_light_in_world)));
    let fill = 0.35 * ramp(0.50, 0.95, d.dot(unit(light.fill.towards_light_in_world)));
    // The floor in front of the feet reflects the downward key light.
    let bounce = 0.5 * ramp(0.2, 0.9, -d.y) * unit(light.key.towards_light_in_world).y.max(0.0);
    std::array::from_fn(|c| {
        let key_light = f64::from(light.key.irradiance[c]);
        f64::from(light.ground[c]) * (1.0 - upwards)
            + f64::from(light.sky[c]) * upwards
            + f64::from(set.glow[c]) * behind
            + key_light * key
            + f64::from(light.fill.irradiance[c]) * fill
            + key_light * f64::from(set.floor[c]) * bounce
    })
}

fn unit(d: DVec3) -> DVec3 {
    d.try_normalize().unwrap_or(DVec3::Y)
}

/// Returns the nine spherical-harmonic basis functions of the shader: 1, y, z, x, xy, yz, 3z²−1,
/// xz, x²−y².
fn basis(d: DVec3) -> [f64; 9] {
    [
        1.0,
        d.y,
        d.z,
        d.x,
        d.x * d.y,
        d.y * d.z,
        3.0 * d.z * d.z - 1.0,
        d.x * d.z,
        d.x * d.x - d.y * d.y,
    ]
}

/// Returns irradiance over pi by normal as spherical harmonics up to order 2 (Ramamoorthi and
/// Hanrahan 2001, "An efficient representation for irradiance environment maps",
/// doi:10.1145/383259.383317): linear RGB factors of [`basis`].
pub(crate) fn harmonics(light: &Lighting, set: &Set) -> [[f32; 3]; 9] {
    // One over the mean square of each function on the sphere, times the cosine lobe's
    // share of its order: 1, 2/3, 1/4.
    const FACTORS: [f64; 9] = [
        1.0,
        2.0,
        2.0,
        2.0,
        15.0 / 4.0,
        15.0 / 4.0,
        5.0 / 16.0,
        15.0 / 4.0,
        15.0 / 16.0,
    ];
    let mut sum = [[0.0; 3]; 9];
    for i in 0..SAMPLES {
        // Even over the sphere (Fibonacci's lattice).
        let y = 1.0 - (2.0 * f64::from(i) + 1.0) / f64::from(SAMPLES);
        let radius = (1.0 - y * y).sqrt();
        let (s, c) = ops::sincos(2.399_963_229_728_653 * f64::from(i));
        let d = DVec3::new(radius * c, y, radius * s);
        let radiance = room_radiance(d, light, set);
        for (sum, b) in sum.iter_mut().zip(basis(d)) {
            for (s, r) in sum.iter_mut().zip(radiance) {
                *s += b * r;
            }
        }
    }
    std::array::from_fn(|k| sum[k].map(|s| (s * FACTORS[k] / f64::from(SAMPLES)) as f32))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_even_room_lights_every_side_alike() {
        let mut light = Lighting::default();
        for l in [&mut light.key, &mut light.fill, &mut light.rim] {
            l.irradiance = [0.0; 3];
        }
        light.sky = [0.5; 3];
        light.ground = [0.5; 3];
        let set = Set {
            glow: [0.0; 3],
            ..Set::default()
        };
        let sh = harmonics(&light, &set);
        assert!((sh[0][0] - 0.5).abs() < 1e-6, "{sh:?}");
        assert!(sh[1..].iter().flatten().all(|c| c.abs() < 0.01), "{sh:?}");
    }

    #[test]
    fn light_is_positive_and_comes_from_where_it_is() {
        let (light, set) = (Lighting::default(), Set::default());
        let sh = harmonics(&light, &set);
        let towards = |d: DVec3, c: usize| -> f64 {
            let b = basis(d);
            (0..9).map(|k| b[k] * f64::from(sh[k][c])).sum()
        };
        for i in 0..200 {
            let at = |id| raconteur_base::noise::signed(3, id, i);
            let d = unit(DVec3::new(at(0), at(1), at(2)));
            assert!((0..3).all(|c| towards(d, c) > 0.0), "{d}");
        }
        assert!(towards(DVec3::Y, 2) > towards(DVec3::NEG_Y, 2), "sky");
        assert!(towards(DVec3::NEG_Z, 0) > towards(DVec3::Z, 0), "backdrop");
    }
}
