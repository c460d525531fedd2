//! Transcriptions to EML to pose: phases at their times, hands at their places.

use std::fs;
use std::path::Path;
use std::process::Command;

use proptest::prelude::*;
use raconteur_annotate::gestura::{
    Dimension, Form, Hands, Interval, Layer, Meaning, Noted, Phase, PhaseKind, Phrase, Statistics,
    Transcription, Word,
};
use raconteur_annotate::gsl::{self, Palm, Shape};
use raconteur_annotate::{Anchoring, anvil, import, read_transcription};
use raconteur_base::{Length as _, Side};
use raconteur_body::Bone;
use raconteur_body::read::read_figure;
use raconteur_eml::{ClauseKind, Severity, Span, write};
use raconteur_player::{LoadedPlayer, Options, Player, StoryInput};
use raconteur_tier::is_long;

/// Tolerance of phase times, seconds.
const LATE_SECS: f64 = 0.02;

fn noted<F: gsl::Feature>(text: &str) -> Option<Noted<F>> {
    let value = gsl::parse(text).unwrap_or_else(|error| panic!("{text}: {error}"));
    Some(Noted::formal(value))
}

/// Gesture of a random transcription: its gap, its lengths, and places in front of the body or inside it.
type Drawn = (f64, [f64; 3], [[f64; 3]; 2], u8, Hands);

fn drawn() -> impl Strategy<Value = Vec<Drawn>> {
    let place = || (4.0..14.0, 8.0..22.0, 3.0..15.0);
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
    load(eml, None, figure)
}

fn load(eml: &str, bundle: Option<&[u8]>, figure: &str) -> LoadedPlayer {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets/figures");
    let bytes = fs::read(path.join(format!("{figure}.glb"))).expect("the figure");
    Player::load(StoryInput {
        eml,
        bundle,
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
                    let is_told = ["player::out-of-reach", "player::in-body"]
                        .iter()
                        .any(|code| told.contains(code));
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

/// The gate measures one of this many gestures.
const SAMPLED: usize = 9;

/// Stories whose source is an annotation.
const TOLD: [&str; 2] = ["papous/the-white-rabbit", "papous/o-coelhinho-branco"];

fn shipped(story: &str, file: &str) -> Vec<u8> {
    let stories = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets/stories");
    let path = stories.join(story).join(file);
    fs::read(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

#[test]
fn the_script_of_a_told_story_is_that_of_its_annotation() {
    for story in TOLD {
        let folder = tempfile::tempdir().expect("a folder");
        let voice = folder.path().join("voice");
        fs::create_dir(&voice).expect("a folder");
        let bundle = shipped(story, "voice/speech.json");
        fs::write(voice.join("speech.json"), bundle).expect("the bundle is written");
        let annotation = folder.path().join("annotation.anvil");
        fs::write(&annotation, shipped(story, "annotation.anvil")).expect("a file is written");
        let script = folder.path().join("story.eml");
        let out = Command::new(env!("CARGO_BIN_EXE_raconteur"))
            .arg("import")
            .arg(&annotation)
            .arg("-o")
            .arg(&script)
            .output()
            .expect("the program runs");
        assert!(
            out.status.success(),
            "{story}: {}",
            String::from_utf8_lossy(&out.stderr)
        );
        let made = fs::read(&script).expect("the script");
        assert!(
            made == shipped(story, "story.eml"),
            "{story}: import the annotation again"
        );
    }
}

/// Loads a told story with its voice and without idle motion.
fn told(story: &str) -> LoadedPlayer {
    let eml = String::from_utf8(shipped(story, "story.eml")).expect("text");
    let bundle = shipped(story, "voice/speech.json");
    load(&eml, Some(&bundle), "papous")
}

#[test]
fn all_gestures_of_the_told_stories_are_where_and_when_they_were_annotated() {
    for story in TOLD {
        let read = read_transcription(&shipped(story, "annotation.anvil"), None);
        let errors = read
            .diagnostics
            .iter()
            .filter(|d| d.severity == Severity::Error);
        assert_eq!(errors.count(), 0, "{story}: {:?}", read.diagnostics);
        let gestures = Statistics::new(&read.transcription).gestures;
        assert!(gestures >= 286, "{story} has {gestures} gestures");
        let loaded = told(story);
        let codes: Vec<_> = loaded.diagnostics.iter().map(|d| d.code).collect();
        let known = ["player::no-animation"];
        assert!(
            codes.iter().all(|code| known.contains(code)),
            "{story}: {codes:?}"
        );
        let mut player = loaded.player;
        let clauses = player.timeline().clauses.clone();
        let starts: Vec<(f64, f64)> = clauses
            .iter()
            .map(|clause| (clause.start_secs, clause.end_secs))
            .collect();
        let layer = &read.transcription.layers[0];
        let mut worst_secs = 0.0_f64;
        let mut misses = Vec::new();
        for phase in &layer.phases {
            let Interval {
                start_secs,
                end_secs,
            } = phase.interval;
            let off =
                |&(start, end): &(f64, f64)| (start - start_secs).abs().max((end - end_secs).abs());
            let near = starts.partition_point(|(start, _)| *start < start_secs - 0.5);
            let near = &starts[near..(near + 40).min(starts.len())];
            worst_secs = worst_secs.max(near.iter().map(off).fold(f64::INFINITY, f64::min));
        }
        // Each frame of a story of eight minutes costs milliseconds.
        let step = if is_long() { 1 } else { SAMPLED };
        for phrase in layer.phrases.iter().step_by(step) {
            let phases = layer.phases_of(phrase);
            let stroke = phases.iter().find(|phase| phase.kind == PhaseKind::Stroke);
            let stroke = stroke.expect("a stroke");
            let motion = stroke
                .form
                .motion
                .as_ref()
                .and_then(|noted| noted.value.as_ref());
            let motion = motion.expect("a motion");
            for side in Side::BOTH {
                let mirrored = side == Side::Left && matches!(motion, gsl::Value::Common(_));
                let takes_part = match phrase.handedness.expect("hands") {
                    Hands::Both => true,
                    Hands::Right => side == Side::Right,
                    Hands::Left => side == Side::Left,
                };
                let mirrored = mirrored && phrase.handedness == Some(Hands::Both);
                let Some(sequence) = motion.for_hand(side).filter(|_| takes_part) else {
                    continue;
                };
                let times = sequence.offsets_secs(stroke.interval.length_secs());
                for (item, time) in sequence.items.iter().zip(times) {
                    let [x, y, z] = item.feature.0;
                    let place = [if mirrored { -x } else { x }, y, z];
                    let secs = stroke.interval.start_secs + time;
                    let units = miss(&mut player, secs, side, place);
                    if units >= 1.0 {
                        misses.push((secs, side, units));
                    }
                }
            }
        }
        assert!(
            worst_secs <= LATE_SECS,
            "{story}: a phase is {worst_secs} s off"
        );
        assert_eq!(misses, [], "{story}: hands, more than a unit off");
    }
}
