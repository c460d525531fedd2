//! Effects of markup on a voice: the same words spoken plainly and with markup, compared phone by
//! phone in the final audio.

use core::f64::consts::{LN_2, LN_10};

use raconteur_base::ops;

use crate::assemble::Speech;
use crate::manner::{Manner, manner};
use crate::realise::{accent_windows, steepened};
use crate::signal::f0::{self, PitchTrack};
use crate::signal::intensity::span_db;
use raconteur_speech::bundle::{FRAME_SECS, Phone, Syllable, Utterance};

/// Acoustic difference between an audio and its neutral version. Only words with an index in the
/// requested span are compared.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Difference {
    /// Factor on the time from the begin of the first word to the end of the last.
    pub duration: f64,
    /// Factor on the length of vowels, nasals, liquids and glides.
    pub sonorant_duration: f64,
    /// Factor on the length of plosives and fricatives.
    pub obstruent_duration: f64,
    /// Difference of the mean pitch, semitones.
    pub semitones: f64,
    /// Difference of the level, decibels.
    pub db: f64,
    /// Factor on the length of pauses between words that are there in both.
    pub pause_duration: f64,
    /// Pauses inside sentences, before and after.
    pub pauses: (usize, usize),
    /// Difference of the intonation; `None` if too little is voiced.
    pub melody: Option<Melody>,
}

/// Components of an intonation difference, each adjusted for the others.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Melody {
    /// Difference of pitch, semitones.
    pub semitones: f64,
    /// Factor on the range of the pitch around its mean.
    pub range: f64,
    /// Additional rise from the start of a phrase to its end, semitones.
    pub rise: f64,
    /// Factor by which the range grows from the begin of a phrase to its end.
    pub range_growth: f64,
    /// Additional pitch in the middle of accented syllables, semitones.
    pub accent: f64,
    /// Factor on the steepness in accented syllables.
    pub accent_slope: f64,
    /// Additional rise of accented syllables over their middle part, semitones.
    pub accent_tilt: f64,
    /// Additional rise of every other accented syllable, with a reduced rise of those between.
    pub accent_alternation: f64,
    /// Additional pitch at the end of phrases, semitones.
    pub end: f64,
}

/// Time at which both are voiced.
struct Point {
    /// Semitones over 100 Hz, plain and changed.
    plain: f64,
    changed: f64,
    /// Position in its phrase, −0.5 to 0.5.
    along: f64,
    /// Position in an accent, if any.
    accent: Option<InAccent>,
    /// Position in the last syllable of its phrase, 0 to 1; 0 before it.
    ending: f64,
}

/// Position in the window of an accent.
#[derive(Clone, Copy)]
struct InAccent {
    /// Index of the accent in its sentence.
    index: usize,
    /// Position within the window of the accent, 0 to 1.
    place: f64,
    /// The pitch in the middle, semitones over 100 Hz.
    centre: f64,
}

/// Compares the words from `first` to `last`. Returns `None` if the two do not have the same
/// phones, or if nothing is voiced.
#[must_use]
pub fn compare(
    plain: &Speech,
    changed: &Speech,
    phone_set: &str,
    first: usize,
    last: usize,
) -> Option<Difference> {
    let pairs = pairs(&plain.utterance, &changed.utterance, first, last)?;
    let tracks = [plain, changed].map(pitch);
    let mut lengths = [[0.0; 2]; 2];
    let (mut db, mut weight) = (0.0, 0.0);
    let mut points = Vec::new();
    for (a, b) in &pairs {
        let kind = manner(phone_set, &a.symbol);
        let class = match kind {
            Manner::Vowel | Manner::Sonorant => 0,
            Manner::Plosive | Manner::Fricative => 1,
            Manner::Silence => continue,
        };
        let secs = a.end_secs - a.start_secs;
        lengths[class][0] += secs;
        lengths[class][1] += b.end_secs - b.start_secs;
        if class == 0 {
            points_of(&plain.utterance, a, b, &tracks, &mut points);
        }
        if kind == Manner::Vowel {
            // Weighted by duration, so that a stretched vowel keeps its weight.
            db += secs * (level(changed, b) - level(plain, a));
            weight += secs;
        }
    }
    if points.is_empty() {
        return None;
    }
    let words = |u: &Utterance| u.words[last].end_secs - u.words[first].start_secs;
    let pauses = [&plain.utterance, &changed.utterance].map(|u| pauses(u, first, last));
    let both = pauses[0]
        .iter()
        .filter_map(|(w, a)| Some((a, &pauses[1].iter().find(|(v, _)| v == w)?.1)));
    let (before, after) = both.fold((0.0, 0.0), |sum, (a, b)| (sum.0 + a, sum.1 + b));
    let higher: f64 = points.iter().map(|p| p.changed - p.plain).sum();
    Some(Difference {
        duration: words(&changed.utterance) / words(&plain.utterance),
        sonorant_duration: lengths[0][1] / lengths[0][0].max(1e-9),
        obstruent_duration: lengths[1][1] / lengths[1][0].max(1e-9),
        semitones: higher / points.len() as f64,
        db: db / f64::max(weight, 1e-9),
        pause_duration: after / f64::max(before, 1e-9),
        pauses: (
            inside(&plain.utterance, &pauses[0]),
            inside(&changed.utterance, &pauses[1]),
        ),
        melody: melody(&points),
    })
}

/// Fits a model of the changed pitch by iterated least squares: the range bends the other
/// components, and errors above three semitones (octave jumps) are excluded after the first fit.
fn melody(points: &[Point]) -> Option<Melody> {
    const PARTS: usize = 9;
    let mean = points.iter().map(|p| p.plain).sum::<f64>() / points.len().max(1) as f64;
    let row = |p: &Point, growth: f64| -> [f64; PARTS] {
        let bend = ops::exp(growth * p.along);
        let plain = (p.plain - mean) * bend;
        let (inside, slope, tilt, other_way) = p.accent.map_or((0.0, 0.0, 0.0, 0.0), |accent| {
            let inside = 0.5 - 0.5 * ops::cos(2.0 * core::f64::consts::PI * accent.place);
            let tilt = inside * 2.0 * (accent.place - 0.5);
            let sign = if accent.index % 2 == 0 { 1.0 } else { -1.0 };
            let steep = steepened(accent.place) * (p.plain - accent.centre) * bend;
            (inside, steep, tilt, sign * tilt)
        });
        [
            1.0,
            plain,
            p.along,
            plain * p.along,
            inside,
            slope,
            tilt,
            other_way,
            p.ending,
        ]
    };
    let mut kept: Vec<&Point> = points.iter().collect();
    let (mut fit, mut growth) = ([0.0; PARTS], 0.0_f64);
    for _ in 0..5 {
        if kept.len() < 5 * PARTS {
            return None;
        }
        let mut matrix = [[0.0; PARTS + 1]; PARTS];
        for p in &kept {
            let row = row(p, growth);
            for i in 0..PARTS {
                for k in 0..PARTS {
                    matrix[i][k] += row[i] * row[k];
                }
                matrix[i][PARTS] += row[i] * (p.changed - mean);
            }
        }
        fit = solve(matrix);
        let error = |p: &Point| {
            let model: f64 = row(p, growth).iter().zip(&fit).map(|(x, c)| x * c).sum();
            (p.changed - mean - model).abs()
        };
        kept.retain(|p| error(p) < 3.0);
        growth = (growth + fit[3] / fit[1].max(1e-3)).clamp(-2.0, 2.0);
    }
    let range = fit[1].max(1e-3);
    Some(Melody {
        semitones: fit[0],
        range,
        rise: fit[2],
        range_growth: ops::exp(growth),
        accent: fit[4],
        accent_slope: 1.0 + fit[5] / range,
        accent_tilt: fit[6],
        accent_alternation: fit[7],
        end: fit[8],
    })
}

/// Solves a symmetric system by elimination; undetermined components are 0.
fn solve<const N: usize, const M: usize>(mut matrix: [[f64; M]; N]) -> [f64; N] {
    let scale: [f64; N] = core::array::from_fn(|i| matrix[i][i].abs());
    for pivot in 0..N {
        if matrix[pivot][pivot].abs() <= 1e-9 * scale[pivot].max(1.0) {
            matrix[pivot] = [0.0; M];
            continue;
        }
        let row = matrix[pivot];
        for (i, other) in matrix.iter_mut().enumerate() {
            if i != pivot {
                let factor = other[pivot] / row[pivot];
                for (x, y) in other.iter_mut().zip(&row) {
                    *x -= factor * y;
                }
            }
        }
    }
    core::array::from_fn(|i| {
        if matrix[i][i] == 0.0 {
            0.0
        } else {
            matrix[i][N] / matrix[i][i]
        }
    })
}

fn pitch(speech: &Speech) -> PitchTrack {
    f0::track_voice(&speech.samples, speech.rate_hz, FRAME_SECS / 2.0)
}

fn level(track: &Speech, phone: &Phone) -> f64 {
    span_db(
        &track.samples,
        track.rate_hz,
        phone.start_secs,
        phone.end_secs,
    )
}

/// Phones of both that belong together.
fn pairs<'a>(
    plain: &'a Utterance,
    changed: &'a Utterance,
    first: usize,
    last: usize,
) -> Option<Vec<(&'a Phone, &'a Phone)>> {
    let of = |u: &'a Utterance| {
        let inside = |p: &Phone| p.word.is_some_and(|w| (first..=last).contains(&w));
        u.phones.iter().filter(|p| inside(p)).collect::<Vec<_>>()
    };
    let (a, b) = (of(plain), of(changed));
    let same = a.len() == b.len() && a.iter().zip(&b).all(|(x, y)| x.symbol == y.symbol);
    (same && last < plain.words.len() && last < changed.words.len())
        .then(|| a.into_iter().zip(b).collect())
}

/// Points of a phone, where both are voiced.
fn points_of(
    plain: &Utterance,
    a: &Phone,
    b: &Phone,
    tracks: &[PitchTrack; 2],
    points: &mut Vec<Point>,
) {
    let word = a.word.unwrap_or(0);
    let phrase = plain
        .phrases
        .iter()
        .find(|p| (p.first_word..p.first_word + p.words).contains(&word));
    let words = phrase.and_then(|p| plain.words.get(p.first_word..p.first_word + p.words));
    let (from, to) = words
        .and_then(|w| Some((w.first()?.start_secs, w.last()?.end_secs)))
        .unwrap_or((a.start_secs, a.end_secs));
    let span = |s: &Syllable| {
        let phones = &plain.phones[s.first_phone..s.first_phone + s.phones];
        (phones[0].start_secs, phones[phones.len() - 1].end_secs)
    };
    let spans: Vec<(f64, f64)> = plain
        .accents
        .iter()
        .filter_map(|accent| plain.syllables.get(accent.syllable))
        .map(span)
        .collect();
    let accents = accent_windows(&spans);
    let sentence = plain
        .sentences
        .iter()
        .find(|s| (s.first_word..s.first_word + s.words).contains(&word));
    let begins_secs = sentence
        .and_then(|s| plain.words.get(s.first_word))
        .map_or(0.0, |w| w.start_secs);
    let first_accent = spans.partition_point(|(start, _)| *start < begins_secs - 1e-6);
    let last = plain
        .syllables
        .iter()
        .map(span)
        .rfind(|(_, end)| *end <= to + 1e-6);
    for share in [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9] {
        let at = |p: &Phone| p.start_secs + share * (p.end_secs - p.start_secs);
        let [before, after] = [tracks[0].hz_at(at(a)), tracks[1].hz_at(at(b))];
        if before <= 0.0 || after <= 0.0 {
            continue;
        }
        let semitones = |hz: f64| 12.0 * ops::ln(hz / 100.0) / LN_2;
        let place = |(start, end): (f64, f64)| (at(a) - start) / f64::max(end - start, 1e-9);
        points.push(Point {
            plain: semitones(before),
            changed: semitones(after),
            along: place((from, to)) - 0.5,
            accent: accents
                .iter()
                .position(|span| (0.0..1.0).contains(&place(*span)))
                .map(|index| {
                    let span = accents[index];
                    let centre = tracks[0].hz_near((span.0 + span.1) / 2.0, 0.05);
                    let centre = if centre > 0.0 { centre } else { before };
                    InAccent {
                        index: index - first_accent.min(index),
                        place: place(span),
                        centre: semitones(centre),
                    }
                }),
            ending: last.map_or(0.0, |span| place(span).clamp(0.0, 1.0)),
        });
    }
}

/// Pauses between words: the word before and the length, seconds.
fn pauses(u: &Utterance, first: usize, last: usize) -> Vec<(usize, f64)> {
    (first..last)
        .filter_map(|word| {
            let secs = u.words[word + 1].start_secs - u.words[word].end_secs;
            (secs > 0.02).then_some((word, secs))
        })
        .collect()
}

/// Returns the number of pauses inside sentences.
fn inside(u: &Utterance, pauses: &[(usize, f64)]) -> usize {
    let ends = |word: usize| u.sentences.iter().any(|s| s.first_word == word + 1);
    pauses.iter().filter(|(word, _)| !ends(*word)).count()
}

/// Converts decibels to a factor of amplitude.
#[must_use]
pub fn amplitude(db: f64) -> f64 {
    ops::exp(db / 20.0 * LN_10)
}

/// Converts semitones to a factor of frequency.
#[must_use]
pub fn frequency(semitones: f64) -> f64 {
    ops::exp(semitones / 12.0 * LN_2)
}
