//! Curves for the face page: controls and articulation over time.

use raconteur_player::Player as Performer;
use raconteur_player::body::face::{FaceControls, MUSCLES};
use wasm_bindgen::prelude::*;

use crate::player::Player;

/// Maximum number of samples per call.
const MAX_SAMPLES: usize = 4096;

/// Appends the controls of a face.
fn push_controls(c: &FaceControls, numbers: &mut Vec<f32>) {
    let mut put = |values: &[f64]| numbers.extend(values.iter().map(|&v| v as f32));
    let all: &[f64; MUSCLES] = &c.contraction;
    put(all);
    put(&[
        c.jaw.pitch_rad,
        c.jaw.yaw_rad,
        c.jaw.forward_m,
        c.jaw.down_m,
    ]);
    put(&c.upper_lid);
    put(&c.lower_lid);
    put(&c.protrusion);
    put(&[
        c.seal,
        c.bite,
        c.tongue_tip,
        c.tongue_back,
        c.tongue_out,
        c.blush,
    ]);
}

#[wasm_bindgen]
impl Player {
    /// Returns the face controls at `count` times from `from` to `to`, story seconds; for each time
    /// contractions of the muscles in their order, then 16 numbers: the jaw's pitch and yaw
    /// (radians), translation forwards and down (metres), upper and lower lids, protrusion, seal,
    /// bite, tip, back and protrusion of the tongue, blush.
    #[wasm_bindgen(js_name = faceCurves)]
    pub fn face_curves(&self, from: f64, to: f64, count: usize) -> Vec<f32> {
        let mut numbers = Vec::new();
        let Some(performer) = &self.performer else {
            return numbers;
        };
        let count = count.min(MAX_SAMPLES);
        for i in 0..count {
            let share = i as f64 / (count - 1).max(1) as f64;
            let mut controls = performer.face_controls(from + (to - from) * share);
            controls.limit();
            push_controls(&controls, &mut numbers);
        }
        numbers
    }

    /// Returns ten numbers for each speech segment: start, end, start and end of full dominance
    /// (story seconds), dominance over opening, rounding, spreading and tongue, rate of dominance
    /// before and after, 1/s.
    pub fn segments(&self) -> Vec<f32> {
        let mut numbers = Vec::new();
        for (start, track) in self.performer.iter().flat_map(Performer::lips) {
            for (_, segment) in track.segments() {
                let own = segment.iter().enumerate();
                numbers.extend(own.map(|(k, v)| (v + if k < 4 { *start } else { 0.0 }) as f32));
            }
        }
        numbers
    }

    /// Returns the phone of each segment in `segments`, by its name in the phone table.
    #[wasm_bindgen(js_name = segmentNames)]
    pub fn segment_names(&self) -> Vec<String> {
        let tracks = self.performer.iter().flat_map(Performer::lips);
        let segments = tracks.flat_map(|(_, track)| track.segments());
        segments.map(|(name, _)| name.to_owned()).collect()
    }
}
