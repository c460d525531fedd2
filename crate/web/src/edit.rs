//! Functions for editing pages: another text for the current performer, and overlays on the frame.

use raconteur_player::stage::{FramingMargin, Lighting, View};
use wasm_bindgen::prelude::*;

use crate::player::Player;

/// Framing margin for every place that a fingertip reaches, as shares of stature: shoulders at 0.82
/// and 0.11 (ANSUR), an arm of 0.30 (GEVH table A.1) and a hand of 0.11. It keeps the framing
/// constant while a hand is dragged.
const REACH_UP: f64 = 1.23;
const REACH_OUT: f64 = 0.52;

#[wasm_bindgen]
#[allow(
    clippy::needless_pass_by_value,
    reason = "optional bytes arrive as owned only"
)]
impl Player {
    /// Reads another text for the figure on stage, which keeps its images; arguments and result are
    /// those of `load`. Returns nothing before a `load`. The caller controls the clock: seek to
    /// continue elsewhere. `roomy`: the framing has room for every place to which a hand may be
    /// dragged, and stays constant meanwhile.
    pub fn rehearse(
        &mut self,
        eml: &str,
        bundle: Option<Vec<u8>>,
        motion: f64,
        roomy: bool,
    ) -> Result<JsValue, JsError> {
        let Some(before) = &self.performer else {
            return Ok(JsValue::UNDEFINED);
        };
        let stature_m = before.figure().skeleton.stature_m();
        let room = match roomy {
            true => FramingMargin {
                top_m: REACH_UP * stature_m,
                half_width_m: REACH_OUT * stature_m,
                ..FramingMargin::default()
            },
            false => FramingMargin::default(),
        };
        self.read_again(eml, bundle.as_deref(), motion, room)
    }

    /// Shows the whole figure from another direction, in this text and later rehearsed ones:
    /// azimuth (radians, positive to its left), elevation (radians), zoom factor, and offset of the
    /// image centre to the right and up (metres).
    #[wasm_bindgen(js_name = setView)]
    pub fn set_view(&mut self, turn: f64, tilt: f64, zoom: f64, right: f64, up: f64) {
        self.view = [turn, tilt, zoom, right, up]
            .iter()
            .all(|n| n.is_finite())
            .then_some(View {
                turn_rad: turn,
                tilt_rad: tilt,
                zoom,
                right_m: right,
                up_m: up,
            });
        if let Some(performer) = &mut self.performer {
            performer.set_view(self.view);
        }
    }

    /// Lights the stage by a preset of `Lighting::PRESETS`, turned about the figure, radians; by
    /// the set's own light for an unknown name.
    #[wasm_bindgen(js_name = setLight)]
    pub fn set_light(&mut self, name: &str, turn: f64) {
        let turn = if turn.is_finite() { turn } else { 0.0 };
        let named = Lighting::named(name);
        let is_chosen = named.is_some() || turn != 0.0;
        self.lighting = is_chosen.then(|| named.unwrap_or_default().turned(turn));
        if let Some(performer) = &mut self.performer {
            performer.set_lighting(self.lighting);
        }
    }

    /// Keeps hands and feet above captions that take this share of the image height at its lower
    /// edge, 0 to 0.4, in this text and later rehearsed ones.
    #[wasm_bindgen(js_name = setCaptions)]
    pub fn set_captions(&mut self, share: f64) {
        self.captions = if share.is_finite() { share } else { 0.0 };
        if let Some(performer) = &mut self.performer {
            performer.set_captions(self.captions);
        }
    }

    /// Returns the last displayed pose as numbers, in the order that `web/element/engine/pose.ts`
    /// reads. World, metres and radians; empty before a `load`.
    ///
    /// - 10 of the camera: eye, target, vertical field of view, aspect, near and far plane;
    /// - 4 of EML's coordinates: the speaker's origin, metres a unit;
    /// - the number of joints, and for each its parent (-1 for the root) and the columns of
    ///   its transform, 13 together;
    /// - for each manipulator its target and how far from there it ended, 4 together.
    pub fn pose(&mut self) -> Vec<f32> {
        let mut numbers = Vec::new();
        let Some(performer) = &mut self.performer else {
            return numbers;
        };
        let manipulators = performer.hand_targets(performer.last_frame().time_secs);
        let mut put = |values: &[f64]| numbers.extend(values.iter().map(|&v| v as f32));
        let frame = performer.last_frame();
        let camera = &frame.camera;
        put(&camera.eye_in_world.to_array());
        put(&camera.target_in_world.to_array());
        put(&[camera.fov_y_rad, self.aspect, camera.near_m, camera.far_m]);
        let units = performer.units();
        put(&units.speaker_point([0.0; 3]).to_array());
        let joints = performer.figure().skeleton.joints();
        put(&[units.world_point([1.0, 0.0, 0.0]).x, joints.len() as f64]);
        for (joint, world) in joints.iter().zip(&frame.world_from_joint) {
            put(&[joint.parent.map_or(-1.0, |p| p as f64)]);
            put(&world.to_cols_array());
        }
        for manipulator in &manipulators {
            put(&manipulator.target_in_world.to_array());
            put(&[manipulator.error_m]);
        }
        numbers
    }

    /// Names of the joints in the order of `pose`, then those of the manipulators.
    #[wasm_bindgen(js_name = poseNames)]
    pub fn pose_names(&mut self) -> Vec<String> {
        let Some(performer) = &mut self.performer else {
            return Vec::new();
        };
        let manipulators = performer.hand_targets(performer.last_frame().time_secs);
        let joints = performer.figure().skeleton.joints().iter();
        joints
            .map(|j| j.name.clone())
            .chain(manipulators.iter().map(|m| m.name.to_owned()))
            .collect()
    }
}
