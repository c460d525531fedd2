//! Colours as bytes and as linear light.

use crate::ops;

/// Converts an sRGB component to linear light; both 0 to 1 (IEC 61966-2-1).
#[must_use]
pub fn srgb_to_linear(value: f64) -> f64 {
    if value <= 0.040_45 {
        value / 12.92
    } else {
        ops::pow((value + 0.055) / 1.055, 2.4)
    }
}

/// Converts linear light to an sRGB component; both 0 to 1 (IEC 61966-2-1).
#[must_use]
pub fn linear_to_srgb(light: f64) -> f64 {
    if light <= 0.003_130_8 {
        12.92 * light
    } else {
        1.055 * ops::pow(light, 1.0 / 2.4) - 0.055
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_byte_comes_back() {
        for byte in 0..=255_u8 {
            let light = srgb_to_linear(f64::from(byte) / 255.0);
            assert_eq!((255.0 * linear_to_srgb(light)).round() as u8, byte);
        }
    }
}
