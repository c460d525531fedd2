//! How a story is performed.

use raconteur_actor::Manner;
use raconteur_base::Side;
use raconteur_stage::{Room, Shot};

/// How a story is performed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// Seed of blinks, glances and idle motion.
    pub seed: u64,
    /// Idle life, from 0 (still) to 1.
    pub motion_amount: f64,
    /// How the figure accompanies its speech with face and head.
    pub manner: Manner,
    /// The dominant hand; none: as the story says, else as the figure is.
    pub handedness: Option<Side>,
    /// How much of the speaker is in the picture until the script says otherwise.
    pub shot: Shot,
    /// No less room than this is kept for gestures, however small the script's own are:
    /// while one edits a script the picture stands still.
    pub room: Room,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            seed: 1,
            motion_amount: 1.0,
            manner: Manner::default(),
            handedness: None,
            shot: Shot::Storyteller,
            room: Room::default(),
        }
    }
}
