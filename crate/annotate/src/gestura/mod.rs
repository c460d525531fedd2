//! Transcriptions by the Gesture Recording Algorithm, GestuRA (GEVH appendix C): what is said, and
//! how and why hands move, in seven passes.
//!
//! | pass | here |
//! |---|---|
//! | 1 words | [`Transcription::words`] |
//! | 2 utterances | [`Transcription::utterances`] |
//! | 3 discourse levels | [`Transcription::levels`] |
//! | 4 classes of gestures | [`Transcription::gestures`] |
//! | 5 phases, 6 form | [`Layer::phases`] |
//! | 7 dimension and meaning | [`Layer::phrases`] |

mod beat_filter;
mod check;
mod cover;
mod form;
mod staging;
mod statistics;
mod word;

use std::ops::RangeInclusive;

use raconteur_eml::Span;

pub use beat_filter::{BeatScore, beat_score};
pub use check::check;
pub(crate) use form::MIN_DISTANCE;
pub use form::{Form, Noted};
pub use staging::{Attributes, Prosody, Setting, Staging};
pub use statistics::{Durations, Statistics, Tally};
pub use word::Vocabulary;

pub(crate) use cover::Cover;
pub(crate) use word::letters;
use word::vocabulary;

/// Transcription of a recording.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Transcription {
    /// Recordings, the leading one first.
    pub media: Vec<String>,
    /// Person who transcribed it.
    pub coder: Option<String>,
    /// Words in the order of time (pass 1).
    pub words: Vec<Word>,
    /// Utterances: runs of words (pass 2).
    pub utterances: Vec<Utterance>,
    /// Discourse levels: runs of utterances (pass 3).
    pub levels: Vec<LevelSpan>,
    /// All gestures with their class, in the order of time (pass 4).
    pub gestures: Vec<Gesture>,
    /// Manner in which words are spoken.
    pub prosody: Vec<Prosody>,
    /// Events on stage.
    pub staging: Vec<Staging>,
    /// Settings of the whole performance.
    pub settings: Vec<Setting>,
    /// Gesticulation in layers, so that gestures may overlap (passes 5 to 7).
    pub layers: Vec<Layer>,
}

/// Time span of a recording.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Interval {
    /// Start, seconds.
    pub start_secs: f64,
    /// End, seconds.
    pub end_secs: f64,
}

impl Interval {
    /// Creates an interval from seconds.
    #[must_use]
    pub fn new(start_secs: f64, end_secs: f64) -> Self {
        Self {
            start_secs,
            end_secs,
        }
    }

    /// Returns the length, seconds.
    #[must_use]
    pub fn length_secs(self) -> f64 {
        self.end_secs - self.start_secs
    }

    /// Returns the smallest interval that contains both.
    #[must_use]
    pub fn to(self, other: Self) -> Self {
        Self {
            start_secs: self.start_secs.min(other.start_secs),
            end_secs: self.end_secs.max(other.end_secs),
        }
    }

    /// Returns true if another interval lies inside, up to a tolerance in seconds.
    #[must_use]
    pub fn contains(self, other: Self, tolerance_secs: f64) -> bool {
        self.start_secs <= other.start_secs + tolerance_secs
            && other.end_secs <= self.end_secs + tolerance_secs
    }
}

/// Spoken word, or a pause (C.3.1).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Word {
    /// The word as transcribed.
    pub token: String,
    /// Time span in which it is spoken.
    pub interval: Interval,
    /// Place in the file.
    pub span: Span,
}

impl Word {
    /// Returns true if it is spoken: not a sign for a pause or a noise, such as `[laughs]`.
    #[must_use]
    pub fn is_spoken(&self) -> bool {
        let is_sign = self.token.starts_with(['[', '<', '(', '{']);
        !is_sign && self.token.contains(char::is_alphanumeric)
    }
}

/// Short utterance that communicates one idea (C.3.2).
#[derive(Clone, Debug, PartialEq)]
pub struct Utterance {
    /// Text; empty: its words.
    pub text: String,
    /// Indices of its words.
    pub words: RangeInclusive<usize>,
    /// Place in the file.
    pub span: Span,
}

/// Utterances at one level of discourse (C.3.3).
#[derive(Clone, Debug, PartialEq)]
pub struct LevelSpan {
    /// Level of discourse.
    pub level: Level,
    /// Indices of its utterances.
    pub utterances: RangeInclusive<usize>,
    /// Place in the file.
    pub span: Span,
}

vocabulary! {
    /// Level of discourse (C.3.3).
    Level {
        /// Events of the story.
        Narrative = "narrative",
        /// The observation of what is told.
        Metanarrative = "metanarrative",
        /// The telling itself.
        Paranarrative = "paranarrative",
    }
}

/// Gesture of any class (C.3.4).
#[derive(Clone, Debug, PartialEq)]
pub struct Gesture {
    /// Class.
    pub class: GestureClass,
    /// Confidence in it, 1 marginally confident to 4 totally certain.
    pub confidence: Option<u8>,
    /// Keyframe animation that reproduces it, for gestures other than gesticulation (addition to
    /// GestuRA; GEVH 3.5.5 reproduces 5 % of the gestures in this manner).
    pub animation: Option<String>,
    /// Time span in which it is performed.
    pub interval: Interval,
    /// Place in the file.
    pub span: Span,
}

vocabulary! {
    /// Class of a gesture (C.3.4).
    GestureClass {
        /// Symbol of a sign language.
        Sign = "sign",
        /// Gesture with a meaning set by the culture.
        Emblem = "emblem",
        /// Spontaneous gesture with speech.
        Gesticulation = "gesticulation",
        /// Gesture that serves the body or adapts to the surroundings.
        Adaptor = "adaptor",
    }
}

/// Layer of gesticulation: phases that follow one another, and the phrases that they make up.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Layer {
    /// Name of the layer.
    pub name: String,
    /// Phases in the order of time.
    pub phases: Vec<Phase>,
    /// Phrases: runs of phases.
    pub phrases: Vec<Phrase>,
}

/// Phase of gesticulation with its form (C.3.5, C.3.6).
#[derive(Clone, Debug, PartialEq)]
pub struct Phase {
    /// Kind of phase.
    pub kind: PhaseKind,
    /// Time span in which it is performed.
    pub interval: Interval,
    /// Form.
    pub form: Form,
    /// Place in the file.
    pub span: Span,
}

vocabulary! {
    /// Kind of a gesticulation phase (C.3.5).
    PhaseKind {
        /// The limb moves to the start of the stroke.
        Preparation = "preparation",
        /// It is held there.
        PreStrokeHold = "pre-stroke hold",
        /// The peak of effort, which carries the meaning.
        Stroke = "stroke",
        /// It is held at the end of the stroke.
        PostStrokeHold = "post-stroke hold",
        /// It returns part of the way.
        PartialRetraction = "partial-retraction",
        /// It returns to rest.
        Retraction = "retraction",
    }
}

impl PhaseKind {
    /// Returns true if the hand does not move.
    #[must_use]
    pub fn is_hold(self) -> bool {
        matches!(self, Self::PreStrokeHold | Self::PostStrokeHold)
    }
}

/// Gesticulation: its phases, hands and meaning (C.3.6, C.3.7).
#[derive(Clone, Debug, PartialEq)]
pub struct Phrase {
    /// Indices of its phases in the layer.
    pub phases: RangeInclusive<usize>,
    /// Most salient dimension.
    pub dimension: Option<Dimension>,
    /// Hands that take part.
    pub handedness: Option<Hands>,
    /// True if the hands mirror each other.
    pub symmetry: Option<bool>,
    /// Position of the speaker frame in universal coordinates, as noted.
    pub speaker_frame_position: Option<String>,
    /// Confidence in dimension and meaning, 1 marginally confident to 4 totally certain.
    pub confidence: Option<u8>,
    /// Addition to the meaning of the speech.
    pub contribution: Option<String>,
    /// Meaning by dimension.
    pub meaning: Meaning,
    /// Place in the file.
    pub span: Span,
}

vocabulary! {
    /// Most salient dimension of a gesticulation (McNeill; C.3.7).
    Dimension {
        /// Shows something concrete.
        Iconic = "iconic",
        /// Shows something abstract as if it were concrete.
        Metaphoric = "metaphoric",
        /// Points.
        Deictic = "deictic",
        /// Marks the rhythm of speech.
        Beat = "beat",
    }
}

vocabulary! {
    /// Hands that take part in a gesticulation (C.3.6).
    Hands {
        /// The right hand.
        Right = "RH",
        /// The left hand.
        Left = "LH",
        /// Both hands.
        Both = "BH",
    }
}

vocabulary! {
    /// Voice of the speaker in an iconic gesticulation (C.3.7).
    Viewpoint {
        /// The speaker is the character.
        Character = "character",
        /// The speaker observes it.
        Observer = "observer",
        /// Both at once.
        Both = "both",
    }
}

/// Meaning of a gesticulation (C.3.7), as noted.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Meaning {
    /// Entity that the form of an iconic gesture shows.
    pub iconic_body: Option<String>,
    /// Motion that the motion of an iconic gesture shows.
    pub iconic_motion: Option<String>,
    /// Voice of an iconic gesture.
    pub iconic_viewpoint: Option<Viewpoint>,
    /// Concrete entity of a metaphoric gesture.
    pub metaphoric_base: Option<String>,
    /// Abstract concept of a metaphoric gesture.
    pub metaphoric_referent: Option<String>,
    /// Motion that the motion of a metaphoric gesture shows.
    pub metaphoric_motion: Option<String>,
    /// Place around the speaker at which a deictic gesture points.
    pub deictic_geographic_target: Option<String>,
    /// Entity or concept of the place.
    pub deictic_narration_target: Option<String>,
}

impl Transcription {
    /// Returns the time span of an utterance; `None` if its words do not exist.
    #[must_use]
    pub fn utterance_interval(&self, utterance: &Utterance) -> Option<Interval> {
        covered(&self.words, &utterance.words, |word| word.interval)
    }
}

impl Layer {
    /// Returns the phases of a phrase; empty if they do not exist.
    #[must_use]
    pub fn phases_of(&self, phrase: &Phrase) -> &[Phase] {
        self.phases.get(phrase.phases.clone()).unwrap_or_default()
    }

    /// Returns the time span of a phrase; `None` if its phases do not exist.
    #[must_use]
    pub fn phrase_interval(&self, phrase: &Phrase) -> Option<Interval> {
        covered(&self.phases, &phrase.phases, |phase| phase.interval)
    }
}

/// Returns the time span of a run of items; `None` if they do not all exist.
fn covered<T>(
    items: &[T],
    range: &RangeInclusive<usize>,
    interval: fn(&T) -> Interval,
) -> Option<Interval> {
    let items = items.get(range.clone())?;
    items.iter().map(interval).reduce(Interval::to)
}
