//! How far labels are from the sound that they label, when all are off by the same.

use super::{PitchTrack, bursts, epochs, is_rate};

/// Something that labels say happens at a time and that can be seen in the sound.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Landmark {
    /// When the labels say it is, in seconds.
    pub secs: f64,
    /// What it is.
    pub kind: LandmarkKind,
}

/// What a landmark is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LandmarkKind {
    /// A plosive's release.
    Burst,
    /// The voice sets in: a vowel after a pause or a voiceless fricative.
    VoicingOnset,
    /// The voice ends: a vowel before a pause or a voiceless obstruent.
    VoicingEnd,
}

/// An estimated offset.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lag {
    /// Time in the sound less time in the labels, the median, in seconds: positive
    /// where the labels are early.
    pub secs: f64,
    /// Median of the distances from that, in seconds: how much to believe it.
    pub spread_secs: f64,
    /// Landmarks found in the sound.
    pub found: usize,
}

/// Fewest landmarks whose median is given.
const FEWEST: usize = 3;

/// The offset of labels from sound. For each landmark the nearest event of its kind
/// within `reach_secs` is taken; none if fewer than three have one.
#[must_use]
pub fn lag(
    samples: &[f64],
    rate_hz: f64,
    track: &PitchTrack,
    landmarks: &[Landmark],
    reach_secs: f64,
) -> Option<Lag> {
    if !is_rate(rate_hz) {
        return None;
    }
    let releases: Vec<f64> = bursts::all(samples, rate_hz)
        .iter()
        .map(|b| b.secs)
        .collect();
    let runs = epochs::voiced(samples, rate_hz, track);
    let edge = |at: Option<&f64>| at.map(|at| at / rate_hz);
    let onsets: Vec<f64> = runs.iter().filter_map(|run| edge(run.first())).collect();
    let ends: Vec<f64> = runs.iter().filter_map(|run| edge(run.last())).collect();
    let mut offsets: Vec<f64> = landmarks
        .iter()
        .filter_map(|landmark| {
            let events = match landmark.kind {
                LandmarkKind::Burst => &releases,
                LandmarkKind::VoicingOnset => &onsets,
                LandmarkKind::VoicingEnd => &ends,
            };
            events
                .iter()
                .map(|at| at - landmark.secs)
                .filter(|offset| offset.abs() <= reach_secs)
                .min_by(|a, b| a.abs().total_cmp(&b.abs()))
        })
        .collect();
    if offsets.len() < FEWEST {
        return None;
    }
    let secs = median(&mut offsets);
    let mut distances: Vec<f64> = offsets.iter().map(|o| (o - secs).abs()).collect();
    Some(Lag {
        secs,
        spread_secs: median(&mut distances),
        found: offsets.len(),
    })
}

/// The middle value, or the mean of the two middle ones; 0 of none.
fn median(values: &mut [f64]) -> f64 {
    values.sort_by(f64::total_cmp);
    let half = values.len() / 2;
    match (values.get(half), half.checked_sub(1)) {
        (Some(high), Some(below)) if values.len().is_multiple_of(2) => 0.5 * (values[below] + high),
        (Some(middle), _) => *middle,
        _ => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::super::f0::{PitchOptions, track};
    use super::super::testing::{self, Part};
    use super::*;

    #[test]
    fn a_constant_offset_is_measured() {
        let rate = 16_000.0;
        let mut parts = vec![Part::silence(0.2)];
        let mut marks = Vec::new();
        let mut t = 0.2;
        for k in 0..5 {
            let hz = 100.0 + 10.0 * f64::from(k);
            marks.push((t, LandmarkKind::VoicingOnset));
            parts.push(Part::vowel(0.2, hz, hz));
            marks.push((t + 0.2, LandmarkKind::VoicingEnd));
            parts.push(Part::silence(0.06));
            marks.push((t + 0.26, LandmarkKind::Burst));
            parts.push(Part::burst());
            parts.push(Part::silence(0.1));
            t += 0.38;
        }
        let (mut sound, _) = testing::utterance(rate, &parts);
        for (i, x) in sound.iter_mut().enumerate() {
            *x += 0.0005 * super::super::scatter(i as u64);
        }
        let found = track(&sound, rate, &PitchOptions::default());
        for offset in [-0.03, 0.0, 0.012, 0.035] {
            let labels: Vec<Landmark> = marks
                .iter()
                .map(|&(secs, kind)| Landmark {
                    secs: secs - offset,
                    kind,
                })
                .collect();
            let lag = lag(&sound, rate, &found, &labels, 0.06);
            assert!(
                lag.is_some_and(|l| (l.secs - offset).abs() < 0.006 && l.found >= 13),
                "{offset}: {lag:?}"
            );
        }
        assert_eq!(lag(&sound, rate, &found, &[], 0.06), None);
    }

    #[test]
    fn the_median_is_the_middle() {
        assert_eq!(median(&mut [3.0, 1.0, 2.0]), 2.0);
        assert_eq!(median(&mut [4.0, 1.0, 2.0, 3.0]), 2.5);
        assert_eq!(median(&mut []), 0.0);
    }
}
