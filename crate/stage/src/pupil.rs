//! Width of the pupils.

use raconteur_base::ops;

use crate::Lighting;

/// Luminance of white paper under an irradiance of 1, candela a square metre: a lit room. Designed.
const PAPER: f64 = 100.0;
/// Albedo of a set's walls and people, share. Designed.
const ALBEDO: f64 = 0.3;
/// Pupil dilation at full activation, millimetres: arousing images widen them by some tenths
/// (Bradley, Miccoli, Escrig and Lang 2008, doi:10.1111/j.1469-8986.2008.00654.x).
const AROUSED: f64 = 0.6;
/// Pupil unrest, millimetres, and frequencies, Hz: incommensurate waves (hippus; Loewenfeld 1999,
/// *The Pupil*: below 0.5 Hz, some tenths at most). Designed.
const UNREST: [(f64, f64); 3] = [(0.07, 0.19), (0.05, 0.31), (0.03, 0.47)];

/// Returns the diameter of the pupils, millimetres, at `arousal` 0 (calm) to 1 and a story time in
/// seconds: 4.9 - 3 tanh(0.4 log10 L) for luminance L in cd/m² (Moon and Spencer 1944, after Watson
/// and Yellott 2012, doi:10.1167/12.10.12).
#[must_use]
pub fn diameter_mm(lighting: &Lighting, arousal: f64, time_secs: f64) -> f64 {
    let mean = |c: [f32; 3]| f64::from(c[0] + c[1] + c[2]) / 3.0;
    let [key, fill] = [&lighting.key, &lighting.fill].map(|l| mean(l.irradiance));
    let light = key + fill + mean(lighting.sky) + mean(lighting.ground);
    let log10 = ops::ln((PAPER * ALBEDO * light).max(1e-3)) / core::f64::consts::LN_10;
    let turn = core::f64::consts::TAU * time_secs;
    let unrest: f64 = UNREST.iter().map(|(a, f)| a * ops::sin(turn * f)).sum();
    let still = 4.9 - 3.0 * tanh(0.4 * log10);
    still + AROUSED * arousal.clamp(0.0, 1.0) + unrest
}

fn tanh(x: f64) -> f64 {
    let e = ops::exp(2.0 * x);
    (e - 1.0) / (e + 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pupils_are_wide_in_the_evening_and_in_fear_and_never_stand_still() {
        let at = |name: &str, arousal: f64| {
            let light = Lighting::named(name).expect("a light");
            diameter_mm(&light, arousal, 0.0)
        };
        assert!(
            at("evening", 0.0) > at("studio", 0.0),
            "the pupils are wider in the evening"
        );
        assert!(
            at("stage", 1.0) > at("stage", 0.0) + 0.5,
            "arousal widens the pupils"
        );
        for (name, light) in Lighting::PRESETS {
            let mut last = 0.0;
            for i in 0..600 {
                let now = diameter_mm(&light(), 0.0, f64::from(i) * 0.1);
                assert!((2.0..6.0).contains(&now) && now != last, "{name}: {now}");
                last = now;
            }
        }
    }
}
