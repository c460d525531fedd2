//! Animation library, addressed by name.

use std::sync::Arc;

use raconteur_body::HandShape;

use super::clip::Clip;
use super::keyframes::read_clip;
use crate::parameters::ParameterClip;

/// Animations that a story may use, by name: clips of bones and animations of control parameters.
/// Copies share the data.
#[derive(Clone, Debug, Default)]
pub struct Library {
    clips: Vec<(String, Arc<Clip>)>,
    parameters: Vec<(String, Arc<ParameterClip>)>,
}

/// Names of the stances that every library has: the hand shapes of the dictionary by number.
const HAND_SHAPE: &str = "hand-shape-";

impl Library {
    /// Reads a clip (see [`read_clip`]) and stores it under a name, replacing any clip of that
    /// name.
    ///
    /// # Errors
    /// Returns an error message that describes the problem in the text; the library is then
    /// unchanged.
    pub fn add(&mut self, name: &str, text: &str) -> Result<(), String> {
        let clip = Arc::new(read_clip(text)?);
        self.clips.retain(|(n, _)| n != name);
        self.clips.push((name.to_owned(), clip));
        Ok(())
    }

    /// Reads an animation of control parameters (see [`ParameterClip::read`]) and stores it under a
    /// name, replacing any of that name.
    ///
    /// # Errors
    /// Returns an error message that describes the problem in the text; the library is then
    /// unchanged.
    pub fn add_parameters(&mut self, name: &str, text: &str) -> Result<(), String> {
        let clip = Arc::new(ParameterClip::read(text)?);
        self.parameters.retain(|(n, _)| n != name);
        self.parameters.push((name.to_owned(), clip));
        Ok(())
    }

    /// Returns an animation of control parameters by its name, or by the name of its file without
    /// folders and extension; `None` if there is none.
    #[must_use]
    pub fn parameters(&self, name: &str) -> Option<Arc<ParameterClip>> {
        let own = self.parameters.iter().find(|(n, _)| n == name);
        let of_file = || self.parameters.iter().rev().find(|(n, _)| stem(n) == name);
        own.or_else(of_file).map(|(_, clip)| Arc::clone(clip))
    }

    /// Returns a clip by name, or `None`. `hand-shape-0` to `hand-shape-60` always exist.
    #[must_use]
    pub fn get(&self, name: &str) -> Option<Arc<Clip>> {
        if let Some((_, clip)) = self.clips.iter().find(|(n, _)| n == name) {
            return Some(Arc::clone(clip));
        }
        let id = name.strip_prefix(HAND_SHAPE)?.parse().ok()?;
        HandShape::get(id).map(|shape| Arc::new(Clip::of_hand_shape(shape)))
    }
}

/// Returns a file name without folders and extension.
#[must_use]
pub fn stem(path: &str) -> &str {
    let file = path.rsplit('/').next().unwrap_or(path);
    match file.rsplit_once('.') {
        Some((stem, _)) if !stem.is_empty() => stem,
        _ => file,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn animations_of_parameters_are_known_by_their_files() {
        let mut library = Library::default();
        let text = r#"{"seconds": 1, "parameters": {"Joy": {"times": [0], "values": [1]}}}"#;
        assert_eq!(library.add_parameters("faces/wink.json", text), Ok(()));
        assert!(
            library.add_parameters("faces/grin.json", "{}").is_err(),
            "an incomplete parameter animation is rejected"
        );
        for (name, is_there) in [
            ("wink", true),
            ("faces/wink.json", true),
            ("wink.json", false),
            ("grin", false),
        ] {
            assert_eq!(library.parameters(name).is_some(), is_there, "{name}");
        }
        assert_eq!(
            ["a/b.c.json", "b", ".b", "a/"].map(stem),
            ["b.c", "b", ".b", ""]
        );
    }
}
