//! Fundamental frequency, after Boersma, "Accurate short-term analysis of the fundamental frequency
//! and the harmonics-to-noise ratio of a sampled sound", Proc. of the Institute of Phonetic
//! Sciences 17 (1993), 97–110.
//!
//! A frame's autocorrelation is divided by that of its window, which makes the height of a peak the
//! periodic share of the audio; the best path through the frames' peaks includes costs for jumps.
//! Constants are the paper's (section 5) or, where it has none, those of the program that its
//! author maintains; each specifies its source.

mod analyser;

use raconteur_base::ops;

use self::analyser::{Analyser, Candidate};
use super::is_rate;

/// Options of the pitch analysis: frequency limits, frame step and costs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PitchOptions {
    /// Minimum frequency, in hertz; a window is three periods of it. Default 60.
    pub min_hz: f64,
    /// Maximum frequency, in hertz. Default 500.
    pub max_hz: f64,
    /// Time between frames, in seconds, at least 0.001. Default 0.01.
    pub step_secs: f64,
    /// A frame whose peak is below this share of the whole sound's peak counts as
    /// silence. Default 0.03.
    pub silence_threshold: f64,
    /// Strength that the aperiodic candidate has, 0..1. Default 0.45.
    pub voicing_threshold: f64,
    /// Preference for the higher of two candidates, per octave. Default 0.01.
    pub octave_cost: f64,
    /// Price of a jump of one octave within 10 ms. Default 0.35.
    pub octave_jump_cost: f64,
    /// Price of going from voiced to unvoiced or back within 10 ms. Default 0.14.
    pub voicing_cost: f64,
}

impl Default for PitchOptions {
    fn default() -> Self {
        Self {
            min_hz: 60.0,
            max_hz: 500.0,
            step_secs: 0.01,
            silence_threshold: 0.03,
            voicing_threshold: 0.45,
            octave_cost: 0.01,
            octave_jump_cost: 0.35,
            voicing_cost: 0.14,
        }
    }
}

/// Fundamental frequency along an audio. Frame `i` is centred at `i * step_secs`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PitchTrack {
    /// Time between frames, in seconds.
    pub step_secs: f64,
    /// Per frame the frequency in hertz, 0 where the sound is unvoiced.
    pub hz: Vec<f64>,
    /// Periodicity of each frame, 0..1: that of the given frequency, or for an unvoiced frame that
    /// of its best candidate.
    pub strength: Vec<f64>,
}

impl PitchTrack {
    /// Returns the frequency at a time, in hertz: interpolated in log frequency between voiced
    /// frames, next to an unvoiced frame that of the nearer frame, 0 if that is unvoiced or beyond
    /// the track.
    #[must_use]
    pub fn hz_at(&self, secs: f64) -> f64 {
        let place = secs / self.step_secs;
        if !place.is_finite() || place < -0.5 {
            return 0.0;
        }
        let place = place.max(0.0);
        let before = place as usize;
        let Some(&low) = self.hz.get(before) else {
            return 0.0;
        };
        let high = self.hz.get(before + 1).copied().unwrap_or(0.0);
        let part = place - before as f64;
        if low > 0.0 && high > 0.0 {
            low * ops::pow(high / low, part)
        } else if part < 0.5 {
            low
        } else {
            high
        }
    }

    /// Returns the frequency at a time, hertz; if it is unvoiced, that of the nearest voiced frame
    /// within `reach_secs`; 0 without one.
    #[must_use]
    pub fn hz_near(&self, secs: f64, reach_secs: f64) -> f64 {
        let here = self.hz_at(secs);
        if here > 0.0 || self.hz.is_empty() || !secs.is_finite() {
            return here;
        }
        let last = self.hz.len() - 1;
        let frame = ((secs / self.step_secs).round().max(0.0) as usize).min(last);
        let reach = ((reach_secs / self.step_secs).max(0.0) as usize).min(last);
        (1..=reach)
            .flat_map(|k| [frame.checked_sub(k), Some(frame + k)])
            .flatten()
            .filter_map(|i| self.hz.get(i).copied())
            .find(|&hz| hz > 0.0)
            .unwrap_or(0.0)
    }

    /// Returns the voiced stretches as frames: first and one past the last.
    #[must_use]
    pub fn voiced_runs(&self) -> Vec<(usize, usize)> {
        let mut runs = Vec::new();
        let mut start = None;
        for (i, &hz) in self.hz.iter().chain([&0.0]).enumerate() {
            match (hz > 0.0, start) {
                (true, None) => start = Some(i),
                (false, Some(first)) => {
                    runs.push((first, i));
                    start = None;
                }
                _ => {}
            }
        }
        runs
    }

    /// Returns the share of voiced frames within a span, 0..1; a span without a frame uses the
    /// frame nearest its middle.
    #[must_use]
    pub fn voiced_share(&self, start_secs: f64, end_secs: f64) -> f64 {
        let first = (start_secs / self.step_secs).ceil().max(0.0) as usize;
        let past = ((end_secs / self.step_secs).floor() + 1.0).max(0.0) as usize;
        let past = past.min(self.hz.len());
        if first >= past {
            return if self.hz_at(0.5 * (start_secs + end_secs)) > 0.0 {
                1.0
            } else {
                0.0
            };
        }
        let voiced = self.hz[first..past].iter().filter(|&&hz| hz > 0.0).count();
        voiced as f64 / (past - first) as f64
    }
}

/// Computes the frequency along a sound. Times before the first and after the last sample count as
/// silence. An empty sound, an unusable rate, or options without a range give a track without
/// frames.
#[must_use]
pub fn track(samples: &[f64], rate_hz: f64, options: &PitchOptions) -> PitchTrack {
    let step_secs = options.step_secs.clamp(0.001, 1.0);
    let none = PitchTrack {
        step_secs,
        ..PitchTrack::default()
    };
    let in_range =
        options.min_hz >= 20.0 && options.max_hz > options.min_hz && options.max_hz.is_finite();
    if samples.is_empty() || !is_rate(rate_hz) || !in_range || !step_secs.is_finite() {
        return none;
    }
    let mean = samples.iter().sum::<f64>() / samples.len() as f64;
    let peak = samples.iter().map(|x| (x - mean).abs()).fold(0.0, f64::max);
    let frames = (samples.len() as f64 / (step_secs * rate_hz)) as usize + 1;
    let mut analyser = Analyser::new(rate_hz, options);
    let candidates: Vec<Vec<Candidate>> = (0..frames)
        .map(|i| {
            let centre = (i as f64 * step_secs * rate_hz).round() as usize;
            analyser.frame(samples, centre, peak)
        })
        .collect();
    let chosen = best_path(&candidates, options, step_secs);
    let mut found = none;
    for (frame, &k) in candidates.iter().zip(&chosen) {
        let best = frame[k];
        found.hz.push(best.hz);
        found.strength.push(if best.hz > 0.0 {
            best.periodic
        } else {
            frame.iter().map(|c| c.periodic).fold(0.0, f64::max)
        });
    }
    found
}

/// Returns the candidates of the cheapest path, one index per frame (the paper's section 3.5, by
/// dynamic programming).
fn best_path(frames: &[Vec<Candidate>], options: &PitchOptions, step_secs: f64) -> Vec<usize> {
    // The paper's costs are for frames 10 ms apart.
    let scale = 0.01 / step_secs;
    let jump = options.octave_jump_cost * scale;
    let voicing = options.voicing_cost * scale;
    let mut from: Vec<Vec<usize>> = Vec::with_capacity(frames.len());
    let mut score: Vec<f64> = Vec::new();
    for (i, frame) in frames.iter().enumerate() {
        let (mut next, mut back) = (Vec::new(), Vec::new());
        for here in frame {
            let mut best = (0, if i == 0 { 0.0 } else { f64::NEG_INFINITY });
            let before = if i == 0 { &[][..] } else { &frames[i - 1][..] };
            for (k, there) in before.iter().enumerate() {
                let cost = match (here.hz > 0.0, there.hz > 0.0) {
                    (true, true) => jump * (here.octaves - there.octaves).abs(),
                    (false, false) => 0.0,
                    _ => voicing,
                };
                if score[k] - cost > best.1 {
                    best = (k, score[k] - cost);
                }
            }
            next.push(best.1 + here.strength);
            back.push(best.0);
        }
        score = next;
        from.push(back);
    }
    let mut path = vec![0; frames.len()];
    let mut at = (0..score.len())
        .max_by(|&a, &b| score[a].total_cmp(&score[b]))
        .unwrap_or(0);
    for i in (0..frames.len()).rev() {
        path[i] = at;
        at = from[i][at];
    }
    path
}

/// Tracks pitch with limits adapted to the voice: a first pass finds the quartiles, a second uses ¾
/// of the lower to 1½ of the upper (De Looze and Hirst, Speech Prosody 2008); wider here, for
/// changed intonation.
#[must_use]
pub fn track_voice(samples: &[f64], rate_hz: f64, step_secs: f64) -> PitchTrack {
    let options = PitchOptions {
        step_secs,
        ..PitchOptions::default()
    };
    let first = track(samples, rate_hz, &options);
    let mut hz: Vec<f64> = first.hz.iter().copied().filter(|hz| *hz > 0.0).collect();
    if hz.len() < 20 {
        return first;
    }
    hz.sort_by(f64::total_cmp);
    let quartile = |share: usize| hz[hz.len() * share / 4];
    let narrowed = PitchOptions {
        min_hz: (0.6 * quartile(1)).max(options.min_hz),
        max_hz: (2.0 * quartile(3)).min(options.max_hz),
        ..options
    };
    track(samples, rate_hz, &narrowed)
}

#[cfg(test)]
mod tests {
    use super::super::testing::{self, Segment};
    use super::*;

    #[test]
    fn a_steady_tone_is_measured_to_a_fifth_of_a_percent() {
        for rate in [8000.0, 16_000.0, 22_050.0, 44_100.0, 48_000.0] {
            for hz in [70.0, 123.4, 217.0, 333.3, 440.0, 491.0] {
                let sound = testing::vowel(rate, 0.5, |_| hz);
                let found = track(&sound, rate, &PitchOptions::default());
                for (i, &f) in found.hz.iter().enumerate().skip(5).take(40) {
                    assert!((f / hz - 1.0).abs() < 0.002, "{rate} {hz}: frame {i} {f}");
                }
            }
        }
    }

    #[test]
    fn glides_in_noise_are_followed_and_voicing_is_told() {
        for (rate, noise) in [(16_000.0, 0.0), (16_000.0, 0.01), (22_050.0, 0.03)] {
            let parts = [
                Segment::silence(0.2),
                Segment::vowel(0.6, 90.0, 160.0),
                Segment::noise(0.2),
                Segment::vowel(0.5, 240.0, 130.0),
                Segment::silence(0.15),
                Segment::vowel(0.8, 200.0, 400.0),
                Segment::noise(0.25),
            ];
            let (mut sound, hz) = testing::utterance(rate, &parts);
            for (i, x) in sound.iter_mut().enumerate() {
                *x += noise * super::super::scatter(i as u64 + 77);
            }
            let found = track(&sound, rate, &PitchOptions::default());
            let (mut wrong, mut judged, mut worst) = (0, 0, 0.0_f64);
            for (i, &f) in found.hz.iter().enumerate() {
                let truth = |d: f64| hz.hz_at(i as f64 * 0.01 + d);
                // Frames that straddle an edge are neither right nor wrong.
                if (truth(-0.012) > 0.0) != (truth(0.012) > 0.0) {
                    continue;
                }
                judged += 1;
                wrong += usize::from((f > 0.0) != (truth(0.0) > 0.0));
                // During a glide, a window has the mean of its range; at edges, half of it.
                if f > 0.0 && truth(-0.03) > 0.0 && truth(0.03) > 0.0 {
                    worst = worst.max((f / truth(0.0) - 1.0).abs());
                }
            }
            assert!(judged > 200 && wrong * 50 < judged, "{wrong} of {judged}");
            assert!(worst < 0.01, "noise {noise}: {worst}");
        }
    }

    #[test]
    fn what_is_no_sound_has_no_pitch_and_no_panic() {
        let o = PitchOptions::default();
        assert!(
            track(&[], 16_000.0, &o).hz.is_empty(),
            "empty audio has no pitch frames"
        );
        assert!(
            track(&[0.0; 10], f64::NAN, &o).hz.is_empty(),
            "an invalid sample rate has no pitch frames"
        );
        assert_eq!(track(&[0.0; 1600], 16_000.0, &o).hz, vec![0.0; 11]);
        let broken = track(&[f64::NAN; 1600], 16_000.0, &o);
        assert!(
            broken.hz.iter().all(|&hz| hz == 0.0),
            "broken audio has no pitch"
        );
        let noise: Vec<f64> = (0..16_000).map(super::super::scatter).collect();
        let found = track(&noise, 16_000.0, &o);
        let voiced = found.hz.iter().filter(|&&hz| hz > 0.0).count();
        assert!(
            voiced * 50 < found.hz.len(),
            "{voiced} voiced frames of noise"
        );
    }

    #[test]
    fn a_track_is_asked_between_its_frames() {
        let track = PitchTrack {
            step_secs: 0.01,
            hz: vec![0.0, 100.0, 400.0, 0.0, 0.0],
            strength: vec![0.0; 5],
        };
        assert!(
            (track.hz_at(0.015) - 200.0).abs() < 1e-9,
            "the pitch between two frames is interpolated"
        );
        assert_eq!(track.hz_at(0.006), 100.0);
        assert_eq!(track.hz_at(0.026), 0.0);
        assert_eq!(track.hz_near(0.04, 0.03), 400.0);
        assert_eq!(track.hz_near(0.04, 0.01), 0.0);
        assert_eq!(track.voiced_runs(), vec![(1, 3)]);
        assert_eq!(track.voiced_share(0.0, 0.04), 0.4);
        assert_eq!(track.voiced_share(0.014, 0.016), 1.0);
        assert_eq!(track.hz_at(f64::NAN), 0.0);
        assert_eq!(track.hz_at(9.0), 0.0);
    }
}
