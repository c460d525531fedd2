//! Figures that read stories.

use std::sync::Arc;

use raconteur_player::body::Figure;
use raconteur_player::body::read::read_figure;
use raconteur_player::eml::Diagnostic;
use raconteur_player::{Options, Player as Performer, StoryInput};
use wasm_bindgen::prelude::*;

use crate::activity::note;
use crate::lesson::Lesson;
use crate::message::Story;

/// Returns digests of a story's poses at some times, in hexadecimal: equal digests mean that native
/// and wasm agree to the last bit. Animations are given by name with their texts.
#[wasm_bindgen(js_name = poseDigests)]
#[allow(
    clippy::needless_pass_by_value,
    reason = "optional bytes and lists arrive as owned only"
)]
pub fn pose_digests(
    eml: &str,
    bundle: Option<Vec<u8>>,
    glb: &[u8],
    names: Vec<String>,
    texts: Vec<String>,
    times_secs: &[f64],
) -> Result<Vec<String>, JsError> {
    let figure = Arc::new(read_figure("figure", glb)?);
    let (mut performer, _) = read(eml, bundle.as_deref(), figure, Options::default());
    if !names.is_empty() {
        provide(&mut performer, &names, &texts);
    }
    let digests = times_secs.iter().map(|&t| performer.digest(t));
    Ok(digests.map(|digest| format!("{digest:016x}")).collect())
}

/// Loads a story for a figure; returns its performer and the summary of the story.
pub(crate) fn read(
    eml: &str,
    bundle: Option<&[u8]>,
    figure: Arc<Figure>,
    options: Options,
) -> (Performer, Story) {
    let input = StoryInput {
        eml,
        bundle,
        figure,
        options,
    };
    let loaded = Performer::load_with_progress(input, &mut |stage| note(stage.into()));
    let performer = loaded.player;
    let story = Story::new(
        eml,
        performer.duration_secs(),
        performer.utterances(),
        performer.choice(),
        Lesson::new(performer.questions(), performer.flow()),
        loaded.diagnostics,
    );
    (performer, story)
}

/// Provides a performer with animations by name, an empty text where one was not found. Returns
/// their problems.
pub(crate) fn provide(
    performer: &mut Performer,
    names: &[String],
    texts: &[String],
) -> Vec<Diagnostic> {
    let clips: Vec<(&str, Option<&str>)> = names
        .iter()
        .zip(texts)
        .map(|(name, text)| (name.as_str(), Some(text.as_str()).filter(|t| !t.is_empty())))
        .collect();
    performer.provide_animations(&clips)
}
