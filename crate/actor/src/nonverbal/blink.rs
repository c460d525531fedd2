//! Blinks: at the start of pauses, and often enough to keep the eyes moist.
//!
//! F&H section 4.2.1 (after Pelachaud et al. 1996) places blinks at the start of pauses, an
//! additional one after 4.8 s without a blink, and their phases on phone boundaries; this module
//! does the same. Its phases, 1/8 s closing and 1/12 s opening, contradict all measurements: the
//! lid falls fast and rises slowly. The phases here are those of voluntary and spontaneous blinks
//! (closing 66 to 78 ms, closed 8 to 13 ms, faster down than up: PubMed 18565090; Evinger, Manning
//! & Sibony 1991, Invest Ophthalmol Vis Sci 32:387). About half of all blinks do not close the eye
//! fully (Sforza et al. 2008, doi:10.1111/j.1475-1313.2008.00577.x), and some are double.
//!
//! Rates: 26 per minute in conversation and 17 at rest (medians of 150 people; Bentivoglio et al.
//! 1997, doi:10.1002/mds.870120629). Time is split into intervals. An interval with speech has one
//! blink, or two in a row, at its most significant pause or at a random time; most silent intervals
//! have one. Blinks at every pause plus the additional ones would make a speaker of short phrases
//! blink twice as often as people do.

use raconteur_base::curve::smooth;
use raconteur_base::noise;

use super::speech_features::SpeechFeatures;
use crate::idle::stream;

/// Duration of the closing phase of a blink, seconds (*paper*).
pub const CLOSING_SECS: f64 = 0.085;
/// Duration of the closed phase of a blink, seconds (*paper*).
pub const CLOSED_SECS: f64 = 0.02;
/// Opening phase, seconds (*paper*: 150 to 300 ms with a slow end, Kwon et al. 2013,
/// doi:10.1098/rsif.2013.0227).
pub const OPENING_SECS: f64 = 0.225;
/// Maximum time between two blinks while speaking, apart from the length of a phone, seconds
/// (*paper*: F&H).
pub const MAX_APART_SECS: f64 = 4.8;
/// Length of a planning interval, seconds. With the doublets that makes 22 blinks per minute of
/// speech.
const STRETCH_SECS: f64 = 2.95;
/// Time between two blinks at least, doublets aside, seconds. Designed: a flutter is another
/// signal.
const APART_SECS: f64 = 0.7;
/// Share of the intervals of silence with a blink: 17 per minute, doublets included.
const AT_REST: f64 = 0.77;
/// Share of blinks followed by a second one. Designed.
const DOUBLETS: f64 = 0.09;
/// Pause between the two blinks of a doublet, from opened to closing again, seconds. Designed.
const DOUBLET_PAUSE_SECS: f64 = 0.06;
/// Share of blinks that do not close the eye fully (*paper*), and their extent: shares of the full
/// closure (*paper*: women's mostly 51 to 75 %, men's from 25 % on; the smallest ones, which are
/// hardly visible, are left out).
const PARTIAL: f64 = 0.5;
const PARTIAL_WAY: [f64; 2] = [0.5, 0.8];
/// Phases differ from their lengths by no more than this share to be on a phone boundary.
const SNAPPED: f64 = 0.25;

/// Blink of both eyes: the times of its phases (story time, seconds) and its depth.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Blink {
    /// Times of the start of closing, full closure, start of opening and end of opening.
    phases: [f64; 4],
    /// Depth, 0 to 1 (fully closed).
    depth: f64,
    /// A second one follows, as far.
    is_double: bool,
}

impl Blink {
    /// Returns the time at which the eye is open again.
    fn end_secs(&self) -> f64 {
        let [start, .., open] = self.phases;
        if self.is_double {
            open + DOUBLET_PAUSE_SECS + (open - start)
        } else {
            open
        }
    }

    /// Returns the closure of the lids, 0 open to 1 closed.
    fn closure(&self, time_secs: f64) -> f64 {
        let [start, .., open] = self.phases;
        let again = time_secs - (open - start) - DOUBLET_PAUSE_SECS;
        let time_secs = if self.is_double && again >= start {
            again
        } else {
            time_secs
        };
        let [start, closed, opening, open] = self.phases;
        let shut = smooth((time_secs - start) / (closed - start));
        let up = ((time_secs - opening) / (open - opening)).clamp(0.0, 1.0);
        // Fast at first and slow at the end.
        self.depth * (shut - smooth(up + 0.6 * up * (1.0 - up)))
    }
}

/// Planned blinks of a figure over the story; give the closure of the lids at any time.
#[derive(Clone, Debug)]
pub(super) struct Blinks {
    /// Blinks in intervals with speech, by the number of the interval.
    planned: Vec<(i64, Blink)>,
    /// Infinite where there are no blinks.
    stretch_secs: f64,
    seed: u64,
}

/// Random values of an interval.
#[derive(Clone, Copy)]
enum RandomDraw {
    Place,
    Rest,
    Partial,
    Depth,
    Double,
}

impl Blinks {
    /// Plans the blinks from speech features. `rate` is a multiple of the natural blink frequency.
    pub(super) fn new(heard: &SpeechFeatures, rate: f64, seed: u64) -> Self {
        let mut blinks = Self {
            planned: Vec::new(),
            stretch_secs: STRETCH_SECS / rate,
            seed,
        };
        let mut begun = 0;
        for boundary in &heard.boundaries {
            let stretch = blinks.interval_index(*boundary);
            let is_known = blinks
                .planned
                .last()
                .is_some_and(|(last, _)| *last == stretch);
            if rate > 0.0 && !is_known {
                while heard
                    .pauses
                    .get(begun)
                    .is_some_and(|p| blinks.interval_index(p.start_secs) < stretch)
                {
                    begun += 1;
                }
                let blink = blinks.plan(stretch, heard, begun);
                blinks.planned.push((stretch, blink));
            }
        }
        blinks
    }

    fn interval_index(&self, time_secs: f64) -> i64 {
        (time_secs / self.stretch_secs).floor() as i64
    }

    fn random_draw(&self, what: RandomDraw, stretch: i64) -> f64 {
        let seed = self.seed.wrapping_add(0x9e37 * what as u64);
        noise::unit(seed, stream::BLINK, stretch)
    }

    /// Returns the closure of the lids at a time, 0 open to 1 closed.
    pub(super) fn closure(&self, time_secs: f64) -> f64 {
        if self.stretch_secs.is_infinite() {
            return 0.0;
        }
        let stretch = self.interval_index(time_secs);
        let [before, now] = [stretch.wrapping_sub(1), stretch].map(|stretch| {
            let blink = self.blink(stretch);
            blink.map_or(0.0, |blink| blink.closure(time_secs))
        });
        before.max(now)
    }

    /// Returns the blink of an interval, if it has one.
    fn blink(&self, stretch: i64) -> Option<Blink> {
        let next = self.planned.partition_point(|(s, _)| *s < stretch);
        match self.planned.get(next) {
            Some((planned, blink)) if *planned == stretch => Some(*blink),
            _ => (self.random_draw(RandomDraw::Rest, stretch) < AT_REST).then(|| {
                let start = self.at_random(stretch);
                let closed = start + CLOSING_SECS;
                self.of_phases(stretch, start, closed)
            }),
        }
    }

    /// Returns the random start time of an interval's spontaneous blink.
    fn at_random(&self, stretch: i64) -> f64 {
        (stretch as f64 + 0.1 + 0.6 * self.random_draw(RandomDraw::Place, stretch))
            * self.stretch_secs
    }

    fn of_phases(&self, stretch: i64, start: f64, closed: f64) -> Blink {
        let opening = closed + CLOSED_SECS;
        let [least, most] = PARTIAL_WAY;
        let is_partial = self.random_draw(RandomDraw::Partial, stretch) < PARTIAL;
        Blink {
            phases: [start, closed, opening, opening + OPENING_SECS],
            depth: if is_partial {
                least + (most - least) * self.random_draw(RandomDraw::Depth, stretch)
            } else {
                1.0
            },
            is_double: self.random_draw(RandomDraw::Double, stretch) < DOUBLETS,
        }
    }

    /// Plans the blink of an interval with speech, whose first pause is `first`.
    fn plan(&self, stretch: i64, heard: &SpeechFeatures, first: usize) -> Blink {
        let at = |share: f64| (stretch as f64 + share) * self.stretch_secs;
        let before = self.blink(stretch.wrapping_sub(1));
        let free_secs = before.map_or(f64::NEG_INFINITY, |b| b.end_secs() + APART_SECS);
        let dry_secs = before.map_or(f64::INFINITY, |b| b.phases[0] + MAX_APART_SECS);
        let (from, to) = (at(0.04).max(free_secs), at(0.96).min(dry_secs));
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
            // A very high rate leaves no time to separate blinks.
            None => {
                let wanted = self.at_random(stretch).min(to);
                heard
                    .snapped(wanted.max(free_secs.min(at(0.5))))
                    .max(at(0.0))
            }
        };
        // The phase stays near its length where no boundary is.
        let wanted = start + CLOSING_SECS;
        let slack = SNAPPED * CLOSING_SECS;
        let closed = heard.boundary_within(wanted, wanted - slack, wanted + slack);
        self.of_phases(stretch, start, closed.unwrap_or(wanted))
    }
}

#[cfg(test)]
mod tests {
    use super::super::Manner;
    use super::super::tests::speech::{hour, shipped};
    use super::*;
    use raconteur_speech::TimedUtterance;

    fn plan(speech: &[TimedUtterance]) -> (SpeechFeatures, Blinks) {
        let heard = SpeechFeatures::new(&speech.iter().collect::<Vec<_>>(), &Manner::default(), 1);
        let blinks = Blinks::new(&heard, 1.0, 1);
        (heard, blinks)
    }

    #[test]
    fn blinks_begin_and_close_on_phone_boundaries_where_there_are_any() {
        for speech in [hour(5), shipped()] {
            let (heard, blinks) = plan(&speech);
            let mut on = 0;
            for (_, blink) in &blinks.planned {
                let [start, closed, ..] = blink.phases;
                let near = |at: f64| heard.boundary_within(at, at - 0.2, at + 0.2);
                assert_eq!(near(start).unwrap_or(start), start);
                // The nearest one that leaves the phase its length, if there is any.
                let far = |b: f64| (b - start - CLOSING_SECS).abs();
                let fits = |b: &&f64| far(**b) <= SNAPPED * CLOSING_SECS;
                let nearest = heard.boundaries.iter().filter(fits).map(|b| far(*b));
                let nearest = nearest.reduce(f64::min);
                assert!(
                    (far(closed) - nearest.unwrap_or(0.0)).abs() < 1e-9,
                    "the blink closes at the nearest phone boundary"
                );
                on += usize::from(nearest.is_some());
            }
            println!("{on} of {} close on a boundary", blinks.planned.len());
            // Most begin with a silence, which has no boundary so soon.
            assert!(on > 0, "some blinks are on phone boundaries");
        }
    }

    #[test]
    fn pauses_are_punctuated() {
        let (heard, blinks) = plan(&hour(5));
        let starts: Vec<f64> = heard.pauses.iter().map(|p| p.start_secs).collect();
        let in_pauses = blinks
            .planned
            .iter()
            .filter(|(_, blink)| starts.contains(&blink.phases[0]))
            .count();
        println!(
            "{in_pauses} of {} blinks begin with a pause",
            blinks.planned.len()
        );
        assert!(
            10 * in_pauses > 6 * blinks.planned.len(),
            "more than 60 % of the blinks are in pauses"
        );
    }

    #[test]
    fn lids_fall_fast_and_rise_slowly_and_half_of_them_all_the_way() {
        let (_, spoken) = plan(&hour(5));
        let silent = Blinks::new(&SpeechFeatures::default(), 1.0, 3);
        for blinks in [&spoken, &silent] {
            let (mut partial, mut double, mut count) = (0, 0, 0);
            for blink in (0..1000).filter_map(|stretch| blinks.blink(stretch)) {
                let [start, closed, opening, open] = blink.phases;
                let at = |t: f64| blinks.closure(t);
                assert_eq!(at(0.5 * (closed + opening)), blink.depth);
                assert!(
                    at(start).abs() < 1e-9 && at(blink.end_secs() + 1e-9) < 1e-9,
                    "the lid is open at both ends of the blink"
                );
                assert!(
                    (0.06..=0.11).contains(&(closed - start)),
                    "the closing time in seconds"
                );
                assert!(
                    (opening - closed - 0.02).abs() < 1e-9,
                    "the lid stays closed for 20 ms"
                );
                assert!(
                    (0.2..=0.25).contains(&(open - opening)),
                    "the opening time in seconds"
                );
                // The rise passes its middle before the middle of its time.
                assert!(
                    at(0.5 * (opening + open)) < 0.4 * blink.depth,
                    "the lid opens fast at first"
                );
                partial += usize::from(blink.depth < 1.0);
                double += usize::from(blink.is_double);
                count += 1;
            }
            let [partial, double] = [partial, double].map(|n| n as f64 / f64::from(count));
            println!("{partial:.2} partial, {double:.2} double of {count}");
            assert!(
                (0.45..=0.55).contains(&partial) && (0.05..=0.13).contains(&double),
                "the shares of partial and double blinks"
            );
        }
    }

    #[test]
    fn blinks_are_apart_and_the_eyes_stay_moist() {
        let (_, blinks) = plan(&hour(5));
        for pair in blinks.planned.windows(2) {
            let [(one, before), (next, after)] = [pair[0], pair[1]];
            assert!(after.phases[0] - before.end_secs() > 0.3, "{pair:?}");
            // Except for the shift to the nearest phone boundary.
            let apart = after.phases[0] - before.phases[0];
            assert!(next > one + 1 || apart < MAX_APART_SECS + 0.3, "{pair:?}");
        }
        assert_eq!(
            Blinks::new(&SpeechFeatures::default(), 0.0, 3).closure(1.0),
            0.0
        );
    }

    #[test]
    fn one_who_is_silent_blinks_less_than_one_who_talks() {
        // 17 a minute (Bentivoglio et al. 1997), within a tenth.
        let silent = Blinks::new(&SpeechFeatures::default(), 1.0, 3);
        let shut = |i: i32| silent.closure(f64::from(i) * 0.01) > 0.3;
        let count = (1..360_000).filter(|i| shut(*i) && !shut(i - 1)).count();
        println!("{count} in an hour of silence");
        assert!((17 * 54..17 * 66).contains(&count), "{count}");
    }
}
