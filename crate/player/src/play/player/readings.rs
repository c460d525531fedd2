//! Queries of a time in addition to its frame: the spoken word, targets of the hands, a digest of
//! the pose.

use raconteur_actor::gesture::{PlannedKey, RestSpot};
use raconteur_base::{DAffine3, DVec3, Side};
use raconteur_stage::{Angle, CurrentSpeech, EmotionType, Illumination, Mood, Shot};

use super::{Manipulator, Player};

/// Emotion that the environment expresses at a time, with the resulting camera, light and music
/// (GEVH 3.5.4).
#[derive(Clone, Debug, PartialEq)]
pub struct EnvironmentExpression {
    /// Strongest emotion, if any.
    pub emotion: Option<&'static EmotionType>,
    /// Potential (strength) of the emotion, 0 to 10.
    pub potential: f64,
    /// Current intensity, 0 to 10.
    pub intensity: f64,
    /// Current or destination shot.
    pub shot: Shot,
    /// Vertical camera angle of the shot.
    pub angle: Angle,
    /// Change of the light.
    pub light: Illumination,
    /// Mood that drives the music.
    pub mood: Mood,
    /// Files of the audible music.
    pub music: Vec<String>,
}

impl Player {
    /// Returns the environment's expression of emotions at a time.
    #[must_use]
    pub fn environment_expression(&self, time_secs: f64) -> EnvironmentExpression {
        let felt = self.emotions.strongest(time_secs, None);
        let take = self.shots.shots().sample(time_secs);
        let music = self.music().into_iter();
        let heard = music.filter(|cue| cue.level_at(time_secs) > 0.0);
        EnvironmentExpression {
            emotion: felt.map(|f| f.kind),
            potential: felt.map_or(0.0, |f| f.potential),
            intensity: felt.map_or(0.0, |f| f.intensity_at(time_secs)),
            shot: take.shot,
            angle: take.angle,
            light: self.shots.illumination(time_secs),
            mood: self.emotions.mood(time_secs),
            music: heard.map(|cue| cue.file).collect(),
        }
    }

    /// Returns the start and length of each shot requested by an emotion, story seconds; the length
    /// lasts until emotions change it.
    pub(crate) fn emotion_shots(&self) -> Vec<(f64, f64)> {
        let takes = self.shots.shots().later().windows(2);
        let lengths = takes.filter_map(|pair| {
            let [take, next] = pair else { return None };
            let led = take.is_by_emotion || next.is_by_emotion;
            (led && !next.is_written)
                .then_some((take.start_secs, next.start_secs - take.start_secs))
        });
        lengths.collect()
    }

    /// Returns true if an emotion has set the shot held from one time to another; `None` if the
    /// camera changes shots.
    pub(crate) fn sustained_shot(&self, from_secs: f64, to_secs: f64) -> Option<bool> {
        let shots = self.shots.shots();
        let take = shots.sample(to_secs);
        let is_kept = take == shots.sample(from_secs) && !shots.moves(from_secs);
        is_kept.then_some(take.is_by_emotion)
    }

    /// Returns the utterance and word audible at a time; of several, the last to begin.
    #[must_use]
    pub fn speech_at(&self, time_secs: f64) -> Option<CurrentSpeech> {
        let (index, cue) = self.scripts.utterance_at(time_secs)?;
        let timed = &cue.timed;
        let words = &timed.utterance.words;
        let word = words
            .partition_point(|w| timed.story_secs(w.start_secs) <= time_secs)
            .checked_sub(1)
            .filter(|&w| time_secs < timed.story_secs(words[w].end_secs));
        Some(CurrentSpeech {
            utterance: index,
            offset_secs: timed.offset_secs(time_secs),
            word,
        })
    }

    /// Returns the targets of the hands at a time, and their errors.
    pub fn hand_targets(&mut self, time_secs: f64) -> [Manipulator; 2] {
        // An idle figure is elsewhere than the story's figure.
        let shown = self.frame.clone();
        let report = self.evaluate(time_secs);
        self.frame = shown;
        Side::BOTH.map(|side| Manipulator {
            name: match side {
                Side::Left => "leftArm",
                Side::Right => "rightArm",
            },
            target_in_world: report.wrist_goals_in_world[side.index()],
            error_m: report.wrist_errors_m[side.index()],
        })
    }

    /// Returns world from figure axes at a time, following the moves in the script.
    #[must_use]
    pub fn world_from_figure(&self, time_secs: f64) -> DAffine3 {
        let moved = self.actors.actor().world_from_figure(time_secs);
        moved.unwrap_or(DAffine3::IDENTITY)
    }

    /// Returns world from gesture space at a time: scripted places follow where the figure stands
    /// and faces.
    #[must_use]
    pub fn world_from_gestures(&self, time_secs: f64) -> DAffine3 {
        self.actors.actor().world_from_gestures(time_secs)
    }

    /// Returns true if the script cuts a limb to other joints after one time and up to another,
    /// story time.
    pub(crate) fn cuts_between(&self, after_secs: f64, to_secs: f64) -> bool {
        self.actors.actor().cuts_between(after_secs, to_secs)
    }

    /// Returns the starts of a hand's strokes, story time, and the first wrist position of each,
    /// limited to reach, in gesture space ([`Player::world_from_gestures`]), metres.
    pub fn strokes(&self, side: Side) -> Vec<(f64, DVec3)> {
        let keys = self.actors.actor().plan(side).keys().iter();
        keys.filter(|k| k.begins_stroke)
            .filter_map(|k| Some((k.time_secs, k.wrist_in_world?)))
            .collect()
    }

    /// Returns the planned keys of a hand, in the order of planning.
    pub(crate) fn planned_keys(&self, side: Side) -> &[PlannedKey] {
        self.actors.actor().plan(side).keys()
    }

    /// Returns the posture in which an arm rests at a story time; `None` if it gestures.
    pub(crate) fn rest_spot(&self, side: Side, time_secs: f64) -> Option<RestSpot> {
        let t = self.clock.shown_secs(time_secs, self.end_secs());
        self.actors.actor().plan(side).rest_spot_at(t)
    }

    /// Evaluates the joints at a story time, world from joint, without tissue, hair, light and the
    /// idle behaviour before playback. The frame stays unchanged.
    pub(crate) fn solve_joints(&mut self, time_secs: f64, world_from_joint: &mut Vec<DAffine3>) {
        let t = self.clock.shown_secs(time_secs, self.end_secs());
        let (pose, weights) = (&mut self.scratch.pose, &mut self.scratch.morph_weights);
        let skeleton = &self.cast.figure.skeleton;
        (self.actors).evaluate(skeleton, &self.cast.face, t, pose, weights);
        skeleton.solve(pose, world_from_joint);
    }

    /// Returns true if the script positions a hand at a time, story time, while its shots make room
    /// for hands.
    pub(crate) fn is_in_seen_stroke(&self, side: Side, time_secs: f64) -> bool {
        if !self.shots.shots().makes_room(time_secs) {
            return false;
        }
        let mut strokes = self.scripts.plans().flat_map(|p| &p.strokes[side.index()]);
        strokes.any(|s| {
            let goes = s.keys.iter().any(|k| k.wrist_in_world.is_some());
            goes && (s.start_secs..=s.end_secs).contains(&time_secs)
        })
    }

    /// Returns the 64-bit FNV-1a hash over the bits of all joint transforms, morph weights and
    /// tissue nodes at a time, little-endian; equal digests mean bit-identical poses.
    pub fn digest(&mut self, time_secs: f64) -> u64 {
        self.forget_welcome();
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
        for node in &self.frame.tissue {
            let moved = node.displacement.iter().chain(&node.normal_delta);
            for value in moved.chain(&node.wrinkles).chain([&node.blush]) {
                eat(&value.to_le_bytes());
            }
        }
        hash
    }
}
