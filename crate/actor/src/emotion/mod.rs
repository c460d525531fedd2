//! Emotion in the face (F&H section 4.4): six basic expressions, all others between them by
//! their place in the space of activation, evaluation and power, but for words with a look of
//! their own; and how they come and go.

mod basic;
mod blend;
mod expression;
mod look;
mod signs;
mod track;
mod wink;

pub use basic::{BASICS, Basic};
pub use blend::{Affect, Mixture, Space, polar};
pub use expression::{Expression, has_antagonist};
pub use look::{LOOKS, Look};
pub use signs::Signs;
pub use track::{Breathing, EmotionSpan, EmotionTrack, SHORTEST_SECS};

#[cfg(test)]
mod tests;
