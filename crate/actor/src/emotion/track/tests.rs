//! Tests of onset, decay and transitions of emotions, and of their effect on breath and face.

use super::super::basic::BasicEmotion;
use super::super::expression::Expression;
use super::*;
use crate::parameters::ParameterTrack;
use crate::parameters::{Parameter, ParameterCommand, ParameterScript};
use raconteur_base::noise;
use raconteur_body::face::ANTAGONISTS;
use raconteur_speech::emotion::WORDS;

fn span(word: &str, times: [f64; 4]) -> EmotionSpan {
    let [start_secs, apex_secs, until_secs, end_secs] = times;
    EmotionSpan {
        start_secs,
        apex_secs,
        until_secs,
        end_secs,
        affect: Affect::named(word).expect(word),
        intensity: 1.0,
    }
}

fn face(track: &EmotionTrack, t: f64) -> FaceControls {
    let mut controls = FaceControls::default();
    track.add(t, &mut controls);
    controls
}

fn full(basic: BasicEmotion) -> FaceControls {
    let mut controls = FaceControls::default();
    Expression::from_basic(basic).add(&mut controls);
    controls.blush = EmotionSigns::from_point(basic.place()).blush;
    controls
}

/// Largest difference of two faces in contractions, lids, jaw (as a share) and blood.
fn apart(a: &FaceControls, b: &FaceControls) -> f64 {
    let pairs = a.contraction.iter().zip(&b.contraction);
    let lids = a.upper_lid.iter().zip(&b.upper_lid);
    let others = [
        (&a.lower_lid[0], &b.lower_lid[0]),
        (&a.blush, &b.blush),
        (&a.jaw.pitch_rad, &b.jaw.pitch_rad),
    ];
    let all = pairs.chain(lids).chain(others);
    all.fold(0.0, |most, (a, b)| most.max((a - b).abs()))
}

#[test]
fn an_emotion_is_full_at_its_apex_and_gone_at_its_borders() {
    let track = EmotionTrack::new(&[span("joy", [1.0, 3.0, 3.0, 4.0])], &[]);
    let rest = FaceControls::default();
    for t in [-5.0, 1.0, 4.0, 90.0] {
        assert_eq!(apart(&face(&track, t), &rest), 0.0, "{t}");
        assert_eq!(track.sample(t), EmotionPoint::default());
        assert_eq!((track.liveliness(t), track.breath(t).depth), (1.0, 1.0));
        assert_eq!(track.strength(t), 0.0);
    }
    assert!(
        apart(&face(&track, 3.0), &full(BasicEmotion::Joy)) < 1e-12,
        "joy is full at its apex"
    );
    let middle =
        face(&track, 2.0).contraction[raconteur_body::face::Muscle::ZygomaticusMajorLeft.index()];
    assert!((middle - 0.4).abs() < 1e-12, "{middle}");
    assert!(
        (track.sample(3.0).evaluation - 42.2).abs() < 1e-9,
        "the evaluation at the apex"
    );
    assert_eq!((track.strength(2.0), track.strength(3.0)), (0.5, 1.0));
}

#[test]
fn one_emotion_passes_into_another_without_a_jump() {
    let track = EmotionTrack::new(
        &[
            span("sorry-for", [0.0, 1.0, 1.5, 3.0]),
            span("joy", [1.0, 2.5, 2.5, 4.0]),
            span("anger", [2.4, 2.4, 2.4, 2.4]),
        ],
        &[],
    );
    let mut worst: f64 = 0.0;
    let mut last = face(&track, -1.0);
    for i in 0..6000 {
        let t = -1.0 + f64::from(i) * 1e-3;
        let now = face(&track, t);
        worst = worst.max(apart(&now, &last));
        for (one, other) in ANTAGONISTS {
            let most = |set: &[raconteur_body::face::Muscle]| {
                set.iter()
                    .map(|m| now.contraction[m.index()])
                    .fold(0.0, f64::max)
            };
            assert!(most(one) == 0.0 || most(other) == 0.0, "at {t}");
        }
        last = now;
    }
    // The fastest onset takes 0.25 s: at most 1.5 times the mean speed, and the replaced emotion
    // fades as fast.
    assert!(worst < 2.0 * 1.5 / 250.0, "{worst} a millisecond");
}

#[test]
fn any_number_of_emotions_stays_within_the_ranges() {
    for seed in 0..60 {
        let unit = |k: u64, i: i64| noise::unit(seed, k, i);
        let spans: Vec<EmotionSpan> = (0..12)
            .map(|i| {
                let (word, _) = WORDS[(unit(1, i) * WORDS.len() as f64) as usize % WORDS.len()];
                let start = 6.0 * unit(2, i);
                let times = [0.0, 3.0 * unit(3, i), 4.0 * unit(4, i), 6.0 * unit(5, i)];
                EmotionSpan {
                    intensity: 4.0 * unit(6, i),
                    ..span(word, times.map(|t| start + t))
                }
            })
            .collect();
        let track = EmotionTrack::new(&spans, &[]);
        let mut last_breath = 0.0;
        for i in 0..140 {
            let t = f64::from(i) * 0.1;
            let face = face(&track, t);
            let within = |v: &f64| (0.0..=1.0 + 1e-12).contains(v);
            assert!(face.contraction.iter().all(within), "{face:?}");
            assert!(
                face.upper_lid[0].abs() <= 1.0 + 1e-12 && face.blush.abs() <= 1.0,
                "lids and blush stay in their ranges"
            );
            assert!(
                (0.3..2.0).contains(&track.liveliness(t)),
                "the liveliness stays in its range"
            );
            let breath = t + track.breath(t).lead_secs;
            assert!(i == 0 || breath > last_breath, "breath goes on");
            last_breath = breath;
        }
    }
}

#[test]
fn breath_goes_faster_in_fear_and_nothing_jumps() {
    let track = EmotionTrack::new(&[span("fear", [2.0, 4.0, 14.0, 16.0])], &[]);
    assert_eq!(track.breath(1.0).lead_secs, 0.0);
    let gained = track.breath(14.0).lead_secs - track.breath(4.0).lead_secs;
    assert!((gained - 5.0).abs() < 1e-9, "half as fast again: {gained}");
    assert!(
        track.breath(9.0).depth < 0.8,
        "fear makes breathing shallower"
    );
    let after = track.breath(16.0).lead_secs;
    assert!(
        (track.breath(60.0).lead_secs - after).abs() < 1e-12,
        "the lead of the breath stays constant afterwards"
    );
    for i in 0..20_000 {
        let t = f64::from(i) * 1e-3;
        let gained = track.breath(t + 1e-3).lead_secs - track.breath(t).lead_secs;
        assert!((0.0..=0.5e-3 + 1e-12).contains(&gained), "{t} {gained}");
    }
}

#[test]
fn emotions_are_set_by_name() {
    let disgust = Parameter::named("Disgust").next().expect("a word");
    let script = ParameterScript {
        commands: vec![(1.0, ParameterCommand::Set(disgust, 1.0))],
    };
    let parameters = ParameterTrack::new(&script, &|_| None);
    let track = EmotionTrack::new(&[], parameters.emotions());
    assert_eq!(apart(&face(&track, 1.0), &FaceControls::default()), 0.0);
    assert!(
        apart(&face(&track, 2.0), &full(BasicEmotion::Disgust)) < 1e-12,
        "disgust set by name is full at its apex"
    );
    let joyful = span("joy", [1.5, 2.0, 3.0, 4.0]);
    let track = EmotionTrack::new(&[joyful], parameters.emotions());
    // Half of both: joy's and disgust's corners of the mouth pull against each other.
    let mixed = face(&track, 2.5).contraction;
    let zygomaticus = raconteur_body::face::Muscle::ZygomaticusMajorLeft.index();
    assert!(
        (mixed[zygomaticus] - 0.5 * (0.8 - 0.2)).abs() < 1e-12,
        "the antagonists of both emotions are subtracted"
    );
}

#[test]
fn who_kids_winks_at_the_apex_with_one_eye_and_smiles_throughout() {
    for intensity in [0.4, 1.0, 2.0] {
        let kidding = EmotionSpan {
            intensity,
            ..span("kidding", [0.0, 2.0, 2.0, 4.0])
        };
        let track = EmotionTrack::new(&[kidding], &[]);
        let lids = |t: f64| face(&track, t).upper_lid;
        assert_eq!(lids(2.1)[0], 1.0);
        for t in [0.5, 1.0, 1.8, 2.6, 3.0] {
            assert!(lids(t)[0].abs() < 1e-9, "{t}");
        }
        let smile = raconteur_body::face::Muscle::ZygomaticusMajorLeft.index();
        for i in 1..40 {
            let t = 0.1 * f64::from(i);
            assert!(face(&track, t).contraction[smile] > 0.0, "{t}");
            assert!(lids(t)[1].abs() < 1e-9, "the other eye stays open at {t}");
        }
        let mut before = lids(1.0)[0];
        for i in 0..1000 {
            let now = lids(1.0 + 0.002 * f64::from(i))[0];
            // 1.5 times the mean speed of closing.
            assert!(
                (now - before).abs() < 1.51 * 0.002 / 0.12,
                "the wink has no jump"
            );
            before = now;
        }
    }
}

#[test]
fn what_is_no_number_is_left_out() {
    let broken = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY];
    let spans: Vec<EmotionSpan> = broken
        .iter()
        .flat_map(|bad| (0..4).map(move |k| (*bad, k)))
        .map(|(bad, k)| {
            let mut times = [0.0, 1.0, 1.0, 2.0];
            times[[0, 1, 3, 3][k]] = bad;
            span("joy", times)
        })
        .collect();
    let track = EmotionTrack::new(&spans, &[]);
    assert_eq!(apart(&face(&track, 1.0), &FaceControls::default()), 0.0);
}
