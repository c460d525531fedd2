//! Blinks: at phrase ends, and often enough to keep the eyes moist.
//!
//! Three phases (F&H section 4.2.1 after Pelachaud et al. 1996): closing 1/8 s, closed
//! 1/24 s, opening 1/12 s; 4.8 s between blinks on average. Those without speech fall at a
//! random place in each stretch of that order and give way to a blink of speech nearby.

use raconteur_base::curve::smooth;
use raconteur_base::noise;

use super::stream;

/// Closing phase, seconds (*paper*).
pub const CLOSING_SECS: f64 = 1.0 / 8.0;
/// Closed phase, seconds (*paper*).
pub const CLOSED_SECS: f64 = 1.0 / 24.0;
/// Opening phase, seconds (*paper*).
pub const OPENING_SECS: f64 = 1.0 / 12.0;
/// Stretch that holds one unprompted blink, seconds: with those of speech 15 to 20 a
/// minute come of it.
const STRETCH_SECS: f64 = 3.9;
/// An unprompted blink this near to one of speech is left out, seconds.
const CROWDED_SECS: f64 = 1.4;

/// When the eyes blink.
#[derive(Clone, Debug)]
pub struct Blinks {
    /// Starts of the blinks that punctuate speech, ascending, seconds.
    prompted: Vec<f64>,
    seed: u64,
    /// The share of blinks that happen.
    amount: f64,
}

impl Blinks {
    /// From the times of pauses in speech (story time, seconds, any order); a share of
    /// them blinks. `amount` is the share of all blinks that happen, 0 to 1.
    #[must_use]
    pub fn new(pauses: &[f64], seed: u64, amount: f64) -> Self {
        let mut prompted: Vec<f64> = pauses
            .iter()
            .enumerate()
            .filter(|(i, t)| {
                t.is_finite() && noise::unit(seed, stream::BLINK, *i as i64) < 0.7 * amount
            })
            .map(|(_, t)| *t)
            .collect();
        raconteur_base::order::sort_by_number(&mut prompted, |t| *t);
        prompted.dedup_by(|later, earlier| *later - *earlier < 0.6);
        Self {
            prompted,
            seed,
            amount,
        }
    }

    /// How far the lids are closed at a time, 0 open to 1 closed.
    #[must_use]
    pub fn closure(&self, time_secs: f64) -> f64 {
        let i = self.prompted.partition_point(|t| *t <= time_secs);
        let prompted = i
            .checked_sub(1)
            .map_or(0.0, |i| shape(time_secs - self.prompted[i]));
        let stretch = (time_secs / STRETCH_SECS).floor() as i64;
        [stretch.wrapping_sub(1), stretch]
            .into_iter()
            .filter_map(|k| self.unprompted(k))
            .map(|start| shape(time_secs - start))
            .fold(prompted, f64::max)
    }

    /// Start of the unprompted blink of a stretch, unless speech blinks nearby.
    fn unprompted(&self, stretch: i64) -> Option<f64> {
        let u = noise::unit(self.seed, stream::BLINK + 1, stretch);
        let start = (stretch as f64 + 0.1 + 0.8 * u) * STRETCH_SECS;
        let i = self.prompted.partition_point(|t| *t < start - CROWDED_SECS);
        let crowded = self
            .prompted
            .get(i)
            .is_some_and(|t| *t < start + CROWDED_SECS);
        let happens = noise::unit(self.seed, stream::BLINK + 2, stretch) < self.amount;
        (happens && !crowded).then_some(start)
    }
}

/// Closure some time after a blink began.
fn shape(since_secs: f64) -> f64 {
    if since_secs <= 0.0 {
        0.0
    } else if since_secs < CLOSING_SECS {
        smooth(since_secs / CLOSING_SECS)
    } else {
        1.0 - smooth((since_secs - CLOSING_SECS - CLOSED_SECS) / OPENING_SECS)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn people_blink_fifteen_to_twenty_times_a_minute() {
        for (pauses, seed) in [
            (vec![], 1),
            ((0..60).map(|i| f64::from(i) * 5.0).collect(), 2),
        ] {
            let blinks = Blinks::new(&pauses, seed, 1.0);
            let closed = |i: i32| blinks.closure(f64::from(i) * 0.01) > 0.9;
            let count = (1..30_000).filter(|i| closed(*i) && !closed(i - 1)).count() as f64 / 5.0;
            assert!((13.0..=20.0).contains(&count), "{count} a minute");
        }
    }

    #[test]
    fn a_blink_closes_fully_and_takes_a_quarter_of_a_second() {
        assert_eq!(shape(CLOSING_SECS + 0.5 * CLOSED_SECS), 1.0);
        assert_eq!(shape(0.25 + 1e-9), 0.0);
        for i in 0..300 {
            let t = f64::from(i) * 1e-3;
            assert!((shape(t + 1e-3) - shape(t)).abs() < 0.02);
        }
    }
}
