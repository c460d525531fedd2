//! Effect of emotions and scripts on the light of a stage (GEVH 3.5.4.2).

use raconteur_base::color::srgb_to_linear;
use raconteur_base::curve::lerp;
use raconteur_base::{DVec3, ops};

use crate::emotion::EmotionType;
use crate::{DirectedLight, Lighting, Set};

/// Share of the key light's colour that fill and set lights take on. Designed: skin still looks
/// like skin.
const SHARED_TINT: f32 = 0.35;
/// Share of white in every key light. Designed: no gel is pure, and surfaces without its colour
/// would be black.
const WHITE: f32 = 0.10;
/// Growth of the colour with the intensity, an exponent of its share of [`FULL_MANNER`]. Designed.
const TINGE: f64 = 0.7;
/// Maximum share of an emotion's colour in the key light and in the set lights. Designed: a face
/// and its clothes keep their hue, as behind a pale gel; the walls show the rest.
const KEY_GEL: f64 = 0.19;
const ROOM_GEL: f64 = 0.60;
/// Maximum darkening and brightening of a stage by an emotion. Designed: nothing is black, and no
/// forehead white.
const DIMMEST: f64 = 0.40;
const BRIGHTEST: f64 = 1.45;
/// Exponents of the lamps' response to brightness, of the key light and of the rest. As with a
/// camera aperture the response is partial, so a face stays readable in the dark and is not
/// overexposed in the light. Designed.
const KEY_FOLLOWS: f64 = 0.5;
const REST_FOLLOWS: f64 = 0.3;
/// Compensation of a colour's own darkness, as an exponent: a grey lamp is not a weak one.
const MADE_UP: f64 = 0.6;
/// Intensity at which shadows are as an emotion has them, of 10. Designed.
const FULL_MANNER: f64 = 5.0;
/// Range of the key light's elevation, radians.
const MIN_ELEVATION_RAD: f64 = -0.35;
const MAX_ELEVATION_RAD: f64 = 1.15;
/// Nor from further round.
const MAX_AZIMUTH_RAD: f64 = 1.25;

/// Direction to a lamp between figure and camera, slightly above the lens so it stays out of frame.
const FRONTAL: DVec3 = DVec3::new(0.0, 0.242_535_625, 0.970_142_5);

/// Change of the stage's light that expresses an emotion, relative to the stage's own light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Illumination {
    /// The key's colour, linear RGB; 1, 1, 1 leaves it.
    pub color: [f32; 3],
    /// Colour of the lights on the set and the figure's edge, likewise.
    pub room_color: [f32; 3],
    /// The key's brightness; 1 leaves it.
    pub brightness: f64,
    /// Azimuth of the key light away from the front, radians.
    pub turn_rad: f64,
    /// Elevation of the key light, radians.
    pub lift_rad: f64,
    /// Softness of its shadows; 1 leaves them unchanged.
    pub softness: f64,
    /// Mist on the stage, 0 to 1.
    pub mist: f64,
    /// Adherence to the thesis, 0 to 1: at 1 the key light takes colour and brightness unscaled and
    /// comes from between figure and camera, and the rest keeps its own light (GEVH 3.5.4.2).
    pub strict: f64,
}

impl Default for Illumination {
    fn default() -> Self {
        Self {
            color: [1.0; 3],
            room_color: [1.0; 3],
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
    /// Returns the illumination of an emotion at an intensity, 0 to 10: a share of the colour of
    /// table 3.2, brightness by equations 3.1 and 3.2 within bounds, and shadows.
    #[must_use]
    pub fn from_emotion(emotion: &EmotionType, intensity: f64) -> Self {
        let share = (intensity / FULL_MANNER).clamp(0.0, 1.0);
        let tinge = ops::pow(share, TINGE);
        let lamp = emotion.lamp;
        Self {
            color: gel(emotion.key_color, KEY_GEL * tinge),
            room_color: gel(emotion.key_color, ROOM_GEL * tinge),
            brightness: emotion.brightness(intensity).clamp(DIMMEST, BRIGHTEST),
            turn_rad: share * lamp.turn_rad,
            lift_rad: share * lamp.lift_rad,
            softness: lerp(1.0, lamp.softness, share),
            mist: share * lamp.mist,
            strict: 0.0,
        }
    }

    /// Returns the change of light exactly as in the thesis: table 3.2 in full colour, and
    /// equations 3.1 and 3.2 unscaled.
    #[must_use]
    pub fn strictly(emotion: &EmotionType, intensity: f64) -> Self {
        Self {
            color: linear(emotion.key_color),
            brightness: 1.0 - emotion.attenuation(intensity),
            ..Self::strict_default()
        }
    }

    /// Returns scripted illumination: the key light takes all of its colour, the set a part.
    #[must_use]
    pub fn written(color: [f32; 3], brightness: f64) -> Self {
        Self {
            color,
            room_color: shared(color),
            brightness,
            ..Self::default()
        }
    }

    /// Returns the thesis's light without emotion: white, from the front.
    #[must_use]
    pub fn strict_default() -> Self {
        Self {
            strict: 1.0,
            ..Self::default()
        }
    }

    /// Returns the illumination a share `s` of the way to another, 0 to 1.
    #[must_use]
    pub fn towards(&self, to: &Self, s: f64) -> Self {
        let share = s as f32;
        let mixed =
            |a: [f32; 3], b: [f32; 3]| std::array::from_fn(|c| a[c] + (b[c] - a[c]) * share);
        Self {
            color: mixed(self.color, to.color),
            room_color: mixed(self.room_color, to.room_color),
            brightness: lerp(self.brightness, to.brightness, s),
            turn_rad: lerp(self.turn_rad, to.turn_rad, s),
            lift_rad: lerp(self.lift_rad, to.lift_rad, s),
            softness: lerp(self.softness, to.softness, s),
            mist: lerp(self.mist, to.mist, s),
            strict: lerp(self.strict, to.strict, s),
        }
    }

    /// Returns the lamps of a stage, changed by this illumination.
    #[must_use]
    pub fn lamps(&self, lighting: &Lighting) -> Lighting {
        let most = self.color.iter().copied().fold(0.0, f32::max);
        let made_up = ops::pow(f64::from(most).max(1e-3), MADE_UP);
        let power = ops::pow(self.brightness.max(0.0), KEY_FOLLOWS) / made_up;
        let key = self.color.map(|c| (c + (most - c) * WHITE) * power as f32);
        let tint = shared(self.color);
        let gain = self.rest_gain();
        // The thesis's secondary and back lights are no part of the expression.
        let strict = self.strict as f32;
        let mixed = |designed: [f32; 3], plain: [f32; 3]| -> [f32; 3] {
            std::array::from_fn(|c| designed[c] + (plain[c] - designed[c]) * strict)
        };
        let rest = mixed(tint.map(|c| c * gain), [1.0; 3]);
        let edge = mixed(self.room_color.map(|c| c * gain), [1.0; 3]);
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
                irradiance: times(lighting.rim.irradiance, edge),
                ..lighting.rim
            },
            sky: times(lighting.sky, rest),
            ground: times(lighting.ground, rest),
            exposure: lighting.exposure,
            softness: lighting.softness * self.softness as f32,
        }
    }

    /// Returns floor and backdrop, changed by this illumination.
    #[must_use]
    pub fn set(&self, set: Set) -> Set {
        if *self == Self::default() {
            return set;
        }
        let gain = self.rest_gain();
        let share = self.strict as f32;
        let tint = self.room_color.map(|c| c + (1.0 - c) * share);
        set.lit(tint, gain + (1.0 - gain) * share, self.mist as f32)
    }

    /// Brightness of everything but the key.
    fn rest_gain(&self) -> f32 {
        ops::pow(self.brightness.max(0.0), REST_FOLLOWS) as f32
    }

    /// Returns the direction of the key lamp, moved by this illumination.
    fn moved(&self, towards_light: DVec3) -> DVec3 {
        let level = ops::hypot(towards_light.x, towards_light.z);
        let lift = ops::atan2(towards_light.y, level) + self.lift_rad;
        // A lamp that is high or low by default stays there.
        let own = ops::atan2(towards_light.y, level);
        let lift = lift.clamp(MIN_ELEVATION_RAD.min(own), MAX_ELEVATION_RAD.max(own));
        let round = ops::atan2(towards_light.x, towards_light.z);
        let side = if towards_light.x < 0.0 { -1.0 } else { 1.0 };
        let most = MAX_AZIMUTH_RAD.max(round.abs());
        let turn = (round + side * self.turn_rad).clamp(-most, most);
        let ((rise, out), (aside, front)) = (ops::sincos(lift), ops::sincos(turn));
        DVec3::new(out * aside, rise, out * front)
    }
}

/// Returns white light filtered by a share of an sRGB colour, as bright as white: linear RGB. The
/// brightest channel is 1, so grey, which has no hue, leaves it white.
fn gel(srgb: [u8; 3], share: f64) -> [f32; 3] {
    let color = linear(srgb);
    let most = color.iter().copied().fold(1e-3, f32::max);
    color.map(|c| lerp(1.0, f64::from(c / most), share) as f32)
}

/// Returns the share of the key light's colour that fill and set lights take on.
fn shared(color: [f32; 3]) -> [f32; 3] {
    color.map(|c| 1.0 + (c - 1.0) * SHARED_TINT)
}

fn times(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    std::array::from_fn(|c| a[c] * b[c])
}

/// Converts a colour in sRGB bytes to linear RGB.
#[must_use]
pub fn linear(srgb: [u8; 3]) -> [f32; 3] {
    srgb.map(|byte| srgb_to_linear(f64::from(byte) / 255.0) as f32)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::emotion::EMOTIONS;

    #[test]
    fn a_strong_emotion_has_the_lamp_of_the_table() {
        for emotion in &EMOTIONS {
            let strong = Illumination::from_emotion(emotion, 10.0);
            let lamp = emotion.lamp;
            assert_eq!(strong.turn_rad, lamp.turn_rad, "{}", emotion.name);
            assert_eq!(strong.lift_rad, lamp.lift_rad, "{}", emotion.name);
            assert_eq!(strong.mist, lamp.mist, "{}", emotion.name);
            assert!(
                (strong.softness - lamp.softness).abs() < 1e-12,
                "the softness of the strong emotion is that of its lamp"
            );
            // A turning lamp turns its light about the figure by the same angle, and to the same
            // side.
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
        assert!(
            moved.length() < 1e-12,
            "without emotion the key light is unchanged"
        );
        assert_eq!(lit.key.irradiance, own.key.irradiance);
        assert_eq!((lit.sky, lit.fill, lit.rim), (own.sky, own.fill, own.rim));
        for emotion in &EMOTIONS {
            assert!(
                (emotion.brightness(0.0) - 1.0).abs() < 1e-12,
                "without emotion the brightness is unchanged"
            );
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
                let lit = Illumination::from_emotion(emotion, 8.0).lamps(&light());
                let key = lit.key.towards_light_in_world;
                assert!((key.length() - 1.0).abs() < 1e-9, "{name}");
                assert!(key.z > 0.0, "{name} {}: never from behind", emotion.name);
                let all = [lit.key.irradiance, lit.fill.irradiance, lit.sky];
                let all = all.iter().flatten();
                assert!(all.clone().all(|c| (0.0..4.0).contains(c)), "{name}");
            }
        }
    }

    /// Converts linear sRGB to CIE L*a*b* under D65.
    fn lab([r, g, b]: [f64; 3]) -> [f64; 3] {
        let root = |t: f64| {
            if t > 0.008_856 {
                ops::pow(t, 1.0 / 3.0)
            } else {
                7.787 * t + 16.0 / 116.0
            }
        };
        let x = root((0.4124 * r + 0.3576 * g + 0.1805 * b) / 0.9505);
        let y = root(0.2126 * r + 0.7152 * g + 0.0722 * b);
        let z = root((0.0193 * r + 0.1192 * g + 0.9505 * b) / 1.089);
        [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
    }

    /// Returns the shift of a paint's colour in a light, ΔE at its lightness in white light; and
    /// its hue, degrees.
    fn shifted(paint: [f64; 3], light: [f32; 3]) -> (f64, f64) {
        let y = |c: [f64; 3]| 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
        let lit: [f64; 3] = std::array::from_fn(|i| paint[i] * f64::from(light[i]));
        let lit = lit.map(|c| c * y(paint) / y(lit));
        let ([_, a0, b0], [_, a1, b1]) = (lab(paint), lab(lit));
        let turn = (ops::atan2(b1, a1) - ops::atan2(b0, a0)).to_degrees().abs();
        (ops::hypot(a1 - a0, b1 - b0), turn.min(360.0 - turn))
    }

    #[test]
    fn skin_stays_skin_and_clothes_keep_their_hue_in_every_emotion() {
        // Of the palest to the darkest of figures, linear.
        let skins = [
            [0.56, 0.37, 0.28],
            [0.46, 0.28, 0.20],
            [0.38, 0.22, 0.14],
            [0.20, 0.105, 0.060],
            [0.085, 0.042, 0.026],
        ];
        // Teal, red, mustard, navy, pink.
        let clothes = [
            [0.010, 0.130, 0.125],
            [0.210, 0.012, 0.014],
            [0.560, 0.240, 0.015],
            [0.022, 0.040, 0.100],
            [0.380, 0.045, 0.130],
        ];
        for emotion in &EMOTIONS {
            for tenths in [5, 20, 50, 80, 100] {
                let intensity = 0.1 * f64::from(tenths);
                let own = Lighting::default();
                let light = Illumination::from_emotion(emotion, intensity);
                let lit = light.lamps(&own);
                let key: [f32; 3] =
                    std::array::from_fn(|c| lit.key.irradiance[c] / own.key.irradiance[c]);
                for skin in skins {
                    let (delta, turn) = shifted(skin, key);
                    assert!(
                        delta < 9.0 && turn < 16.0,
                        "{} {delta} {turn}",
                        emotion.name
                    );
                }
                for cloth in clothes {
                    let (delta, turn) = shifted(cloth, key);
                    assert!(
                        delta < 12.0 && turn < 16.0,
                        "{} {delta} {turn}",
                        emotion.name
                    );
                }
                // No colour is black or white.
                let most = key.iter().copied().fold(0.0, f32::max);
                assert!((0.55..1.35).contains(&most), "{} {most}", emotion.name);
            }
        }
    }
}
