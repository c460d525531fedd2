//! Everything that is seen and heard at one time, as plain data.
//!
//! Does: the [`Frame`] that a renderer draws, the camera and its framing of the
//! speaker, lights, floor and backdrop, and what of the figure is drawn.
//! Does not: know where a frame came from (`player`) or how it is drawn (`render`).
//!
//! Frames: right-handed, metres, radians; +x is the character's left, +y up, +z front.

pub mod camera;
pub mod frame;
pub mod light;
pub mod line;
pub mod pupil;
pub mod set;
pub mod shown;
pub mod storyteller;

pub use camera::{Camera, MOST_CAPTIONS, Room, Shot, View};
pub use frame::{Frame, SpeechNow};
pub use light::{DirectedLight, Lighting};
pub use line::Line;
pub use set::{Set, SetKind};
pub use shown::{Fill, Shown};
pub use storyteller::{Gesture, Span, TakenSpace};
