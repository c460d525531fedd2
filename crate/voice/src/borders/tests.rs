//! Boundaries in audio with known phones.

use super::*;
use crate::signal::testing::{self, Segment as Sound};

const RATE_HZ: f64 = 24_000.0;

/// Returns audio and an engine's labels for it: symbols with their true ends, each label with the
/// given error.
fn told(parts: &[(&str, f64)], off_secs: &[f64]) -> (Spoken, Vec<f64>) {
    let sounds: Vec<Sound> = parts
        .iter()
        .map(|(symbol, secs)| match *symbol {
            "pau" => Sound::silence(*secs),
            "s" => Sound::noise(*secs),
            _ => Sound::vowel(*secs, 190.0, 180.0),
        })
        .collect();
    let (samples, _) = testing::utterance(RATE_HZ, &sounds);
    let mut end_secs = 0.0;
    let ends: Vec<f64> = parts
        .iter()
        .map(|(_, secs)| {
            end_secs += secs;
            end_secs
        })
        .collect();
    let last = parts.len() - 1;
    let segments = parts
        .iter()
        .zip(&ends)
        .enumerate()
        .map(|(i, ((symbol, _), end))| Segment {
            symbol: (*symbol).to_owned(),
            end_secs: if i == last { *end } else { end + off_secs[i] },
            token: (*symbol != "pau").then_some(0),
        });
    let spoken = Spoken {
        segments: segments.collect(),
        samples,
        rate_hz: RATE_HZ,
        phone_set: "radio".to_owned(),
        ..Spoken::default()
    };
    (spoken, ends)
}

#[test]
fn borders_move_to_where_the_sound_changes() {
    let parts = [
        ("pau", 0.2),
        ("aa", 0.15),
        ("s", 0.12),
        ("iy", 0.2),
        ("pau", 0.25),
    ];
    for off_secs in [
        [0.03, 0.03, 0.03, 0.06],
        [-0.04, 0.03, -0.03, -0.05],
        [0.0; 4],
    ] {
        let (mut spoken, ends) = told(&parts, &off_secs);
        refine(&mut spoken);
        assert_eq!(spoken.segments.len(), parts.len());
        for (segment, end) in spoken.segments.iter().zip(&ends) {
            let off = segment.end_secs - end;
            assert!(
                off.abs() <= 0.016,
                "{} {off} of {off_secs:?}",
                segment.symbol
            );
        }
    }
}

#[test]
fn phones_tile_whatever_they_are_told_to_be() {
    use raconteur_base::noise::unit;
    for seed in 0..60 {
        let draw = |i: i64| unit(seed, 1, i);
        let count = 3 + (8.0 * draw(0)) as usize;
        let parts: Vec<(&str, f64)> = (0..count)
            .map(|i| {
                let symbol = ["pau", "s", "aa", "m", "t"][(5.0 * draw(3 * i as i64 + 1)) as usize];
                (symbol, 0.02 + 0.2 * draw(3 * i as i64 + 2))
            })
            .collect();
        let (mut spoken, _) = told(&parts, &vec![0.0; count]);
        for (i, segment) in spoken.segments.iter_mut().enumerate() {
            segment.end_secs = (segment.end_secs + 0.01 * draw(500 + i as i64)).max(0.0);
        }
        let end_secs = spoken.segments[count - 1].end_secs;
        refine(&mut spoken);
        let ends: Vec<f64> = spoken.segments.iter().map(|s| s.end_secs).collect();
        assert!(ends.windows(2).all(|p| p[0] <= p[1]), "{parts:?} {ends:?}");
        assert_eq!(ends.last(), Some(&end_secs), "{parts:?}");
    }
}

#[test]
fn a_sound_that_is_too_short_stays_as_it_is() {
    let (mut spoken, _) = told(&[("aa", 0.004), ("s", 0.004)], &[0.0; 2]);
    let before = spoken.clone();
    refine(&mut spoken);
    assert_eq!(spoken, before);
    let mut nothing = Spoken::default();
    refine(&mut nothing);
    assert_eq!(nothing, Spoken::default());
}
