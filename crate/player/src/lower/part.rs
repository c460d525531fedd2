//! A script lowered for one figure: what it asks of arms and voice, and what it tells.

use raconteur_actor::animation::PlayerCommand;
use raconteur_actor::gesture::TrunkShape;
use raconteur_actor::parameters::ParameterCommand;
use raconteur_actor::{
    ArmScript, GestureStroke, Library, ManipulatorScript, ParameterScript, Performance,
    PlayerScript, Sex,
};
use raconteur_base::order::sort_by_number;
use raconteur_base::{DVec3, Side};

use crate::lower::animations;
use crate::lower::cues::{self, Cue, UtteranceCue};
use crate::lower::feelings::{self, Felt};
use crate::lower::geometry::{self, Switch};
use crate::lower::gestures::{self, Hands};
use crate::lower::manipulators;
use crate::lower::music::{self, MusicClause};
use crate::lower::script::Script;
use crate::lower::units::Units;
use crate::lower::views::{self, ShotCue};
use crate::options::Options;

/// A story, or a fragment of a live performance, at its times.
pub(crate) struct Part {
    /// Strokes of the left and right arm.
    pub(crate) strokes: [Vec<GestureStroke>; 2],
    /// What manipulators are asked for.
    pub(crate) manipulators: ManipulatorScript,
    /// When gestures are turned on and off, by time.
    switches: Vec<(f64, bool)>,
    /// What animation players are asked for, by time.
    pub(crate) players: Vec<(f64, PlayerCommand)>,
    /// What of the figure is drawn, by time.
    pub(crate) geometry: Vec<Switch>,
    /// What is felt, and what control parameters are asked for.
    pub(crate) felt: Felt,
    /// Shots of the camera, by time.
    pub(crate) shots: Vec<ShotCue>,
    /// Music, by time.
    pub(crate) music: Vec<MusicClause>,
    /// What is said, by time.
    pub(crate) utterances: Vec<UtteranceCue>,
    /// What listeners are told, by time.
    pub(crate) cues: Vec<Cue>,
}

impl Part {
    /// Lowers a script. `first_utterance` is the index of its first utterance, `fragment` the
    /// number of a live fragment.
    pub(crate) fn new(
        script: &Script,
        units: &Units,
        hands: Hands,
        first_utterance: usize,
        fragment: Option<u32>,
    ) -> Self {
        let (document, timeline) = (&script.document, &script.timeline);
        let utterances = cues::utterances(script);
        Self {
            strokes: Side::BOTH
                .map(|side| gestures::strokes(document, timeline, side, units, hands)),
            manipulators: manipulators::script(document, timeline, units),
            switches: gestures::switches(document, timeline),
            players: animations::commands(document, timeline).0,
            geometry: geometry::switches(document, timeline),
            felt: feelings::lower(script, &utterances),
            shots: views::shots(script),
            music: music::clauses(script),
            cues: cues::cues(script, &utterances, first_utterance, fragment),
            utterances,
        }
    }
}

/// What parts that are forgotten have asked for and what stays, by time.
#[derive(Default)]
pub(crate) struct Carried {
    /// Of animation players.
    pub(crate) players: Vec<(f64, PlayerCommand)>,
    /// Of control parameters.
    pub(crate) parameters: Vec<(f64, ParameterCommand)>,
}

/// What the figure does when all parts are performed together.
pub(crate) fn performance<'a>(
    parts: impl Iterator<Item = &'a Part> + Clone,
    carried: &Carried,
    library: &Library,
    options: &Options,
    trunk: TrunkShape,
    sex: Sex,
    listener_in_world: DVec3,
) -> Performance {
    let mut switches: Vec<(f64, bool)> = parts
        .clone()
        .flat_map(|p| p.switches.iter().copied())
        .collect();
    sort_by_number(&mut switches, |(time_secs, _)| *time_secs);
    let on = gestures::on_spans(&switches);
    let character = parts.clone().find_map(|p| p.felt.character.as_ref());
    let players = parts.clone().flat_map(|p| p.players.iter());
    let parameters = parts.clone().flat_map(|p| p.felt.parameters.iter());
    Performance {
        players: PlayerScript {
            commands: carried.players.iter().chain(players).cloned().collect(),
        },
        emotions: parts
            .clone()
            .flat_map(|p| p.felt.emotions.iter().copied())
            .collect(),
        parameters: ParameterScript {
            commands: carried
                .parameters
                .iter()
                .chain(parameters)
                .cloned()
                .collect(),
        },
        library: library.clone(),
        arms: Side::BOTH.map(|side| ArmScript {
            strokes: parts
                .clone()
                .flat_map(|p| p.strokes[side.index()].iter().cloned())
                .collect(),
            on: on.clone(),
        }),
        manipulators: manipulators::together(parts.clone().map(|p| &p.manipulators)),
        speech: parts
            .flat_map(|p| &p.utterances)
            .map(|u| u.timed.clone())
            .collect(),
        seed: options.seed,
        motion_amount: options.motion_amount,
        manner: character.map_or(options.manner, |of| feelings::manner(of, options.manner)),
        listener_in_world,
        sex,
        dominant: options.handedness.unwrap_or(Side::Right),
        trunk: Some(trunk),
        welcomes: false,
    }
}

/// Whether a script asks anything of manipulators.
pub(crate) fn is_asked(script: &ManipulatorScript) -> bool {
    !(script.commands.is_empty() && script.moves.is_empty())
}
