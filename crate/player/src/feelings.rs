//! From emotions and control parameters of a script to what the actor is asked.
//!
//! A browser fetches their code in a file of its own. All of it is reached through this module
//! alone, and only where it is there ([`Options::feels`](crate::Options::feels)):
//! `web/tools/split.mjs` cuts there. Its functions are never inlined, or the code would come
//! along.

use raconteur_actor::parameters::ParameterCommand;
use raconteur_actor::{EmotionSpan, Library};
use raconteur_eml::{Diagnostic, Document, Span};

use crate::cues::UtteranceCue;
use crate::script::Script;
use crate::{emotions, parameters};

/// What a script asks of what is felt.
#[derive(Default)]
pub(crate) struct Felt {
    /// What is felt.
    pub(crate) emotions: Vec<EmotionSpan>,
    /// What control parameters are asked for, by time.
    pub(crate) parameters: Vec<(f64, ParameterCommand)>,
    /// The names of the animations of parameters that it needs.
    pub(crate) clips: Vec<String>,
}

/// All of a script.
#[inline(never)]
pub(crate) fn lower(script: &Script, utterances: &[UtteranceCue]) -> Felt {
    let clips = parameters::wanted(&script.document).into_iter();
    Felt {
        emotions: emotions::spans(script, utterances),
        parameters: parameters::commands(&script.document, &script.timeline),
        clips: clips.map(|(name, _)| name.to_owned()).collect(),
    }
}

/// As [`parameters::problems`].
#[inline(never)]
pub(crate) fn problems(document: &Document) -> Vec<Diagnostic> {
    parameters::problems(document)
}

/// As [`parameters::wanted`].
#[inline(never)]
pub(crate) fn wanted(document: &Document) -> Vec<(&str, Span)> {
    parameters::wanted(document)
}

/// As [`Library::add_parameters`].
#[inline(never)]
pub(crate) fn learn(library: &mut Library, name: &str, text: &str) -> Result<(), String> {
    library.add_parameters(name, text)
}
