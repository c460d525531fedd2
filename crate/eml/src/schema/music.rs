//! `music`: plays music.

use super::{Attribute, Element, Kind};
use crate::{ClauseKind, ControlSource, Valence};

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text(
        "Plays music: a piece of a mood from the library, or a file. Without either, the music stops.",
    ),
    source: super::reference_text("Extension; GEVH 3.5.4.3"),
    decision: super::reference_text(
        "Without one, and after by='emotion', the mood chooses the music of a story with emotions, unless r:environment disables it. The library has three pieces for each mood: fast for good, medium tempo for neutral, slow for bad. The random seed of the performance draws one of each, which stays throughout; arousal adds voices to it. A piece of the library repeats when it ends; a file plays once. Music is 8 dB quieter during speech. An .mp3 of the same name may accompany an .opus file, for browsers that need it. If music is unavailable, the story continues without it.",
    ),
    example: super::reference_text(
        "<eml xmlns:r='urn:raconteur:eml:1'><body><r:music time='0' valence='positive' volume='0.5' fade='2'/></body></eml>",
    ),
    extension: true,
    attributes: &[
        Attribute::choice(
            "by",
            ControlSource::WORDS,
            "Who controls the music from here on: this element, or the mood.",
        )
        .default("script"),
        Attribute::choice("valence", Valence::WORDS, "The mood of the piece."),
        Attribute::new(
            "file",
            Kind::Path,
            "A file next to the story; overrides the mood.",
        ),
        Attribute::between("volume", 0.0, 10.0, "The volume: 1 as recorded.").default("1"),
        Attribute::seconds(
            "fade",
            "The duration of its fade-in and of the previous piece's fade-out.",
        )
        .default("0"),
    ],
    ..Element::record("music", || ClauseKind::Music(Default::default()))
};

#[cfg(test)]
mod tests {
    use crate::ClauseKind;
    use crate::schema::testing::extended;

    #[test]
    fn pieces_are_chosen_by_mood_or_file() {
        let kind = extended("<x:music time='0' file='music/a.ogg' fade='2'/>");
        let ClauseKind::Music(music) = kind else {
            panic!("{kind:?}")
        };
        assert_eq!(
            (music.valence, music.file.as_deref()),
            (None, Some("music/a.ogg"))
        );
        assert_eq!((music.volume, music.fade_secs), (1.0, 2.0));
    }
}
