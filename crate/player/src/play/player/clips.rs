//! Animations of a story that the page must supply.

use raconteur_actor::Library;
use raconteur_actor::animation::{Operation, PlayerCommand};
use raconteur_eml::{Diagnostic, thinned};

use super::Player;
use crate::lower::animations;
use crate::lower::plan::ScriptPlan;
use crate::lower::requirements::Requirements;
use crate::play::crossfade::ActorCrossfade;

/// Animations available to a player, and the names of missing ones.
#[derive(Default)]
pub(super) struct Animations {
    pub(super) library: Library,
    /// Names of animations that could not be found or read.
    missing: Vec<String>,
}

impl Animations {
    /// Takes the text of an animation of the body, or of control parameters. Returns the code and
    /// message of a diagnostic if it cannot be played.
    fn provide(
        &mut self,
        name: &str,
        text: Option<&str>,
        is_of_parameters: bool,
    ) -> Result<(), (&'static str, String)> {
        let Some(text) = text else {
            let file = match name.contains('.') {
                true => name.to_owned(),
                false => format!("{name}.json"),
            };
            let message =
                format!("the animation `{name}` was not found as `{file}`; it is left out");
            return Err(("player::no-animation", message));
        };
        if is_xml(text) {
            let (xml, json) = (with_ending(name, "xml"), with_ending(name, "json"));
            let message = format!(
                "the animation `{name}` was found as `{xml}`, which is XML; it is ignored, because animations are JSON files such as `{json}`"
            );
            return Err(("player::bad-animation", message));
        }
        let taken = if is_of_parameters {
            self.library.add_parameters(name, text)
        } else {
            self.library.add(name, text)
        };
        taken.map_err(|why| {
            let message = format!("the animation `{name}` cannot be read: {why}");
            ("player::bad-animation", message)
        })
    }
}

/// Returns true if a text is XML, like the animations of GEVH.
fn is_xml(text: &str) -> bool {
    let text = text.trim_start_matches('\u{feff}');
    text.trim_start().starts_with('<')
}

/// Returns the name of an animation's file with this extension, replacing a known one.
fn with_ending(name: &str, ending: &str) -> String {
    let stem = ["xml", "json"]
        .iter()
        .find_map(|known| name.strip_suffix(known)?.strip_suffix('.'));
    format!("{}.{ending}", stem.unwrap_or(name))
}

impl Player {
    /// Returns the names of missing animations that the story and live clauses play, each once: a
    /// name in the library, or a path in the story's folder. Pass their texts to
    /// [`Player::provide_animations`].
    #[must_use]
    pub fn needed_animations(&self) -> Vec<String> {
        let library = &self.animations.library;
        let played = |(_, command): &'_ (f64, PlayerCommand)| match command {
            PlayerCommand::Operate {
                operation: Operation::Push(name, _) | Operation::Exchange(name, _),
                ..
            } => Some(name.clone()),
            _ => None,
        };
        let plans = self.scripts.plans();
        let bodies = plans.clone().flat_map(|p| p.players.iter());
        let bodies = bodies
            .filter_map(played)
            .filter(|name| library.get(name).is_none());
        let parameters = plans.flat_map(|p| p.face.parameter_animations.iter().cloned());
        let parameters = parameters.filter(|name| library.parameters(name).is_none());
        let mut wanted: Vec<String> = Vec::new();
        for name in bodies.chain(parameters) {
            if !self.animations.missing.contains(&name) && !wanted.contains(&name) {
                wanted.push(name);
            }
        }
        wanted
    }

    /// Takes animations by name with their text (JSON of `docs/animation.md`, or that of
    /// [`ParameterClip`](raconteur_actor::parameters::ParameterClip) for those of control
    /// parameters), or `None` if not found; the story's times follow their lengths. An XML file,
    /// which is not supported, is reported. Returns diagnostics for missing and broken animations;
    /// the rest plays. Animations that arrive during playback ease in.
    pub fn provide_animations(&mut self, clips: &[(&str, Option<&str>)]) -> Vec<Diagnostic> {
        let mut diagnostics = Vec::new();
        let plans = self.scripts.plans();
        let parameters: Vec<String> = plans
            .flat_map(|p| p.face.parameter_animations.clone())
            .collect();
        for &(name, text) in clips {
            let is_of_parameters = parameters.iter().any(|n| n == name);
            match self.animations.provide(name, text, is_of_parameters) {
                // A player of the body that plays one of this name cannot have it.
                Ok(()) if is_of_parameters => self.animations.missing.push(name.to_owned()),
                Ok(()) => {}
                Err((code, message)) => {
                    self.animations.missing.push(name.to_owned());
                    let needs = Requirements::from_document(&self.script.document);
                    let span = needs.span(name, is_of_parameters);
                    let mut warning = Diagnostic::warning(code, span, message);
                    match text {
                        None => warning.hints.extend(animations::hint(name)),
                        Some(text) if is_xml(text) => {
                            let json = with_ending(name, "json");
                            warning = warning.hint(format!(
                                "convert it to `{json}` next to the story, and use that full name in the clause"
                            ));
                        }
                        Some(_) => {}
                    }
                    diagnostics.push(warning);
                }
            }
        }
        self.rebuild_performance();
        thinned(diagnostics)
    }

    /// Times, lowers and rehearses the story again, now that more animations are known.
    fn rebuild_performance(&mut self) {
        self.script.retime(&self.animations.library);
        self.scripts.story = ScriptPlan::new(&self.script, &self.cast, 0, None);
        self.shots.retell(&self.scripts.story);
        self.direct();
        let (actor, needs) = self.rehearse();
        let passed_secs = self.clock.passed_secs();
        if passed_secs < 0.0 && self.scripts.live.plans().next().is_none() {
            self.actors = ActorCrossfade::new(actor, needs, self.cast.morphs());
        } else {
            let from_secs = passed_secs.max(self.actors.last_change_secs());
            self.actors.change(from_secs.max(0.0), actor, needs);
        }
        self.forget_motion();
    }
}
