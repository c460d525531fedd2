//! The typed document: clauses with their values read, times not yet resolved.

use crate::RunUp;
use crate::clauses::asking::{Assignment, Condition, Draw, Goto, Heading, Question, Reaction};
use crate::clauses::environment::{Camera, Emotion, Environment, Light, Music, Performer};
use crate::clauses::functions::{FunctionArgs, VhMove};
use crate::clauses::geometry::ConfigureGeometry;
use crate::clauses::manipulators::{
    ConfigureManipulator, ForwardKinematics, FrameInterpolation, Jacobian, JointInterpolation,
    Lock, ManipulatorFunction, Stop,
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
use crate::clauses::speech::{Beat, VoiceChange, VoiceSay};
use crate::record::Record;
use crate::{GestureKey, Name, Span, TimeExpr, VoiceText};
use std::borrow::Cow;

/// The place of a clause in [`Document::clauses`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ClauseId(pub u32);

impl ClauseId {
    /// The index into [`Document::clauses`].
    #[must_use]
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// An EML script. Clauses lie flat in document order, so that walking, cloning and
/// dropping never recurse; groups name their children.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Document {
    /// The `name` of the `eml` element.
    pub name: Option<String>,
    /// What gives way to the preparation of its first gesture (extension); none where it does not say.
    pub run_up: Option<RunUp>,
    /// Who performs it (extension).
    pub performer: Option<Performer>,
    /// The start tag that says so; empty where none does.
    pub performer_span: Span,
    /// How its environment expresses emotions, and where it is told (extension).
    pub environment: Option<Environment>,
    /// The named sets of tracks (GEVH D.3.3).
    pub sets: Vec<Set>,
    /// Every clause, nested ones included, each group before its children.
    pub clauses: Vec<Clause>,
    /// The clauses directly in the body, in document order.
    pub roots: Vec<ClauseId>,
}

impl Document {
    /// The clause of an id that came from this document or its timeline.
    ///
    /// # Panics
    /// When the id comes from another, longer document.
    #[must_use]
    pub fn clause(&self, id: ClauseId) -> &Clause {
        &self.clauses[id.index()]
    }

    /// The pictures of questions and their options, by their paths beside the story, each with the
    /// start tag that names it.
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

    /// Every clause with its id, in document order.
    pub fn iter(&self) -> impl Iterator<Item = (ClauseId, &Clause)> {
        (0..).map(ClauseId).zip(&self.clauses)
    }
}

/// One thing to do at one time.
#[derive(Clone, Debug, PartialEq)]
pub struct Clause {
    /// The whole element, end tag included.
    pub span: Span,
    /// The start tag.
    pub tag_span: Span,
    /// When it starts: absolute when it names a moment or stands in the body, else
    /// relative to its group (GEVH D.2.4, D.2.5).
    pub start: TimeExpr,
    /// The name that other clauses may call its start (GEVH D.2.2).
    pub time_id: Option<Name>,
    /// The seq or par it stands in; none in the body.
    pub parent: Option<ClauseId>,
    /// What it does.
    pub kind: ClauseKind,
}

/// What a clause does.
#[derive(Clone, Debug, PartialEq)]
pub enum ClauseKind {
    /// Speaks a text (GEVH D.4.1).
    VoiceText(VoiceText),
    /// Turns the gesture model on or off (GEVH D.5.1).
    GestureIsOn(bool),
    /// Moves hands through shapes, palm orientations and positions (GEVH D.5.2).
    GestureKey(GestureKey),
    /// Tells listeners that something happened (GEVH D.1.4).
    Event {
        /// The listeners' category.
        kind: Option<Name>,
        /// The character data, references resolved.
        payload: Name,
    },
    /// Keeps the script running until its time (GEVH D.1.5).
    Null,
    /// Its clauses one after another (GEVH D.2.4).
    Seq(Group),
    /// Its clauses together (GEVH D.2.5).
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
    /// Brings a limb to a target by its joints (GEVH D.3.21).
    JointInterpolation(Box<JointInterpolation>),
    /// Brings a limb to a target on a straight way (GEVH D.3.22).
    FrameInterpolation(FrameInterpolation),
    /// Moves a limb along a function (GEVH D.3.23).
    ManipulatorFunction(ManipulatorFunction),
    /// Moves a limb by inverse velocity (GEVH D.3.24).
    Jacobian(Box<Jacobian>),
    /// Stops a manipulator (GEVH D.3.25).
    ManipulatorStop(Stop),
    /// Holds the end of a limb (GEVH D.3.26).
    ManipulatorLock(Lock),
    /// Sets a control parameter (GEVH D.3.27).
    SetControlParameter(SetControlParameter),
    /// Leads a control parameter through four phases (GEVH D.3.28).
    AdsrControlParameter(Box<AdsrControlParameter>),
    /// Loads an animation of control parameters (GEVH D.3.29).
    LoadControlParameterAnimation(LoadControlParameterAnimation),
    /// Plays an animation of control parameters (GEVH D.3.30).
    AnimateControlParameter(AnimateControlParameter),
    /// Speaks a text or a file without time markers (GEVH D.4.2).
    VoiceSay(Box<VoiceSay>),
    /// Changes the voice (GEVH D.4.15).
    VoiceChange(VoiceChange),
    /// Says how tense the story is (extension).
    Beat(Beat),
    /// Elicits an emotion (extension).
    Emotion(Emotion),
    /// Takes a shot (extension).
    Camera(Camera),
    /// Changes the key light (extension).
    Light(Light),
    /// Plays music (extension).
    Music(Box<Music>),
    /// Asks something (extension).
    Ask(Box<Ask>),
    /// What is performed after certain answers (extension).
    Answer(Box<Answer>),
    /// A part of the story (extension).
    Part(Box<Part>),
    /// What is performed under a condition (extension).
    If(Box<Branch>),
    /// Of what is in it some is performed, by chance (extension).
    Pool(Box<Pool>),
    /// A variable takes a value (extension).
    Set(Box<Assignment>),
    /// The story goes on at a part (extension).
    Goto(Goto),
}

impl ClauseKind {
    /// The name of the element.
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

    /// The attributes and children, when they are all that it consists of.
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

    /// The text that it speaks; empty where only its voice knows the words.
    #[must_use]
    pub fn spoken_text(&self) -> Option<Cow<'_, VoiceText>> {
        match self {
            Self::VoiceText(text) => Some(Cow::Borrowed(text)),
            Self::VoiceSay(say) => say.spoken_text().map(Cow::Owned),
            _ => None,
        }
    }

    /// How long it takes by itself, in seconds: neither speech nor the members of a group. A
    /// function in a loop takes one period; what goes on until something stops it takes
    /// no time.
    #[must_use]
    pub fn own_length_secs(&self) -> f64 {
        let period =
            |args: &Option<FunctionArgs>| args.as_ref().map_or(0.0, FunctionArgs::period_secs);
        match self {
            Self::GestureKey(gesture) => gesture.duration_secs,
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

    /// The clauses in it, when it holds some.
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

    /// As [`ClauseKind::group`].
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

    /// Whether the clauses in it follow each other.
    #[must_use]
    pub fn is_sequence(&self) -> bool {
        matches!(self, Self::Seq(_) | Self::Ask(_) | Self::Pool(_))
    }
}

/// The content of a seq or a par.
#[derive(Clone, Debug, PartialEq)]
pub struct Group {
    /// The clauses directly inside, in document order.
    pub children: Vec<ClauseId>,
    /// How often the content plays, at least 1 (GEVH D.2.6).
    pub repetition_count: u32,
    /// Where the count is written, else the start tag.
    pub repetition_span: Span,
    /// The length of one iteration in seconds; none: as long as the content.
    pub iteration_secs: Option<f64>,
}

/// A question, with what follows from its answers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Ask {
    /// The question.
    pub question: Question,
    /// Its answers, one after another in the timeline; which of them is performed is only known
    /// when somebody has answered.
    pub answers: Group,
}

/// What is performed after certain answers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Answer {
    /// After which.
    pub reaction: Reaction,
    /// Its clauses, together.
    pub content: Group,
}

/// A part of the story.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Part {
    /// What it is called.
    pub heading: Heading,
    /// Its clauses, together.
    pub content: Group,
}

/// What is performed under a condition; the timeline has room for it in any case.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Branch {
    /// When it is performed.
    pub condition: Condition,
    /// Its clauses, together.
    pub content: Group,
}

/// Clauses of which some are performed, drawn anew for each learner; the timeline has room for all.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Pool {
    /// How many.
    pub draw: Draw,
    /// Its clauses, one after another.
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
