//! Options of a performance.

use raconteur_actor::Manner;
use raconteur_base::Side;
use raconteur_stage::{FramingMargin, Shot};

/// Options of a performance: seed, amount of motion, manner, handedness, language and camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// Seed of blinks, glances, idle motion, and the choice of library music.
    pub seed: u64,
    /// Idle life, from 0 (still) to 1.
    pub motion_amount: f64,
    /// Manner in which face and head accompany speech.
    pub manner: Manner,
    /// Dominant hand; `None`: the story's, else the figure's.
    pub handedness: Option<Side>,
    /// Default language for text without a language in script or bundle: that of the surrounding
    /// page.
    pub language: Option<LanguageTag>,
    /// Shot size until the script sets another.
    pub shot: Shot,
    /// True if emotions move the camera; false to cut instead, for users who prefer reduced motion.
    pub moving_camera: bool,
    /// Minimum framing margin for gestures, even if the script's own are smaller: it keeps the
    /// framing constant while a script is edited.
    pub margin: FramingMargin,
}

/// Language tag of BCP 47 in a fixed buffer that fits any needed length (RFC 5646, section 4.4.1).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LanguageTag {
    letters: [u8; Self::MAX_TAG_BYTES],
    length: usize,
}

impl LanguageTag {
    const MAX_TAG_BYTES: usize = 35;

    /// Creates a language tag; `None` if it is empty, too long, or contains other characters than
    /// letters, digits and hyphens.
    #[must_use]
    pub fn new(tag: &str) -> Option<Self> {
        let is_of_tag = |b: u8| b.is_ascii_alphanumeric() || b == b'-';
        if tag.is_empty() || tag.len() > Self::MAX_TAG_BYTES || !tag.bytes().all(is_of_tag) {
            return None;
        }
        let mut letters = [0; Self::MAX_TAG_BYTES];
        letters[..tag.len()].copy_from_slice(tag.as_bytes());
        let length = tag.len();
        Some(Self { letters, length })
    }

    /// Returns the language tag as text.
    #[must_use]
    pub fn as_str(&self) -> &str {
        // The content is only ASCII.
        str::from_utf8(&self.letters[..self.length]).unwrap_or_default()
    }
}

impl Default for Options {
    fn default() -> Self {
        Self {
            seed: 1,
            motion_amount: 1.0,
            manner: Manner::default(),
            handedness: None,
            language: None,
            shot: Shot::Storyteller,
            moving_camera: true,
            margin: FramingMargin::default(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::LanguageTag;

    #[test]
    fn a_tag_is_kept_and_nothing_else() {
        for tag in ["de", "pt-BR", "zh-Hant-TW", &"a".repeat(35)] {
            assert_eq!(LanguageTag::new(tag).expect("a tag").as_str(), tag);
        }
        for none in ["", "de_DE", "d\u{e9}", &"a".repeat(36)] {
            assert_eq!(LanguageTag::new(none), None, "{none}");
        }
    }
}
