//! Clicks: jumps that exceed the surrounding audio.

use super::is_rate;

/// Worst click in an audio: its time and its strength.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Click {
    /// Time, in seconds.
    pub(super) secs: f64,
    /// The second difference there over its root mean square nearby. Speech has values
    /// up to about 10 at strong glottal pulses and bursts: compare with the sound
    /// before a change, not with a constant.
    pub(super) ratio: f64,
}

/// Reach of the neighbourhood on either side, in seconds; the next constant is the excluded part
/// around the position itself, so that a click is not compared with itself.
const REACH_SECS: f64 = 0.015;
const OWN_SECS: f64 = 0.001;

/// Share of the whole sound's RMS that is added to the local one: digital silence next to the
/// quietest noise is not a click.
const FLOOR: f64 = 0.1;

/// Returns the largest second difference relative to the level of second differences around it;
/// `None` for silence or an unusable rate.
#[must_use]
pub(super) fn click_measure(samples: &[f64], rate_hz: f64) -> Option<Click> {
    if samples.len() < 3 || !is_rate(rate_hz) {
        return None;
    }
    let bends: Vec<f64> = samples
        .windows(3)
        .map(|w| w[0] - 2.0 * w[1] + w[2])
        .collect();
    let mut sums = vec![0.0; bends.len() + 1];
    for (i, b) in bends.iter().enumerate() {
        sums[i + 1] = sums[i] + b * b;
    }
    let count = bends.len();
    let floor = FLOOR * (sums[count] / count as f64).sqrt();
    let reach = (REACH_SECS * rate_hz) as usize;
    let own = (OWN_SECS * rate_hz) as usize;
    let mut worst: Option<Click> = None;
    for (i, bend) in bends.iter().enumerate() {
        let (from, to) = (i.saturating_sub(reach), (i + reach + 1).min(count));
        let (left, right) = (i.saturating_sub(own), (i + own + 1).min(count));
        let power = (sums[left] - sums[from]) + (sums[to] - sums[right]);
        let near = (left - from) + (to - right);
        let level = floor + (power.max(0.0) / near.max(1) as f64).sqrt();
        let ratio = bend.abs() / level;
        if ratio.is_finite() && worst.is_none_or(|w| ratio > w.ratio) {
            let secs = (i + 1) as f64 / rate_hz;
            worst = Some(Click { secs, ratio });
        }
    }
    worst
}

#[cfg(test)]
mod tests {
    use super::super::testing;
    use super::*;

    #[test]
    fn a_click_is_found_where_it_is() {
        let rate = 16_000.0;
        let mut sound = testing::vowel(rate, 1.0, |_| 120.0);
        let before = click_measure(&sound, rate).map_or(0.0, |c| c.ratio);
        for x in &mut sound[8000..] {
            *x = -*x + 0.2;
        }
        let after = click_measure(&sound, rate);
        assert!(
            after.is_some_and(|c| (c.secs - 0.5).abs() < 2e-4 && c.ratio > 3.0 * before),
            "the click is found at 0.5 s and louder than before"
        );
        assert_eq!(click_measure(&[0.0; 99], rate), None);
        assert_eq!(click_measure(&[1.0, 0.0], rate), None);
        assert_eq!(click_measure(&[f64::NAN; 9], rate), None);
    }
}
