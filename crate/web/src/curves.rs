//! For the page of the face: what it does over a time, and why.

use wasm_bindgen::prelude::*;

use crate::drawn;
use crate::player::{Player, has_face};

#[wasm_bindgen]
impl Player {
    /// What the face is asked to do at `count` times from `from` to `to`, story seconds; for
    /// each time 54 numbers: contractions of the muscles in their order, then the jaw's pitch
    /// and yaw (radians), way forwards and down (metres), upper and lower lids, protrusion,
    /// seal, bite, tip, back and protrusion of the tongue, blush.
    #[wasm_bindgen(js_name = faceCurves)]
    pub fn face_curves(&self, from: f64, to: f64, count: usize) -> Vec<f32> {
        let performer = self.performer.as_ref().filter(|_| has_face());
        performer.map_or_else(Vec::new, |p| drawn::controls(p, from, to, count))
    }

    /// What the mouth goes through, as 10 numbers for each segment of everything that is said:
    /// start, end, from when to when it dominates fully (story seconds), its dominance over
    /// opening, rounding, spreading and tongue, and its rates before and after, 1/s.
    pub fn segments(&self) -> Vec<f32> {
        let performer = self.performer.as_ref().filter(|_| has_face());
        performer.map_or_else(Vec::new, drawn::segments)
    }

    /// The names of the phones of `segments`, as the table of phones has them.
    #[wasm_bindgen(js_name = segmentNames)]
    pub fn segment_names(&self) -> Vec<String> {
        let performer = self.performer.as_ref().filter(|_| has_face());
        performer.map_or_else(Vec::new, drawn::names)
    }
}
