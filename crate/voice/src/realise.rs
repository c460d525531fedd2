//! Realisation of a sentence: from styles and emotions to changes of the engine's plain audio. All
//! engines are changed in the same way, so that the same markup has the same effect on all.

use core::f64::consts::LN_2;

use raconteur_base::ops;

use crate::manner::{Manner, manner};
use crate::prosody::{AccentShape, Prosody};
use crate::signal::{Change, PitchTrack, TimeMap, change};
use crate::spoken::{Spoken, SpokenSyllable};
use crate::style::{NO_EMPHASIS, Style};
use raconteur_speech::emotion::EmotionPoint;

/// Changes are functions of time that are known every so often, seconds.
const STEP_SECS: f64 = 0.005;
/// Pitch passes from one word's to the next one's within this time, seconds.
const GLIDE_SECS: f64 = 0.04;
/// The height of an accent over its surroundings, semitones: *designed*, in the middle of
/// the two to six that accents of read speech have.
pub const ACCENT_SEMITONES: f64 = 3.0;
/// Extension of an accent before and after its syllable, seconds. *Designed*.
const ACCENT_MARGIN_SECS: f64 = 0.04;
/// Half the movement of a preferred shape over an accented syllable, semitones. *Designed*.
pub const SHAPE_SEMITONES: f64 = 1.0;
/// Shift of the end of a phrase by a preferred boundary at full power, semitones. *Designed*.
pub const BOUNDARY_SEMITONES: f64 = 6.0;

/// Effect of emphasis: SABLE's level, factor of duration, semitones, decibels. *Designed* around
/// perceived emphasis: a tenth to a quarter longer, two to four semitones higher, some decibels
/// louder. Other levels are interpolated.
pub const EMPHASIS: [(f64, f64, f64, f64); 4] = [
    (0.0, 0.85, -1.0, -3.0),
    (NO_EMPHASIS, 1.0, 0.0, 0.0),
    (1.0, 1.12, 1.5, 1.5),
    (2.0, 1.25, 3.5, 3.0),
];

/// Returns the effect of an emphasis level: factor of duration, semitones, decibels.
#[must_use]
pub fn emphasis(level: f64) -> (f64, f64, f64) {
    let level = level.clamp(0.0, 2.0);
    let above = EMPHASIS.partition_point(|row| row.0 <= level).min(3);
    let (low, high) = (EMPHASIS[above - 1], EMPHASIS[above]);
    let share = (level - low.0) / (high.0 - low.0);
    let mix = |a: f64, b: f64| a + (b - a) * share;
    (mix(low.1, high.1), mix(low.2, high.2), mix(low.3, high.3))
}

/// Neutral pitch and speech rate of the voice in an utterance, the reference for absolute settings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VoiceBaseline {
    /// Mean of the pitch on a musical scale, hertz.
    pub mean_hz: f64,
    /// The base line: the twentieth part of the pitch is lower, hertz.
    pub base_hz: f64,
    /// Distance from the 5th to the 95th percentile of the pitch, hertz.
    pub range_hz: f64,
    /// Words a minute, pauses inside sentences included.
    pub words_a_minute: f64,
}

impl VoiceBaseline {
    /// Measures sentences, each with the pitch of its sound.
    #[must_use]
    pub fn measure<'a>(sentences: impl Iterator<Item = (&'a Spoken, &'a PitchTrack)>) -> Self {
        let (mut hz, mut words, mut secs) = (Vec::new(), 0_usize, 0.0);
        for (spoken, track) in sentences {
            hz.extend(track.hz.iter().copied().filter(|hz| *hz > 0.0));
            let tokens = spoken.segments.iter().filter_map(|s| s.token);
            words += tokens.max().map_or(0, |last| last + 1);
            let voiced =
                |silent: bool| spoken.segments.iter().position(|s| s.is_silent() == silent);
            let first = voiced(false).unwrap_or(0);
            let start = first
                .checked_sub(1)
                .map_or(0.0, |i| spoken.segments[i].end_secs);
            let end = spoken.segments.iter().rfind(|s| !s.is_silent());
            secs += end.map_or(0.0, |s| s.end_secs - start);
        }
        hz.sort_by(f64::total_cmp);
        let at = |share: f64| hz.get((hz.len() as f64 * share) as usize).copied();
        // A whisper has no pitch; any value is valid, because none is changed.
        let (low, high) = (at(0.05).unwrap_or(100.0), at(0.95).unwrap_or(150.0));
        let logs: f64 = hz.iter().map(|hz| ops::ln(*hz)).sum();
        Self {
            mean_hz: if hz.is_empty() {
                120.0
            } else {
                ops::exp(logs / hz.len() as f64)
            },
            base_hz: low,
            range_hz: (high - low).max(1.0),
            words_a_minute: if secs > 0.0 {
                words as f64 / secs * 60.0
            } else {
                180.0
            },
        }
    }
}

/// Delivery of one token.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Delivery {
    duration: f64,
    semitones: f64,
    range: f64,
    /// Factor for pitch below the mean, in addition to the range.
    lower: f64,
    gain: f64,
    prosody: Prosody,
    power: f64,
}

impl Delivery {
    fn resolve(style: &Style, place: EmotionPoint, own: &VoiceBaseline) -> Self {
        let prosody = Prosody::from_point(place);
        let (longer, higher, louder) = emphasis(style.emphasis);
        let base = style.pitch_base.factor_on(own.base_hz);
        let middle = style.pitch_middle.factor_on(own.mean_hz);
        // A base line alone moves the pitch contour with it, as in Festival.
        let moved = if style.pitch_middle.is_default() {
            base
        } else {
            middle
        };
        let lower = if style.pitch_middle.is_default() || style.pitch_base.is_default() {
            1.0
        } else {
            let before = semitones(own.base_hz / own.mean_hz).min(-0.1);
            let after = semitones(own.base_hz * base / (own.mean_hz * middle));
            (after / before).clamp(0.1, 4.0)
        };
        Self {
            duration: longer / (style.rate.factor_on(own.words_a_minute) * prosody.rate),
            semitones: semitones(moved * prosody.pitch) + higher,
            range: style.pitch_range.factor_on(own.range_hz) * prosody.range,
            lower,
            gain: style.volume
                * prosody.volume
                * ops::exp(louder * core::f64::consts::LN_10 / 20.0),
            prosody,
            power: place.power,
        }
    }
}

fn semitones(ratio: f64) -> f64 {
    12.0 * ops::ln(ratio) / LN_2
}

/// Functions of time on a grid of [`STEP_SECS`].
struct Grid {
    duration: Vec<f64>,
    gain: Vec<f64>,
    range: Vec<f64>,
    lower: Vec<f64>,
    semitones: Vec<f64>,
    /// Pitch centres of steepening, semitones from the mean, with the factor.
    slope: Vec<(f64, f64)>,
}

impl Grid {
    fn index(&self, secs: f64) -> usize {
        ((secs / STEP_SECS) as usize).min(self.gain.len() - 1)
    }

    fn between(values: &[f64], secs: f64) -> f64 {
        let place = (secs / STEP_SECS - 0.5).clamp(0.0, (values.len() - 1) as f64);
        let low = place as usize;
        let high = (low + 1).min(values.len() - 1);
        values[low] + (values[high] - values[low]) * (place - low as f64)
    }
}

/// Smooths values with a running mean over [`GLIDE_SECS`].
fn glide(values: &mut Vec<f64>) {
    let half = (GLIDE_SECS / STEP_SECS / 2.0) as usize;
    let mut sums = Vec::with_capacity(values.len() + 1);
    sums.push(0.0);
    for value in values.iter() {
        sums.push(sums[sums.len() - 1] + value);
    }
    let count = values.len();
    *values = (0..count)
        .map(|i| {
            let (from, to) = (i.saturating_sub(half), (i + half + 1).min(count));
            (sums[to] - sums[from]) / (to - from) as f64
        })
        .collect();
}

/// Realises a sentence with its styles and emotions. `track` is the pitch of its audio, `styles`
/// has for each token its style and the emotion's position.
#[must_use]
pub fn realise(
    spoken: &Spoken,
    track: &PitchTrack,
    styles: &[(&Style, EmotionPoint)],
    own: &VoiceBaseline,
) -> Spoken {
    let deliveries: Vec<Delivery> = styles
        .iter()
        .map(|(style, place)| Delivery::resolve(style, *place, own))
        .collect();
    if deliveries.is_empty() || spoken.segments.is_empty() {
        return spoken.clone();
    }
    let grid = grid(spoken, track, &deliveries, own);
    let changed = change(
        &spoken.samples,
        spoken.rate_hz,
        track,
        &Change {
            duration: &|secs| grid.duration[grid.index(secs)],
            pitch: &|secs, hz| {
                let before = semitones(hz / own.mean_hz);
                let (around, slope) = grid.slope[grid.index(secs)];
                let mut after = around + (before - around) * slope;
                if after < 0.0 {
                    after *= Grid::between(&grid.lower, secs);
                }
                after =
                    after * Grid::between(&grid.range, secs) + Grid::between(&grid.semitones, secs);
                if (after - before).abs() < 1e-9 {
                    hz
                } else {
                    own.mean_hz * ops::exp(after / 12.0 * LN_2)
                }
            },
            gain: &|secs| grid.gain[grid.index(secs)],
            rigid: &[],
        },
    );
    let mut out = spoken.clone();
    out.samples = changed.samples;
    retime(&mut out, &changed.times);
    out
}

fn retime(spoken: &mut Spoken, times: &TimeMap) {
    for segment in &mut spoken.segments {
        segment.end_secs = times.after(segment.end_secs);
    }
}

/// Releases of plosives do not grow when a voice slows down; this long before their ends.
const RELEASE_SECS: f64 = 0.015;

/// Returns the length factor of a plosive at a time: all of it applies to the closure. `length` is
/// the plosive's, `left` its remainder, seconds.
fn plosive_factor(factor: f64, length: f64, left: f64) -> f64 {
    let closure = length - RELEASE_SECS;
    if closure < RELEASE_SECS {
        factor
    } else if left <= RELEASE_SECS {
        1.0
    } else {
        ((length * factor - RELEASE_SECS) / closure).max(0.2)
    }
}

/// Returns start and end of a run of segments, seconds from the start of the sentence.
fn span(spoken: &Spoken, first: usize, count: usize) -> (f64, f64) {
    let end = |i: usize| spoken.segments.get(i).map_or(0.0, |s| s.end_secs);
    let start = first.checked_sub(1).map_or(0.0, end);
    (start, end((first + count).max(1) - 1))
}

fn grid(spoken: &Spoken, track: &PitchTrack, deliveries: &[Delivery], own: &VoiceBaseline) -> Grid {
    let length_secs = (spoken.samples.len() as f64 / spoken.rate_hz.max(1.0))
        .max(spoken.segments.last().map_or(0.0, |s| s.end_secs));
    let count = (length_secs / STEP_SECS) as usize + 2;
    let mut grid = Grid {
        duration: Vec::with_capacity(count),
        gain: Vec::with_capacity(count),
        range: Vec::with_capacity(count),
        lower: Vec::with_capacity(count),
        semitones: Vec::with_capacity(count),
        slope: vec![(0.0, 1.0); count],
    };
    // Silence is as the token before it; before the first, as the first.
    let mut token = spoken.segments.iter().find_map(|s| s.token).unwrap_or(0);
    let mut segment = 0;
    for i in 0..count {
        let secs = (i as f64 + 0.5) * STEP_SECS;
        while segment + 1 < spoken.segments.len() && spoken.segments[segment].end_secs <= secs {
            segment += 1;
        }
        let here = &spoken.segments[segment];
        token = here.token.unwrap_or(token);
        let how = &deliveries[token.min(deliveries.len() - 1)];
        grid.duration
            .push(match manner(&spoken.phone_set, &here.symbol) {
                Manner::Vowel | Manner::Sonorant => how.duration * how.prosody.sonorant_duration,
                Manner::Fricative => how.duration * how.prosody.obstruent_duration,
                Manner::Plosive => {
                    let start = segment
                        .checked_sub(1)
                        .map_or(0.0, |i| spoken.segments[i].end_secs);
                    let factor = how.duration * how.prosody.obstruent_duration;
                    plosive_factor(factor, here.end_secs - start, here.end_secs - secs)
                }
                // The assembly of sentences sets the length of pauses.
                Manner::Silence => 1.0,
            });
        grid.gain.push(how.gain);
        grid.range.push(how.range);
        grid.lower.push(how.lower);
        grid.semitones.push(how.semitones);
    }
    glide(&mut grid.range);
    glide(&mut grid.lower);
    glide(&mut grid.semitones);
    phrases(&mut grid, spoken, deliveries);
    accents(&mut grid, spoken, track, deliveries, own);
    grid
}

/// Returns the first and last token of every phrase.
#[must_use]
pub fn phrases_of(spoken: &Spoken, tokens: usize) -> Vec<(usize, usize)> {
    let mut phrases = Vec::new();
    let mut first = 0;
    for (last, _) in &spoken.breaks {
        if (first..tokens).contains(last) {
            phrases.push((first, *last));
            first = last + 1;
        }
    }
    if first < tokens {
        phrases.push((first, tokens - 1));
    }
    phrases
}

/// Returns the time span of a run of tokens.
fn token_span(spoken: &Spoken, first: usize, last: usize) -> Option<(f64, f64)> {
    let of = |s: &crate::spoken::Segment| s.token.is_some_and(|t| (first..=last).contains(&t));
    let from = spoken.segments.iter().position(of)?;
    let to = spoken.segments.iter().rposition(of)?;
    Some(span(spoken, from, to + 1 - from))
}

/// Applies changes along a phrase: the dynamics of pitch and range, and its end.
fn phrases(grid: &mut Grid, spoken: &Spoken, deliveries: &[Delivery]) {
    for (first, last) in phrases_of(spoken, deliveries.len()) {
        let Some((start, end)) = token_span(spoken, first, last) else {
            continue;
        };
        let how = &deliveries[last];
        let (from, to) = (grid.index(start), grid.index(end));
        for i in from..to {
            let along = (i - from) as f64 / (to - from).max(1) as f64 - 0.5;
            grid.semitones[i] += semitones(how.prosody.pitch_dynamics) * along;
            grid.range[i] *= ops::exp(ops::ln(how.prosody.range_dynamics) * along);
        }
        if let Some(high) = how.prosody.ends_high {
            // Over the last syllable, growing towards the end.
            let syllable = spoken.syllables.iter().rfind(|s| {
                let (_, syllable_end) = span(spoken, s.first, s.count);
                syllable_end <= end + 1e-6
            });
            let start = syllable.map_or(end - 0.2, |s| span(spoken, s.first, s.count).0);
            let from = grid.index(start.max(0.0));
            let sign = if high { 1.0 } else { -1.0 };
            for i in from..to {
                let along = (i - from) as f64 / (to - from).max(1) as f64;
                grid.semitones[i] += sign * BOUNDARY_SEMITONES * how.power.abs() / 100.0 * along;
            }
        }
    }
}

/// Returns the weight of an accent's steepness at a position in it, 0 to 1: full except at its
/// edges, where the intonation is farthest from its middle.
#[must_use]
pub fn steepened(place: f64) -> f64 {
    (6.0 * place.min(1.0 - place)).clamp(0.0, 1.0)
}

/// Returns the windows in which accents change the intonation: from slightly before their syllables
/// until slightly after them, at most half way to the next one. `spans` are syllables in order.
#[must_use]
pub fn accent_windows(spans: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let gap = |i: usize| (spans[i + 1].0 - spans[i].1).max(0.0);
    (0..spans.len())
        .map(|i| {
            let margin = |gap: Option<f64>| {
                gap.map_or(ACCENT_MARGIN_SECS, |gap| {
                    (gap / 2.0).min(ACCENT_MARGIN_SECS)
                })
            };
            let before = margin(i.checked_sub(1).map(gap));
            let after = margin((i + 1 < spans.len()).then(|| gap(i)));
            (spans[i].0 - before, spans[i].1 + after)
        })
        .collect()
}

/// Applies changes at pitch accents: their height, steepness and shape.
fn accents(
    grid: &mut Grid,
    spoken: &Spoken,
    track: &PitchTrack,
    deliveries: &[Delivery],
    own: &VoiceBaseline,
) {
    let mut rising = true;
    let accented: Vec<&SpokenSyllable> = spoken
        .syllables
        .iter()
        .filter(|s| !s.accent.is_empty() && s.count > 0)
        .collect();
    let spans: Vec<(f64, f64)> = accented
        .iter()
        .map(|s| span(spoken, s.first, s.count))
        .collect();
    for (syllable, (start, end)) in accented.into_iter().zip(accent_windows(&spans)) {
        let token = spoken.segments.get(syllable.first).and_then(|s| s.token);
        let Some(how) = token.and_then(|t| deliveries.get(t)) else {
            continue;
        };
        let prosody = &how.prosody;
        let (from, to) = (grid.index(start.max(0.0)), grid.index(end));
        let tilt = match prosody.accent_shape {
            None => 0.0,
            Some(AccentShape::Rising) => SHAPE_SEMITONES,
            Some(AccentShape::Falling) => -SHAPE_SEMITONES,
            Some(AccentShape::Alternating) => {
                rising = !rising;
                if rising {
                    -SHAPE_SEMITONES
                } else {
                    SHAPE_SEMITONES
                }
            }
        };
        let around = track.hz_near((start + end) / 2.0, 0.05);
        let centre = if around > 0.0 {
            semitones(around / own.mean_hz)
        } else {
            0.0
        };
        for i in from..to {
            let along = (i - from) as f64 / (to - from).max(1) as f64;
            // Zero at the edges, full in the middle.
            let inside = 0.5 - 0.5 * ops::cos(2.0 * core::f64::consts::PI * along);
            grid.semitones[i] += inside
                * (ACCENT_SEMITONES * (prosody.accent_prominence - 1.0)
                    + tilt * 2.0 * (along - 0.5));
            grid.slope[i] = (
                centre,
                1.0 + (prosody.accent_slope - 1.0) * steepened(along),
            );
        }
    }
}
