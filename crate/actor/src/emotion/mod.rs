//! Emotion in the face (F&H section 4.4): six basic expressions; all others between them by their
//! position in the space of activation, evaluation and power, except words with an own expression;
//! onset and decay.

mod basic;
mod blend;
mod expression;
mod look;
mod signs;
mod track;
mod wink;

pub use basic::{BASICS, BasicEmotion};
pub use blend::{Affect, EmotionSpace, ExpressionWeights, polar};
pub use expression::{Expression, has_antagonist};
pub use look::{BASE_EXPRESSIONS, BaseExpression};
pub use signs::EmotionSigns;
pub use track::{Breathing, EmotionSpan, EmotionTrack, MIN_SECS};

#[cfg(test)]
mod tests;
