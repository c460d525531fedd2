//! Names of the tracks and attributes of GestuRA (GEVH C.4).

pub(crate) const CODER: &str = "coder";
pub(crate) const WORDS: &str = "words";
pub(crate) const TOKEN: &str = "token";
pub(crate) const UTTERANCES: &str = "utterances";
pub(crate) const TEXT: &str = "text";
pub(crate) const LEVELS: &str = "discourse-levels";
pub(crate) const LEVEL: &str = "level";
pub(crate) const GESTURES: &str = "gestures";
pub(crate) const TYPE: &str = "type";
pub(crate) const CONFIDENCE: &str = "confidence-level";
pub(crate) const ANIMATION: &str = "animation";
/// Group of the tracks of prosody, each named after an element of EML.
pub(crate) const PROSODY: &str = "prosody";
/// Group of the tracks of events on stage, likewise.
pub(crate) const STAGING: &str = "staging";
pub(crate) const PHASES: &str = "gesticulation.phases";
pub(crate) const PHASE: &str = "phase";
pub(crate) const SOURCE: &str = "source";
pub(crate) const TARGET: &str = "target";
pub(crate) const MOTION: &str = "motion";
pub(crate) const HAND_SHAPES: &str = "hand-shapes";
pub(crate) const PALM_ORIENTATIONS: &str = "palm-orientations";
pub(crate) const BODY_SHAPE: &str = "body-shape";
pub(crate) const PHRASES: &str = "gesticulation.phrases";
pub(crate) const PHRASE: &str = "phrase";
pub(crate) const HANDEDNESS: &str = "handedness";
pub(crate) const SYMMETRY: &str = "symmetry";
pub(crate) const SPEAKER_FRAME_POSITION: &str = "speaker-frame-position";
pub(crate) const CONTRIBUTION: &str = "contribution";
pub(crate) const ICONIC_BODY: &str = "iconic-body-meaning";
pub(crate) const ICONIC_MOTION: &str = "iconic-motion-meaning";
pub(crate) const ICONIC_VIEWPOINT: &str = "iconic-viewpoint";
pub(crate) const METAPHORIC_BASE: &str = "metaphoric-base";
pub(crate) const METAPHORIC_REFERENT: &str = "metaphoric-referent";
pub(crate) const METAPHORIC_MOTION: &str = "metaphoric-motion-meaning";
pub(crate) const DEICTIC_GEOGRAPHIC: &str = "deictic-geographic-target";
pub(crate) const DEICTIC_NARRATION: &str = "deictic-narration-target";
