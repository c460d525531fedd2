//! What markup did to a voice: the same words spoken plainly and otherwise, compared phone by
//! phone in the final sound.

use core::f64::consts::{LN_2, LN_10};

use raconteur_base::ops;

use crate::assemble::Track;
use crate::bundle::{FRAME_SECS, Phone, Utterance};
use crate::manner::{Manner, manner};
use crate::signal::f0::{self, PitchOptions, PitchTrack};
use crate::signal::intensity::span_db;

/// How a sound differs from the plain one. Only words with an index in the span that was
/// asked for are compared.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Difference {
    /// Factor on the time from the begin of the first word to the end of the last.
    pub duration: f64,
    /// Factor on the length of vowels, nasals, liquids and glides.
    pub sonorant_duration: f64,
    /// Factor on the length of plosives and fricatives.
    pub obstruent_duration: f64,
    /// How much higher it is, semitones, on the mean.
    pub semitones: f64,
    /// Factor on the range of the pitch around its mean.
    pub range: f64,
    /// How much more it rises, from the begin of a phrase to its end, semitones.
    pub rise: f64,
    /// Factor by which the range grows from the begin of a phrase to its end.
    pub range_growth: f64,
    /// How much higher accented syllables are, over what all are, semitones.
    pub accent: f64,
    /// How much louder it is, decibels.
    pub db: f64,
    /// Factor on the length of pauses between words that are there in both.
    pub pause_duration: f64,
    /// Pauses between words, before and after.
    pub pauses: (usize, usize),
}

/// A place where both can be heard: a point of a vowel.
struct Point {
    /// Semitones over 100 Hz, plain and changed.
    plain: f64,
    changed: f64,
    /// Place in its phrase, −0.5 to 0.5.
    along: f64,
    accented: bool,
}

/// Compares the words from `first` to `last`. `None` when the two do not have the same
/// phones, or nothing is voiced.
#[must_use]
pub fn compare(
    plain: &Track,
    changed: &Track,
    phone_set: &str,
    first: usize,
    last: usize,
) -> Option<Difference> {
    let pairs = pairs(&plain.utterance, &changed.utterance, first, last)?;
    let tracks = [plain, changed].map(pitch);
    let (mut lengths, mut levels) = ([[0.0; 2]; 2], [0.0; 2]);
    let mut points = Vec::new();
    for (i, a, b) in &pairs {
        let class = match manner(phone_set, &a.symbol) {
            Manner::Vowel | Manner::Sonorant => 0,
            Manner::Plosive | Manner::Fricative => 1,
            Manner::Silence => continue,
        };
        lengths[class][0] += a.end_secs - a.start_secs;
        lengths[class][1] += b.end_secs - b.start_secs;
        if manner(phone_set, &a.symbol) == Manner::Vowel {
            // By length, so that a stretched vowel counts as it did.
            let weight = a.end_secs - a.start_secs;
            levels[0] += weight * level(plain, a);
            levels[1] += weight * level(changed, b);
            points.extend(points_of(&plain.utterance, *i, a, b, &tracks));
        }
    }
    if points.len() < 3 {
        return None;
    }
    let words = |u: &Utterance| u.words[last].end_secs - u.words[first].start_secs;
    let weight: f64 = pairs
        .iter()
        .filter(|(_, a, _)| manner(phone_set, &a.symbol) == Manner::Vowel)
        .map(|(_, a, _)| a.end_secs - a.start_secs)
        .sum();
    let mean = |f: &dyn Fn(&Point) -> f64, of: &dyn Fn(&Point) -> bool| {
        let kept: Vec<f64> = points.iter().filter(|p| of(p)).map(f).collect();
        kept.iter().sum::<f64>() / kept.len().max(1) as f64
    };
    let all = |_: &Point| true;
    let [plain_mean, changed_mean] = [mean(&|p| p.plain, &all), mean(&|p| p.changed, &all)];
    // Lines through the points: what is asked against what is there.
    let moved = |p: &Point| p.changed - changed_mean - (p.plain - plain_mean);
    let rise = line(points.iter().map(|p| (p.along, moved(p))));
    let spread = |of: &dyn Fn(&Point) -> bool, f: &dyn Fn(&Point) -> f64| {
        let centre = mean(f, of);
        mean(&|p| (f(p) - centre) * (f(p) - centre), of).sqrt()
    };
    let growth = |of: &dyn Fn(&Point) -> bool| {
        spread(of, &|p| p.changed) / spread(of, &|p| p.plain).max(1e-9)
    };
    let pauses = [&plain.utterance, &changed.utterance].map(|u| pauses(u, first, last));
    let both = pauses[0]
        .iter()
        .filter_map(|(w, a)| Some((a, &pauses[1].iter().find(|(v, _)| v == w)?.1)));
    let (before, after) = both.fold((0.0, 0.0), |sum, (a, b)| (sum.0 + a, sum.1 + b));
    Some(Difference {
        duration: words(&changed.utterance) / words(&plain.utterance),
        sonorant_duration: lengths[0][1] / lengths[0][0].max(1e-9),
        obstruent_duration: lengths[1][1] / lengths[1][0].max(1e-9),
        semitones: changed_mean - plain_mean,
        range: line(points.iter().map(|p| (p.plain, p.changed))),
        rise,
        range_growth: growth(&|p| p.along > 0.0) / growth(&|p| p.along <= 0.0).max(1e-9),
        accent: mean(&moved, &|p| p.accented) - mean(&moved, &|p| !p.accented),
        db: (levels[1] - levels[0]) / weight.max(1e-9),
        pause_duration: after / f64::max(before, 1e-9),
        pauses: (pauses[0].len(), pauses[1].len()),
    })
}

fn pitch(track: &Track) -> PitchTrack {
    let options = PitchOptions {
        step_secs: FRAME_SECS / 2.0,
        ..PitchOptions::default()
    };
    f0::track(&track.samples, track.rate_hz, &options)
}

fn level(track: &Track, phone: &Phone) -> f64 {
    span_db(
        &track.samples,
        track.rate_hz,
        phone.start_secs,
        phone.end_secs,
    )
}

/// Phones of both that belong together, with the index in the plain one.
fn pairs<'a>(
    plain: &'a Utterance,
    changed: &'a Utterance,
    first: usize,
    last: usize,
) -> Option<Vec<(usize, &'a Phone, &'a Phone)>> {
    let of = |u: &'a Utterance| {
        let inside = |p: &Phone| p.word.is_some_and(|w| (first..=last).contains(&w));
        let phones = u.phones.iter().enumerate();
        phones.filter(move |(_, p)| inside(p)).collect::<Vec<_>>()
    };
    let (a, b) = (of(plain), of(changed));
    let same = a.len() == b.len() && a.iter().zip(&b).all(|(x, y)| x.1.symbol == y.1.symbol);
    (same && last < plain.words.len() && last < changed.words.len())
        .then(|| a.iter().zip(&b).map(|(x, y)| (x.0, x.1, y.1)).collect())
}

/// Three points of a vowel, where both are voiced.
fn points_of(
    plain: &Utterance,
    index: usize,
    a: &Phone,
    b: &Phone,
    tracks: &[PitchTrack; 2],
) -> Vec<Point> {
    let word = a.word.unwrap_or(0);
    let phrase = plain
        .phrases
        .iter()
        .find(|p| (p.first_word..p.first_word + p.words).contains(&word));
    let span = phrase.and_then(|p| {
        let words = plain.words.get(p.first_word..p.first_word + p.words)?;
        Some((words.first()?.start_secs, words.last()?.end_secs))
    });
    let (from, to) = span.unwrap_or((a.start_secs, a.end_secs));
    let accented = plain.accents.iter().any(|accent| {
        let syllable = plain.syllables.get(accent.syllable);
        syllable.is_some_and(|s| (s.first_phone..s.first_phone + s.phones).contains(&index))
    });
    [0.3, 0.5, 0.7]
        .iter()
        .filter_map(|share| {
            let at = |p: &Phone| p.start_secs + share * (p.end_secs - p.start_secs);
            let hz = [tracks[0].hz_at(at(a)), tracks[1].hz_at(at(b))];
            let semitones = |hz: f64| 12.0 * ops::ln(hz / 100.0) / LN_2;
            (hz[0] > 0.0 && hz[1] > 0.0).then(|| Point {
                plain: semitones(hz[0]),
                changed: semitones(hz[1]),
                along: (at(a) - from) / (to - from).max(1e-9) - 0.5,
                accented,
            })
        })
        .collect()
}

/// The slope of the line through points, by least squares.
fn line(points: impl Iterator<Item = (f64, f64)>) -> f64 {
    let points: Vec<(f64, f64)> = points.collect();
    let count = points.len().max(1) as f64;
    let (x, y) = points
        .iter()
        .fold((0.0, 0.0), |s, p| (s.0 + p.0, s.1 + p.1));
    let (x, y) = (x / count, y / count);
    let (xy, xx) = points.iter().fold((0.0, 0.0), |s, p| {
        (s.0 + (p.0 - x) * (p.1 - y), s.1 + (p.0 - x) * (p.0 - x))
    });
    xy / f64::max(xx, 1e-12)
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

/// Decibels as a factor of amplitude.
#[must_use]
pub fn amplitude(db: f64) -> f64 {
    ops::exp(db / 20.0 * LN_10)
}

/// Semitones as a factor of frequency.
#[must_use]
pub fn frequency(semitones: f64) -> f64 {
    ops::exp(semitones / 12.0 * LN_2)
}
