//! What one figure is asked for over a whole story, as plain data.

use raconteur_base::{DVec3, Side};
use raconteur_speech::bundle::{Emotion, Phrase, Sentence};
use raconteur_speech::{Phone, Word};

use crate::animation::{Library, PlayerScript};
use crate::emotion::EmotionSpan;
use crate::gesture::{ArmScript, TrunkShape};
use crate::manipulator::{ManipulatorScript, Sex};
use crate::nonverbal::Manner;
use crate::parameters::ParameterScript;

/// An accented syllable of an utterance.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Accent {
    /// Seconds from the start of the utterance.
    pub start_secs: f64,
    /// Seconds from the start of the utterance.
    pub end_secs: f64,
    /// 0..2; 1 is an ordinary accent.
    pub strength: f64,
    /// Its name in ToBI, for example `H*`; empty or `*` where it is not known.
    pub label: String,
}

/// An utterance at its place in the story.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SpokenUtterance {
    /// Story time of its first sample, seconds.
    pub start_secs: f64,
    /// Length, seconds.
    pub duration_secs: f64,
    /// Phones, seconds from the start of the utterance.
    pub phones: Vec<Phone>,
    /// Words, seconds from the start of the utterance.
    pub words: Vec<Word>,
    /// Accents by time; empty where they are not known: some of the words count as accented.
    pub accents: Vec<Accent>,
    /// Intonational phrases of its words, in order; empty where they are not known.
    pub phrases: Vec<Phrase>,
    /// Sentences of its words, in order; where there are none, punctuation tells.
    pub sentences: Vec<Sentence>,
    /// Emotions in force, seconds from the start of the utterance.
    pub emotions: Vec<Emotion>,
    /// Fundamental frequency, a code for each 10 ms as in a bundle; empty where it is not
    /// known.
    pub f0: Vec<u8>,
    /// Intensity, likewise.
    pub intensity: Vec<u8>,
}

/// What one figure is asked for over a whole story.
#[derive(Clone, Debug)]
pub struct Performance {
    /// Left and right arm.
    pub arms: [ArmScript; 2],
    /// What limbs, head and the whole figure do as manipulators.
    pub manipulators: ManipulatorScript,
    /// Whose joint limits hold.
    pub sex: Sex,
    /// The dominant hand.
    pub dominant: Side,
    /// Animation players.
    pub players: PlayerScript,
    /// The animations that they may play.
    pub library: Library,
    /// What is said, in any order.
    pub speech: Vec<SpokenUtterance>,
    /// What is felt, in any order.
    pub emotions: Vec<EmotionSpan>,
    /// What control parameters are asked for.
    pub parameters: ParameterScript,
    /// Seed of everything that nobody scripted.
    pub seed: u64,
    /// How lively the idle motion is, 0 (still) to 1.
    pub motion_amount: f64,
    /// How the figure accompanies its speech; the amounts count beside `motion_amount`.
    pub manner: Manner,
    /// Whom the figure speaks to, world, metres: usually the camera.
    pub listener_in_world: DVec3,
    /// What of its body hands keep out of; without this, an average build.
    pub trunk: Option<TrunkShape>,
    /// The figure waits to begin: what it does with nothing to do is a welcome, with open
    /// arms, its head a little to the side, and a smile.
    pub welcomes: bool,
}

impl Default for Performance {
    fn default() -> Self {
        Self {
            arms: [ArmScript::default(), ArmScript::default()],
            manipulators: ManipulatorScript::default(),
            sex: Sex::default(),
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
            trunk: None,
            welcomes: false,
        }
    }
}
