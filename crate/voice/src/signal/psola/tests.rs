//! Modifications measured with this module's own analysis, on audio with known properties.

use super::*;
use crate::signal::bursts::{self, rigid_spans};
use crate::signal::click::click_measure;
use crate::signal::f0::{PitchOptions, track};
use crate::signal::intensity::decibels;
use crate::signal::testing::{self, Segment};

const RATE: f64 = 16_000.0;

fn plain() -> Change<'static> {
    Change {
        duration: &|_| 1.0,
        pitch: &|_, hz| hz,
        gain: &|_| 1.0,
        rigid: &[],
    }
}

fn story() -> (Vec<f64>, PitchTrack) {
    let (mut sound, _) = testing::utterance(
        RATE,
        &[
            Segment::silence(0.1),
            Segment::vowel(0.3, 110.0, 140.0),
            Segment::noise(0.12),
            Segment::vowel(0.35, 150.0, 90.0),
            Segment::silence(0.06),
            Segment::burst(),
            Segment::vowel(0.3, 120.0, 120.0),
            Segment::silence(0.1),
        ],
    );
    for (i, x) in sound.iter_mut().enumerate() {
        *x += 0.001 * crate::signal::scatter(i as u64);
    }
    let found = track(&sound, RATE, &PitchOptions::default());
    (sound, found)
}

fn power(samples: &[f64]) -> f64 {
    samples.iter().map(|x| x * x).sum::<f64>() / samples.len().max(1) as f64
}

/// Returns the ratio of frequencies after and before where both are voiced: the median, because a
/// window half beyond the end of a voiced stretch measures neither.
fn measured_ratio(before: &PitchTrack, made: &Changed) -> f64 {
    let options = PitchOptions {
        min_hz: 40.0,
        ..PitchOptions::default()
    };
    let now = track(&made.samples, RATE, &options);
    let mut ratios: Vec<f64> = now
        .hz
        .iter()
        .enumerate()
        .map(|(i, hz)| hz / before.hz_at(made.times.before(i as f64 * 0.01)))
        .filter(|ratio| *ratio > 0.0 && ratio.is_finite())
        .collect();
    assert!(
        ratios.len() as f64 > 50.0 * made.times.after(1.0),
        "the measured ratios cover the audio"
    );
    ratios.sort_by(f64::total_cmp);
    ratios[ratios.len() / 2]
}

#[test]
fn no_change_is_none_to_the_bit() {
    let (sound, found) = story();
    let same = change(&sound, RATE, &found, &plain());
    assert_eq!(same.samples, sound);
    assert_eq!(same.times.after(0.5), 0.5);
}

#[test]
fn what_is_beside_a_change_stays_as_it_was() {
    let (sound, found) = story();
    // Only the last vowel is raised; the preceding audio is assembled from grains again.
    let raised = change(
        &sound,
        RATE,
        &found,
        &Change {
            pitch: &|t, hz| if t > 0.95 { 1.2 * hz } else { hz },
            ..plain()
        },
    );
    assert_eq!(raised.samples.len(), sound.len());
    let until = (0.9 * RATE) as usize;
    let error: Vec<f64> = (0..until).map(|i| raised.samples[i] - sound[i]).collect();
    let snr_db = decibels(power(&sound[..until]) / power(&error).max(1e-30));
    assert!(snr_db > 100.0, "{snr_db}");
}

#[test]
fn duration_is_exact_and_pitch_and_level_stay() {
    let (sound, found) = story();
    for factor in [0.4, 0.6, 0.9, 1.25, 1.6, 2.5] {
        let made = change(
            &sound,
            RATE,
            &found,
            &Change {
                duration: &|_| factor,
                ..plain()
            },
        );
        let wanted = sound.len() as f64 * factor;
        assert!(
            (made.samples.len() as f64 - wanted).abs() <= 1.0,
            "the duration is exact to one sample"
        );
        let pitch = measured_ratio(&found, &made);
        assert!((pitch - 1.0).abs() < 0.01, "{factor}: pitch {pitch}");
        let level_db = decibels(power(&made.samples) / power(&sound));
        assert!(level_db.abs() < 0.7, "{factor}: {level_db} dB");
    }
}

#[test]
fn pitch_is_as_asked_and_duration_and_level_stay() {
    let (sound, found) = story();
    for ratio in [0.5, 0.7, 0.9, 1.1, 1.4, 2.0] {
        let made = change(
            &sound,
            RATE,
            &found,
            &Change {
                pitch: &|_, hz| ratio * hz,
                ..plain()
            },
        );
        assert_eq!(made.samples.len(), sound.len());
        let got = measured_ratio(&found, &made);
        assert!((got / ratio - 1.0).abs() < 0.01, "{ratio}: {got}");
        let level_db = decibels(power(&made.samples) / power(&sound));
        assert!(level_db.abs() < 1.0, "{ratio}: {level_db} dB");
    }
}

#[test]
fn a_rigid_burst_is_neither_doubled_nor_lost() {
    let (sound, found) = story();
    let burst = (0.93, 0.95);
    for factor in [0.5, 2.0] {
        let made = change(
            &sound,
            RATE,
            &found,
            &Change {
                duration: &|_| factor,
                rigid: &[burst],
                ..plain()
            },
        );
        let start = (made.times.after(burst.0) * RATE) as isize;
        let old = &sound[(burst.0 * RATE) as usize..(burst.1 * RATE) as usize];
        let at = |shift: isize| &made.samples[(start + shift) as usize..][..old.len()];
        let match_at = |shift: isize| {
            let new = at(shift);
            let dot: f64 = old.iter().zip(new).map(|(a, b)| a * b).sum::<f64>();
            dot / old.len() as f64 / power(old).max(power(new))
        };
        let best = (-100..=100).map(match_at).fold(0.0, f64::max);
        assert!(best > 0.9, "{factor}: {best}");
        // Once, within 5 ms of where it should be, and the closure before it stays quiet.
        let quiet = power(&made.samples[start as usize - 240..start as usize - 100]);
        assert!(quiet < 0.01 * power(old), "{factor}: {quiet}");
    }
}

#[test]
fn gain_is_as_asked_and_its_jumps_are_ramps() {
    let (sound, found) = story();
    let made = change(
        &sound,
        RATE,
        &found,
        &Change {
            gain: &|_| 2.0,
            ..plain()
        },
    );
    assert!(
        made.samples
            .iter()
            .zip(&sound)
            .all(|(a, b)| (a - 2.0 * b).abs() < 1e-12),
        "a constant gain scales every sample"
    );
    let constant = vec![1.0; 16_000];
    let step = |t: f64| if t < 0.5 { 1.0 } else { 3.0 };
    let made = change(
        &constant,
        RATE,
        &found,
        &Change {
            gain: &step,
            ..plain()
        },
    );
    let jump = made
        .samples
        .windows(2)
        .map(|p| (p[1] - p[0]).abs())
        .fold(0.0, f64::max);
    assert!(jump < 0.02 && made.samples[15_999] == 3.0, "{jump}");
}

#[test]
fn wild_wishes_and_wild_sound_are_survived() {
    let (sound, found) = story();
    let wild = Change {
        duration: &|t| if t > 0.3 { f64::NAN } else { f64::INFINITY },
        pitch: &|t, hz| if t < 0.6 { -hz } else { f64::NAN },
        gain: &|_| f64::NEG_INFINITY,
        rigid: &[(f64::NAN, 1.0), (0.5, 0.2), (f64::NEG_INFINITY, 0.1)],
    };
    let made = change(&sound, RATE, &found, &wild);
    assert!(
        made.samples.len() <= 5 * sound.len(),
        "the changed audio is at most five times as long"
    );
    assert!(
        change(&[], RATE, &found, &wild).samples.is_empty(),
        "empty audio stays empty"
    );
    assert_eq!(change(&sound, f64::NAN, &found, &wild).samples, sound);
    let broken = vec![f64::NAN; 2000];
    let stretched = Change {
        duration: &|_| 2.0,
        ..plain()
    };
    assert_eq!(
        change(&broken, RATE, &found, &stretched).samples.len(),
        4000
    );
}

#[test]
fn changes_bring_no_clicks() {
    let (sound, found) = story();
    let worst = |samples: &[f64]| click_measure(samples, RATE).map_or(0.0, |c| c.ratio);
    let before = worst(&sound);
    let rigid = rigid_spans(&bursts::all(&sound, RATE));
    for factor in [0.6, 0.8, 1.3, 1.6] {
        let stretched = Change {
            duration: &|t| if t < 0.5 { factor } else { 1.0 / factor },
            rigid: &rigid,
            ..plain()
        };
        let raised = Change {
            pitch: &|t, hz| if t < 0.25 { hz } else { factor * hz },
            ..plain()
        };
        let louder = Change {
            gain: &|t| if t < 0.3 { 1.0 } else { factor },
            ..plain()
        };
        for (name, wish) in [("length", stretched), ("pitch", raised), ("gain", louder)] {
            let after = worst(&change(&sound, RATE, &found, &wish).samples);
            assert!(after < 1.1 * before, "{name} {factor}: {before} to {after}");
        }
    }
}
