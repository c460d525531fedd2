//! Preparation of an actor for all known parts of a performance.

use raconteur_actor::animation::PlayerCommand;
use raconteur_actor::{
    Actor, ArmScript, Discourse, Library, ParameterScript, Performance, PlayerScript,
};
use raconteur_base::order::sort_by_number;
use raconteur_base::{DVec3, Side};
use raconteur_stage::{FramingMargin, Gesture, TakenSpace};

use crate::lower::cast::Cast;
use crate::lower::plan::{CarriedCommands, ScriptPlan};
use crate::lower::{clips, discourse, face, gestures, manipulators};
use crate::options::Options;

/// Formality of a performance whose script gives none, 0 (casual) to 1 (formal).
const USUAL_FORMALITY: f64 = 0.5;
/// Distance from the middle that steps, sway and turns add to a hand, share of stature. Designed.
const STEPS_ASIDE: f64 = 0.07;
/// Length of a hand with a margin, share of stature (0.108 in adults, ANSUR).
const HAND_LENGTH: f64 = 0.12;

/// Framing requirements of a performance: the margin that gestures need, and their times.
#[derive(Clone, Debug)]
pub(crate) struct FramingNeeds {
    /// Room for everything that the hands do.
    pub(crate) margin: FramingMargin,
    /// Gestures, with their times.
    pub(crate) gestures: Vec<Gesture>,
}

/// Inputs for preparing an actor: figure, options, animations and carried commands.
pub(crate) struct ActorBuilder<'a> {
    pub(crate) cast: &'a Cast,
    pub(crate) options: &'a Options,
    pub(crate) library: &'a Library,
    /// Persistent state of removed fragments.
    pub(crate) carried: &'a CarriedCommands,
    /// Minimum framing margin, so the framing does not change with every gesture.
    pub(crate) min_margin: FramingMargin,
}

impl ActorBuilder<'_> {
    /// Returns the actor of all plans together, and their framing requirements.
    pub(crate) fn actor<'p>(
        &self,
        plans: impl Iterator<Item = &'p ScriptPlan> + Clone,
    ) -> (Actor, FramingNeeds) {
        let skeleton = &self.cast.figure.skeleton;
        let stature_m = skeleton.stature_m();
        let discourse =
            discourse::together(plans.clone().map(|p| &p.discourse), &self.carried.places);
        let needs = self.needs(plans.clone(), &discourse, stature_m);
        let shot = self.options.shot;
        let camera = shot.frame(DVec3::ZERO, stature_m, 16.0 / 9.0, needs.margin);
        let performance = self.performance(plans, discourse, camera.eye_in_world);
        (Actor::new(&performance, skeleton), needs)
    }

    /// Returns the framing requirements of the gestures, manipulators and animations of all plans.
    fn needs<'p>(
        &self,
        plans: impl Iterator<Item = &'p ScriptPlan> + Clone,
        discourse: &Discourse,
        stature_m: f64,
    ) -> FramingNeeds {
        let hand_m = HAND_LENGTH * stature_m;
        let mut gestures: Vec<Gesture> = plans
            .clone()
            .flat_map(|p| {
                let strokes = p.strokes.iter().flatten();
                strokes
                    .filter_map(|s| gestures::space(s, hand_m, stature_m))
                    .chain(manipulators::space(&p.manipulators, hand_m))
            })
            .chain(discourse::indicated_spaces(discourse, stature_m))
            .map(|g| Gesture {
                space: self.with_steps(g.space, stature_m).within_reach(stature_m),
                ..g
            })
            .collect();
        let room = gestures
            .iter()
            .fold(self.min_margin, |room, g| FramingMargin {
                top_m: room.top_m.max(g.space.top_m),
                half_width_m: room.half_width_m.max(g.space.half_width_m),
                ..room
            });
        let least = self.options.margin;
        if least != FramingMargin::default() {
            gestures.push(Gesture {
                from_secs: f64::NEG_INFINITY,
                to_secs: f64::INFINITY,
                // A request for space shows all of it, in a narrow image too.
                space: TakenSpace {
                    top_m: least.top_m,
                    bottom_m: 0.0,
                    half_width_m: least.half_width_m,
                }
                .within_reach(stature_m)
                .with_margin(),
            });
        }
        let commands = self.player_commands(plans);
        gestures.extend(clips::spaces(&commands, self.library, stature_m));
        FramingNeeds {
            margin: room,
            gestures,
        }
    }

    /// Adds the room that a figure needs that steps and turns with its gestures.
    fn with_steps(&self, space: TakenSpace, stature_m: f64) -> TakenSpace {
        TakenSpace {
            half_width_m: space.half_width_m + STEPS_ASIDE * stature_m * self.options.motion_amount,
            ..space
        }
    }

    /// Returns the commands of all plans to animation players.
    fn player_commands<'p>(
        &self,
        plans: impl Iterator<Item = &'p ScriptPlan>,
    ) -> Vec<(f64, PlayerCommand)> {
        let players = plans.flat_map(|p| p.players.iter());
        self.carried
            .players
            .iter()
            .chain(players)
            .cloned()
            .collect()
    }

    /// Returns the figure's performance of all plans together.
    fn performance<'p>(
        &self,
        plans: impl Iterator<Item = &'p ScriptPlan> + Clone,
        discourse: Discourse,
        listener_in_world: DVec3,
    ) -> Performance {
        let mut switches: Vec<(f64, bool)> = plans
            .clone()
            .flat_map(|p| p.switches.iter().copied())
            .collect();
        sort_by_number(&mut switches, |(time_secs, _)| *time_secs);
        let on = gestures::on_spans(&switches);
        let character = plans.clone().find_map(|p| p.face.character.as_ref());
        let parameters = plans.clone().flat_map(|p| p.face.parameters.iter());
        Performance {
            players: PlayerScript {
                commands: self.player_commands(plans.clone()),
            },
            emotions: plans
                .clone()
                .flat_map(|p| p.face.emotions.iter().map(|felt| felt.span))
                .collect(),
            parameters: ParameterScript {
                commands: self
                    .carried
                    .parameters
                    .iter()
                    .chain(parameters)
                    .cloned()
                    .collect(),
            },
            discourse,
            formality: character
                .and_then(|of| of.formality)
                .unwrap_or(USUAL_FORMALITY),
            library: self.library.clone(),
            arms: Side::BOTH.map(|side| ArmScript {
                strokes: plans
                    .clone()
                    .flat_map(|p| p.strokes[side.index()].iter().cloned())
                    .collect(),
                on: on.clone(),
            }),
            postures: (self.carried.posture.into_iter())
                .chain(plans.clone().flat_map(|p| p.postures.iter().copied()))
                .collect(),
            manipulators: manipulators::together(plans.clone().map(|p| &p.manipulators)),
            speech: plans
                .flat_map(|p| &p.utterances)
                .map(|u| u.timed.clone())
                .collect(),
            seed: self.options.seed,
            motion_amount: self.options.motion_amount,
            manner: character.map_or(self.options.manner, |of| {
                face::manner(of, self.options.manner)
            }),
            listener_in_world,
            build: self.cast.build,
            dominant: self.cast.hands.dominant,
            welcomes: false,
        }
    }
}
