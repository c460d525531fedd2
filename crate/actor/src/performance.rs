//! Score of one figure: all its commands over a whole story, as plain data.

use raconteur_base::{DVec3, Side};
use raconteur_speech::TimedUtterance;

use crate::animation::{Library, PlayerScript};
use crate::body_posture::PostureCommand;
use crate::discourse::Discourse;
use crate::emotion::EmotionSpan;
use crate::gesture::ArmScript;
use crate::limb::Build;
use crate::manipulator::ManipulatorScript;
use crate::nonverbal::Manner;
use crate::parameters::ParameterScript;

/// All commands to one figure over a whole story, as plain data; an actor performs it.
#[derive(Clone, Debug)]
pub struct Performance {
    /// Gesture scripts of the left and right arm.
    pub arms: [ArmScript; 2],
    /// Motions of limbs, head and the whole figure as manipulators.
    pub manipulators: ManipulatorScript,
    /// Joint limits of the figure, and the body shape that its arms avoid.
    pub build: Build,
    /// Dominant hand of the figure.
    pub dominant: Side,
    /// Commands to the animation players.
    pub players: PlayerScript,
    /// The animations that they may play.
    pub library: Library,
    /// Utterances, in any order.
    pub speech: Vec<TimedUtterance>,
    /// Emotions, in any order.
    pub emotions: Vec<EmotionSpan>,
    /// Discourse structure of the speech.
    pub discourse: Discourse,
    /// Formality of the occasion, 0 (casual) to 1 (formal); it prefers some rest postures.
    pub formality: f64,
    /// Postures of spine and shoulder girdle, in any order.
    pub postures: Vec<PostureCommand>,
    /// Commands to control parameters.
    pub parameters: ParameterScript,
    /// Seed of all unscripted motion.
    pub seed: u64,
    /// Amount of idle motion, 0 (still) to 1.
    pub motion_amount: f64,
    /// Manner of nonverbal behaviour during speech; its amounts are combined with `motion_amount`.
    pub manner: Manner,
    /// Position of the listener, world, metres: usually the camera.
    pub listener_in_world: DVec3,
    /// True if the figure waits to begin: its idle motion is a welcome, with open arms, the head
    /// slightly tilted, and a smile.
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
            discourse: Discourse::default(),
            formality: 0.5,
            postures: Vec::new(),
            parameters: ParameterScript::default(),
            seed: 0,
            motion_amount: 1.0,
            manner: Manner::default(),
            listener_in_world: DVec3::new(0.0, 1.6, 2.5),
            welcomes: false,
        }
    }
}
