//! The player: evaluates any moment of a story for one figure.

use std::sync::Arc;

use raconteur_actor::performance::Report;
use raconteur_actor::{Accent, Actor, FaceRig, Performance, SpokenUtterance};
use raconteur_base::order::sort_by_number;
use raconteur_base::{DVec3, Side};
use raconteur_body::{Bone, Figure, Pose};
use raconteur_eml::{ClauseKind, Diagnostic, Timeline};
use raconteur_speech::{Phone, Word};
use raconteur_stage::{Camera, Frame, Room, Shot, SpeechNow};

use crate::cues::{self, Cue, UtteranceCue};
use crate::gestures;
use crate::script::Script;
use crate::units::Units;

/// How a story is performed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// Seed of blinks, glances and idle motion.
    pub seed: u64,
    /// Idle life, from 0 (still) to 1.
    pub motion_amount: f64,
    /// How much of the speaker is in the picture.
    pub shot: Shot,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            seed: 1,
            motion_amount: 1.0,
            shot: Shot::Medium,
        }
    }
}

/// What a player needs.
pub struct StoryInput<'a> {
    /// The script's text.
    pub eml: &'a str,
    /// The JSON of its speech bundle, if it has one.
    pub bundle: Option<&'a [u8]>,
    /// Who performs.
    pub figure: Arc<Figure>,
    /// How.
    pub options: Options,
}

/// A player, and what was wrong with its story.
pub struct Loaded {
    /// Ready to be asked for frames.
    pub player: Player,
    /// Problems of the script; the rest plays.
    pub diagnostics: Vec<Diagnostic>,
}

/// Where a hand was sent and how near it came.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Manipulator {
    /// `leftArm` or `rightArm`.
    pub name: &'static str,
    /// Where the wrist was to be, world, metres.
    pub target_in_world: DVec3,
    /// Distance of the wrist from there, metres.
    pub error_m: f64,
}

/// Evaluates any moment of a story. Frames depend on the time alone, so seeking costs no
/// more than playing.
pub struct Player {
    figure: Arc<Figure>,
    actor: Actor,
    face: FaceRig,
    timeline: Timeline,
    utterances: Vec<UtteranceCue>,
    cues: Vec<Cue>,
    shot: Shot,
    room: Room,
    pose: Pose,
    frame: Frame,
}

/// Length of a hand with a margin, share of stature (0.108 in adults, ANSUR).
const HAND_LENGTH: f64 = 0.12;

/// How strongly the actor marks an emphasised word, 0..1. Designed.
const EMPHASIS_ACCENT: f64 = 1.0;

impl Player {
    /// Reads a story and prepares its performance. Never fails; see [`Loaded::diagnostics`].
    #[must_use]
    pub fn load(input: StoryInput<'_>) -> Loaded {
        let script = Script::read(input.eml, input.bundle);
        let figure = input.figure;
        let units = Units::of(&figure.skeleton);
        let utterances = cues::utterances(&script);
        let cues = cues::cues(&script, &utterances);

        let mut world = Vec::new();
        figure.skeleton.solve(&Pose::zero(), &mut world);
        let at = |bone: Bone| world[bone.index()].translation;
        let reach_m = figure.skeleton.offset_length_m(Bone::LElbow)
            + figure.skeleton.offset_length_m(Bone::LWrist);
        let mut diagnostics = script.diagnostics.clone();
        diagnostics.extend(gestures::out_of_reach(
            &script.document,
            &units,
            [at(Bone::LShoulder), at(Bone::RShoulder)],
            reach_m,
        ));
        sort_by_number(&mut diagnostics, |d| f64::from(d.span.start));

        let arms = Side::BOTH
            .map(|side| gestures::arm_script(&script.document, &script.timeline, side, &units));
        let stature_m = figure.skeleton.stature_m();
        let room = gestures::room(&arms, HAND_LENGTH * stature_m);
        let shot = input.options.shot;
        let camera = shot.frame(DVec3::ZERO, stature_m, 16.0 / 9.0, room);
        let performance = Performance {
            arms: Side::BOTH
                .map(|side| gestures::arm_script(&script.document, &script.timeline, side, &units)),
            speech: utterances.iter().map(|u| spoken(&script, u)).collect(),
            seed: input.options.seed,
            motion_amount: input.options.motion_amount,
            listener_in_world: camera.eye_in_world,
        };
        let face = FaceRig::new(&figure);
        let actor = Actor::new(&performance, &figure.skeleton);
        let frame = Frame::with_capacity(figure.skeleton.joints().len(), figure.morph_names.len());
        let player = Self {
            figure,
            actor,
            face,
            timeline: script.timeline,
            utterances,
            cues,
            shot,
            room,
            pose: Pose::zero(),
            frame,
        };
        Loaded {
            player,
            diagnostics,
        }
    }

    /// Length of the story, seconds.
    #[must_use]
    pub fn duration_secs(&self) -> f64 {
        self.timeline.duration_secs
    }

    /// Who performs.
    #[must_use]
    pub fn figure(&self) -> &Figure {
        &self.figure
    }

    /// When everything happens.
    #[must_use]
    pub fn timeline(&self) -> &Timeline {
        &self.timeline
    }

    /// What is said, in order of time.
    #[must_use]
    pub fn utterances(&self) -> &[UtteranceCue] {
        &self.utterances
    }

    /// What listeners are told, in order of time.
    #[must_use]
    pub fn cues(&self) -> &[Cue] {
        &self.cues
    }

    /// The cues after `from_secs` up to and including `to_secs`; none when time runs
    /// backwards. O(log n).
    #[must_use]
    pub fn cues_between(&self, from_secs: f64, to_secs: f64) -> &[Cue] {
        let first = self.cues.partition_point(|c| c.time_secs <= from_secs);
        let last = self.cues.partition_point(|c| c.time_secs <= to_secs);
        self.cues.get(first..last).unwrap_or_default()
    }

    /// The frame of a time, for a picture of `aspect` (width over height). Times outside
    /// the story show its first or last moment; a time that is not a number, the first.
    pub fn frame(&mut self, time_secs: f64, aspect: f64) -> &Frame {
        self.evaluate(time_secs);
        self.frame.camera = self.camera(aspect);
        &self.frame
    }

    fn camera(&self, aspect: f64) -> Camera {
        let stature_m = self.figure.skeleton.stature_m();
        self.shot.frame(DVec3::ZERO, stature_m, aspect, self.room)
    }

    /// The order of evaluation: time, body and face, joints, sound.
    fn evaluate(&mut self, time_secs: f64) -> Report {
        let t = if time_secs.is_nan() {
            0.0
        } else {
            time_secs.clamp(0.0, self.duration_secs())
        };
        self.frame.time_secs = t;
        let report = self.actor.evaluate(
            &self.figure.skeleton,
            &self.face,
            t,
            &mut self.pose,
            &mut self.frame.morph_weights,
        );
        self.figure
            .skeleton
            .solve(&self.pose, &mut self.frame.world_from_joint);
        self.frame.speech = self.speech_at(t);
        report
    }

    /// What is being said at a time.
    #[must_use]
    pub fn speech_at(&self, time_secs: f64) -> Option<SpeechNow> {
        let begun = self
            .utterances
            .partition_point(|u| u.start_secs <= time_secs);
        let index = begun.checked_sub(1)?;
        let utterance = &self.utterances[index];
        let offset_secs = time_secs - utterance.start_secs;
        if offset_secs >= utterance.duration_secs {
            return None;
        }
        let word = utterance
            .words
            .partition_point(|w| w.start_secs <= time_secs)
            .checked_sub(1)
            .filter(|&w| time_secs < utterance.words[w].end_secs);
        Some(SpeechNow {
            utterance: index,
            offset_secs,
            word,
        })
    }

    /// Where the hands are sent at a time, and how near they come.
    pub fn manipulators(&mut self, time_secs: f64) -> [Manipulator; 2] {
        let report = self.evaluate(time_secs);
        Side::BOTH.map(|side| Manipulator {
            name: match side {
                Side::Left => "leftArm",
                Side::Right => "rightArm",
            },
            target_in_world: report.wrist_goals_in_world[side.index()],
            error_m: report.arms[side.index()].error_m,
        })
    }

    /// FNV-1a (64 bits) over the bits of every joint's transform and every morph weight at a
    /// time, little-endian: equal digests mean equal poses to the last bit.
    pub fn digest(&mut self, time_secs: f64) -> u64 {
        self.evaluate(time_secs);
        let mut hash: u64 = 0xcbf2_9ce4_8422_2325;
        let mut eat = |bytes: &[u8]| {
            for byte in bytes {
                hash ^= u64::from(*byte);
                hash = hash.wrapping_mul(0x0100_0000_01b3);
            }
        };
        for joint in &self.frame.world_from_joint {
            for value in joint.to_cols_array() {
                eat(&value.to_le_bytes());
            }
        }
        for weight in &self.frame.morph_weights {
            eat(&weight.to_le_bytes());
        }
        hash
    }
}

/// What the actor needs to know of an utterance: phones for the lips, words, accents.
fn spoken(script: &Script, cue: &UtteranceCue) -> SpokenUtterance {
    let phones = match &script.document.clause(cue.clause).kind {
        ClauseKind::VoiceText(voice) => script.utterance(voice).map(|u| u.phones.clone()),
        _ => None,
    };
    SpokenUtterance {
        start_secs: cue.start_secs,
        duration_secs: cue.duration_secs,
        phones: phones.unwrap_or_else(|| murmured(cue)),
        phone_set: script.phone_set().to_owned(),
        words: cue
            .words
            .iter()
            .map(|w| Word {
                text: w.text.clone(),
                start_secs: w.start_secs - cue.start_secs,
                end_secs: w.end_secs - cue.start_secs,
            })
            .collect(),
        accents: cue
            .words
            .iter()
            .filter(|w| w.emphasized)
            .map(|w| Accent {
                offset_secs: w.start_secs - cue.start_secs,
                strength: EMPHASIS_ACCENT,
            })
            .collect(),
    }
}

/// Phones for a text that was not baked, so that the lips move with the captions: one
/// consonant and one vowel for every three letters of a word. Designed; a diagnostic has
/// said that the voice is missing.
fn murmured(cue: &UtteranceCue) -> Vec<Phone> {
    const SYLLABLES: [[&str; 2]; 4] = [["m", "aa"], ["d", "eh"], ["s", "iy"], ["n", "ow"]];
    let mut phones = Vec::new();
    let mut push = |symbol: &str, start_secs: f64, end_secs: f64, word: Option<usize>| {
        if end_secs > start_secs {
            phones.push(Phone {
                symbol: symbol.to_owned(),
                start_secs,
                end_secs,
                word,
            });
        }
    };
    let mut now = 0.0;
    for (index, word) in cue.words.iter().enumerate() {
        let (start, end) = (
            word.start_secs - cue.start_secs,
            word.end_secs - cue.start_secs,
        );
        push("pau", now, start, None);
        let letters = word.text.chars().filter(|c| c.is_alphanumeric()).count();
        let syllables = letters.div_ceil(3).clamp(1, 8);
        let step = (end - start) / syllables as f64;
        for s in 0..syllables {
            let from = start + step * s as f64;
            let [consonant, vowel] = SYLLABLES[(index + s) % SYLLABLES.len()];
            push(consonant, from, from + 0.4 * step, Some(index));
            push(vowel, from + 0.4 * step, from + step, Some(index));
        }
        now = end;
    }
    push("pau", now, cue.duration_secs, None);
    phones
}
