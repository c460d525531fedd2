//! Random GSL values and transcriptions.

use proptest::prelude::*;
use raconteur_annotate::gestura::{
    Dimension, Form, Gesture, GestureClass, Hands, Interval, Layer, Level, LevelSpan, Meaning,
    Noted, Phase, PhaseKind, Phrase, Prosody, Setting, Staging, Transcription, Utterance,
    Viewpoint, Vocabulary, Word,
};
use raconteur_annotate::gsl::{Feature, Item, Offset, Palm, Position, Sequence, Shape, Value};
use raconteur_eml::Span;

pub(crate) fn shape() -> BoxedStrategy<Shape> {
    (0_u8..=60).prop_map(Shape).boxed()
}

pub(crate) fn position() -> BoxedStrategy<Position> {
    prop::array::uniform3(-90.0_f64..90.0)
        .prop_map(Position)
        .boxed()
}

pub(crate) fn palm() -> BoxedStrategy<Palm> {
    let axis = prop::array::uniform3(-1.0_f64..1.0);
    let axis = axis.prop_filter("a direction", |axis| axis.iter().any(|c| c.abs() > 1e-3));
    (-360.0_f64..360.0, axis)
        .prop_map(|(angle_deg, axis)| Palm { angle_deg, axis })
        .boxed()
}

fn offset() -> impl Strategy<Value = Option<Offset>> {
    prop_oneof![
        Just(None),
        (0.0_f64..9.0).prop_map(|secs| Some(Offset::Secs(secs))),
        (0_u32..9).prop_map(|secs| Some(Offset::Secs(f64::from(secs)))),
        (0.0_f64..=100.0).prop_map(|percent| Some(Offset::Percent(percent))),
    ]
}

fn sequence<F: Feature + std::fmt::Debug + 'static>(
    feature: BoxedStrategy<F>,
) -> impl Strategy<Value = Sequence<F>> {
    let item = (offset(), feature).prop_map(|(offset, feature)| Item { offset, feature });
    prop::collection::vec(item, 1..5).prop_map(|items| Sequence { items })
}

pub(crate) fn value<F: Feature + std::fmt::Debug + 'static>(
    feature: BoxedStrategy<F>,
) -> impl Strategy<Value = Value<F>> {
    let per_hand = (sequence(feature.clone()), sequence(feature.clone()), 0..3).prop_map(
        |(right, left, hands)| Value::PerHand {
            right: (hands != 0).then_some(right),
            left: (hands != 1).then_some(left),
        },
    );
    prop_oneof![sequence(feature).prop_map(Value::Common), per_hand]
}

fn word<V: Vocabulary + std::fmt::Debug>() -> impl Strategy<Value = V> {
    (0..V::WORDS.len()).prop_map(|i| V::WORDS[i].0)
}

fn text() -> impl Strategy<Value = Option<String>> {
    prop::option::of("[a-zé<&'\"][a-z é;<>&'\"]{0,12}[a-z.]")
}

fn form() -> impl Strategy<Value = Form> {
    macro_rules! noted {
        ($feature:expr) => {
            prop::option::of(value($feature).prop_map(Noted::formal))
        };
    }
    (
        noted!(position()),
        noted!(position()),
        noted!(position()),
        noted!(shape()),
        noted!(palm()),
        text(),
    )
        .prop_map(
            |(source, target, motion, hand_shapes, palm_orientations, body_shape)| Form {
                source,
                target,
                motion,
                hand_shapes,
                palm_orientations,
                body_shape,
            },
        )
}

fn meaning() -> impl Strategy<Value = Meaning> {
    let texts = prop::collection::vec(text(), 7);
    (texts, prop::option::of(word::<Viewpoint>())).prop_map(|(mut texts, iconic_viewpoint)| {
        let mut next = || texts.pop().flatten();
        Meaning {
            iconic_body: next(),
            iconic_motion: next(),
            iconic_viewpoint,
            metaphoric_base: next(),
            metaphoric_referent: next(),
            metaphoric_motion: next(),
            deictic_geographic_target: next(),
            deictic_narration_target: next(),
        }
    })
}

/// Runs that cover `count` items, each of one to three.
fn runs(lengths: &[usize], count: usize) -> Vec<std::ops::RangeInclusive<usize>> {
    let mut start = 0;
    let mut runs = Vec::new();
    for &length in lengths {
        if start + length > count {
            break;
        }
        runs.push(start..=start + length - 1);
        start += length;
    }
    runs
}

/// Intervals one after another, times of whole milliseconds.
fn intervals(lengths: &[(u32, u32)]) -> Vec<Interval> {
    let mut at = 0;
    let mut out = Vec::new();
    for &(gap, length) in lengths {
        let (start, end) = (at + gap, at + gap + length);
        out.push(Interval::new(
            f64::from(start) / 1000.0,
            f64::from(end) / 1000.0,
        ));
        at = end;
    }
    out
}

fn layer(name: &'static str) -> impl Strategy<Value = Layer> {
    let phases = prop::collection::vec(
        ((0_u32..300, 20_u32..900), word::<PhaseKind>(), form()),
        0..9,
    );
    let phrase = (
        (
            prop::option::of(word::<Dimension>()),
            prop::option::of(word::<Hands>()),
        ),
        prop::option::of(any::<bool>()),
        text(),
        prop::option::of(1_u8..=4),
        text(),
        meaning(),
    );
    let phrases = prop::collection::vec((1_usize..4, phrase), 0..5);
    (phases, phrases).prop_map(move |(phases, phrases)| {
        let lengths: Vec<(u32, u32)> = phases.iter().map(|phase| phase.0).collect();
        let times = intervals(&lengths);
        let spans = runs(
            &phrases.iter().map(|phrase| phrase.0).collect::<Vec<_>>(),
            phases.len(),
        );
        Layer {
            name: name.into(),
            phases: phases
                .into_iter()
                .zip(times)
                .map(|((_, kind, form), interval)| Phase {
                    kind,
                    interval,
                    form,
                    span: Span::default(),
                })
                .collect(),
            phrases: phrases
                .into_iter()
                .zip(spans)
                .map(|((_, phrase), phases)| {
                    let (
                        (dimension, handedness),
                        symmetry,
                        frame,
                        confidence,
                        contribution,
                        meaning,
                    ) = phrase;
                    Phrase {
                        phases,
                        dimension,
                        handedness,
                        symmetry,
                        speaker_frame_position: frame,
                        confidence,
                        contribution,
                        meaning,
                        span: Span::default(),
                    }
                })
                .collect(),
        }
    })
}

/// Prosody, events and settings over some words.
fn around(words: &[Word]) -> (Vec<Prosody>, Vec<Staging>, Vec<Setting>) {
    let attribute = |name: &str, value: &str| vec![(name.to_owned(), value.to_owned())];
    let prosody = words.len().checked_sub(1).map(|last| Prosody {
        element: "emph".into(),
        attributes: attribute("level", "strong"),
        words: last / 2..=last,
        span: Span::default(),
    });
    let staging = words.iter().step_by(5).map(|word| Staging {
        element: "emotion".into(),
        attributes: attribute("type", "joy"),
        interval: word.interval,
        span: Span::default(),
    });
    let setting = Setting {
        element: "environment".into(),
        attribute: "set".into(),
        value: "garden".into(),
    };
    (
        prosody.into_iter().collect(),
        staging.collect(),
        vec![setting],
    )
}

/// Transcriptions of every kind of annotation, without places in a file.
pub(crate) fn transcription() -> impl Strategy<Value = Transcription> {
    let words = prop::collection::vec(((0_u32..700, 40_u32..500), "[a-zé']{1,8}"), 0..20);
    let utterances = prop::collection::vec((1_usize..6, text()), 0..5);
    let levels = prop::collection::vec((1_usize..3, word::<Level>()), 0..3);
    let gesture = (
        word::<GestureClass>(),
        prop::option::of(1_u8..=4),
        prop::option::of("[a-z]{1,8}"),
    );
    let gestures = prop::collection::vec(((0_u32..900, 100_u32..2000), gesture), 0..6);
    let layers = (layer("layer1"), layer("layer2"));
    (words, utterances, levels, gestures, layers).prop_map(
        |(words, utterances, levels, gestures, (first, second))| {
            let times = intervals(&words.iter().map(|word| word.0).collect::<Vec<_>>());
            let words: Vec<Word> = words
                .into_iter()
                .zip(times)
                .map(|((_, token), interval)| Word {
                    token,
                    interval,
                    span: Span::default(),
                })
                .collect();
            let spoken = runs(
                &utterances
                    .iter()
                    .map(|utterance| utterance.0)
                    .collect::<Vec<_>>(),
                words.len(),
            );
            let utterances: Vec<Utterance> = utterances
                .into_iter()
                .zip(spoken)
                .map(|((_, text), words)| Utterance {
                    text: text.unwrap_or_default(),
                    words,
                    span: Span::default(),
                })
                .collect();
            let spans = runs(
                &levels.iter().map(|level| level.0).collect::<Vec<_>>(),
                utterances.len(),
            );
            let levels = levels
                .into_iter()
                .zip(spans)
                .map(|((_, level), utterances)| LevelSpan {
                    level,
                    utterances,
                    span: Span::default(),
                })
                .collect();
            let times = intervals(&gestures.iter().map(|gesture| gesture.0).collect::<Vec<_>>());
            let gestures = gestures
                .into_iter()
                .zip(times)
                .map(|((_, (class, confidence, animation)), interval)| Gesture {
                    class,
                    confidence,
                    animation,
                    interval,
                    span: Span::default(),
                })
                .collect();
            let (prosody, staging, settings) = around(&words);
            Transcription {
                prosody,
                staging,
                settings,
                media: vec!["rabbit.mp4".into()],
                coder: Some("one".into()),
                words,
                utterances,
                levels,
                gestures,
                layers: vec![first, second],
            }
        },
    )
}
