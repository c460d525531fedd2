//! Another face for the figure on stage.

use std::sync::Arc;

use raconteur_player::body::reshape::{NewFace, NewOrgans, Reshaper};
use wasm_bindgen::prelude::*;

use crate::activity::{Activity, ActivityGuard};
use crate::player::Player;

#[wasm_bindgen]
impl Player {
    /// Gives the figure on stage a face of a face model; what is played goes on. `skin` holds x, y and z of
    /// each vertex (metres, frame of the head), `organs` what lies in the head, `factors` those of the
    /// colours of each vertex, of the irises and of the brows, or nothing. Nothing happens before a `load`.
    #[wasm_bindgen(js_name = setFace)]
    pub fn set_face(
        &mut self,
        skin: &[f64],
        organs: &[f64],
        factors: &[f64],
    ) -> Result<(), JsError> {
        let _activity = ActivityGuard::new(Activity::Figure);
        let Some(performer) = &mut self.performer else {
            return Ok(());
        };
        let organs = NewOrgans::from_numbers(organs)
            .ok_or_else(|| JsError::new("what lies in the head takes nine finite numbers"))?;
        let (tone, rest) = factors.split_at(factors.len().saturating_sub(6));
        let colour = |rest: &[f64]| <[f64; 3]>::try_from(rest).unwrap_or([1.0; 3]);
        let (iris, brows) = rest.split_at(rest.len() / 2);
        let reshaper = match self.reshaper.take() {
            Some(reshaper) => reshaper,
            None => Reshaper::new(performer.figure().as_ref().clone(), skin.len() / 3)?,
        };
        let made = reshaper.with_face(&NewFace {
            skin,
            tone,
            organs,
            iris: colour(iris),
            brows: colour(brows),
        });
        // Kept whatever came of it: preparing takes longer than a face.
        self.reshaper = Some(reshaper);
        let figure = Arc::new(made?);
        if let Some(picture) = &mut self.picture {
            picture.set_shape(&figure)?;
        }
        performer.set_face(figure);
        Ok(())
    }
}
