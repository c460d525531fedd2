//! Beats: small movements of a held hand on accented syllables (McNeill 1992: beats are superposed
//! on other gestures).

use raconteur_base::DVec3;

use super::tracks::WristTrack;
use crate::superposition::SuperposedTrack;

/// Height that a hand rises before a beat, and depth of the beat below its place, for a stature of
/// 1.7 m, metres. Designed.
const RISE_M: f64 = 0.03;
const FALL_M: f64 = 0.03;
/// Movement to the front with the fall, as a share of it. Designed.
const FORWARD: f64 = 0.5;
/// Times of rise, fall and return, seconds. Designed; strokes of beats last about 0.2 s.
const BEAT_SECS: [f64; 3] = [0.17, 0.14, 0.26];
/// Time between two beats of a hand at least, seconds. Designed.
const APART_SECS: f64 = 0.5;
/// Margin of a hold before its first and after its last beat, seconds.
const MARGIN_SECS: f64 = 0.04;
/// Movement of a held hand at most, metres: no one holds perfectly still.
const HELD_M: f64 = 0.02;

/// Beats of one hand over the whole story: height and depth, metres.
#[derive(Clone, Debug, Default)]
pub(super) struct Beats {
    track: SuperposedTrack<2>,
}

impl Beats {
    /// Plans beats at accents, ascending times in seconds, while the hand is held. `size_at` gives
    /// the size at a time, 1 for ordinary speech of a person 1.7 m tall.
    pub(super) fn new(wrist: &WristTrack, accents: &[f64], size_at: &dyn Fn(f64) -> f64) -> Self {
        let mut pulses = Vec::new();
        let mut last = f64::NEG_INFINITY;
        for (from, to) in holds(wrist) {
            let begun = accents.partition_point(|t| *t < from);
            for accent in accents[begun..].iter().take_while(|t| **t < to) {
                // The fall ends at the middle of the accent.
                let start = accent - BEAT_SECS[0] - 0.5 * BEAT_SECS[1];
                let end = start + BEAT_SECS.iter().sum::<f64>();
                let fits = start >= from + MARGIN_SECS && end <= to - MARGIN_SECS;
                if !fits || start - last < APART_SECS {
                    continue;
                }
                last = start;
                let size = size_at(*accent);
                let [rise, fall, back] = BEAT_SECS;
                pulses.push((start, [rise, fall], [size * RISE_M, 0.0]));
                let fall_m = size * FALL_M;
                pulses.push((start + rise, [fall, back], [-fall_m, FORWARD * fall_m]));
            }
        }
        Self {
            track: SuperposedTrack::of_pulses(&pulses),
        }
    }

    /// Returns the displacement of the hand at a time, metres.
    pub(super) fn sample(&self, time_secs: f64) -> DVec3 {
        let [up, front] = self.track.sample(time_secs);
        DVec3::new(0.0, up, front)
    }
}

/// Returns the spans in which a hand is held in a gesture.
fn holds(wrist: &WristTrack) -> impl Iterator<Item = (f64, f64)> {
    let ends = wrist.times.windows(2).zip(wrist.nodes.windows(2));
    ends.filter_map(|(times, nodes)| {
        let (from, to) = (nodes[0].place?, nodes[1].place?);
        ((to - from).length_squared() < HELD_M * HELD_M).then_some((times[0], times[1]))
    })
}
