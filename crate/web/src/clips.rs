//! Animations of a story, fetched by the page.

use raconteur_player::Player as Performer;
use wasm_bindgen::prelude::*;

use crate::activity::{Activity, ActivityGuard};
use crate::lesson::Lesson;
use crate::message::Story;
use crate::player::{Player, plain};
use crate::reading::provide;

#[wasm_bindgen]
#[allow(clippy::needless_pass_by_value, reason = "lists arrive as owned only")]
impl Player {
    /// Returns the names of animations that the story or live clauses play and that have not been
    /// provided: names in the library, or paths in the story's folder.
    #[wasm_bindgen(js_name = wantedAnimations)]
    pub fn needed_animations(&self) -> Vec<String> {
        let performer = self.performer.as_ref();
        performer.map_or_else(Vec::new, Performer::needed_animations)
    }

    /// Takes animations by name with their texts; an empty text means not found. Returns the story
    /// like `load`, with only the problems of these animations; `eml` is its text.
    #[wasm_bindgen(js_name = provideAnimations)]
    pub fn provide_animations(
        &mut self,
        eml: &str,
        names: Vec<String>,
        texts: Vec<String>,
    ) -> Result<JsValue, JsError> {
        let _activity = ActivityGuard::new(Activity::Animation);
        let Some(performer) = &mut self.performer else {
            return Ok(JsValue::UNDEFINED);
        };
        let problems = provide(performer, &names, &texts);
        plain(&Story::new(
            eml,
            performer.duration_secs(),
            performer.utterances(),
            performer.choice(),
            Lesson::new(performer.questions(), performer.flow()),
            problems,
        ))
    }
}
