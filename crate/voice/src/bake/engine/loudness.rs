//! Times of a recording without an alignment, from its intensity alone.
//!
//! Quiet intervals are silence. Each rise and fall in between is a syllable, whose vowel is more
//! open the louder it is; words share the speech by their letters and punctuation. Jaw, head and
//! brows therefore move with the voice; the lips form no shapes of phones, because intensity does
//! not show them. All numbers are *designed*.

mod spread;

use crate::signal::intensity::{Intensity, intensity};
use crate::spoken::Spoken;
use anyhow::{Result, ensure};
use raconteur_speech::bundle::SILENCE;

use super::labels::{self, Labels, Phone};
use super::wave::Wave;
pub(super) use spread::SpokenUnit;
use spread::{Pause, Words};

/// Time between levels, and the window of each, seconds.
const STEP_SECS: f64 = 0.01;
const WINDOW_SECS: f64 = 0.032;
/// Level below which a recording counts as empty, decibels.
const NOTHING_DB: f64 = -60.0;
/// Range below the loudest speech that still counts as speech, decibels.
const RANGE_DB: f64 = 30.0;
/// Level of speech above the room noise, decibels.
const OVER_NOISE_DB: f64 = 8.0;
/// Quiet shorter than this is within speech (the closure of a p), seconds.
const MIN_QUIET_SECS: f64 = 0.12;
/// Sound shorter than this is a click, seconds.
const MIN_SOUND_SECS: f64 = 0.05;
/// Minimum fall and rise of the level between two syllables, decibels.
const DIP_DB: f64 = 3.0;
/// Level below a syllable's peak to which its vowel extends, decibels.
const VOWEL_DB: f64 = 4.0;
/// Quiet that ends a phrase, seconds.
const PHRASE_SECS: f64 = 0.15;
/// Maximum level of an accent below the loudest, decibels.
const ACCENT_DB: f64 = 6.0;
/// Distance within which the start of a word snaps to that of a phone, seconds.
const NEAR_SECS: f64 = 0.05;
/// Between vowels.
const NARROW: &str = "ax";
/// Vowels by their maximum level below the loudest, decibels.
const VOWELS: [(f64, &str); 3] = [(4.0, "aa"), (9.0, "ah"), (f64::INFINITY, NARROW)];

/// A syllable: frames from its begin to its end, and its peak.
#[derive(Clone, Copy, Debug)]
struct Peak {
    begin: usize,
    end: usize,
    db: f64,
}

/// Aligns audio by its loudness; `tokens` are the words spoken in it.
///
/// # Errors
/// Returns an error if the audio is silent.
pub(super) fn align_by_loudness(wave: Wave, tokens: &[SpokenUnit<'_>]) -> Result<Spoken> {
    let level = intensity(&wave.samples, wave.rate_hz, STEP_SECS, WINDOW_SECS);
    let mut sorted = level.db.clone();
    sorted.sort_by(f64::total_cmp);
    let percentile = |share: f64| {
        let at = (share * sorted.len().saturating_sub(1) as f64) as usize;
        sorted.get(at).copied().unwrap_or(f64::NEG_INFINITY)
    };
    let (noise, loud) = (percentile(0.1), percentile(0.95));
    ensure!(loud > NOTHING_DB, "it is silent");
    let least = (loud - RANGE_DB).max((noise + OVER_NOISE_DB).min(loud - 10.0));
    let stretches: Vec<Vec<Peak>> = stretches(&level, least)
        .into_iter()
        .map(|(begin, end)| peaks(&level, begin, end))
        .collect();
    let mut labels = Labels::default();
    let mut end_secs = 0.0;
    for stretch in &stretches {
        let (Some(first), Some(last)) = (stretch.first(), stretch.last()) else {
            continue;
        };
        let begin_secs = secs(first.begin);
        if begin_secs > end_secs {
            labels.phones.push(phone(SILENCE, begin_secs, None));
        }
        for (i, peak) in stretch.iter().enumerate() {
            syllable(&level, *peak, loud, &mut labels);
            let near = [i.checked_sub(1), Some(i + 1)];
            let louder = near.into_iter().flatten().filter_map(|k| stretch.get(k));
            let highest = louder.into_iter().all(|other| other.db < peak.db);
            let accent = if highest && peak.db > loud - ACCENT_DB {
                "*"
            } else {
                ""
            };
            let stress = u8::from(!accent.is_empty());
            labels.syllables.push((stress, accent.to_owned()));
        }
        end_secs = secs(last.end);
    }
    share(&mut labels, tokens);
    labels::finish(&labels, wave, "radio", 0.0)
}

fn secs(frame: usize) -> f64 {
    frame as f64 * STEP_SECS
}

fn phone(symbol: &str, end_secs: f64, syllable: Option<usize>) -> Phone {
    Phone {
        symbol: symbol.to_owned(),
        end_secs,
        token: None,
        syllable,
    }
}

/// Returns the audible stretches, as frames from start to end.
fn stretches(level: &Intensity, least_db: f64) -> Vec<(usize, usize)> {
    let mut out: Vec<(usize, usize)> = Vec::new();
    for (i, _) in level
        .db
        .iter()
        .enumerate()
        .filter(|(_, db)| **db >= least_db)
    {
        match out.last_mut() {
            Some(last) if secs(i - last.1) < MIN_QUIET_SECS => last.1 = i + 1,
            _ => out.push((i, i + 1)),
        }
    }
    out.retain(|(begin, end)| secs(end - begin) >= MIN_SOUND_SECS);
    out
}

/// Returns the syllables of a stretch: each starts in the dip before its peak.
fn peaks(level: &Intensity, begin: usize, end: usize) -> Vec<Peak> {
    let mut out = Vec::new();
    let mut open = Peak {
        begin,
        end,
        db: f64::NEG_INFINITY,
    };
    // The lowest since the peak.
    let mut dip = (begin, f64::INFINITY);
    for (i, &db) in level.db.iter().enumerate().take(end).skip(begin) {
        if db > open.db && dip.1 > open.db - DIP_DB {
            open.db = db;
            dip = (i, db);
        } else if db < dip.1 {
            dip = (i, db);
        } else if dip.1 <= open.db - DIP_DB && db >= dip.1 + DIP_DB {
            out.push(Peak { end: dip.0, ..open });
            open = Peak {
                begin: dip.0,
                end,
                db,
            };
            dip = (i, db);
        }
    }
    out.push(open);
    out
}

/// Adds the phones of one syllable: a constriction, its vowel, a constriction.
fn syllable(level: &Intensity, peak: Peak, loud: f64, labels: &mut Labels) {
    let own = Some(labels.syllables.len());
    let frames = level.db.get(peak.begin..peak.end).unwrap_or_default();
    let open = |db: &f64| *db >= peak.db - VOWEL_DB;
    let from = frames.iter().position(open).unwrap_or(0);
    let to = frames
        .iter()
        .rposition(open)
        .map_or(frames.len(), |i| i + 1);
    let under = VOWELS.iter().find(|(most, _)| loud - peak.db <= *most);
    let vowel = under.map_or(NARROW, |(_, vowel)| *vowel);
    for (symbol, end) in [(NARROW, from), (vowel, to), (NARROW, frames.len())] {
        labels
            .phones
            .push(phone(symbol, secs(peak.begin + end), own));
    }
}

/// Divides the audible stretches among the tokens by their letters, and ends phrases at long
/// silences.
fn share(labels: &mut Labels, tokens: &[SpokenUnit<'_>]) {
    let phones = core::mem::take(&mut labels.phones);
    // The ends of phones if all quiet intervals are omitted.
    let (mut begin_secs, mut heard_secs) = (0.0, 0.0);
    let (mut heard, mut pauses) = (Vec::with_capacity(phones.len()), Vec::new());
    for phone in &phones {
        if phone.syllable.is_some() {
            heard_secs += phone.end_secs - begin_secs;
        } else {
            pauses.push(Pause {
                at_secs: heard_secs,
                length_secs: phone.end_secs - begin_secs,
            });
        }
        begin_secs = phone.end_secs;
        heard.push(heard_secs);
    }
    let ends = token_ends(tokens, &heard, &pauses);
    let mut token = 0_usize;
    for (phone, next) in phones.iter().zip(&heard) {
        if phone.syllable.is_none() {
            let begin_secs = labels.phones.last().map(|p| p.end_secs);
            let long = begin_secs.is_some_and(|begin| phone.end_secs - begin >= PHRASE_SECS);
            if long && let Some(last) = token.checked_sub(1) {
                labels.breaks.push((last, String::new()));
            }
            labels.phones.push(phone.clone());
            continue;
        }
        while let Some(end) = ends.get(token).filter(|end| *end < next) {
            labels.phones.push(Phone {
                end_secs: phone.end_secs - (next - end),
                token: Some(token),
                ..phone.clone()
            });
            token += 1;
        }
        labels.phones.push(Phone {
            token: Some(token),
            ..phone.clone()
        });
        if ends.get(token) == Some(next) {
            token += 1;
        }
    }
    labels.breaks.dedup_by_key(|b| b.0);
}

/// Returns the ends of all tokens but the last in audible time: at their own pause; otherwise by
/// their letters, moved to a pause that would split the token, and to the end of a phone if one is
/// near.
fn token_ends(tokens: &[SpokenUnit<'_>], heard: &[f64], pauses: &[Pause]) -> Vec<f64> {
    let words = Words::from_units(tokens);
    let total = heard.last().copied().unwrap_or(0.0);
    let quiet: Vec<f64> = pauses.iter().map(|p| p.at_secs).collect();
    let anchors = words.anchors(pauses, total);
    let mut ends = Vec::with_capacity(tokens.len());
    for pair in anchors.windows(2) {
        let [(first, from), (last, to)] = [pair[0], pair[1]];
        let letter = (to - from) / words.between(first, last).max(1.0);
        for token in first + 1..last {
            let own = letter * words.between(token - 1, token);
            let next = letter * words.between(token, token + 1);
            let end = from + letter * words.between(first, token);
            // Two ends never meet: each moves by less than half of the word that it moves into.
            let at_pause = nearest(&quiet, end, 0.49 * own, 0.49 * next);
            let near = NEAR_SECS.min(0.3 * own.min(next));
            let end = at_pause
                .or_else(|| nearest(heard, end, near, near))
                .unwrap_or(end);
            ends.push(end.clamp(from, to));
        }
        if last < words.count() {
            ends.push(to);
        }
    }
    ends
}

/// Returns the nearest of the sorted `times` within the given distances before or after.
fn nearest(times: &[f64], at: f64, before: f64, after: f64) -> Option<f64> {
    let next = times.partition_point(|t| *t < at);
    let last = next.checked_sub(1).and_then(|i| times.get(i));
    let last = last.filter(|t| at - **t <= before);
    let next = times.get(next).filter(|t| **t - at <= after);
    match (last, next) {
        (Some(a), Some(b)) => Some(if at - a < b - at { *a } else { *b }),
        (one, other) => one.or(other).copied(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use raconteur_base::ops;

    /// Syllables of 0.2 s of a hummed tone with these amplitudes; 0 is quiet.
    fn hummed(amplitudes: &[f64]) -> Wave {
        let rate_hz = 16_000.0;
        let count = 3_200;
        let samples = amplitudes.iter().flat_map(|amplitude| {
            (0..count).map(move |i| {
                let swell = ops::sin(core::f64::consts::PI * f64::from(i) / f64::from(count));
                amplitude * swell * ops::sin(f64::from(i) * 0.06)
            })
        });
        Wave {
            samples: samples.collect(),
            rate_hz,
        }
    }

    fn spoken_words<'a>(words: &[&'a str]) -> Vec<SpokenUnit<'a>> {
        let of = |text: &&'a str| SpokenUnit { text, ends: false };
        words.iter().map(of).collect()
    }

    fn jaw(symbol: &str) -> f64 {
        use raconteur_speech::phones::{Channel, find};
        find("radio", symbol).unwrap().channel(Channel::Jaw)
    }

    #[test]
    fn the_jaw_follows_the_loudness_and_quiet_is_silence() {
        let spoken = align_by_loudness(
            hummed(&[0.0, 0.5, 0.2, 0.5, 0.0, 0.0, 0.4, 0.1]),
            &spoken_words(&["a", "b"]),
        )
        .unwrap();
        let level = |secs: f64| {
            let at = spoken.segments.iter().find(|s| s.end_secs > secs).unwrap();
            if at.is_silent() { 0.0 } else { jaw(&at.symbol) }
        };
        assert_eq!([level(0.05), level(0.9)], [0.0; 2]);
        assert!(
            level(0.3) > level(0.5) && level(0.7) > level(0.5) && level(0.5) > 0.0,
            "the jaw opens more at both loud times"
        );
        assert!(
            level(1.3) > level(1.5),
            "the jaw closes with the falling intensity"
        );
        assert_eq!(spoken.syllables.len(), 5);
        let accents = spoken.syllables.iter().filter(|s| s.accent == "*").count();
        assert!((2..=3).contains(&accents), "{accents}");
    }

    #[test]
    fn every_word_has_its_share_by_its_letters_and_phrases_end_at_pauses() {
        let tokens = ["one", "two", "sixes", "I", "am"];
        let spoken = align_by_loudness(
            hummed(&[0.5, 0.5, 0.0, 0.0, 0.5, 0.5]),
            &spoken_words(&tokens),
        )
        .unwrap();
        let length = |token: usize| {
            let mut begin_secs = 0.0;
            let mut sum = 0.0;
            for s in &spoken.segments {
                if s.token == Some(token) {
                    sum += s.end_secs - begin_secs;
                }
                begin_secs = s.end_secs;
            }
            sum
        };
        for token in 0..tokens.len() {
            assert!(length(token) > 0.02, "{token}: {} s", length(token));
        }
        assert!(length(2) > length(3), "the longer word lasts longer");
        assert!(
            spoken.segments.is_sorted_by_key(|s| s.token.unwrap_or(0)) || spoken.breaks.len() == 1,
            "the tokens of the segments are sorted"
        );
        assert_eq!(spoken.breaks, [(1, String::new())], "no pause is in a word");
    }

    #[test]
    fn many_words_of_a_short_sound_each_have_a_place() {
        let tokens = vec!["word"; 40];
        let spoken = align_by_loudness(hummed(&[0.5, 0.5]), &spoken_words(&tokens)).unwrap();
        for token in 0..40 {
            assert!(
                spoken.segments.iter().any(|s| s.token == Some(token)),
                "{token}"
            );
        }
    }

    #[test]
    fn nothing_heard_is_an_error_and_no_words_are_none() {
        assert!(
            align_by_loudness(hummed(&[0.0, 0.0]), &spoken_words(&["a"])).is_err(),
            "silence cannot be aligned"
        );
        assert!(
            align_by_loudness(Wave::default(), &spoken_words(&["a"])).is_err(),
            "an empty wave cannot be aligned"
        );
        assert!(
            align_by_loudness(hummed(&[0.5]), &[]).is_ok(),
            "a wave without words is accepted"
        );
    }
}
