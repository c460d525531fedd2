//! Expression Markup Language (GEVH appendix D): text to typed document to timeline.
//!
//! Scope: parsing of EML with recovery from any malformed part, checks against one table of
//! elements ([`schema::ELEMENTS`]), problems as data with byte spans ([`Diagnostic`]), and
//! resolution of every time expression to seconds ([`Timeline::resolve`]).
//! Out of scope: file access, fetching of entities or references, speech synthesis (it queries
//! [`Durations`]) and the effect of clauses on a body.
//!
//! Values keep EML's own units and axes: seconds, degrees, skeleton units; `x` to the speaker's
//! left, `y` up, `z` to the back. Consumers convert them.

mod check;
mod clauses;
mod decode;
mod diagnostic;
mod document;
mod durations;
pub mod emoticon;
mod gesture;
mod hints;
mod limits;
mod markup;
mod namespaces;
pub mod narration;
mod parse;
mod question_checks;
mod questions;
mod record;
pub mod reference;
pub mod schema;
mod sorted;
mod span;
mod suggest;
mod syntax;
mod text_emotion;
mod time_expr;
mod timeline;
mod voice;
mod words;
mod work;
mod write;

pub use clauses::asking::{
    AskKind, AskOption, Assignment, Condition, Goto, Heading, Question, Reaction,
};
pub use clauses::environment::{
    Arousal, Camera, CameraAngle, ControlSource, Emotion, EmotionKind, EmotionSpace, Environment,
    Expressions, Fidelity, Light, Music, Performer, Piece, PreferredHand, RunUp, ShotKind,
    StageSet, Valence,
};
pub use clauses::functions::{Arg, ArgValue, FunctionArgs, VhMove};
pub use clauses::geometry::{ConfigureGeometry, FillMode, VisibleMeshes};
pub use clauses::manipulators::{
    ConfigureManipulator, ForwardKinematics, FrameInterpolation, Jacobian, JointInterpolation,
    Lock, MAX_COORDINATE, Manipulator, ManipulatorFunction, Posture, Stop, Target,
};
pub use clauses::parameters::{
    AdsrControlParameter, AnimateControlParameter, LoadControlParameterAnimation,
    SetControlParameter, Style,
};
pub use clauses::players::{
    AnimationStyle, Bones, DeterministicAnimation, DeterministicPrimitive,
    DeterministicTrackProperty, PlaybackStyle, PlayerAdd, PlayerChangePriority, PlayerKind,
    PlayerRemove, PlayerSetExclusive, PrimitiveKind, TrackProperty, Tracks, Transition,
};
pub use clauses::sets::{
    BODY_GROUPS, BONES, Member, MemberKind, Set, SetKind, items_of, layer_number,
};
pub use clauses::speech::{
    Age, Audio, AudioMode, Beat, Boundary, Emph, Engine, Gender, Language, Level, Markup, Pitch,
    Place, Pron, Rate, SayAs, SayAsMode, SayAsType, Speaker, UtteranceKind, VoiceChange,
    VoiceOperation, VoiceSay, Volume,
};
pub use decode::{Decoded, decode, parse_bytes};
pub use diagnostic::{Diagnostic, MAX_PER_KIND, Severity, thinned};
pub use document::{
    Answer, Ask, Branch, Clause, ClauseId, ClauseKind, Document, Group, Part, Pool,
};
pub use durations::{Durations, EstimatedDurations, PhoneTime, VoiceTiming, WordTime};
pub use gesture::{
    Coords, GestureKey, Handedness, Interpolator, Key, MotionKey, PalmKey, Phase, Profile,
    ShapeKey, Space, Track,
};
pub use limits::Limits;
pub use namespaces::{EXTENSIONS, EXTENSIONS_PREFIX};
pub use parse::{Parsed, parse, parse_fragment, parse_fragment_with, parse_with};
/// A name or another short text: up to 23 bytes need no allocation, and copies are cheap.
pub use smol_str::SmolStr as Name;
pub use sorted::SortedMap;
pub use span::{LineIndex, Position, Span};
pub use suggest::{nearest, quoted};
pub use text_emotion::Emoticon;
pub use time_expr::{NameTerm, TimeExpr};
pub use timeline::{Resolved, TimedClause, Timeline};
pub use voice::{DivKind, Mark, MarkEvent, TextSegment, VoiceText, Word};
pub use write::{HARMLESS, normal_form, write, write_with_comments};
