//! What emotions, and scripts, do to the light of a stage (GEVH 3.5.4.2).

use raconteur_base::curve::lerp;
use raconteur_base::{DVec3, ops};

use crate::emotion::EmotionType;
use crate::{DirectedLight, Lighting, Set};

/// How much of the key's colour fill and room take on. Designed: skin stays skin.
const SHARED_TINT: f32 = 0.35;
/// How much white is in every key light. Designed: no gel is pure, and what has none of its colour
/// would be black.
const WHITE: f32 = 0.10;
/// How the colour grows with the intensity, an exponent of its share of [`FULL_MANNER`]. Designed: a
/// weak emotion tinges, a strong one drenches.
const TINGE: f64 = 0.7;
/// Lamps follow a brightness as a lens opens: in part, so that a face is read in the dark and not
/// burnt in the light; exponents of the key and of the rest. Designed.
const KEY_FOLLOWS: f64 = 0.5;
const REST_FOLLOWS: f64 = 0.3;
/// How much of a colour's own darkness is made up, as an exponent: a grey lamp is no weak one.
const MADE_UP: f64 = 0.6;
/// Intensity at which shadows are as an emotion has them, of 10. Designed.
const FULL_MANNER: f64 = 5.0;
/// A key lamp never comes from further below or above, radians.
const LOWEST_RAD: f64 = -0.35;
const HIGHEST_RAD: f64 = 1.15;
/// Nor from further round.
const FARTHEST_RAD: f64 = 1.25;

/// Towards a lamp between figure and camera, a little over the lens so that it is not in the picture.
const FRONTAL: DVec3 = DVec3::new(0.0, 0.242_535_625, 0.970_142_5);

/// What is done to the light of a stage: everything against its own light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Illumination {
    /// The key's colour, linear RGB; 1, 1, 1 leaves it.
    pub color: [f32; 3],
    /// The key's brightness; 1 leaves it.
    pub brightness: f64,
    /// How far the key lamp goes round, away from the front, radians.
    pub turn_rad: f64,
    /// How far it rises, radians.
    pub lift_rad: f64,
    /// How soft its shadows are; 1 leaves them.
    pub softness: f64,
    /// How misty the stage is, 0 to 1.
    pub mist: f64,
    /// How far the light is that of the thesis, 0 to 1: the key takes colour and brightness as they
    /// are and comes from between figure and camera, and the rest keeps its own light (GEVH 3.5.4.2).
    pub strict: f64,
}

impl Default for Illumination {
    fn default() -> Self {
        Self {
            color: [1.0; 3],
            brightness: 1.0,
            turn_rad: 0.0,
            lift_rad: 0.0,
            softness: 1.0,
            mist: 0.0,
            strict: 0.0,
        }
    }
}

impl Illumination {
    /// How an emotion lights the stage at an intensity, 0 to 10: colour by table 3.2, brightness by
    /// equations 3.1 and 3.2, and shadows.
    #[must_use]
    pub fn of(emotion: &EmotionType, intensity: f64) -> Self {
        let share = (intensity / FULL_MANNER).clamp(0.0, 1.0);
        let tinge = ops::pow(share, TINGE);
        let lamp = emotion.lamp;
        Self {
            color: linear(emotion.key_color).map(|c| lerp(1.0, f64::from(c), tinge) as f32),
            brightness: emotion.brightness(intensity),
            turn_rad: share * lamp.turn_rad,
            lift_rad: share * lamp.lift_rad,
            softness: lerp(1.0, lamp.softness, share),
            mist: share * lamp.mist,
            strict: 0.0,
        }
    }

    /// The same to the letter of the thesis: table 3.2 in full colour, and equations 3.1 and 3.2
    /// unscaled.
    #[must_use]
    pub fn strictly(emotion: &EmotionType, intensity: f64) -> Self {
        Self {
            color: linear(emotion.key_color),
            brightness: 1.0 - emotion.attenuation(intensity),
            ..Self::strict_default()
        }
    }

    /// The light of the thesis where nothing is felt: white, from the front.
    #[must_use]
    pub fn strict_default() -> Self {
        Self {
            strict: 1.0,
            ..Self::default()
        }
    }

    /// A share `s` of the way to another, 0 to 1.
    #[must_use]
    pub fn towards(&self, to: &Self, s: f64) -> Self {
        let share = s as f32;
        Self {
            color: std::array::from_fn(|c| self.color[c] + (to.color[c] - self.color[c]) * share),
            brightness: lerp(self.brightness, to.brightness, s),
            turn_rad: lerp(self.turn_rad, to.turn_rad, s),
            lift_rad: lerp(self.lift_rad, to.lift_rad, s),
            softness: lerp(self.softness, to.softness, s),
            mist: lerp(self.mist, to.mist, s),
            strict: lerp(self.strict, to.strict, s),
        }
    }

    /// The lamps of a stage in this light.
    #[must_use]
    pub fn lamps(&self, lighting: &Lighting) -> Lighting {
        let most = self.color.iter().copied().fold(0.0, f32::max);
        let made_up = ops::pow(f64::from(most).max(1e-3), MADE_UP);
        let power = ops::pow(self.brightness.max(0.0), KEY_FOLLOWS) / made_up;
        let key = self.color.map(|c| (c + (most - c) * WHITE) * power as f32);
        let (tint, gain) = self.shared();
        // The thesis's secondary and back lights are no part of the expression.
        let strict = self.strict as f32;
        let mixed = |designed: [f32; 3], plain: [f32; 3]| -> [f32; 3] {
            std::array::from_fn(|c| designed[c] + (plain[c] - designed[c]) * strict)
        };
        let rest = mixed(tint.map(|c| c * gain), [1.0; 3]);
        let key = mixed(key, self.color.map(|c| c * self.brightness.max(0.0) as f32));
        let towards = self.moved(lighting.key.towards_light_in_world);
        Lighting {
            key: DirectedLight {
                towards_light_in_world: towards.lerp(FRONTAL, self.strict).normalize(),
                irradiance: times(lighting.key.irradiance, key),
            },
            fill: DirectedLight {
                irradiance: times(lighting.fill.irradiance, rest),
                ..lighting.fill
            },
            rim: DirectedLight {
                irradiance: times(lighting.rim.irradiance, rest),
                ..lighting.rim
            },
            sky: times(lighting.sky, rest),
            ground: times(lighting.ground, rest),
            exposure: lighting.exposure,
            softness: lighting.softness * self.softness as f32,
        }
    }

    /// Floor and backdrop in this light.
    #[must_use]
    pub fn set(&self, set: Set) -> Set {
        if *self == Self::default() {
            return set;
        }
        let (tint, gain) = self.shared();
        let share = self.strict as f32;
        let tint = tint.map(|c| c + (1.0 - c) * share);
        set.lit(tint, gain + (1.0 - gain) * share, self.mist as f32)
    }

    /// Colour and brightness of everything but the key.
    fn shared(&self) -> ([f32; 3], f32) {
        let tint = self.color.map(|c| 1.0 + (c - 1.0) * SHARED_TINT);
        let gain = ops::pow(self.brightness.max(0.0), REST_FOLLOWS) as f32;
        (tint, gain)
    }

    /// The direction of the key lamp where this light moves it.
    fn moved(&self, towards_light: DVec3) -> DVec3 {
        let level = ops::hypot(towards_light.x, towards_light.z);
        let lift = ops::atan2(towards_light.y, level) + self.lift_rad;
        // A lamp that hangs high or low by itself stays there.
        let own = ops::atan2(towards_light.y, level);
        let lift = lift.clamp(LOWEST_RAD.min(own), HIGHEST_RAD.max(own));
        let round = ops::atan2(towards_light.x, towards_light.z);
        let side = if towards_light.x < 0.0 { -1.0 } else { 1.0 };
        let most = FARTHEST_RAD.max(round.abs());
        let turn = (round + side * self.turn_rad).clamp(-most, most);
        let ((rise, out), (aside, front)) = (ops::sincos(lift), ops::sincos(turn));
        DVec3::new(out * aside, rise, out * front)
    }
}

fn times(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    std::array::from_fn(|c| a[c] * b[c])
}

/// Linear RGB of a colour in sRGB (IEC 61966-2-1).
#[must_use]
pub fn linear(srgb: [u8; 3]) -> [f32; 3] {
    srgb.map(|byte| {
        let x = f64::from(byte) / 255.0;
        let linear = if x <= 0.04045 {
            x / 12.92
        } else {
            ops::pow((x + 0.055) / 1.055, 2.4)
        };
        linear as f32
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::emotion::EMOTIONS;

    #[test]
    fn a_strong_emotion_has_the_lamp_of_the_table() {
        for emotion in &EMOTIONS {
            let strong = Illumination::of(emotion, 10.0);
            let lamp = emotion.lamp;
            assert_eq!(strong.turn_rad, lamp.turn_rad, "{}", emotion.name);
            assert_eq!(strong.lift_rad, lamp.lift_rad, "{}", emotion.name);
            assert_eq!(strong.mist, lamp.mist, "{}", emotion.name);
            assert!((strong.softness - lamp.softness).abs() < 1e-12);
            // A lamp that goes round turns its light about the figure by as much, and to that side.
            let own = Lighting::default();
            let side = |l: &Lighting| {
                let towards = l.key.towards_light_in_world;
                ops::atan2(towards.x, towards.z)
            };
            let turned = side(&strong.lamps(&own)) - side(&own);
            assert!(
                turned * side(&own) * lamp.turn_rad >= -1e-9,
                "{} {turned}",
                emotion.name
            );
        }
    }

    #[test]
    fn no_emotion_changes_nothing_and_none_jumps_in() {
        let own = Lighting::default();
        let none = Illumination::default();
        let lit = none.lamps(&own);
        let moved = lit.key.towards_light_in_world - own.key.towards_light_in_world;
        assert!(moved.length() < 1e-12);
        assert_eq!(lit.key.irradiance, own.key.irradiance);
        assert_eq!((lit.sky, lit.fill, lit.rim), (own.sky, own.fill, own.rim));
        for emotion in &EMOTIONS {
            assert!((emotion.brightness(0.0) - 1.0).abs() < 1e-12);
            let mut last = emotion.brightness(0.0);
            for i in 1..=100 {
                let now = emotion.brightness(0.1 * f64::from(i));
                assert!((now - last).abs() < 0.03, "{} {i}", emotion.name);
                let way = (now - last) * emotion.valence.sign();
                assert!(way >= 0.0, "{} {i}", emotion.name);
                last = now;
            }
        }
    }

    #[test]
    fn the_light_of_the_thesis_is_that_of_its_table_and_equations() {
        let own = Lighting::default();
        for emotion in &EMOTIONS {
            for intensity in [0.0, 2.0, 5.0, 10.0] {
                let lit = Illumination::strictly(emotion, intensity).lamps(&own);
                let color = linear(emotion.key_color);
                let left = (1.0 - emotion.attenuation(intensity)) as f32;
                let expected = times(own.key.irradiance, color.map(|c| c * left));
                for (lit, expected) in lit.key.irradiance.iter().zip(expected) {
                    assert!((lit - expected).abs() < 1e-6, "{}", emotion.name);
                }
                let towards = lit.key.towards_light_in_world;
                assert!(towards.x.abs() < 1e-9 && towards.z > 0.95, "{towards}");
                assert_eq!((lit.fill, lit.rim, lit.sky), (own.fill, own.rim, own.sky));
            }
        }
        let joy = EmotionType::named("joy").unwrap();
        assert_eq!(Illumination::strictly(joy, 10.0).color, [1.0, 1.0, 0.0]);
        assert_eq!(Illumination::strictly(joy, 10.0).brightness, 1.0);
        assert_eq!(Illumination::strictly(joy, 2.0).brightness, 0.5);
        let distress = EmotionType::named("distress").unwrap();
        assert_eq!(Illumination::strictly(distress, 2.0).brightness, 0.75);
        assert_eq!(Illumination::strictly(distress, 8.0).brightness, 1.0 - 0.8);
    }

    #[test]
    fn lamps_stay_lamps_in_every_emotion() {
        for (name, light) in Lighting::PRESETS {
            for emotion in &EMOTIONS {
                let lit = Illumination::of(emotion, 8.0).lamps(&light());
                let key = lit.key.towards_light_in_world;
                assert!((key.length() - 1.0).abs() < 1e-9, "{name}");
                assert!(key.z > 0.0, "{name} {}: never from behind", emotion.name);
                let all = [lit.key.irradiance, lit.fill.irradiance, lit.sky];
                let all = all.iter().flatten();
                assert!(all.clone().all(|c| (0.0..4.0).contains(c)), "{name}");
            }
        }
    }
}
