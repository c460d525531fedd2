//! Loudness as broadcasters measure it: ITU-R BS.1770-4.

use super::instrument::Stereo;
use super::signal::RATE_HZ;

/// A filter of second order by its coefficients, b0 b1 b2 a1 a2.
fn filter(x: &[f64], [b0, b1, b2, a1, a2]: [f64; 5]) -> Vec<f64> {
    let (mut s1, mut s2) = (0.0, 0.0);
    x.iter()
        .map(|&x| {
            let y = b0 * x + s1;
            s1 = b1 * x - a1 * y + s2;
            s2 = b2 * x - a2 * y;
            y
        })
        .collect()
}

/// The shelf that stands for the head, and the high-pass, at 48 kHz (BS.1770-4, tables 1 and 2).
const SHELF: [f64; 5] = [
    1.535_124_859_586_97,
    -2.691_696_189_406_38,
    1.198_392_810_852_85,
    -1.690_659_293_182_41,
    0.732_480_774_215_85,
];
const HIGH: [f64; 5] = [1.0, -2.0, 1.0, -1.990_047_454_833_98, 0.990_072_250_366_21];

/// Integrated loudness in LUFS; -120 for silence.
pub(crate) fn integrated_lufs(sound: &Stereo) -> f64 {
    let weighted = [0, 1].map(|c| filter(&filter(&sound[c], SHELF), HIGH));
    // Blocks of 400 ms, a quarter of them new.
    let (block, step) = ((0.4 * RATE_HZ) as usize, (0.1 * RATE_HZ) as usize);
    let mut powers = Vec::new();
    let mut at = 0;
    while at + block <= weighted[0].len() {
        let power = |c: usize| {
            weighted[c][at..at + block]
                .iter()
                .map(|x| x * x)
                .sum::<f64>()
        };
        powers.push((power(0) + power(1)) / block as f64);
        at += step;
    }
    let lufs = |power: f64| -0.691 + 10.0 * libm::log10(power.max(1e-12));
    let mean = |gate: f64| {
        let kept: Vec<f64> = powers.iter().copied().filter(|p| lufs(*p) > gate).collect();
        kept.iter().sum::<f64>() / kept.len().max(1) as f64
    };
    let relative = lufs(mean(-70.0)) - 10.0;
    lufs(mean(relative.max(-70.0)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compose::signal::sine;

    #[test]
    fn a_full_sine_on_one_side_has_the_loudness_of_the_standard() {
        // BS.1770-4: 0 dB FS at 997 Hz in one front channel reads -3.01 LUFS.
        let tone = (0..240_000)
            .map(|i| sine(997.0 * f64::from(i) / RATE_HZ))
            .collect();
        let sound = [tone, vec![0.0; 240_000]];
        let lufs = integrated_lufs(&sound);
        assert!((lufs + 3.01).abs() < 0.02, "{lufs}");
    }
}
