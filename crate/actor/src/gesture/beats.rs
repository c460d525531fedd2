//! Beats: small movements of a held hand on accented syllables (McNeill 1992: beats are superposed
//! on other gestures).

use raconteur_base::curve::lerp;
use raconteur_base::order::sort_by_number;
use raconteur_base::{DVec3, noise};

use super::tracks::WristTrack;
use crate::idle::stream;
use crate::superposition::SuperposedTrack;

/// Height that a hand rises before a beat, and depth of the beat below its place, for a stature of
/// 1.7 m, metres. Designed.
const RISE_M: f64 = 0.042;
const FALL_M: f64 = 0.042;
/// Movement to the front with the fall, as a share of it. Designed.
const FORWARD: f64 = 0.5;
/// Sideways movement with the fall at most, likewise.
const ASIDE_M: f64 = 0.03;
/// Least and largest size of a beat, and share of accents without one. Designed: no two beats are
/// alike.
const SIZES: [f64; 2] = [0.45, 1.3];
const SKIPPED_SHARE: f64 = 0.25;
/// Times of rise, fall and return, seconds. Designed; strokes of beats last about 0.2 s.
const BEAT_SECS: [f64; 3] = [0.17, 0.14, 0.26];
/// Time between two beats of a hand at least, seconds. Designed.
const APART_SECS: f64 = 0.5;
/// Size of beats of a hand that rests beside the other one. Designed.
const BESIDE_SHARE: f64 = 0.7;
/// Margin of a hold before its first and after its last beat, seconds.
const MARGIN_SECS: f64 = 0.04;
/// Movement of a held hand at most, metres: no one holds perfectly still.
const HELD_M: f64 = 0.02;

/// Beats of one hand over the whole story: to the left, up and to the front, metres.
#[derive(Clone, Debug, Default)]
pub(super) struct Beats {
    track: SuperposedTrack<3>,
}

impl Beats {
    /// Plans beats at accents, ascending times in seconds, while the hand is held, and smaller ones
    /// in the spans `beside` in which it rests free beside the other one. `size_at` gives the size
    /// at a time, 1 for ordinary speech of a person 1.7 m tall.
    pub(super) fn new(
        wrist: &WristTrack,
        beside: &[(f64, f64)],
        accents: &[f64],
        size_at: &dyn Fn(f64) -> f64,
        seed: u64,
    ) -> Self {
        let mut pulses = Vec::new();
        let mut last = f64::NEG_INFINITY;
        let beside = beside.iter().map(|&(from_secs, to_secs)| BeatSpan {
            from_secs,
            to_secs,
            still_secs: to_secs,
            size: BESIDE_SHARE,
        });
        let mut spans: Vec<BeatSpan> = holds(wrist).chain(beside).collect();
        sort_by_number(&mut spans, |span| span.from_secs);
        for span in spans {
            let begun = accents.partition_point(|t| *t < span.from_secs);
            let inside = accents[begun..].iter();
            for accent in inside.take_while(|t| **t < span.to_secs) {
                // The fall ends at the middle of the accent.
                let start = accent - BEAT_SECS[0] - 0.5 * BEAT_SECS[1];
                // The return may be under way with the next movement, but is over at its end.
                let falls = start + BEAT_SECS[0] + BEAT_SECS[1];
                let fits = start >= span.from_secs + MARGIN_SECS
                    && falls <= span.to_secs - MARGIN_SECS
                    && falls + BEAT_SECS[2] <= span.still_secs - MARGIN_SECS;
                if !fits || start - last < APART_SECS {
                    continue;
                }
                last = start;
                let bucket = (1e3 * accent).round() as i64;
                let chance = |id: u64| noise::unit(seed, stream::BEAT + id, bucket);
                if chance(0) < SKIPPED_SHARE {
                    continue;
                }
                let [least, most] = SIZES;
                let size = span.size * size_at(*accent) * lerp(least, most, chance(1));
                let aside_m = ASIDE_M * size * (2.0 * chance(2) - 1.0);
                let [rise, fall, back] = BEAT_SECS;
                pulses.push((start, [rise, fall], [0.0, size * RISE_M, 0.0]));
                let fall_m = size * FALL_M;
                pulses.push((
                    start + rise,
                    [fall, back],
                    [aside_m, -fall_m, FORWARD * fall_m],
                ));
            }
        }
        Self {
            track: SuperposedTrack::of_pulses(&pulses),
        }
    }

    /// Returns the displacement of the hand at a time, metres.
    pub(super) fn sample(&self, time_secs: f64) -> DVec3 {
        let [left, up, front] = self.track.sample(time_secs);
        DVec3::new(left, up, front)
    }
}

/// Span of time with beats.
#[derive(Clone, Copy, Debug)]
struct BeatSpan {
    /// Start and end of the hold, seconds.
    from_secs: f64,
    to_secs: f64,
    /// Time of the next key after it, where the hand is without beats, seconds.
    still_secs: f64,
    /// Size of the beats.
    size: f64,
}

/// Returns the spans in which a hand is held in a gesture.
fn holds(wrist: &WristTrack) -> impl Iterator<Item = BeatSpan> {
    let ends = wrist.times.windows(2).zip(wrist.nodes.windows(2));
    ends.enumerate().filter_map(|(i, (times, nodes))| {
        let (from, to) = (nodes[0].place?, nodes[1].place?);
        let is_held = (to - from).length_squared() < HELD_M * HELD_M;
        is_held.then(|| BeatSpan {
            from_secs: times[0],
            to_secs: times[1],
            still_secs: wrist.times.get(i + 2).copied().unwrap_or(f64::INFINITY),
            size: 1.0,
        })
    })
}
