//! Checks of a read utterance.

use super::Utterance;

/// Returns true if a name is a plain file name in a bundle.
fn plain(name: &str) -> bool {
    !name.is_empty()
        && !name.starts_with('.')
        && name
            .chars()
            .all(|c| c.is_ascii_alphanumeric() || "._-".contains(c))
}

impl Utterance {
    /// Rejects file names outside the folder, and unknown voices.
    pub(super) fn check(&self, voices: usize) -> Result<(), String> {
        if let Some(bad) = self.audio.iter().find(|a| !plain(&a.file)) {
            let name: String = bad.file.chars().flat_map(char::escape_default).collect();
            return Err(["\"", &name, "\" is not a plain file name"].concat());
        }
        if self.voice >= voices {
            return Err("its voice is not there".to_owned());
        }
        Ok(())
    }
}
