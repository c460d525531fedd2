//! Typed document: clauses with parsed values and unresolved times.

use crate::RunUp;
use crate::clauses::asking::{Assignment, Condition, Draw, Goto, Heading, Question, Reaction};
use crate::clauses::environment::{Camera, Emotion, Environment, Light, Music, Performer};
use crate::clauses::functions::{FunctionArgs, VhMove};
use crate::clauses::geometry::ConfigureGeometry;
use crate::clauses::manipulators::{
    ConfigureManipulator, ForwardKinematics, FrameInterpolation, Jacobian, JointInterpolation,
    Lock, ManipulatorFunction, Posture, Stop,
};
use crate::clauses::parameters::{
    AdsrControlParameter, AnimateControlParameter, LoadControlParameterAnimation,
    SetControlParameter,
};
use crate::clauses::players::{
    DeterministicAnimation, DeterministicPrimitive, DeterministicTrackProperty, PlayerAdd,
    PlayerChangePriority, PlayerRemove, PlayerSetExclusive,
};
use crate::clauses::sets::Set;
use crate::clauses::speech::{Beat, Place, VoiceChange, VoiceSay};
use crate::record::Record;
use crate::{GestureKey, Name, Span, TimeExpr, VoiceText};
use std::borrow::Cow;

/// Identifier of a clause: its index in [`Document::clauses`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ClauseId(pub u32);

impl ClauseId {
    /// Returns the index of the clause in [`Document::clauses`].
    #[must_use]
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// Parsed EML script. Clauses are stored flat in document order, so traversal, cloning and dropping
/// never recurse; groups refer to their children.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Document {
    /// The `name` of the `eml` element.
    pub name: Option<String>,
    /// Adjustment for the preparation of its first gesture (extension); `None` if unspecified.
    pub run_up: Option<RunUp>,
    /// Settings of the performing figure (extension); `None` if the script has none.
    pub performer: Option<Performer>,
    /// Span of the performer's start tag; empty if there is none.
    pub performer_span: Span,
    /// Expression of emotions by its environment, and its set (extension).
    pub environment: Option<Environment>,
    /// The named sets of tracks (GEVH D.3.3).
    pub sets: Vec<Set>,
    /// All clauses including nested ones, each group before its children.
    pub clauses: Vec<Clause>,
    /// The clauses directly in the body, in document order.
    pub roots: Vec<ClauseId>,
}

impl Document {
    /// Returns the clause of an id that came from this document or its timeline.
    ///
    /// # Panics
    /// Panics if the id comes from another, longer document.
    #[must_use]
    pub fn clause(&self, id: ClauseId) -> &Clause {
        &self.clauses[id.index()]
    }

    /// Returns the images of questions and their options, by their paths next to the story, each
    /// with the start tag that names it.
    pub fn pictures(&self) -> impl Iterator<Item = (&str, Span)> {
        self.clauses.iter().flat_map(|clause| {
            let ClauseKind::Ask(ask) = &clause.kind else {
                return Vec::new();
            };
            let options = ask.question.options.iter();
            let named = options.map(|option| (option.picture.as_deref(), option.span));
            let all = [(ask.question.picture.as_deref(), clause.tag_span)];
            let all = all.into_iter().chain(named);
            all.filter_map(|(path, span)| Some((path?, span))).collect()
        })
    }

    /// Returns all clauses with their identifiers, in document order.
    pub fn iter(&self) -> impl Iterator<Item = (ClauseId, &Clause)> {
        (0..).map(ClauseId).zip(&self.clauses)
    }
}

/// Clause of a script: one action of speech, gesture, stage or lesson, with its start time.
#[derive(Clone, Debug, PartialEq)]
pub struct Clause {
    /// The whole element, end tag included.
    pub span: Span,
    /// Span of the start tag.
    pub tag_span: Span,
    /// Start time: absolute if it is a marker or the clause is in the body, else relative to its
    /// group (GEVH D.2.4, D.2.5).
    pub start: TimeExpr,
    /// The name that other clauses may call its start (GEVH D.2.2).
    pub time_id: Option<Name>,
    /// Enclosing seq or par; `None` in the body.
    pub parent: Option<ClauseId>,
    /// Kind of the clause.
    pub kind: ClauseKind,
}

/// Kind of a clause (speech, gesture, animation, light, question and so on), with its data.
#[derive(Clone, Debug, PartialEq)]
pub enum ClauseKind {
    /// Speaks a text (GEVH D.4.1).
    VoiceText(VoiceText),
    /// Turns the gesture model on or off (GEVH D.5.1).
    GestureIsOn(bool),
    /// Moves hands through shapes, palm orientations and positions (GEVH D.5.2).
    GestureKey(GestureKey),
    /// Notifies listeners of an event (GEVH D.1.4).
    Event {
        /// The listeners' category.
        kind: Option<Name>,
        /// The character data, references resolved.
        payload: Name,
    },
    /// Keeps the script running until its time (GEVH D.1.5).
    Null,
    /// Sequence: its clauses are performed one after another (GEVH D.2.4).
    Seq(Group),
    /// Parallel group: its clauses start together (GEVH D.2.5).
    Par(Group),
    /// Moves the whole figure along a function (GEVH D.1.6).
    VhMove(VhMove),
    /// Switches parts of the drawing (GEVH D.3.4).
    ConfigureGeometry(ConfigureGeometry),
    /// Configures transitions of keyframe animations (GEVH D.3.5).
    DeterministicAnimation(DeterministicAnimation),
    /// Sets a property of tracks (GEVH D.3.6).
    DeterministicTrackProperty(Box<DeterministicTrackProperty>),
    /// Adds an animation player (GEVH D.3.11).
    PlayerAdd(PlayerAdd),
    /// Replaces all animation players by one (GEVH D.3.12).
    PlayerSetExclusive(PlayerSetExclusive),
    /// Changes the priority of a player (GEVH D.3.14).
    PlayerChangePriority(PlayerChangePriority),
    /// Removes a player (GEVH D.3.15).
    PlayerRemove(PlayerRemove),
    /// Removes all players (GEVH D.3.16).
    PlayerClear,
    /// Operates on a stack of animations (GEVH D.3.17).
    DeterministicPrimitive(Box<DeterministicPrimitive>),
    /// Switches a manipulator (GEVH D.3.19).
    ConfigureManipulator(ConfigureManipulator),
    /// Sets joints (GEVH D.3.20).
    ForwardKinematics(Box<ForwardKinematics>),
    /// Moves a limb to a target, interpolating its joints (GEVH D.3.21).
    JointInterpolation(Box<JointInterpolation>),
    /// Moves a limb to a target in a straight line (GEVH D.3.22).
    FrameInterpolation(FrameInterpolation),
    /// Moves a limb along a function (GEVH D.3.23).
    ManipulatorFunction(ManipulatorFunction),
    /// Moves a limb by inverse velocity (GEVH D.3.24).
    Jacobian(Box<Jacobian>),
    /// Stops a manipulator (GEVH D.3.25).
    ManipulatorStop(Stop),
    /// Locks the end of a limb (GEVH D.3.26).
    ManipulatorLock(Lock),
    /// Sets a control parameter (GEVH D.3.27).
    SetControlParameter(SetControlParameter),
    /// Moves a control parameter through four phases (GEVH D.3.28).
    AdsrControlParameter(Box<AdsrControlParameter>),
    /// Loads an animation of control parameters (GEVH D.3.29).
    LoadControlParameterAnimation(LoadControlParameterAnimation),
    /// Plays an animation of control parameters (GEVH D.3.30).
    AnimateControlParameter(AnimateControlParameter),
    /// Speaks a text or a file without time markers (GEVH D.4.2).
    VoiceSay(Box<VoiceSay>),
    /// Changes the voice (GEVH D.4.15).
    VoiceChange(VoiceChange),
    /// Sets the tension of the story (extension).
    Beat(Beat),
    /// Gives a referent of the speech a place on the stage (extension).
    Place(Box<Place>),
    /// Moves spine and shoulder girdle to a posture (extension).
    Posture(Box<Posture>),
    /// Elicits an emotion (extension).
    Emotion(Emotion),
    /// Sets the shot (extension).
    Camera(Camera),
    /// Changes the key light (extension).
    Light(Light),
    /// Plays music (extension).
    Music(Box<Music>),
    /// Asks a question (extension).
    Ask(Box<Ask>),
    /// Clauses performed after certain answers (extension).
    Answer(Box<Answer>),
    /// A part of the story (extension).
    Part(Box<Part>),
    /// Clauses performed under a condition (extension).
    If(Box<Branch>),
    /// Clauses of which some are performed, drawn at random (extension).
    Pool(Box<Pool>),
    /// Sets a variable (extension).
    Set(Box<Assignment>),
    /// Continues the story at a part (extension).
    Goto(Goto),
}

impl ClauseKind {
    /// Returns the name of the EML element.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Self::VoiceText(_) => "voice-text",
            Self::GestureIsOn(_) => "gesture-is-on",
            Self::GestureKey(_) => "gesture-key",
            Self::Event { .. } => "event",
            Self::Null => "null",
            Self::Seq(_) => "seq",
            Self::Par(_) => "par",
            Self::VhMove(_) => "vh-move",
            Self::ConfigureGeometry(_) => "body-configure-geometry",
            Self::DeterministicAnimation(_) => "body-configure-deterministic-animation",
            Self::DeterministicTrackProperty(_) => "body-configure-deterministic-track-property",
            Self::PlayerAdd(_) => "body-player-add",
            Self::PlayerSetExclusive(_) => "body-player-set-exclusive",
            Self::PlayerChangePriority(_) => "body-player-change-priority",
            Self::PlayerRemove(_) => "body-player-remove",
            Self::PlayerClear => "body-player-clear",
            Self::DeterministicPrimitive(_) => "body-deterministic-primitive",
            Self::ConfigureManipulator(_) => "body-configure-manipulator",
            Self::ForwardKinematics(_) => "body-non-deterministic-fk",
            Self::JointInterpolation(_) => "body-non-deterministic-joint-interpolation",
            Self::FrameInterpolation(_) => "body-non-deterministic-frame-interpolation",
            Self::ManipulatorFunction(_) => "body-non-deterministic-function",
            Self::Jacobian(_) => "body-non-deterministic-jacobian",
            Self::ManipulatorStop(_) => "body-non-deterministic-stop",
            Self::ManipulatorLock(_) => "body-non-deterministic-lock",
            Self::SetControlParameter(_) => "body-set-control-parameter",
            Self::AdsrControlParameter(_) => "body-animate-ADSR-control-parameter",
            Self::LoadControlParameterAnimation(_) => "body-load-control-parameter-animation",
            Self::AnimateControlParameter(_) => "body-animate-control-parameter",
            Self::VoiceSay(_) => "voice-say",
            Self::VoiceChange(_) => "voice-change",
            Self::Beat(_) => "beat",
            Self::Place(_) => "place",
            Self::Posture(_) => "posture",
            Self::Emotion(_) => "emotion",
            Self::Camera(_) => "camera",
            Self::Light(_) => "light",
            Self::Music(_) => "music",
            Self::Ask(_) => "ask",
            Self::Answer(_) => "answer",
            Self::Part(_) => "part",
            Self::If(_) => "if",
            Self::Pool(_) => "pool",
            Self::Set(_) => "set",
            Self::Goto(_) => "goto",
        }
    }

    /// Returns the clause as a record of attributes and children; `None` if it has other content.
    pub(crate) fn record(&mut self) -> Option<&mut dyn Record> {
        let record: &mut dyn Record = match self {
            Self::VhMove(record) => record,
            Self::ConfigureGeometry(record) => record,
            Self::DeterministicAnimation(record) => record,
            Self::DeterministicTrackProperty(record) => record.as_mut(),
            Self::PlayerAdd(record) => record,
            Self::PlayerSetExclusive(record) => record,
            Self::PlayerChangePriority(record) => record,
            Self::PlayerRemove(record) => record,
            Self::DeterministicPrimitive(record) => record.as_mut(),
            Self::ConfigureManipulator(record) => record,
            Self::ForwardKinematics(record) => record.as_mut(),
            Self::JointInterpolation(record) => record.as_mut(),
            Self::FrameInterpolation(record) => record,
            Self::ManipulatorFunction(record) => record,
            Self::Jacobian(record) => record.as_mut(),
            Self::ManipulatorStop(record) => record,
            Self::ManipulatorLock(record) => record,
            Self::SetControlParameter(record) => record,
            Self::AdsrControlParameter(record) => record.as_mut(),
            Self::LoadControlParameterAnimation(record) => record,
            Self::AnimateControlParameter(record) => record,
            Self::VoiceSay(record) => record.as_mut(),
            Self::VoiceChange(record) => record,
            Self::Beat(record) => record,
            Self::Place(record) => record.as_mut(),
            Self::Posture(record) => record.as_mut(),
            Self::Emotion(record) => record,
            Self::Camera(record) => record,
            Self::Light(record) => record,
            Self::Music(record) => record.as_mut(),
            Self::Ask(ask) => &mut ask.question,
            Self::Answer(answer) => &mut answer.reaction,
            Self::Part(part) => &mut part.heading,
            Self::If(branch) => &mut branch.condition,
            Self::Pool(pool) => &mut pool.draw,
            Self::Set(assignment) => assignment.as_mut(),
            Self::Goto(goto) => goto,
            Self::VoiceText(_)
            | Self::GestureIsOn(_)
            | Self::GestureKey(_)
            | Self::Event { .. }
            | Self::Null
            | Self::PlayerClear
            | Self::Seq(_)
            | Self::Par(_) => return None,
        };
        Some(record)
    }

    /// Returns the spoken text; empty if the words are known only to its voice.
    #[must_use]
    pub fn spoken_text(&self) -> Option<Cow<'_, VoiceText>> {
        match self {
            Self::VoiceText(text) => Some(Cow::Borrowed(text)),
            Self::VoiceSay(say) => say.spoken_text().map(Cow::Owned),
            _ => None,
        }
    }

    /// Returns its own duration, seconds, without speech and group members. A looping function
    /// counts one period; a clause that runs until it is stopped counts 0.
    #[must_use]
    pub fn own_length_secs(&self) -> f64 {
        let period =
            |args: &Option<FunctionArgs>| args.as_ref().map_or(0.0, FunctionArgs::period_secs);
        match self {
            Self::GestureKey(gesture) => gesture.duration_secs,
            Self::Posture(posture) => posture.duration_secs,
            Self::VhMove(function) => period(&function.args),
            Self::ManipulatorFunction(function) => period(&function.args),
            Self::DeterministicTrackProperty(property) => property.duration_secs,
            Self::ForwardKinematics(fk) => fk.length_secs(),
            Self::JointInterpolation(motion) => motion.static_time_secs.unwrap_or(0.0),
            Self::FrameInterpolation(motion) => motion.period_secs,
            Self::AdsrControlParameter(adsr) => {
                adsr.attack_secs + adsr.decay_secs + adsr.sustain_secs + adsr.release_secs
            }
            Self::Emotion(emotion) => emotion.duration_secs,
            Self::Camera(camera) => camera.transition_secs,
            Self::Light(light) => light.transition_secs,
            Self::Music(music) => music.fade_secs,
            _ => 0.0,
        }
    }

    /// Returns the group of contained clauses; `None` for a clause without children.
    #[must_use]
    pub fn group(&self) -> Option<&Group> {
        match self {
            Self::Seq(group) | Self::Par(group) => Some(group),
            Self::Ask(ask) => Some(&ask.answers),
            Self::Answer(answer) => Some(&answer.content),
            Self::Part(part) => Some(&part.content),
            Self::If(branch) => Some(&branch.content),
            Self::Pool(pool) => Some(&pool.content),
            _ => None,
        }
    }

    /// Returns the mutable group of contained clauses, see [`ClauseKind::group`].
    pub(crate) fn group_mut(&mut self) -> Option<&mut Group> {
        match self {
            Self::Seq(group) | Self::Par(group) => Some(group),
            Self::Ask(ask) => Some(&mut ask.answers),
            Self::Answer(answer) => Some(&mut answer.content),
            Self::Part(part) => Some(&mut part.content),
            Self::If(branch) => Some(&mut branch.content),
            Self::Pool(pool) => Some(&mut pool.content),
            _ => None,
        }
    }

    /// Returns true if the contained clauses are performed one after another.
    #[must_use]
    pub fn is_sequence(&self) -> bool {
        matches!(self, Self::Seq(_) | Self::Ask(_) | Self::Pool(_))
    }
}

/// Contained clauses of a seq, par or other group, with the number of repetitions.
#[derive(Clone, Debug, PartialEq)]
pub struct Group {
    /// The clauses directly inside, in document order.
    pub children: Vec<ClauseId>,
    /// Number of repetitions, at least 1 (GEVH D.2.6).
    pub repetition_count: u32,
    /// Span of the count, else of the start tag.
    pub repetition_span: Span,
    /// Length of one iteration in seconds; `None`: the length of the content.
    pub iteration_secs: Option<f64>,
}

/// Question of a lesson with the reactions to its answers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Ask {
    /// Question to ask.
    pub question: Question,
    /// Reactions to its answers, sequential in the timeline; the one to perform is known only after
    /// the answer.
    pub answers: Group,
}

/// Reaction to certain answers of a question: clauses performed after them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Answer {
    /// Answers that trigger the reaction.
    pub reaction: Reaction,
    /// Clauses of the reaction, performed in parallel.
    pub content: Group,
}

/// Named part of the story, a possible destination of a jump.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Part {
    /// Title of the part.
    pub heading: Heading,
    /// Clauses of the part, performed in parallel.
    pub content: Group,
}

/// Clauses performed under a condition; the timeline always reserves time for them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Branch {
    /// Condition under which the clauses are performed.
    pub condition: Condition,
    /// Clauses of the branch, performed in parallel.
    pub content: Group,
}

/// Pool of clauses from which some are drawn at random for each learner; the timeline reserves time
/// for all.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Pool {
    /// Number of clauses to draw.
    pub draw: Draw,
    /// Clauses of the pool, performed in sequence.
    pub content: Group,
}

impl Default for Group {
    fn default() -> Self {
        Self {
            children: Vec::new(),
            repetition_count: 1,
            repetition_span: Span::default(),
            iteration_secs: None,
        }
    }
}
