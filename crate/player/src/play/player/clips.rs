//! Animations that a story plays and that somebody has to bring.

use raconteur_actor::animation::{Operation, PlayerCommand};
use raconteur_eml::{Diagnostic, thinned};

use super::Player;
use crate::lower::part::Part;
use crate::lower::views::Views;
use crate::lower::{animations, parameters};
use crate::play::layers::Layers;

impl Player {
    /// The names of the animations that the story and live clauses play and that the player
    /// does not have yet, each once: a name of the library, or a path in the story's folder.
    /// Their texts are for [`Player::provide_animations`].
    #[must_use]
    pub fn wanted_animations(&self) -> Vec<String> {
        let mut wanted: Vec<String> = Vec::new();
        let parts = self.parts();
        for (_, command) in parts.clone().flat_map(|p| &p.players) {
            if let PlayerCommand::Operate {
                operation: Operation::Push(name, _) | Operation::Exchange(name, _),
                ..
            } = command
                && self.library.get(name).is_none()
                && !self.missing_animations.contains(name)
                && !wanted.contains(name)
            {
                wanted.push(name.clone());
            }
        }
        for name in parts.flat_map(|p| &p.felt.clips) {
            if self.library.parameters(name).is_none()
                && !self.missing_animations.contains(name)
                && !wanted.contains(name)
            {
                wanted.push(name.clone());
            }
        }
        wanted
    }

    /// Takes animations by name with their text (JSON of `docs/animation.md`, or that of
    /// [`ParameterClip`](raconteur_actor::parameters::ParameterClip) for those of control
    /// parameters), or none where
    /// it could not be had; the story's times follow their lengths. Tells which are missing or
    /// broken; the rest plays. What comes while the story plays eases in.
    pub fn provide_animations(&mut self, clips: &[(&str, Option<&str>)]) -> Vec<Diagnostic> {
        let mut diagnostics = Vec::new();
        let parts = self.parts();
        let faces: Vec<String> = parts.flat_map(|p| p.felt.clips.clone()).collect();
        for (name, text) in clips {
            let is_of_face = faces.iter().any(|n| n == name);
            let problem = match text {
                Some(text) => {
                    let learnt = if is_of_face {
                        self.library.add_parameters(name, text)
                    } else {
                        self.library.add(name, text)
                    };
                    learnt.err().map(|why| {
                        let message = format!("the animation `{name}` cannot be read: {why}");
                        ("player::bad-animation", message)
                    })
                }
                None => {
                    let message = format!("the animation `{name}` was not found; it is left out");
                    Some(("player::no-animation", message))
                }
            };
            if is_of_face && problem.is_none() {
                // Should a player want one of that name, it cannot be had.
                self.missing_animations.push((*name).to_owned());
            }
            if let Some((code, message)) = problem {
                let wanted = if is_of_face {
                    parameters::wanted(&self.script.document)
                } else {
                    animations::wanted(&self.script.document)
                };
                let used = wanted.into_iter().find(|(n, _)| n == name);
                let span = used.map(|(_, span)| span).unwrap_or_default();
                self.missing_animations.push((*name).to_owned());
                let mut warning = Diagnostic::warning(code, span, message);
                if text.is_none() {
                    warning.hints.extend(animations::hint(name));
                }
                diagnostics.push(warning);
            }
        }
        self.script.retime(&self.library);
        self.story = Part::new(&self.script, &self.units, self.hands, 0, None);
        self.geometry.retell(&self.story.geometry);
        let parts = self.parts();
        self.views = Views::new(self.options.shot, parts.flat_map(|p| p.shots.iter()));
        let (actor, room) = self.rehearse_all(self.layers.last_room());
        if self.passed_secs < 0.0 && self.live.parts().next().is_none() {
            self.layers = Layers::new(actor, room, self.figure.morph_names.len());
        } else {
            let from_secs = self.passed_secs.max(self.layers.last_change_secs());
            self.layers.change(from_secs.max(0.0), actor, room);
        }
        self.forget_face();
        thinned(diagnostics)
    }
}
