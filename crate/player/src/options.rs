//! How a story is performed.

use raconteur_actor::Manner;
use raconteur_base::Side;
use raconteur_stage::{FramingMargin, Shot};

/// How a story is performed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// Seed of blinks, glances and idle motion, and of which pieces of the library are heard.
    pub seed: u64,
    /// Idle life, from 0 (still) to 1.
    pub motion_amount: f64,
    /// How the figure accompanies its speech with face and head.
    pub manner: Manner,
    /// The dominant hand; none: as the story says, else as the figure is.
    pub handedness: Option<Side>,
    /// The language of what neither the script nor a bundle tells of: that of the page around it.
    pub language: Option<LanguageTag>,
    /// How much of the speaker is in the picture until the script says otherwise.
    pub shot: Shot,
    /// Whether the camera moves where an emotion takes it; else it cuts, for those who ask for less
    /// motion.
    pub moving_camera: bool,
    /// No less room than this is kept for gestures, however small the script's own are:
    /// while one edits a script the picture stands still.
    pub room: FramingMargin,
}

/// A tag of BCP 47, as long as any needs to be (RFC 5646, section 4.4.1).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LanguageTag {
    letters: [u8; Self::MAX_TAG_BYTES],
    length: usize,
}

impl LanguageTag {
    const MAX_TAG_BYTES: usize = 35;

    /// None for what is no tag: empty, longer, or not of letters, digits and hyphens.
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

    /// The tag.
    #[must_use]
    pub fn as_str(&self) -> &str {
        // Nothing but ASCII is in it.
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
            room: FramingMargin::default(),
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
