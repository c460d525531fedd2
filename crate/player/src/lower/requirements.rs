//! Requirements of a document's clauses: animations that the page must supply.

use raconteur_actor::animation::stem;
use raconteur_eml::{
    Clause, ClauseKind, Document, LoadControlParameterAnimation, PrimitiveKind, Span,
};

/// Maximum number of control parameter animations in a script; further ones are omitted.
const MAX_PARAMETER_ANIMATIONS: usize = 100;

/// Animations that a document requires, each name once, with the first clause that requires it.
#[derive(Default)]
pub(crate) struct Requirements<'d> {
    /// Animations of the body: from the library by name, next to the story by path.
    pub(crate) body_animations: Vec<(&'d str, Span)>,
    /// Animations of control parameters, those that are loaded before those of the library.
    pub(crate) parameter_animations: Vec<(&'d str, Span)>,
}

/// Resource required by one clause.
enum Requirement<'d> {
    /// The clause requires no animation.
    Nothing,
    BodyAnimation(&'d str),
    /// An animation of control parameters under the name of its text.
    LoadedParameters(&'d str),
    /// Control parameter animation, by the name under which it was loaded or by its name in the
    /// library.
    PlayedParameters(&'d str),
}

impl<'d> Requirements<'d> {
    /// Collects the requirements of a document.
    pub(crate) fn from_document(document: &'d Document) -> Self {
        let mut needs = Self::default();
        let mut played = Vec::new();
        for (_, clause) in document.iter() {
            let span = clause.tag_span;
            match Requirement::from_clause(clause) {
                Requirement::Nothing => {}
                Requirement::BodyAnimation(name) => {
                    add_once(&mut needs.body_animations, name, span);
                }
                Requirement::LoadedParameters(name) => needs.add_parameters(name, span),
                Requirement::PlayedParameters(name) => played.push((name, span)),
            }
        }
        let loaded = needs.parameter_animations.clone();
        let is_loaded = |id: &str| loaded.iter().any(|(n, _)| *n == id || stem(n) == id);
        for (name, span) in played {
            if !is_loaded(name) {
                needs.add_parameters(name, span);
            }
        }
        needs
    }

    /// Returns the names of all required animations, those of control parameters first.
    pub(crate) fn animations(&self) -> impl Iterator<Item = &'d str> {
        let parameters = self.parameter_animations.iter();
        parameters
            .chain(&self.body_animations)
            .map(|(name, _)| *name)
    }

    /// Returns the clause that first requires an animation; the document's start if there is none.
    pub(crate) fn span(&self, name: &str, is_of_parameters: bool) -> Span {
        let needed = if is_of_parameters {
            &self.parameter_animations
        } else {
            &self.body_animations
        };
        let used = needed.iter().find(|(n, _)| *n == name);
        used.map(|(_, span)| *span).unwrap_or_default()
    }

    fn add_parameters(&mut self, name: &'d str, span: Span) {
        if self.parameter_animations.len() < MAX_PARAMETER_ANIMATIONS {
            add_once(&mut self.parameter_animations, name, span);
        }
    }
}

impl<'d> Requirement<'d> {
    fn from_clause(clause: &'d Clause) -> Self {
        match &clause.kind {
            ClauseKind::DeterministicPrimitive(primitive) => {
                match (primitive.primitive, primitive.animation.as_deref()) {
                    (PrimitiveKind::Push | PrimitiveKind::Exchange, Some(name)) => {
                        Self::BodyAnimation(name)
                    }
                    _ => Self::Nothing,
                }
            }
            ClauseKind::LoadControlParameterAnimation(load) => Self::LoadedParameters(source(load)),
            ClauseKind::AnimateControlParameter(animate) => {
                Self::PlayedParameters(&animate.animation)
            }
            _ => Self::Nothing,
        }
    }
}

/// Returns the name of a loaded animation's text: in the library the file name only, next to the
/// story its path.
fn source(load: &LoadControlParameterAnimation) -> &str {
    if load.is_resources_relative {
        stem(&load.file)
    } else {
        &load.file
    }
}

fn add_once<'d>(needed: &mut Vec<(&'d str, Span)>, name: &'d str, span: Span) {
    if !needed.iter().any(|(n, _)| *n == name) {
        needed.push((name, span));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Script;

    #[test]
    fn loaded_animations_are_needed_by_file_and_others_by_name() {
        let load = |file: &str, library: bool| {
            format!(
                "<body-load-control-parameter-animation time='0' file='{file}' \
                 isResourcesRelative='{library}'/>"
            )
        };
        let play =
            |id: &str| format!("<body-animate-control-parameter time='0' animationId='{id}'/>");
        let body = [
            load("faces/visemes-1.xml", true),
            load("own/wink.json", false),
            play("visemes-1"),
            play("wink"),
            play("own/wink.json"),
            play("grin"),
            play("grin"),
        ]
        .concat();
        let script = Script::read(&format!("<eml><body>{body}</body></eml>"), None);
        let names: Vec<&str> = Requirements::from_document(&script.document)
            .animations()
            .collect();
        assert_eq!(names, ["visemes-1", "own/wink.json", "grin"]);
        assert_eq!(script.needed_animations(), names);
    }
}
