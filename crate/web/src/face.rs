//! New face for the figure on stage, with its hair and accessories.

use std::sync::Arc;

use raconteur_player::base::{DVec3, ops};
use raconteur_player::body::read::read_figure;
use raconteur_player::body::{Bone, HairColour};
use raconteur_player::reshape::{
    HairDonor, Look, NewFace, NewOrgans, Reshaper, SpeckleKind, SurfacePoint,
};
use serde::Serialize;
use wasm_bindgen::prelude::*;

use crate::activity::{Activity, ActivityGuard};
use crate::player::{Player, plain};

/// A colour of hair; `NaturalHair` in `web/element/base/face-types.ts`.
#[derive(Serialize)]
struct NaturalHair {
    name: &'static str,
    colour: HairColour,
    rgb: [f64; 3],
}

#[wasm_bindgen]
impl Player {
    /// Sets a face of a face model on the figure on stage; playback continues. `skin` holds x, y
    /// and z of each vertex (metres, frame of the head), `organs` the parts in the head, `factors`
    /// those of the colours of each vertex, of the irises and of the brows, or nothing; `look` is a
    /// `FaceLook` of `web/element/base/face-types.ts`, or undefined. With `moves` it is an
    /// intermediate face: it is shown fast rather than in full detail. No effect before a `load`.
    #[wasm_bindgen(js_name = setFace)]
    pub fn set_face(
        &mut self,
        skin: &[f64],
        organs: &[f64],
        factors: &[f64],
        look: JsValue,
        moves: bool,
    ) -> Result<(), JsError> {
        let _activity = ActivityGuard::new(Activity::Figure);
        let Some(performer) = &mut self.performer else {
            return Ok(());
        };
        let organs = NewOrgans::from_numbers(organs)
            .ok_or_else(|| JsError::new("the organs of the head need nine finite numbers"))?;
        let look = if look.is_undefined() {
            Look::default()
        } else {
            serde_wasm_bindgen::from_value(look)?
        };
        let face = NewFace::from_numbers(skin, factors, organs);
        let reshaper = match self.reshaper.take() {
            Some(reshaper) => reshaper,
            None => Reshaper::new(performer.figure().as_ref().clone(), skin.len() / 3)?,
        };
        let made = reshaper.with_look(&face, &look, &self.donors);
        // The reshaper is stored regardless of the result, because its preparation takes longer
        // than a face.
        self.reshaper = Some(reshaper);
        let figure = Arc::new(made?);
        self.hair = [look.hair, look.beard];
        if let Some(picture) = &mut self.picture {
            picture.set_shape(performer.figure(), &figure, moves)?;
        }
        if moves {
            performer.move_face(figure);
        } else {
            performer.set_face(figure);
        }
        Ok(())
    }

    /// Returns the natural hair colours from dark to pale, as `NaturalHair` objects; `rgb` is
    /// linear.
    #[wasm_bindgen(js_name = naturalHair)]
    pub fn natural_hair(&self) -> Result<JsValue, JsError> {
        let entries = HairColour::NATURAL
            .iter()
            .map(|(name, colour)| NaturalHair {
                name,
                colour: *colour,
                rgb: colour.linear_rgb(),
            });
        plain(&entries.collect::<Vec<_>>())
    }

    /// Returns true if a hair donor of this name is loaded.
    #[wasm_bindgen(js_name = hasDonor)]
    #[must_use]
    pub fn has_donor(&self, name: &str) -> bool {
        self.donors.contains_key(name)
    }

    /// Adds a figure as hair donor for faces of a number of vertices.
    #[wasm_bindgen(js_name = addDonor)]
    pub fn add_donor(&mut self, name: &str, glb: &[u8], vertices: usize) -> Result<(), JsError> {
        let _activity = ActivityGuard::new(Activity::Figure);
        let lender = HairDonor::new(&read_figure(name, glb)?, vertices)?;
        self.donors.insert(name.to_owned(), lender);
        Ok(())
    }

    /// Returns the visible point of the skin at an image position, −1 to 1 from the left and from
    /// the bottom: three vertices and their weights; nothing outside the head, and before a face
    /// was set.
    #[wasm_bindgen(js_name = pickFace)]
    #[must_use]
    pub fn pick_face(&self, x: f64, y: f64) -> Option<Vec<f64>> {
        let (reshaper, performer) = (self.reshaper.as_ref()?, self.performer.as_ref()?);
        let frame = performer.last_frame();
        let camera = frame.camera;
        let ahead = (camera.target_in_world - camera.eye_in_world).try_normalize()?;
        let right = ahead.cross(DVec3::Y).try_normalize()?;
        let half = ops::tan(camera.fov_y_rad / 2.0);
        let to = ahead + right * (x * half * self.aspect) + right.cross(ahead) * (y * half);
        let skull = frame.world_from_joint.get(Bone::Skull.index())?;
        let spot = reshaper.pick(performer.figure(), skull, camera.eye_in_world, to)?;
        let corners = spot.corners.map(f64::from);
        Some(corners.into_iter().chain(spot.shares).collect())
    }

    /// Returns the texture coordinates of a point of the skin, as returned by `pickFace`, and their
    /// change per metre to the right and upwards.
    #[wasm_bindgen(js_name = faceChart)]
    #[must_use]
    pub fn face_chart(&self, spot: &[f64]) -> Option<Vec<f64>> {
        let (reshaper, performer) = (self.reshaper.as_ref()?, self.performer.as_ref()?);
        let chart = reshaper.chart(performer.figure(), &SurfacePoint::from_numbers(spot)?)?;
        Some([chart.uv, chart.right, chart.up].concat())
    }

    /// Returns the data for painting hair areas on that texture when the hair has changed: linear
    /// red, green and blue, the position of skin like a bare scalp, the number of corners under
    /// hair, then their texture coordinates, and those of bare corners.
    #[must_use]
    pub fn scalp(&self) -> Option<Vec<f32>> {
        let (reshaper, performer) = (self.reshaper.as_ref()?, self.performer.as_ref()?);
        let [hair, beard] = &self.hair;
        let paint = reshaper.scalp_paint(performer.figure(), hair, beard);
        let count = paint.corners.len();
        if count == 0 && paint.bare.is_empty() {
            return None;
        }
        let head = paint.rgb.map(|x| x as f32).into_iter().chain(paint.like);
        let places = paint.corners.into_iter().chain(paint.bare).flatten();
        Some(head.chain([count as f32]).chain(places).collect())
    }

    /// Returns spots of a kind, `freckles`, `stubble`, `ageSpots` or `moles`, at the positions of a
    /// seed, in random order: for each the result of `faceChart` for its position, then its
    /// strength, 0..1.
    #[must_use]
    pub fn speckles(&self, kind: &str, seed: u32) -> Option<Vec<f32>> {
        let (reshaper, performer) = (self.reshaper.as_ref()?, self.performer.as_ref()?);
        let kind = match kind {
            "freckles" => SpeckleKind::Freckles,
            "stubble" => SpeckleKind::Stubble,
            "ageSpots" => SpeckleKind::AgeSpots,
            "moles" => SpeckleKind::Moles,
            _ => return None,
        };
        let spots = reshaper.speckles(performer.figure(), kind, u64::from(seed));
        let numbers = spots.iter().flat_map(|s| {
            let [uv, right, up] = [s.chart.uv, s.chart.right, s.chart.up];
            [uv[0], uv[1], right[0], right[1], up[0], up[1], s.strength]
        });
        Some(numbers.map(|x| x as f32).collect())
    }

    /// Returns the index of the figure's image with the colour of its skin.
    #[wasm_bindgen(js_name = skinImage)]
    #[must_use]
    pub fn skin_image(&self) -> Option<usize> {
        self.reshaper.as_ref()?.skin_picture()
    }
}
