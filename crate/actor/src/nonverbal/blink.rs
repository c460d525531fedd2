//! Blinks: at the beginning of pauses, and often enough to keep the eyes moist.
//!
//! Three phases (F&H section 4.2.1 after Pelachaud et al. 1996): closing 1/8 s, closed
//! 1/24 s, opening 1/12 s, on phone boundaries where there are any; 4.8 s between blinks on
//! average. Every stretch of 4.8 s has one blink. It is at the beginning of the weightiest
//! pause that begins in the stretch, and else, as the additional blink of the thesis, at a
//! random place. Were there a blink at every pause and the additional ones besides, a
//! speaker of short phrases would blink three times as often as people do.

use raconteur_base::curve::smooth;
use raconteur_base::noise;

use super::heard::Heard;
use crate::idle::stream;

/// Closing phase, seconds (*paper*).
pub const CLOSING_SECS: f64 = 1.0 / 8.0;
/// Closed phase, seconds (*paper*).
pub const CLOSED_SECS: f64 = 1.0 / 24.0;
/// Opening phase, seconds (*paper*).
pub const OPENING_SECS: f64 = 1.0 / 12.0;
/// Time between two blinks on average, seconds (*paper*).
pub const INTERVAL_SECS: f64 = 4.8;
/// Time between two blinks at least, seconds. Designed: a flutter is another signal.
const APART_SECS: f64 = 1.0;

/// When a blink begins to close, is closed, begins to open and is open again, seconds.
type Phases = [f64; 4];

/// When the eyes blink.
#[derive(Clone, Debug)]
pub(super) struct Blinks {
    /// Blinks in stretches with speech, by the number of the stretch.
    planned: Vec<(i64, Phases)>,
    /// Infinite where nobody blinks.
    stretch_secs: f64,
    seed: u64,
}

impl Blinks {
    /// `rate` is a multiple of the natural frequency.
    pub(super) fn new(heard: &Heard, rate: f64, seed: u64) -> Self {
        let mut blinks = Self {
            planned: Vec::new(),
            stretch_secs: INTERVAL_SECS / rate,
            seed,
        };
        let mut begun = 0;
        for boundary in &heard.boundaries {
            let stretch = blinks.stretch_of(*boundary);
            let is_known = blinks
                .planned
                .last()
                .is_some_and(|(last, _)| *last == stretch);
            if rate > 0.0 && !is_known {
                while heard
                    .pauses
                    .get(begun)
                    .is_some_and(|p| blinks.stretch_of(p.start_secs) < stretch)
                {
                    begun += 1;
                }
                let phases = blinks.plan(stretch, heard, begun);
                blinks.planned.push((stretch, phases));
            }
        }
        blinks
    }

    fn stretch_of(&self, time_secs: f64) -> i64 {
        (time_secs / self.stretch_secs).floor() as i64
    }

    /// How far the lids are closed at a time, 0 open to 1 closed.
    pub(super) fn closure(&self, time_secs: f64) -> f64 {
        if self.stretch_secs.is_infinite() {
            return 0.0;
        }
        let stretch = self.stretch_of(time_secs);
        let [before, now] = [stretch.wrapping_sub(1), stretch].map(|stretch| {
            let [closing, closed, opening, open] = self.blink(stretch);
            let shut = smooth((time_secs - closing) / (closed - closing));
            shut - smooth((time_secs - opening) / (open - opening))
        });
        before.max(now)
    }

    /// The blink of a stretch.
    fn blink(&self, stretch: i64) -> Phases {
        let next = self.planned.partition_point(|(s, _)| *s < stretch);
        match self.planned.get(next) {
            Some((planned, phases)) if *planned == stretch => *phases,
            _ => {
                let u = noise::unit(self.seed, stream::BLINK, stretch);
                let start = (stretch as f64 + 0.1 + 0.75 * u) * self.stretch_secs;
                let closed = start + CLOSING_SECS;
                let opening = closed + CLOSED_SECS;
                [start, closed, opening, opening + OPENING_SECS]
            }
        }
    }

    /// The blink of a stretch with speech, the first pause of which is `first`.
    fn plan(&self, stretch: i64, heard: &Heard, first: usize) -> Phases {
        let at = |share: f64| (stretch as f64 + share) * self.stretch_secs;
        let free_secs = self.blink(stretch.wrapping_sub(1))[3] + APART_SECS;
        let (from, to) = (at(0.04).max(free_secs), at(0.96));
        let mut best: Option<(f64, f64)> = None;
        for pause in heard.pauses[first..]
            .iter()
            .take_while(|p| p.start_secs < to)
        {
            let length_secs = pause.end_secs - pause.start_secs;
            let weight = f64::from(pause.parts as u8) + length_secs.min(1.0);
            if pause.start_secs >= from && best.is_none_or(|(most, _)| weight > most) {
                best = Some((weight, pause.start_secs));
            }
        }
        let start = match best {
            Some((_, start)) => start,
            // Who blinks very often has no time to keep them apart.
            None => heard
                .snapped(self.blink(stretch)[0].max(free_secs.min(at(0.5))))
                .max(at(0.0)),
        };
        // Phases stay near their lengths where no boundary is.
        let phase = |from: f64, length: f64| {
            let wanted = from + length;
            let on = heard.boundary_within(wanted, from + 0.5 * length, from + 2.0 * length);
            on.unwrap_or(wanted)
        };
        let closed = phase(start, CLOSING_SECS);
        let opening = phase(closed, CLOSED_SECS);
        [start, closed, opening, opening + OPENING_SECS]
    }
}

#[cfg(test)]
mod tests {
    use super::super::Manner;
    use super::super::tests::speech::{hour, shipped};
    use super::*;
    use crate::performance::SpokenUtterance;

    fn plan(speech: &[SpokenUtterance]) -> (Heard, Blinks) {
        let heard = Heard::new(&speech.iter().collect::<Vec<_>>(), &Manner::default(), 1);
        let blinks = Blinks::new(&heard, 1.0, 1);
        (heard, blinks)
    }

    #[test]
    fn phases_are_on_phone_boundaries_where_there_are_any() {
        for speech in [hour(5), shipped()] {
            let (heard, blinks) = plan(&speech);
            let mut on = 0;
            for (_, [closing, closed, opening, _]) in &blinks.planned {
                let near = |at: f64| heard.boundary_within(at, at - 0.2, at + 0.2);
                assert_eq!(near(*closing).unwrap_or(*closing), *closing);
                // The nearest one that leaves the phase a phase, if there is any.
                for (from, to, length) in [
                    (closing, closed, CLOSING_SECS),
                    (closed, opening, CLOSED_SECS),
                ] {
                    let fit = |b: &&f64| **b >= from + 0.5 * length && **b <= from + 2.0 * length;
                    let far = |b: f64| (b - from - length).abs();
                    let nearest = heard
                        .boundaries
                        .iter()
                        .filter(fit)
                        .map(|b| far(*b))
                        .reduce(f64::min);
                    assert!((far(*to) - nearest.unwrap_or(0.0)).abs() < 1e-9);
                    on += usize::from(nearest.is_some());
                }
            }
            println!(
                "{on} of {} later phases have a boundary",
                2 * blinks.planned.len()
            );
            assert!(5 * on > blinks.planned.len());
        }
    }

    #[test]
    fn pauses_are_punctuated() {
        let (heard, blinks) = plan(&hour(5));
        let starts: Vec<f64> = heard.pauses.iter().map(|p| p.start_secs).collect();
        let in_pauses = blinks
            .planned
            .iter()
            .filter(|(_, p)| starts.contains(&p[0]))
            .count();
        println!(
            "{in_pauses} of {} blinks begin with a pause",
            blinks.planned.len()
        );
        assert!(10 * in_pauses > 8 * blinks.planned.len());
    }

    #[test]
    fn blinks_close_fully_and_are_apart() {
        let (_, blinks) = plan(&hour(5));
        for pair in blinks.planned.windows(2) {
            assert!(pair[1].1[0] - pair[0].1[3] > 0.4, "{pair:?}");
        }
        for (_, [closing, closed, opening, open]) in &blinks.planned {
            assert_eq!(blinks.closure(0.5 * (closed + opening)), 1.0);
            assert_eq!(blinks.closure(*closing), 0.0);
            assert!(blinks.closure(open + 1e-9) < 1e-9);
            assert!(closed - closing >= 0.06 && open - closing < 0.5);
        }
        // One who is silent blinks as often.
        let silent = Blinks::new(&Heard::default(), 1.0, 3);
        let shut = |i: i32| silent.closure(f64::from(i) * 0.01) > 0.9;
        let count = (1..48_000).filter(|i| shut(*i) && !shut(i - 1)).count();
        assert_eq!(count, 100);
        assert_eq!(Blinks::new(&Heard::default(), 0.0, 3).closure(1.0), 0.0);
    }
}
