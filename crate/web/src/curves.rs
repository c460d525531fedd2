//! For the page of the face: what it does over a time, and why.

use raconteur_player::body::face::MUSCLES;
use raconteur_player::{Manner, Way};
use wasm_bindgen::prelude::*;

use crate::player::Player;

/// Samples that are taken at once at most.
const MOST: usize = 4096;

#[wasm_bindgen]
impl Player {
    /// What the face is asked to do at `count` times from `from` to `to`, story seconds; for
    /// each time 54 numbers: contractions of the muscles in their order, then the jaw's pitch
    /// and yaw (radians), way forwards and down (metres), upper and lower lids, protrusion,
    /// seal, bite, tip, back and protrusion of the tongue, blush.
    #[wasm_bindgen(js_name = faceCurves)]
    pub fn face_curves(&self, from: f64, to: f64, count: usize) -> Vec<f32> {
        let mut numbers = Vec::new();
        let Some(performer) = &self.performer else {
            return numbers;
        };
        let count = count.min(MOST);
        for i in 0..count {
            let share = i as f64 / (count - 1).max(1) as f64;
            let mut c = performer.face_controls(from + (to - from) * share);
            c.limit();
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
        numbers
    }

    /// What the mouth goes through, as 10 numbers for each segment of everything that is said:
    /// start, end, from when to when it dominates fully (story seconds), its dominance over
    /// opening, rounding, spreading and tongue, and its rates before and after, 1/s.
    pub fn segments(&self) -> Vec<f32> {
        let mut numbers = Vec::new();
        let lips = self.performer.as_ref().map_or(&[][..], |p| p.lips());
        for (start, track) in lips {
            for (_, segment) in track.segments() {
                let own = segment.iter().enumerate();
                numbers.extend(own.map(|(k, v)| (v + if k < 4 { *start } else { 0.0 }) as f32));
            }
        }
        numbers
    }

    /// The names of the phones of `segments`, as the table of phones has them.
    #[wasm_bindgen(js_name = segmentNames)]
    pub fn segment_names(&self) -> Vec<String> {
        let lips = self.performer.as_ref().map_or(&[][..], |p| p.lips());
        let tracks = lips.iter().flat_map(|(_, track)| track.segments());
        tracks.map(|(name, _)| name.to_owned()).collect()
    }

    /// Whether what accompanies speech is made from its text instead of its sound, in texts
    /// that are read from now on.
    #[wasm_bindgen(js_name = setTextWay)]
    pub fn set_text_way(&mut self, text: bool) {
        self.manner = Manner {
            way: if text { Way::Text } else { Way::Audio },
            ..Manner::default()
        };
    }
}
