//! Script lowered for one figure: its plans for the actor, the frame, the music and the cues.

use raconteur_actor::animation::PlayerCommand;
use raconteur_actor::parameters::ParameterCommand;
use raconteur_actor::{GestureStroke, ManipulatorScript, PostureCommand};
use raconteur_base::Side;
use raconteur_base::order::sort_by_number;

use crate::lower::animations;
use crate::lower::cast::Cast;
use crate::lower::control_source::Channels;
use crate::lower::cues::{self, Cue, UtteranceCue};
use crate::lower::discourse::{DiscoursePlan, PlaceCue};
use crate::lower::face::{self, FacePlan};
use crate::lower::gestures;
use crate::lower::lamps::{self, LampCue};
use crate::lower::manipulators;
use crate::lower::moods::{self, OwnPiece};
use crate::lower::music;
use crate::lower::music_stem::MusicClause;
use crate::lower::postures;
use crate::lower::repertoire::Repertoire;
use crate::lower::script::Script;
use crate::lower::shots::{self, ShotCue};
use crate::lower::visibility::{self, Switch};

/// Maximum number of places of referents that outlive their fragments.
const MAX_CARRIED_PLACES: usize = 1024;

/// Script or live fragment, compiled for one figure: plans of gestures, face, camera, light, music
/// and cues.
pub(crate) struct ScriptPlan {
    /// Strokes of the left and right arm.
    pub(crate) strokes: [Vec<GestureStroke>; 2],
    /// Commands to manipulators, and moves of the whole figure.
    pub(crate) manipulators: ManipulatorScript,
    /// Postures of spine and shoulders, by time.
    pub(crate) postures: Vec<PostureCommand>,
    /// Times at which gestures are turned on and off.
    pub(crate) switches: Vec<(f64, bool)>,
    /// Commands to animation players, by time.
    pub(crate) players: Vec<(f64, PlayerCommand)>,
    /// Switches of the figure's visible parts, by time.
    pub(crate) geometry: Vec<Switch>,
    /// Emotions and control parameters.
    pub(crate) face: FacePlan,
    /// Shots of the camera, by time.
    pub(crate) shots: Vec<ShotCue>,
    /// Lights, by time.
    pub(crate) lamps: Vec<LampCue>,
    /// The channels that express emotions.
    pub(crate) channels: Channels,
    /// Music, by time.
    pub(crate) music: Vec<MusicClause>,
    /// The author's pieces for moods.
    pub(crate) pieces: Vec<OwnPiece>,
    /// The library's pieces for moods.
    pub(crate) repertoire: Repertoire,
    /// Utterances, by time.
    pub(crate) utterances: Vec<UtteranceCue>,
    /// Discourse structure of the speech.
    pub(crate) discourse: DiscoursePlan,
    /// Cues, by time.
    pub(crate) cues: Vec<Cue>,
}

impl ScriptPlan {
    /// Lowers a script. `first_utterance` is the index of its first utterance, `fragment` the
    /// number of a live fragment.
    pub(crate) fn new(
        script: &Script,
        cast: &Cast,
        first_utterance: usize,
        fragment: Option<u32>,
    ) -> Self {
        let (document, timeline) = (&script.document, &script.timeline);
        let (units, hands) = (&cast.units, cast.hands);
        let utterances = cues::utterances(script);
        let strokes = Side::BOTH
            .map(|side| gestures::strokes(document, timeline, side, units, hands))
            .map(|strokes| gestures::not_before(strokes, script.hands_from_secs));
        let switches = gestures::switches(document, timeline);
        Self {
            discourse: DiscoursePlan::new(script, &utterances, &strokes, &switches, cast),
            strokes,
            manipulators: manipulators::script(document, timeline, units),
            postures: postures::postures(document, timeline),
            switches,
            players: animations::commands(document, timeline).0,
            geometry: visibility::switches(document, timeline),
            face: face::lower(script, &utterances),
            shots: shots::shots(script),
            lamps: lamps::lamps(script),
            channels: Channels::from_document(document),
            music: music::clauses(script),
            pieces: moods::own_pieces(document),
            repertoire: script.repertoire,
            cues: cues::cues(script, &utterances, first_utterance, fragment),
            utterances,
        }
    }
}

/// Commands of forgotten live fragments that remain in force, sorted by time.
#[derive(Default)]
pub(crate) struct CarriedCommands {
    /// Commands to animation players, with their times.
    pub(crate) players: Vec<(f64, PlayerCommand)>,
    /// Commands to control parameters, with their times.
    pub(crate) parameters: Vec<(f64, ParameterCommand)>,
    /// Places of referents.
    pub(crate) places: Vec<PlaceCue>,
    /// Posture in force, if a fragment set it.
    pub(crate) posture: Option<PostureCommand>,
}

impl CarriedCommands {
    /// Adds the postures of a removed fragment: the latest stays in force.
    pub(crate) fn add_postures(&mut self, postures: Vec<PostureCommand>) {
        let all = self.posture.into_iter().chain(postures);
        self.posture = all.max_by(|a, b| a.start_secs.total_cmp(&b.start_secs));
    }

    /// Adds the places of a removed fragment; beyond the limit, the oldest are lost.
    pub(crate) fn add_places(&mut self, places: Vec<PlaceCue>) {
        self.places.extend(places);
        sort_by_number(&mut self.places, |place| place.start_secs);
        let surplus = self.places.len().saturating_sub(MAX_CARRIED_PLACES);
        self.places.drain(..surplus);
    }
}
