//! Emphasis: an emphasised word is longer, higher and louder; a reduced one the reverse.
//!
//! Festival's HTS voices take an accent (see `scheme`) but no duration or pitch for one
//! word, so the finished sound is changed: waveform-similarity overlap-add (WSOLA,
//! Verhelst and Roelands 1993, doi:10.1109/ICASSP.1993.319366) makes the word longer,
//! resampling makes it higher. The times of the phones follow the sound exactly, through
//! the places that overlap-add chose.

use super::festival::Spoken;
use super::plan::Sentence;

/// Lengthening for each level of emphasis above plain, as a ratio. *Designed*, within the
/// 10 to 20 per cent that emphasis adds to words in read speech.
const STRETCH_PER_LEVEL: f64 = 0.24;

/// Rise in semitones for each level. *Designed*: more would make the voice small, because
/// resampling moves the formants as well.
const SEMITONES_PER_LEVEL: f64 = 1.6;

/// Gain in decibels for each level. *Designed*.
const DECIBELS_PER_LEVEL: f64 = 3.0;

/// Time over which a change comes in and goes out, seconds.
const RAMP_SECS: f64 = 0.04;

/// Overlap-add: half a window, seconds; long enough for two periods of a deep voice.
const HOP_SECS: f64 = 0.012;

/// Overlap-add: how far a window may move to find its like, seconds; one period.
const SEARCH_SECS: f64 = 0.006;

/// A stretch of a sentence with one level.
struct Stress {
    start_secs: f64,
    end_secs: f64,
    /// Level above plain, -1 to 1.
    level: f64,
}

impl Stress {
    /// 0 outside, 1 inside, with soft ends inside the span.
    fn weight(&self, at_secs: f64) -> f64 {
        let ramp_secs = RAMP_SECS
            .min((self.end_secs - self.start_secs) / 2.0)
            .max(1e-6);
        let inside_secs = (at_secs - self.start_secs).min(self.end_secs - at_secs);
        let x = (inside_secs / ramp_secs).clamp(0.0, 1.0);
        x * x * (3.0 - 2.0 * x)
    }
}

/// Applies the emphasis of a sentence's tokens to its sound and times.
pub(crate) fn apply(sentence: &Sentence, spoken: Spoken) -> Spoken {
    let stresses = stresses(sentence, &spoken);
    if stresses.is_empty() {
        return spoken;
    }
    let rate = f64::from(spoken.rate_hz);
    let level = |at_secs: f64| {
        stresses
            .iter()
            .map(|s| s.level * s.weight(at_secs))
            .sum::<f64>()
    };
    let loud: Vec<f64> = spoken
        .samples
        .iter()
        .enumerate()
        .map(|(i, s)| s * decibels(DECIBELS_PER_LEVEL * level(i as f64 / rate)))
        .collect();
    let stretch = |at_secs: f64| 1.0 + STRETCH_PER_LEVEL * level(at_secs);
    let pitch = |at_secs: f64| libm::exp2(SEMITONES_PER_LEVEL * level(at_secs) / 12.0);
    // Overlap-add makes it longer by both, so that reading it faster leaves the stretch.
    let (long, anchors) = overlap_add(&loud, rate, &|t| stretch(t) * pitch(t));
    let (samples, times) = resample(&long, rate, &|at_secs| {
        pitch(interpolate(&anchors, at_secs, Side::Output))
    });
    let segments = spoken
        .segments
        .into_iter()
        .map(|mut s| {
            let long_secs = interpolate(&anchors, s.end_secs, Side::Input);
            s.end_secs = interpolate(&times, long_secs, Side::Input);
            s
        })
        .collect();
    Spoken {
        samples,
        rate_hz: spoken.rate_hz,
        segments,
    }
}

fn decibels(level: f64) -> f64 {
    libm::exp(level * core::f64::consts::LN_10 / 20.0)
}

/// Where the emphasised words lie; neighbours with the same level are one stretch.
fn stresses(sentence: &Sentence, spoken: &Spoken) -> Vec<Stress> {
    let mut out: Vec<Stress> = Vec::new();
    let mut start_secs = 0.0;
    for segment in &spoken.segments {
        let level = segment
            .word
            .and_then(|w| {
                sentence
                    .tokens
                    .get(sentence.tokens.partition_point(|t| t.word < w))
            })
            .map_or(0.0, |t| (t.emphasis - 1.0).clamp(-1.0, 1.0));
        if level != 0.0 {
            match out.last_mut() {
                Some(last) if last.end_secs == start_secs && last.level == level => {
                    last.end_secs = segment.end_secs;
                }
                _ => out.push(Stress {
                    start_secs,
                    end_secs: segment.end_secs,
                    level,
                }),
            }
        }
        start_secs = segment.end_secs;
    }
    out
}

/// A time before and after a change, seconds; both grow.
#[derive(Clone, Copy)]
struct Anchor {
    input_secs: f64,
    output_secs: f64,
}

#[derive(Clone, Copy)]
enum Side {
    Input,
    Output,
}

/// The time on the other side of `secs`, by linear interpolation.
fn interpolate(anchors: &[Anchor], secs: f64, from: Side) -> f64 {
    let pair = |a: &Anchor| match from {
        Side::Input => (a.input_secs, a.output_secs),
        Side::Output => (a.output_secs, a.input_secs),
    };
    let after = anchors.partition_point(|a| pair(a).0 <= secs);
    let (Some(before), next) = (
        after.checked_sub(1).map(|i| pair(&anchors[i])),
        anchors.get(after),
    ) else {
        return anchors.first().map_or(secs, |a| pair(a).1);
    };
    match next.map(pair) {
        Some(next) if next.0 > before.0 => {
            before.1 + (next.1 - before.1) * (secs - before.0) / (next.0 - before.0)
        }
        _ => before.1 + (secs - before.0),
    }
}

/// Lengthens `input` by `factor` of the time in it, keeping its pitch.
fn overlap_add(input: &[f64], rate: f64, factor: &dyn Fn(f64) -> f64) -> (Vec<f64>, Vec<Anchor>) {
    let hop = (HOP_SECS * rate) as usize;
    let search = (SEARCH_SECS * rate) as usize;
    let window: Vec<f64> = (0..2 * hop)
        .map(|i| 0.5 - 0.5 * libm::cos(core::f64::consts::PI * i as f64 / hop as f64))
        .collect();
    let at = |i: usize| input.get(i).copied().unwrap_or(0.0);
    // Sample `i` of the window around `middle`.
    let sample = |middle: usize, i: usize| (middle + i).checked_sub(hop).map_or(0.0, at);
    // The first window stands half before the start: its second half begins the sound.
    let mut output: Vec<f64> = (0..hop).map(|i| at(i) * window[hop + i]).collect();
    let mut anchors = vec![Anchor {
        input_secs: 0.0,
        output_secs: 0.0,
    }];
    // Middle of the last window in the input, and where the middle of the next should be.
    let (mut last, mut wanted) = (0_usize, 0.0);
    let mut middle_out = 0;
    while last < input.len() {
        wanted += hop as f64 / factor(wanted / rate).max(0.1);
        middle_out += hop;
        // What would follow the last window in the input is what sounds right after it.
        let natural = last + hop;
        let middle = if (wanted - natural as f64).abs() < 1.0 {
            natural
        } else {
            let centre = wanted as usize;
            (centre.saturating_sub(search).max(last + 1)..=centre + search)
                .map(|m| {
                    let (mut likeness, mut power) = (0.0, 1e-9);
                    for i in (0..2 * hop).step_by(2) {
                        likeness += sample(m, i) * sample(natural, i);
                        power += sample(m, i) * sample(m, i);
                    }
                    (likeness / f64::sqrt(power), m)
                })
                .fold((f64::NEG_INFINITY, natural), |best, c| {
                    if c.0 > best.0 { c } else { best }
                })
                .1
        };
        output.resize(middle_out + hop, 0.0);
        for (i, w) in window.iter().enumerate() {
            output[middle_out - hop + i] += w * sample(middle, i);
        }
        anchors.push(Anchor {
            input_secs: middle as f64 / rate,
            output_secs: middle_out as f64 / rate,
        });
        last = middle;
    }
    let end_secs = interpolate(&anchors, input.len() as f64 / rate, Side::Input);
    output.truncate((end_secs * rate) as usize);
    (output, anchors)
}

/// Reads `input` at a speed that depends on the time in it, and so changes pitch and length.
fn resample(input: &[f64], rate: f64, speed: &dyn Fn(f64) -> f64) -> (Vec<f64>, Vec<Anchor>) {
    let at = |i: isize| {
        usize::try_from(i)
            .ok()
            .and_then(|i| input.get(i))
            .copied()
            .unwrap_or(0.0)
    };
    let mut output = Vec::with_capacity(input.len());
    let mut anchors = Vec::new();
    let mut position = 0.0;
    while position < input.len() as f64 {
        if output.len() % 32 == 0 {
            anchors.push(Anchor {
                input_secs: position / rate,
                output_secs: output.len() as f64 / rate,
            });
        }
        // Catmull-Rom through the four samples around the place.
        let i = position as isize;
        let x = position - i as f64;
        let (a, b, c, d) = (at(i - 1), at(i), at(i + 1), at(i + 2));
        let cubic = b + 0.5
            * x
            * (c - a + x * (2.0 * a - 5.0 * b + 4.0 * c - d + x * (3.0 * (b - c) + d - a)));
        output.push(cubic);
        position += speed(position / rate);
    }
    (output, anchors)
}

#[cfg(test)]
mod tests {
    use super::super::festival::Segment;
    use super::super::plan::Token;
    use super::*;

    const RATE: f64 = 16_000.0;

    /// Three words of 0.3 s on a tone of 200 Hz; the second has this emphasis.
    fn tone(emphasis: f64) -> (Sentence, Spoken) {
        let token = |word, emphasis| Token {
            word,
            text: "la".to_owned(),
            punctuation: String::new(),
            emphasis,
            pause_secs: None,
        };
        let sentence = Sentence {
            tokens: vec![token(0, 1.0), token(1, emphasis), token(2, 1.0)],
        };
        let samples = (0..14_400)
            .map(|i| 0.3 * libm::sin(core::f64::consts::TAU * 200.0 * f64::from(i) / RATE))
            .collect();
        let segment = |w: usize| Segment {
            symbol: "aa".to_owned(),
            end_secs: 0.3 * (w + 1) as f64,
            word: Some(w),
        };
        (
            sentence,
            Spoken {
                samples,
                rate_hz: 16_000,
                segments: (0..3).map(segment).collect(),
            },
        )
    }

    /// Frequency between two times, from its upward zero crossings.
    fn hertz(spoken: &Spoken, from_secs: f64, to_secs: f64) -> f64 {
        let cut = &spoken.samples[(from_secs * RATE) as usize..(to_secs * RATE) as usize];
        let crossings: Vec<f64> = cut
            .windows(2)
            .enumerate()
            .filter(|(_, w)| w[0] < 0.0 && w[1] >= 0.0)
            .map(|(i, w)| i as f64 - w[0] / (w[1] - w[0]))
            .collect();
        (crossings.len() - 1) as f64 * RATE / (crossings[crossings.len() - 1] - crossings[0])
    }

    #[test]
    fn plain_words_are_left_as_they_are() {
        let (sentence, spoken) = tone(1.0);
        assert_eq!(apply(&sentence, spoken.clone()), spoken);
    }

    #[test]
    fn a_stressed_word_is_longer_higher_and_louder_and_the_others_are_not() {
        for level in [0.5, 1.0, -0.5] {
            let (sentence, spoken) = tone(1.0 + level);
            let out = apply(&sentence, spoken);
            let ends: Vec<f64> = out.segments.iter().map(|s| s.end_secs).collect();
            let lengths = [ends[0], ends[1] - ends[0], ends[2] - ends[1]];
            // Windows may be a search width and half a hop off where a change ends.
            let slack_secs = SEARCH_SECS + HOP_SECS / 2.0;
            assert!(
                (lengths[0] - 0.3).abs() < slack_secs && (lengths[2] - 0.3).abs() < slack_secs,
                "{lengths:?}"
            );
            // The soft ends of the change take a little of it away.
            let gain = lengths[1] / 0.3 - 1.0;
            let full = STRETCH_PER_LEVEL * level;
            assert!(gain / full > 0.7 && gain / full < 1.1, "{gain} of {full}");
            assert!((out.samples.len() as f64 / RATE - ends[2]).abs() < 0.002);
            assert!((hertz(&out, 0.05, 0.25) - 200.0).abs() < 2.0);
            assert!((hertz(&out, ends[1] + 0.05, ends[2] - 0.05) - 200.0).abs() < 2.0);
            let high = hertz(&out, ends[0] + 0.08, ends[1] - 0.08);
            let expected = 200.0 * libm::exp2(SEMITONES_PER_LEVEL * level / 12.0);
            assert!((high - expected).abs() < 3.0, "{high} for {expected}");
            let peak = |a: f64, b: f64| {
                out.samples[(a * RATE) as usize..(b * RATE) as usize]
                    .iter()
                    .fold(0.0, |m: f64, s| m.max(s.abs()))
            };
            let louder = peak(ends[0] + 0.08, ends[1] - 0.08) / peak(0.05, 0.25);
            assert!(
                (louder / decibels(DECIBELS_PER_LEVEL * level) - 1.0).abs() < 0.03,
                "{louder}"
            );
        }
    }

    #[test]
    fn a_click_stays_on_its_phone_boundary() {
        let (sentence, mut spoken) = tone(1.5);
        for s in &mut spoken.samples {
            *s *= 0.01;
        }
        // The third word begins with a burst, as a plosive would.
        for i in 9_600..9_616 {
            spoken.samples[i] = 0.9;
        }
        let out = apply(&sentence, spoken);
        let loudest = (0..out.samples.len())
            .max_by(|a, b| out.samples[*a].abs().total_cmp(&out.samples[*b].abs()));
        let at_secs = loudest.unwrap() as f64 / RATE;
        assert!(
            (at_secs - out.segments[1].end_secs).abs() < 0.004,
            "{at_secs} {:?}",
            out.segments
        );
    }
}
