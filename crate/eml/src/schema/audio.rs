//! `audio`: a recording in speech.

use super::{Attribute, Context, Element, Fields, Kind, Role, VOICE_PARENTS, VoiceBuilder};
use crate::{Audio, AudioMode, TextSegment};

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text("Plays a recording."),
    source: super::reference_text("GEVH D.4.4"),
    example: super::reference_text(
        "<voice-text time='0'>Listen: <audio src='sounds/bell.ogg'/> did you hear?</voice-text>",
    ),
    attributes: &[
        Attribute::new(
            "src",
            Kind::Url,
            "The address: relative to the story, or http or https; the page may forbid others.",
        )
        .required(),
        Attribute::choice(
            "mode",
            AudioMode::WORDS,
            "Whether speech waits for the recording, or it plays in the background.",
        )
        .default("insertion"),
        Attribute::between("level", 0.0, 1e6, "The volume: 1 as recorded, 0 silent.").default("1"),
    ],
    ..Element::new("audio", VOICE_PARENTS, Role::Voice(read))
};

fn read(cx: &mut Context<'_>, node: usize, fields: &Fields<'_>, voice: &mut VoiceBuilder) {
    let mut audio = Box::<Audio>::default();
    if cx.record(node, fields, audio.as_mut()) {
        let span = cx.full_span(node);
        voice.pieces.push(TextSegment::Audio { audio, span });
    }
}

#[cfg(test)]
mod tests {
    use crate::schema::testing::clause_codes;

    #[test]
    fn addresses_obey_the_policy_of_pages() {
        let with = |attributes: &str| {
            clause_codes(&format!(
                "<voice-text time='0'>a<audio {attributes}/></voice-text>"
            ))
        };
        assert_eq!(with("src='http://www.music.com/trackX.au'"), [""; 0]);
        assert_eq!(with("src='javascript:alert(1)'"), ["eml::bad-url"]);
        assert_eq!(with("src='a.ogg' mode='foreground'"), ["eml::bad-choice"]);
        assert_eq!(with("src='a.ogg' level='-1'"), ["eml::out-of-range"]);
    }
}
