//! Seeds and impossible speech.

use std::sync::Arc;

use raconteur_body::face::{FaceControls, MUSCLES};
use raconteur_speech::bundle::{Accent, Phrase, Sentence, SentenceKind, Syllable};
use raconteur_speech::{Phone, TimedUtterance, Utterance, Word};

use super::speech::hour;
use crate::nonverbal::{Manner, NonVerbal, PlanBasis};

/// Returns all outputs of a plan at a time.
fn all(plan: &NonVerbal, t: f64) -> Vec<f64> {
    let mut face = FaceControls::default();
    plan.face(t, 1.0, &mut face);
    let gaze = plan.gaze(t);
    let mut all = face.contraction.to_vec();
    assert_eq!(all.len(), MUSCLES);
    all.extend([
        face.tongue_out,
        plan.closure(t),
        plan.lick(t),
        plan.loudness(t),
    ]);
    all.extend(plan.head(t, 1.0).iter().chain(&gaze.eyes).chain(&gaze.head));
    all
}

#[test]
fn a_seed_gives_one_plan_and_another_seed_another() {
    let speech = &hour(1)[..20];
    let [a, b, c] = [1, 1, 2].map(|seed| NonVerbal::new(speech, seed, &Manner::default()));
    // In any order of asking.
    let times: Vec<f64> = (0..4000).map(|i| f64::from(i) * 0.013).collect();
    let of = |plan: &NonVerbal, t: f64| all(plan, t);
    let backwards: Vec<Vec<f64>> = times.iter().rev().map(|t| of(&b, *t)).collect();
    let forwards: Vec<Vec<f64>> = times.iter().map(|t| of(&a, *t)).collect();
    assert!(
        forwards.iter().eq(backwards.iter().rev()),
        "the samples do not depend on the sampling order"
    );
    let changed = times.iter().filter(|t| of(&a, **t) != of(&c, **t)).count();
    assert!(changed > 3000, "{changed}");
}

#[test]
fn nothing_of_a_still_manner_moves_but_the_lips() {
    let manner = Manner {
        head: 0.0,
        brows: 0.0,
        blinks: 0.0,
        gaze: 0.0,
        thinking_share: 0.0,
        ..Manner::default()
    };
    let speech = &hour(1)[..20];
    let plan = NonVerbal::new(speech, 1, &manner);
    for i in 0..8000 {
        let t = f64::from(i) * 0.01;
        let gaze = plan.gaze(t);
        assert_eq!(plan.head(t, 1.0).map(f64::abs), [0.0; 3]);
        assert_eq!((gaze.eyes, gaze.head), ([0.0; 2], [0.0; 2]));
        assert_eq!(plan.closure(t), 0.0);
    }
}

/// Returns utterances with values that no bundle should hold.
fn impossible() -> Vec<TimedUtterance> {
    let odd = [
        0.0,
        -0.0,
        1e-300,
        0.1,
        -5.0,
        1e9,
        1e300,
        f64::NAN,
        f64::INFINITY,
        -1e308,
    ];
    let mut all = vec![TimedUtterance::default()];
    for (i, a) in odd.into_iter().enumerate() {
        for (k, b) in odd.into_iter().enumerate() {
            let utterance = Utterance {
                duration_secs: a,
                phones: vec![
                    Phone::new("pau", 0.0, a, None),
                    Phone::new("aa", a, b, Some(0)),
                    Phone::new("aa", b, a, Some(9)),
                    Phone::new("?", a, a + 1e8, Some(1)),
                ],
                words: ["", "errr", "what?\u{e9}\"", "?"]
                    .iter()
                    .map(|text| Word {
                        text: (*text).to_owned(),
                        start_secs: a,
                        end_secs: b,
                        emphasized: i % 2 == 0,
                    })
                    .collect(),
                syllables: vec![
                    Syllable {
                        first_phone: k % 4,
                        phones: 1 + i % 2,
                        stress: 1,
                    },
                    Syllable {
                        first_phone: usize::MAX,
                        phones: 0,
                        stress: 1,
                    },
                ],
                accents: (0..k % 4)
                    .map(|syllable| Accent {
                        syllable,
                        label: "!".to_owned(),
                    })
                    .collect(),
                phrases: vec![
                    Phrase {
                        first_word: i,
                        words: usize::MAX,
                        tone: "H%".to_owned(),
                    },
                    Phrase {
                        first_word: usize::MAX,
                        words: k,
                        tone: String::new(),
                    },
                ],
                sentences: (0..k % 3)
                    .map(|s| Sentence {
                        first_word: s,
                        words: i,
                        kind: SentenceKind::Question,
                    })
                    .collect(),
                f0: (0..i * k * 3).map(|x| (x * x % 256) as u8).collect(),
                intensity: (0..i).map(|x| (x * 40) as u8).collect(),
                ..Utterance::default()
            };
            all.push(TimedUtterance {
                start_secs: odd[(i + k) % odd.len()],
                utterance: Arc::new(utterance),
            });
        }
    }
    all
}

#[test]
fn impossible_speech_is_survived() {
    for way in [PlanBasis::Audio, PlanBasis::Text] {
        for amount in [1.0, 0.0, -3.0, f64::NAN, 1e300] {
            let manner = Manner {
                basis: way,
                head: amount,
                brows: amount,
                blinks: amount,
                gaze: amount,
                pitch_threshold: amount,
                thinking_secs: amount,
                lick_secs: amount,
                accent_glances: amount,
                ..Manner::default()
            };
            let speech = impossible();
            let together = NonVerbal::new(&speech, 3, &manner);
            let alone = speech
                .iter()
                .map(|u| NonVerbal::new(std::slice::from_ref(u), 3, &manner));
            for plan in alone.chain([together]) {
                for i in -50..200 {
                    let now = all(&plan, f64::from(i) * 0.11);
                    assert!(now.iter().all(|x| x.abs() < 3.0), "{now:?}");
                }
                for t in [1e9, -1e9, 1e18] {
                    assert!(
                        all(&plan, t).iter().all(|x| x.is_finite()),
                        "all sampled values are finite"
                    );
                }
            }
        }
    }
}

#[test]
fn a_long_plan_is_as_small_as_its_speech() {
    // Four phones of fifty days.
    let secs = 4.29e6;
    let phone = |i: i32, symbol: &str| {
        Phone::new(symbol, f64::from(i) * secs, f64::from(i + 1) * secs, None)
    };
    let u = Utterance {
        duration_secs: 4.0 * secs,
        phones: ["aa", "pau", "s", "aa"]
            .iter()
            .zip(0..)
            .map(|(s, i)| phone(i, s))
            .collect(),
        ..Utterance::default()
    };
    let u = TimedUtterance {
        start_secs: 0.0,
        utterance: Arc::new(u),
    };
    let plan = NonVerbal::new(&[u], 1, &Manner::default());
    assert!(
        (0..1000).all(|i| {
            all(&plan, f64::from(i) * 17e3)
                .iter()
                .all(|x| x.is_finite())
        }),
        "all sampled values of the long plan are finite"
    );
}
