//! Phone boundaries, moved to changes in the audio.
//!
//! An engine that works in frames knows the order of its phones and the approximate start of each.
//! This module moves each boundary within a limited range, so that vowels and sonorants cover
//! voiced audio, friction noise, plosives their closure and burst, and pauses silence, for the
//! whole sentence together by the shortest path. Costs are *designed*, in logarithms of odds;
//! [`crate::measured_speech`] measures their effect.

use crate::manner::{Manner, manner};
use crate::signal::bursts;
use crate::signal::f0::{PitchTrack, track_voice};
use crate::signal::filter::Biquad;
use crate::signal::intensity::{Intensity, decibels, intensity};
use crate::spoken::{Segment, Spoken};
use raconteur_base::ops;

/// Time step of possible borders, seconds.
const STEP_SECS: f64 = 0.005;
/// Maximum displacement of a border, in steps, and typical error of an engine's border, seconds:
/// half a frame of 25 ms and the uncertainty of its network. Engines are less accurate at the
/// borders of pauses.
const REACH: (usize, f64) = (14, 0.03);
const REACH_OF_PAUSES: (usize, f64) = (80, 0.08);
/// Typical deviation of a phone's length from the engine's, as a factor in logarithms.
const STRETCH: f64 = 0.3;
/// The shortest phone, steps.
const MIN_STEPS: usize = 3;
/// Minimum length of a vowel, in steps, unless the engine reports it as much shorter.
const MIN_VOWEL: usize = 8;
/// Level below the loudest of a sentence that counts as inaudible, decibels.
const HEARD_DB: f64 = -45.0;
/// The shortest phone before a pause, seconds.
const MIN_LAST_SECS: f64 = 0.04;
/// Silence that is shorter is no pause, seconds.
const PAUSE_SECS: f64 = 0.04;
/// The window of levels, seconds.
const WINDOW_SECS: f64 = 0.012;
/// Frequency above which friction is measured.
const HISS_HZ: f64 = 2500.0;
/// Nasals have little above this frequency, vowels that are not closed much.
const OPEN_HZ: f64 = 600.0;
/// The price of a plosive without its burst.
const NO_BURST: f64 = 2.5;

/// Acoustic features at each step.
struct Frame {
    voiced: bool,
    /// Level under the loudest of the sentence, decibels, at most 0.
    level_db: f64,
    /// Level above [`HISS_HZ`] over the whole, decibels.
    hiss_db: f64,
    /// Level above [`OPEN_HZ`], decibels.
    open_db: f64,
}

/// Moves the borders of a sentence; the first begins and the last ends as before.
pub(crate) fn refine(spoken: &mut Spoken) {
    let count = spoken.segments.len();
    let frames = frames(spoken);
    if count < 2 || frames.len() < count * MIN_STEPS {
        return;
    }
    let told: Vec<f64> = spoken.segments.iter().map(|s| s.end_secs).collect();
    let of = |wanted: Manner| {
        let segments = spoken.segments.iter();
        segments
            .map(|s| manner(&spoken.phone_set, &s.symbol) == wanted)
            .collect()
    };
    let paths = Paths {
        costs: sums(spoken, &frames),
        bursts: bursts::all(&spoken.samples, spoken.rate_hz)
            .iter()
            .map(|b| b.secs)
            .collect(),
        plosive: of(Manner::Plosive),
        vowel: of(Manner::Vowel),
        silent: spoken.segments.iter().map(Segment::is_silent).collect(),
        places: told[..count - 1]
            .iter()
            .map(|t| (t / STEP_SECS).round() as usize)
            .collect(),
        last: frames.len(),
    };
    let Some(ends) = paths.best() else { return };
    for (segment, end) in spoken.segments.iter_mut().zip(ends) {
        segment.end_secs = end as f64 * STEP_SECS;
    }
    trim(spoken, &frames);
    drop_short_pauses(spoken);
}

/// Ends a phone before a pause, or at the end, when it becomes inaudible, because closures cannot
/// be distinguished from pauses.
fn trim(spoken: &mut Spoken, frames: &[Frame]) {
    for at in 1..spoken.segments.len() {
        let before = at
            .checked_sub(2)
            .map_or(0.0, |i| spoken.segments[i].end_secs);
        if !spoken.segments[at].is_silent() || spoken.segments[at - 1].is_silent() {
            continue;
        }
        let end = spoken.segments[at - 1].end_secs;
        let step = |secs: f64| ((secs / STEP_SECS).round() as usize).min(frames.len());
        let (from, to) = (step(before + MIN_LAST_SECS), step(end));
        let heard = (from..to).rev().find(|k| frames[*k].level_db > HEARD_DB);
        let last = heard.map_or(from, |k| k + 1).min(to);
        spoken.segments[at - 1].end_secs = last as f64 * STEP_SECS;
    }
}

/// Merges pauses that are too short to be perceived into the preceding phone.
fn drop_short_pauses(spoken: &mut Spoken) {
    for at in (1..spoken.segments.len().saturating_sub(1)).rev() {
        let (begins, end_secs) = (
            spoken.segments[at - 1].end_secs,
            spoken.segments[at].end_secs,
        );
        if !spoken.segments[at].is_silent() || end_secs - begins >= PAUSE_SECS {
            continue;
        }
        spoken.segments[at - 1].end_secs = end_secs;
        spoken.segments.remove(at);
        for syllable in spoken.syllables.iter_mut().filter(|s| s.first >= at) {
            syllable.first -= 1;
        }
    }
}

fn frames(spoken: &Spoken) -> Vec<Frame> {
    let (samples, rate_hz) = (&spoken.samples, spoken.rate_hz);
    let end_secs = spoken.segments.last().map_or(0.0, |s| s.end_secs);
    let count = (end_secs / STEP_SECS) as usize;
    let track: PitchTrack = track_voice(samples, rate_hz, STEP_SECS);
    let whole = intensity(samples, rate_hz, STEP_SECS, WINDOW_SECS);
    let above = |hz: f64| -> Intensity {
        let high = Biquad::high_pass(rate_hz, hz.min(0.25 * rate_hz)).run(samples);
        intensity(&high, rate_hz, STEP_SECS, WINDOW_SECS)
    };
    let (hiss, open) = (above(HISS_HZ), above(OPEN_HZ));
    let middle = |k: usize| (k as f64 + 0.5) * STEP_SECS;
    let loudest = (0..count)
        .map(|k| whole.db_at(middle(k)))
        .fold(decibels(0.0), f64::max);
    (0..count)
        .map(|k| {
            let level_db = whole.db_at(middle(k));
            Frame {
                voiced: track.hz_at(middle(k)) > 0.0,
                level_db: level_db - loudest,
                hiss_db: hiss.db_at(middle(k)) - level_db,
                open_db: open.db_at(middle(k)) - level_db,
            }
        })
        .collect()
}

/// Returns the degree to which a value exceeds a bound, 0 to 1.
fn over(value: f64, bound: f64, width: f64) -> f64 {
    ((value - bound) / width).clamp(0.0, 1.0)
}

/// Kind of a phone, in addition to its manner.
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Nasal,
    VoicedFriction,
    Other,
}

impl Kind {
    /// Returns the class of a phone of the set `radio`.
    fn from_symbol(symbol: &str) -> Self {
        match symbol {
            "m" | "n" | "ng" => Self::Nasal,
            "z" | "zh" | "v" | "dh" | "jh" | "hh" => Self::VoicedFriction,
            _ => Self::Other,
        }
    }
}

/// Returns the cost of assigning a step to a phone.
fn cost(manner: Manner, kind: Kind, frame: &Frame) -> f64 {
    let Frame {
        voiced,
        level_db,
        hiss_db,
        open_db,
    } = *frame;
    let unvoiced = f64::from(u8::from(!voiced));
    match manner {
        Manner::Vowel => unvoiced + over(-level_db, 18.0, 15.0) + 0.5 * over(hiss_db, -8.0, 6.0),
        Manner::Sonorant => {
            let open = if kind == Kind::Nasal { 0.6 } else { 0.0 };
            0.8 * unvoiced
                + 0.6 * over(-level_db, 26.0, 14.0)
                + 0.5 * over(hiss_db, -8.0, 6.0)
                + open * over(open_db, -7.0, 5.0)
        }
        Manner::Fricative => {
            let voice = if kind == Kind::VoicedFriction {
                0.1
            } else {
                0.5
            };
            voice * (1.0 - unvoiced)
                + 0.6 * over(-hiss_db, 8.0, 12.0)
                + 0.8 * over(-level_db, 42.0, 12.0)
        }
        // The release is short, regardless of its audio.
        Manner::Plosive => 0.8 * over(level_db, -22.0, 14.0) + 0.2 * (1.0 - unvoiced),
        Manner::Silence => 1.2 * over(level_db, -42.0, 14.0) + 0.3 * (1.0 - unvoiced),
    }
}

/// Returns, for each phone, the cumulative costs of all steps before a step.
fn sums(spoken: &Spoken, frames: &[Frame]) -> Vec<Vec<f64>> {
    spoken
        .segments
        .iter()
        .map(|segment| {
            let symbol = segment.symbol.as_str();
            let manner = manner(&spoken.phone_set, symbol);
            let kind = Kind::from_symbol(symbol);
            let mut sum = 0.0;
            let mut out = Vec::with_capacity(frames.len() + 1);
            out.push(0.0);
            for frame in frames {
                sum += cost(manner, kind, frame);
                out.push(sum);
            }
            out
        })
        .collect()
}

struct Paths {
    costs: Vec<Vec<f64>>,
    /// Times of the bursts, ascending, seconds.
    bursts: Vec<f64>,
    plosive: Vec<bool>,
    vowel: Vec<bool>,
    silent: Vec<bool>,
    /// Borders between phones from the engine, in steps.
    places: Vec<usize>,
    /// End of the last phone.
    last: usize,
}

impl Paths {
    /// Returns the cost of a phone from one step to another.
    fn phone(&self, phone: usize, from: usize, to: usize) -> f64 {
        let own = self.costs[phone][to] - self.costs[phone][from];
        if self.silent[phone] {
            return own;
        }
        let told = self.engine_steps(phone);
        let stretch = ops::ln((to - from) as f64 / told.max(MIN_STEPS) as f64) / STRETCH;
        let own = own + 0.5 * stretch * stretch;
        if !self.plosive[phone] {
            return own;
        }
        let (from, to) = (from as f64 * STEP_SECS, (to + 1) as f64 * STEP_SECS);
        let next = self.bursts.partition_point(|b| *b < from);
        let bursts = self.bursts.get(next).is_some_and(|b| *b <= to);
        own + if bursts { 0.0 } else { NO_BURST }
    }

    /// Returns the length of a phone according to the engine, in steps.
    fn engine_steps(&self, phone: usize) -> usize {
        let start = phone.checked_sub(1).map_or(0, |before| self.places[before]);
        let end = self.places.get(phone).copied().unwrap_or(self.last);
        end.saturating_sub(start)
    }

    /// Returns the minimum length of a phone, steps.
    fn min_steps(&self, phone: usize) -> usize {
        match self.vowel[phone] {
            true => MIN_VOWEL.min(self.engine_steps(phone) + MIN_STEPS),
            false => MIN_STEPS,
        }
    }

    /// Returns the maximum displacement of a border and its typical error.
    fn reach(&self, border: usize) -> (usize, f64) {
        match self.silent[border] || self.silent[border + 1] {
            true => REACH_OF_PAUSES,
            false => REACH,
        }
    }

    /// Returns the range of steps in which a border may lie.
    fn choices(&self, border: usize) -> (usize, usize) {
        let (place, (reach, _)) = (self.places[border], self.reach(border));
        let room = MIN_STEPS * (self.places.len() - border);
        let first = place.saturating_sub(reach).max(MIN_STEPS * (border + 1));
        (
            first.min(self.last - room),
            (place + reach).min(self.last - room),
        )
    }

    /// Returns the ends of all phones but the last; `None` if no path is long enough.
    fn best(&self) -> Option<Vec<usize>> {
        let moved = |border: usize, at: usize| {
            let (_, spread_secs) = self.reach(border);
            let off = (at as f64 - self.places[border] as f64) * STEP_SECS / spread_secs;
            0.5 * off * off
        };
        // Of each border, of each choice: the least cost until there, and the choice before.
        let mut layers: Vec<Vec<(f64, usize)>> = Vec::with_capacity(self.places.len());
        for border in 0..self.places.len() {
            let (first, last) = self.choices(border);
            let layer = (first..=last).map(|at| {
                let (until, before) = match border.checked_sub(1) {
                    None => (self.phone(0, 0, at), 0),
                    Some(previous) => {
                        let (start, _) = self.choices(previous);
                        let reached = layers[previous].iter().enumerate();
                        let ways = reached.filter_map(|(i, (until, _))| {
                            let from = start + i;
                            let fits = from + self.min_steps(border) <= at && until.is_finite();
                            fits.then(|| (until + self.phone(border, from, at), i))
                        });
                        ways.min_by(|a, b| a.0.total_cmp(&b.0))
                            .unwrap_or((f64::INFINITY, 0))
                    }
                };
                (until + moved(border, at), before)
            });
            layers.push(layer.collect());
        }
        let (start, _) = self.choices(self.places.len() - 1);
        let end = layers.last()?.iter().enumerate().map(|(i, (until, _))| {
            (
                until + self.phone(self.places.len(), start + i, self.last),
                i,
            )
        });
        let (least, mut choice) = end.min_by(|a, b| a.0.total_cmp(&b.0))?;
        if !least.is_finite() {
            return None;
        }
        let mut ends = vec![0; self.places.len()];
        for border in (0..self.places.len()).rev() {
            ends[border] = self.choices(border).0 + choice;
            choice = layers[border][choice].1;
        }
        Some(ends)
    }
}

#[cfg(test)]
mod tests;
