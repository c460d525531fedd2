//! Animations by name.

use std::sync::Arc;

use raconteur_body::HandShape;

use super::clip::Clip;
use super::keyframes::read_clip;

/// The animations that a story may use. Copies share the clips.
#[derive(Clone, Debug, Default)]
pub struct Library {
    clips: Vec<(String, Arc<Clip>)>,
}

/// Names of the stances that every library has: the hand shapes of the dictionary by number.
const HAND_SHAPE: &str = "hand-shape-";

impl Library {
    /// Reads a clip (see [`read_clip`]) and keeps it under a name, in the place of one that
    /// has it.
    ///
    /// # Errors
    /// A sentence that says what is wrong with the text; the library is as it was.
    pub fn add(&mut self, name: &str, text: &str) -> Result<(), String> {
        let clip = Arc::new(read_clip(text)?);
        self.clips.retain(|(n, _)| n != name);
        self.clips.push((name.to_owned(), clip));
        Ok(())
    }

    /// The animation of a name. `hand-shape-0` to `hand-shape-60` are always there.
    #[must_use]
    pub fn get(&self, name: &str) -> Option<Arc<Clip>> {
        if let Some((_, clip)) = self.clips.iter().find(|(n, _)| n == name) {
            return Some(Arc::clone(clip));
        }
        let id = name.strip_prefix(HAND_SHAPE)?.parse().ok()?;
        HandShape::get(id).map(|shape| Arc::new(Clip::of_hand_shape(shape)))
    }
}
