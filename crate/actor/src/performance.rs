//! The score of one figure: all its commands over a whole story, as plain data.

use raconteur_base::{DVec3, Side};
use raconteur_speech::TimedUtterance;

use crate::animation::{Library, PlayerScript};
use crate::emotion::EmotionSpan;
use crate::gesture::ArmScript;
use crate::limb::Build;
use crate::manipulator::ManipulatorScript;
use crate::nonverbal::Manner;
use crate::parameters::ParameterScript;

/// All commands to one figure over a whole story.
#[derive(Clone, Debug)]
pub struct Performance {
    /// Left and right arm.
    pub arms: [ArmScript; 2],
    /// What limbs, head and the whole figure do as manipulators.
    pub manipulators: ManipulatorScript,
    /// How far its joints turn, and what of its body arms keep out of.
    pub build: Build,
    /// The dominant hand.
    pub dominant: Side,
    /// Animation players.
    pub players: PlayerScript,
    /// The animations that they may play.
    pub library: Library,
    /// Utterances, in any order.
    pub speech: Vec<TimedUtterance>,
    /// Emotions, in any order.
    pub emotions: Vec<EmotionSpan>,
    /// Commands to control parameters.
    pub parameters: ParameterScript,
    /// Seed of all unscripted motion.
    pub seed: u64,
    /// How lively the idle motion is, 0 (still) to 1.
    pub motion_amount: f64,
    /// How the figure accompanies its speech; the amounts count beside `motion_amount`.
    pub manner: Manner,
    /// Whom the figure speaks to, world, metres: usually the camera.
    pub listener_in_world: DVec3,
    /// The figure waits to begin: what it does with nothing to do is a welcome, with open
    /// arms, its head a little to the side, and a smile.
    pub welcomes: bool,
}

impl Default for Performance {
    fn default() -> Self {
        Self {
            arms: [ArmScript::default(), ArmScript::default()],
            manipulators: ManipulatorScript::default(),
            build: Build::default(),
            dominant: Side::Right,
            players: PlayerScript::default(),
            library: Library::default(),
            speech: Vec::new(),
            emotions: Vec::new(),
            parameters: ParameterScript::default(),
            seed: 0,
            motion_amount: 1.0,
            manner: Manner::default(),
            listener_in_world: DVec3::new(0.0, 1.6, 2.5),
            welcomes: false,
        }
    }
}
