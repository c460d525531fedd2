//! Visible and audible state at one time, as plain data.
//!
//! Scope: the [`Frame`] for the renderer, the camera and its framing of the speaker, lights, floor
//! and backdrop, their expression of emotions, and the visible parts of the figure.
//! Out of scope: the source of a frame (`player`) and its rendering (`render`).
//!
//! Frames: right-handed, metres, radians; +x is the character's left, +y up, +z front.

pub mod camera;
pub mod emotion;
pub mod frame;
pub mod illumination;
pub mod light;
pub mod line;
pub mod mood;
pub mod pupil;
pub mod set;
pub mod storyteller;
pub mod visibility;

pub use camera::{Camera, FramingMargin, MAX_CAPTIONS, Shot, View};
pub use emotion::{Angle, EmotionType};
pub use frame::{CurrentSpeech, Frame};
pub use illumination::Illumination;
pub use light::{DirectedLight, Lighting};
pub use line::Line;
pub use mood::{EmotionEnvelope, EmotionTimeline, Mood};
pub use set::{Set, StageSet};
pub use storyteller::{BROAD, Gesture, QUICK_ZOOM, SLOW_ZOOM, Span, TakenSpace, aside_in};
pub use visibility::{Fill, Visibility};
