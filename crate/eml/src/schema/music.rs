//! `music`: plays music.

use super::{Attribute, Element, Kind};
use crate::{ClauseKind, Lead, Valence};

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text(
        "Plays music: a piece of a mood from the library, or a file. With neither it becomes silent.",
    ),
    source: super::reference_text("Extension; GEVH 3.5.4.3"),
    decision: super::reference_text(
        "Without one, and after by='emotion', the mood chooses the music of a story in which something is felt, unless r:environment says otherwise. The library has three pieces of each mood: fast where it is good, of medium tempo where neutral, slow where bad. The seed of the performance draws one of each, which stays throughout; arousal adds voices to it. A piece of the library begins again when it is over, a file plays once. Music is 8 dB lower while somebody speaks. Beside an .opus file there may be an .mp3 of the same name for browsers that need it. Where music cannot be had the story goes on without it.",
    ),
    example: super::reference_text(
        "<eml xmlns:r='urn:raconteur:eml:1'><body><r:music time='0' valence='positive' volume='0.5' fade='2'/></body></eml>",
    ),
    extension: true,
    attributes: &[
        Attribute::choice(
            "by",
            Lead::WORDS,
            "Who leads the music from here on: what is written here, or the mood again.",
        )
        .default("script"),
        Attribute::choice("valence", Valence::WORDS, "The mood of the piece."),
        Attribute::new(
            "file",
            Kind::Path,
            "A file beside the story; counts instead of the mood.",
        ),
        Attribute::between("volume", 0.0, 10.0, "Its volume: 1 as recorded.").default("1"),
        Attribute::seconds("fade", "How long it fades in, and the piece before out.").default("0"),
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
