//! What cannot be in an utterance.

use super::Utterance;

/// A file that is not made for bundles has other names.
fn plain(name: &str) -> bool {
    !name.is_empty()
        && !name.starts_with('.')
        && name
            .chars()
            .all(|c| c.is_ascii_alphanumeric() || "._-".contains(c))
}

impl Utterance {
    /// What is wrong with it, if anything.
    pub(super) fn check(&self, voices: usize) -> Result<(), String> {
        if let Some(bad) = self.audio.iter().find(|a| !plain(&a.file)) {
            let name: String = bad.file.chars().flat_map(char::escape_default).collect();
            return Err(["\"", &name, "\" is not a plain file name"].concat());
        }
        if self.voice >= voices {
            return Err("its voice is not there".to_owned());
        }
        #[cfg(feature = "bake")]
        self.check_melody()?;
        Ok(())
    }

    #[cfg(feature = "bake")]
    fn check_melody(&self) -> Result<(), String> {
        let words = |first: usize, words: usize| first.saturating_add(words) <= self.words.len();
        let wrong = [
            (
                self.syllables.iter().any(|s| {
                    s.phones == 0 || s.first_phone.saturating_add(s.phones) > self.phones.len()
                }),
                "a syllable has phones that are not there",
            ),
            (
                !self.phrases.iter().all(|p| words(p.first_word, p.words)),
                "a phrase has words that are not there",
            ),
            (
                !self.sentences.iter().all(|s| words(s.first_word, s.words)),
                "a sentence has words that are not there",
            ),
            (
                self.emotions.iter().any(|e| {
                    // Written so that a NaN fails as well; 1 ms forgives rounding.
                    let fine = 0.0 <= e.start_secs
                        && e.start_secs <= e.apex_secs
                        && e.apex_secs <= e.end_secs
                        && e.end_secs <= self.duration_secs + 1e-3;
                    !fine
                }),
                "an emotion is out of the utterance",
            ),
        ];
        match wrong.iter().find(|(is, _)| *is) {
            Some((_, what)) => Err((*what).to_owned()),
            None => Ok(()),
        }
    }
}
