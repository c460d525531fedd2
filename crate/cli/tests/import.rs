//! Transcriptions to EML to pose: phases at their times, hands at their places.

use std::fs;
use std::path::Path;

use proptest::prelude::*;
use raconteur_annotate::gestura::{
    Dimension, Form, Hands, Interval, Layer, Meaning, Noted, Phase, PhaseKind, Phrase,
    Transcription, Word,
};
use raconteur_annotate::gsl::{self, Palm, Shape};
use raconteur_annotate::{Anchoring, anvil, import};
use raconteur_base::{Length as _, Side};
use raconteur_body::Bone;
use raconteur_body::read::read_figure;
use raconteur_eml::{ClauseKind, Severity, Span, write};
use raconteur_player::{LoadedPlayer, Options, Player, StoryInput};

/// Tolerance of phase times, seconds.
const LATE_SECS: f64 = 0.02;

fn noted<F: gsl::Feature>(text: &str) -> Option<Noted<F>> {
    let value = gsl::parse(text).unwrap_or_else(|error| panic!("{text}: {error}"));
    Some(Noted::formal(value))
}

/// Gesture of a random transcription: its gap, its lengths, and places in front of the body.
type Drawn = (f64, [f64; 3], [[f64; 3]; 2], u8, Hands);

fn drawn() -> impl Strategy<Value = Vec<Drawn>> {
    let place = || (3.0..14.0, 6.0..22.0, 11.0..14.0);
    let gesture = (
        0.1..1.2,
        (0.6..0.9, 0.35..0.8, 0.6..1.0),
        (place(), place()),
        0_u8..=60,
        prop_oneof![Just(Hands::Right), Just(Hands::Left), Just(Hands::Both)],
    );
    let gesture = gesture.prop_map(|(gap, lengths, (a, b), shape, hands)| {
        let sign = if hands == Hands::Left { 1.0 } else { -1.0 };
        let side = |(x, y, z): (f64, f64, f64)| [sign * x, y, z];
        // A stroke of at most eight units, so that it can be performed in its time.
        let (from, far) = (side(a), side(b));
        let span: f64 = (0..3)
            .map(|i| (far[i] - from[i]).powi(2))
            .sum::<f64>()
            .sqrt();
        let share = (8.0 / span.max(1e-3)).min(1.0);
        let to = std::array::from_fn(|i| from[i] + share * (far[i] - from[i]));
        (
            gap,
            [lengths.0, lengths.1, lengths.2],
            [from, to],
            shape,
            hands,
        )
    });
    prop::collection::vec(gesture, 1..6)
}

/// Returns the transcription of gestures, each prepared, performed and retracted.
fn transcription(gestures: &[Drawn]) -> Transcription {
    let mut layer = Layer {
        name: "layer1".into(),
        ..Layer::default()
    };
    let mut at = 1.0;
    for (gap, [prepare, stroke, retract], [from, to], shape, hands) in gestures {
        let text = |[x, y, z]: [f64; 3]| format!("[{x};{y};{z}]");
        let angle = if *hands == Hands::Left { -90 } else { 90 };
        let mut phase = |kind, length: f64, form: Form| {
            layer.phases.push(Phase {
                kind,
                interval: Interval::new(at, at + length),
                form,
                span: Span::default(),
            });
            at += length;
        };
        phase(
            PhaseKind::Preparation,
            *prepare,
            Form {
                target: noted(&text(*from)),
                ..Form::default()
            },
        );
        phase(
            PhaseKind::Stroke,
            *stroke,
            Form {
                motion: noted(&format!("[{};{}]", text(*from), text(*to))),
                hand_shapes: noted::<Shape>(&shape.to_string()),
                palm_orientations: noted::<Palm>(&format!("[{angle};[0;-1;0]]")),
                ..Form::default()
            },
        );
        phase(PhaseKind::Retraction, *retract, Form::default());
        let last = layer.phases.len() - 1;
        layer.phrases.push(Phrase {
            phases: last - 2..=last,
            dimension: Some(Dimension::Iconic),
            handedness: Some(*hands),
            symmetry: None,
            speaker_frame_position: None,
            confidence: None,
            contribution: None,
            meaning: Meaning::default(),
            span: Span::default(),
        });
        at += gap;
    }
    let strokes = layer
        .phases
        .iter()
        .filter(|phase| phase.kind == PhaseKind::Stroke);
    let words = strokes.enumerate().map(|(number, stroke)| Word {
        token: format!("word{number}"),
        interval: Interval::new(stroke.interval.start_secs, stroke.interval.start_secs + 0.3),
        span: Span::default(),
    });
    Transcription {
        words: words.collect(),
        layers: vec![layer],
        ..Transcription::default()
    }
}

/// A player of a figure without idle motion, so that only the script moves it.
fn player(eml: &str, figure: &str) -> LoadedPlayer {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets/figures");
    let bytes = fs::read(path.join(format!("{figure}.glb"))).expect("the figure");
    Player::load(StoryInput {
        eml,
        bundle: None,
        figure: read_figure(figure, &bytes).expect("a figure").into(),
        options: Options {
            motion_amount: 0.0,
            ..Options::default()
        },
    })
}

/// Returns the script of a transcription, by way of an annotation file of ANVIL.
fn script(transcription: &Transcription, anchoring: Anchoring) -> String {
    let file = anvil::write(&anvil::from_transcription(transcription));
    let imported = import(file.as_bytes(), None, anchoring);
    let errors = imported
        .diagnostics
        .iter()
        .filter(|d| d.severity == Severity::Error);
    assert_eq!(errors.count(), 0, "{:?}", imported.diagnostics);
    let eml = write(&imported.document);
    let parsed = raconteur_eml::parse(&eml);
    assert_eq!(parsed.diagnostics, [], "{eml}");
    eml
}

/// Distance of a wrist from a place in the frame of GSL at a time, skeleton units.
fn miss(player: &mut Player, secs: f64, side: Side, [x, y, z]: [f64; 3]) -> f64 {
    let wanted = player.units().speaker_point([x, y, -z]);
    let metres = player.units().metres();
    let wrist = if side == Side::Left {
        Bone::LWrist
    } else {
        Bone::RWrist
    };
    let at = player.frame(secs, 1.0).world_from_joint[wrist.index()].translation;
    at.distance_to(wanted) / metres
}

fn check(gestures: &[Drawn], figure: &str) -> Result<(), TestCaseError> {
    let transcription = transcription(gestures);
    let eml = script(&transcription, Anchoring::Seconds);
    let loaded = player(&eml, figure);
    let told: Vec<_> = loaded.diagnostics.iter().map(|d| d.code).collect();
    let mut player = loaded.player;
    let phases = &transcription.layers[0].phases;
    let clauses = player.timeline().clauses.clone();
    let keys = clauses
        .iter()
        .filter(|clause| clause.end_secs - clause.start_secs > 0.0);
    let keys: Vec<(f64, f64)> = keys
        .filter(|clause| {
            phases
                .iter()
                .any(|p| (p.interval.start_secs - clause.start_secs).abs() < 1e-3)
        })
        .map(|clause| (clause.start_secs, clause.end_secs))
        .collect();
    for phase in phases {
        let Interval {
            start_secs,
            end_secs,
        } = phase.interval;
        let near = |key: &&(f64, f64)| {
            (key.0 - start_secs).abs() <= LATE_SECS && (key.1 - end_secs).abs() <= LATE_SECS
        };
        prop_assert!(
            keys.iter().any(|key| near(&key)),
            "no phase at {start_secs}: {told:?}\n{eml}"
        );
    }
    let strokes = phases
        .iter()
        .filter(|phase| phase.kind == PhaseKind::Stroke);
    for (stroke, (_, _, places, _, hands)) in strokes.zip(gestures) {
        let times = [stroke.interval.start_secs, stroke.interval.end_secs];
        for (secs, place) in times.into_iter().zip(places) {
            for side in Side::BOTH {
                let (takes_part, place) = match (hands, side) {
                    (Hands::Right, Side::Right) | (Hands::Left, Side::Left) => (true, *place),
                    (Hands::Both, Side::Right) => (true, *place),
                    (Hands::Both, Side::Left) => (true, [-place[0], place[1], place[2]]),
                    _ => (false, *place),
                };
                if takes_part {
                    let units = miss(&mut player, secs, side, place);
                    let is_told = told.contains(&"player::out-of-reach");
                    prop_assert!(
                        units < 1.0 || is_told,
                        "{units:.2} units from {place:?} at {secs} s: {told:?}\n{eml}"
                    );
                }
            }
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, ..ProptestConfig::default() })]
    #[test]
    fn hands_are_where_and_when_they_were_transcribed(gestures in drawn(), papous: bool) {
        check(&gestures, if papous { "papous" } else { "sofia" })?;
    }

    /// In another voice, the stroke stays on its word.
    #[test]
    fn strokes_begin_with_their_words(gestures in drawn()) {
        let transcription = transcription(&gestures);
        let eml = script(&transcription, Anchoring::Words);
        let player = player(&eml, "sofia").player;
        let timeline = player.timeline();
        let document = raconteur_eml::parse(&eml).document;
        let starts = timeline.clauses.iter().filter(|clause| {
            let kind = &document.clause(clause.clause).kind;
            matches!(kind, ClauseKind::GestureKey(key) if key.phase == Some(raconteur_eml::Phase::Stroke))
        });
        for (word, stroke) in starts.enumerate() {
            let mark = timeline.marks.get(format!("w{word}").as_str()).copied();
            let mark = mark.expect("the mark of the word");
            prop_assert!((stroke.start_secs - mark).abs() < 1e-6, "{} after {mark}", stroke.start_secs);
        }
    }
}
