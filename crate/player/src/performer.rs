//! The player: evaluates any moment of a story for one figure.

use std::sync::Arc;

use raconteur_actor::performance::Report;
use raconteur_actor::{Actor, FaceRig};
use raconteur_base::order::sort_by_number;
use raconteur_base::{DVec3, Side};
use raconteur_body::{Bone, Figure, Pose};
use raconteur_eml::{Diagnostic, Timeline};
use raconteur_speech::Bundle;
use raconteur_stage::{Camera, Frame, Room, Shot, SpeechNow};

use crate::cues::{Cue, UtteranceCue};
use crate::event::Event;
use crate::gestures::{self, Reach};
use crate::layers::Layers;
use crate::live::{self, Live, Performed, Scene};
use crate::music::{self, MusicClause, MusicCue};
use crate::part::{self, Part};
use crate::script::Script;
use crate::units::Units;
use crate::views::Views;

/// How a story is performed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// Seed of blinks, glances and idle motion.
    pub seed: u64,
    /// Idle life, from 0 (still) to 1.
    pub motion_amount: f64,
    /// How much of the speaker is in the picture until the script says otherwise.
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

/// Evaluates any moment of a story, and of what joins it while it plays. Frames depend on the
/// time alone, so seeking costs no more than playing.
pub struct Player {
    figure: Arc<Figure>,
    face: FaceRig,
    units: Units,
    reach: Reach,
    options: Options,
    timeline: Timeline,
    bundle: Option<Arc<Bundle>>,
    story: Part,
    live: Live,
    layers: Layers,
    views: Views,
    /// Cues up to this time are passed.
    passed_secs: f64,
    /// Cues up to this time are told.
    told_secs: f64,
    /// The clock may pass the end.
    open_ended: bool,
    /// The latest time that the clock has come to beyond the end.
    open_until_secs: f64,
    pose: Pose,
    frame: Frame,
}

/// Length of a hand with a margin, share of stature (0.108 in adults, ANSUR).
const HAND_LENGTH: f64 = 0.12;

impl Player {
    /// Reads a story and prepares its performance. Never fails; see [`Loaded::diagnostics`].
    #[must_use]
    pub fn load(input: StoryInput<'_>) -> Loaded {
        let script = Script::read(input.eml, input.bundle);
        let figure = input.figure;
        let units = Units::of(&figure.skeleton);

        let mut world = Vec::new();
        figure.skeleton.solve(&Pose::zero(), &mut world);
        let at = |bone: Bone| world[bone.index()].translation;
        let reach = Reach {
            shoulders_in_world: [at(Bone::LShoulder), at(Bone::RShoulder)],
            arm_m: figure.skeleton.offset_length_m(Bone::LElbow)
                + figure.skeleton.offset_length_m(Bone::LWrist),
        };
        let mut diagnostics = script.diagnostics.clone();
        diagnostics.extend(gestures::out_of_reach(&script.document, &units, &reach));
        sort_by_number(&mut diagnostics, |d| f64::from(d.span.start));

        let story = Part::new(&script, &units, 0, None);
        let live = Live::new(story.utterances.len());
        let (actor, room) = rehearse(
            &figure,
            &input.options,
            Room::default(),
            [&story].into_iter(),
        );
        let morphs = figure.morph_names.len();
        let player = Self {
            views: Views::new(input.options.shot, story.shots.iter()),
            face: FaceRig::new(&figure),
            units,
            reach,
            options: input.options,
            timeline: script.timeline,
            bundle: script.bundle,
            story,
            live,
            layers: Layers::new(actor, room, morphs),
            passed_secs: -1.0,
            told_secs: -1.0,
            open_ended: false,
            open_until_secs: 0.0,
            pose: Pose::zero(),
            frame: Frame::with_capacity(figure.skeleton.joints().len(), morphs),
            figure,
        };
        Loaded {
            player,
            diagnostics,
        }
    }

    /// Length of the script, seconds; live clauses may go on beyond it.
    #[must_use]
    pub fn duration_secs(&self) -> f64 {
        self.timeline.duration_secs
    }

    /// When everything that is known is over: the script, live clauses, and the time that an
    /// open-ended performance has come to; seconds.
    #[must_use]
    pub fn end_secs(&self) -> f64 {
        self.duration_secs()
            .max(self.live.end_secs())
            .max(self.open_until_secs)
    }

    /// Whether the clock may pass the end, because more may come: while a mind listens.
    pub fn set_open_ended(&mut self, open_ended: bool) {
        self.open_ended = open_ended;
    }

    /// Who performs.
    #[must_use]
    pub fn figure(&self) -> &Figure {
        &self.figure
    }

    /// When everything in the script happens.
    #[must_use]
    pub fn timeline(&self) -> &Timeline {
        &self.timeline
    }

    /// What the script says, in order of time.
    #[must_use]
    pub fn utterances(&self) -> &[UtteranceCue] {
        &self.story.utterances
    }

    /// An utterance by the index that cues give: of the script, or of what is remembered of
    /// the live performance.
    #[must_use]
    pub fn utterance(&self, index: usize) -> Option<&UtteranceCue> {
        let live = || self.live.utterances().find(|(i, _)| *i == index);
        self.story
            .utterances
            .get(index)
            .or_else(|| live().map(|(_, u)| u))
    }

    /// What listeners are told of the script, in order of time.
    #[must_use]
    pub fn cues(&self) -> &[Cue] {
        &self.story.cues
    }

    /// The music under the story and under what joined it, by time.
    #[must_use]
    pub fn music(&self) -> Vec<MusicCue> {
        let parts = [&self.story].into_iter().chain(self.live.parts());
        let mut clauses: Vec<MusicClause> = parts
            .clone()
            .flat_map(|p| p.music.iter().cloned())
            .collect();
        sort_by_number(&mut clauses, |c| c.start_secs);
        music::cues(&clauses, parts.flat_map(|p| &p.utterances))
    }

    /// Performs EML that comes while the story plays (GEVH 3.6): a list of clauses or a whole
    /// script. Plain times count from `now_secs` (story time), names are those of the
    /// fragment, of earlier ones and of the script. `mind` tells senders apart, each of which
    /// has an allowance; see [`live::limits`].
    ///
    /// The same fragments at the same times give the same frames, however often frames are
    /// asked for between.
    pub fn perform(&mut self, mind: u32, fragment: &str, now_secs: f64) -> Performed {
        let now_secs = if now_secs.is_finite() {
            now_secs.max(0.0)
        } else {
            0.0
        };
        // What comes within one change of actors shares it, what comes soon after waits for
        // the next; after a seek to earlier times the change begins there.
        let last_secs = self.layers.last_change_secs();
        let base_secs = if last_secs - now_secs > Layers::APART_SECS {
            now_secs
        } else if last_secs >= now_secs {
            last_secs
        } else {
            now_secs.max(last_secs + Layers::APART_SECS)
        };
        let scene = Scene {
            units: &self.units,
            reach: &self.reach,
            bundle: self.bundle.as_ref(),
            marks: &self.timeline.marks,
            actor: self.layers.actor(),
        };
        let performed = self.live.admit(mind, fragment, now_secs, base_secs, &scene);
        if !performed.clauses.is_empty() {
            let parts = [&self.story].into_iter().chain(self.live.parts());
            let held = self.layers.last_room();
            let shots = parts.clone().flat_map(|p| &p.shots);
            self.views = Views::new(self.options.shot, shots);
            let (actor, room) = rehearse(&self.figure, &self.options, held, parts);
            self.layers.change(base_secs, actor, room);
        }
        performed
    }

    /// Whether a mind may send a fragment at a story time without being refused for its pace.
    #[must_use]
    pub fn has_room(&self, mind: u32, now_secs: f64) -> bool {
        self.live.has_room(mind, now_secs)
    }

    /// Lets time pass: the cues up to `time_secs` are there for [`Player::drain_events`].
    /// Time that runs backwards passes nothing; see [`Player::seek`].
    pub fn advance(&mut self, time_secs: f64) {
        if time_secs > self.passed_secs {
            self.passed_secs = time_secs;
        }
        if self.open_ended && time_secs.is_finite() {
            self.open_until_secs = self.open_until_secs.max(time_secs);
        }
    }

    /// Moves without passing the cues between; those at `time_secs` itself are still to come.
    /// Live clauses keep their times; those that a move forwards passes over are told as
    /// skipped.
    pub fn seek(&mut self, time_secs: f64) {
        let to_secs = if time_secs.is_finite() {
            time_secs.next_down()
        } else {
            -1.0
        };
        self.live.skip(self.told_secs, to_secs);
        self.passed_secs = to_secs;
        self.told_secs = to_secs;
    }

    /// What has happened since the last call, by time.
    pub fn drain_events(&mut self) -> Vec<Event> {
        let mut cues = self.live.take_cues(self.told_secs, self.passed_secs);
        let story = live::between(&self.story.cues, self.told_secs, self.passed_secs);
        if !cues.is_empty() {
            cues.extend_from_slice(story);
            sort_by_number(&mut cues, |c| c.time_secs);
        }
        self.told_secs = self.passed_secs;
        let all = if cues.is_empty() { story } else { &cues };
        all.iter().filter_map(|c| Event::new(c, self)).collect()
    }

    /// The frame of a time, for a picture of `aspect` (width over height). Times outside
    /// the story show its first or last moment, unless it is open-ended; a time that is not a
    /// number, the first.
    pub fn frame(&mut self, time_secs: f64, aspect: f64) -> &Frame {
        self.evaluate(time_secs);
        self.frame.camera = self.camera(aspect);
        &self.frame
    }

    fn camera(&self, aspect: f64) -> Camera {
        let stature_m = self.figure.skeleton.stature_m();
        let room = self.layers.room_at(self.frame.time_secs);
        self.views.camera(self.frame.time_secs, |shot| {
            shot.frame(DVec3::ZERO, stature_m, aspect, room)
        })
    }

    /// The order of evaluation: time, body and face, joints, sound.
    fn evaluate(&mut self, time_secs: f64) -> Report {
        let t = if time_secs.is_nan() {
            0.0
        } else {
            let open = self.open_ended && time_secs.is_finite();
            let end_secs = if open { time_secs } else { self.end_secs() };
            time_secs.min(end_secs).max(0.0)
        };
        self.frame.time_secs = t;
        let report = self.layers.evaluate(
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

    /// What is being said at a time; of several, what was begun last.
    #[must_use]
    pub fn speech_at(&self, time_secs: f64) -> Option<SpeechNow> {
        let story = &self.story.utterances;
        let begun = story.partition_point(|u| u.start_secs <= time_secs);
        let last = begun.checked_sub(1).map(|i| (i, &story[i]));
        let heard = |u: &UtteranceCue| {
            let offset_secs = time_secs - u.start_secs;
            (0.0..u.duration_secs).contains(&offset_secs)
        };
        let (index, utterance) = last
            .into_iter()
            .chain(self.live.utterances())
            .filter(|(_, u)| heard(u))
            .max_by(|(_, a), (_, b)| a.start_secs.total_cmp(&b.start_secs))?;
        let word = utterance
            .words
            .partition_point(|w| w.start_secs <= time_secs)
            .checked_sub(1)
            .filter(|&w| time_secs < utterance.words[w].end_secs);
        Some(SpeechNow {
            utterance: index,
            offset_secs: time_secs - utterance.start_secs,
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

/// Prepares an actor for all parts together, and the room that they need in the picture:
/// no less than `held`, so that the picture does not breathe with every gesture.
fn rehearse<'a>(
    figure: &Figure,
    options: &Options,
    held: Room,
    parts: impl Iterator<Item = &'a Part> + Clone,
) -> (Actor, Room) {
    let stature_m = figure.skeleton.stature_m();
    let rooms = parts
        .clone()
        .map(|p| gestures::room(&p.strokes, HAND_LENGTH * stature_m));
    let room = rooms.fold(held, |a, b| Room {
        top_m: a.top_m.max(b.top_m),
        half_width_m: a.half_width_m.max(b.half_width_m),
    });
    let camera = options.shot.frame(DVec3::ZERO, stature_m, 16.0 / 9.0, room);
    let performance = part::performance(parts, options, camera.eye_in_world);
    (Actor::new(&performance, &figure.skeleton), room)
}
