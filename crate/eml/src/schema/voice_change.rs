//! `voice-change`: another voice.

use super::{Attribute, Element};
use crate::ClauseKind;

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text("Changes the voice of subsequent speech."),
    decision: super::reference_text(
        "Subsequent means later in the document, whatever the times are: the duration of speech determines the times of clauses, so a voice cannot depend on them.",
    ),
    source: super::reference_text("GEVH D.4.15"),
    example: super::reference_text("<voice-change time='1' voice='don_diphone'/>"),
    attributes: &[Attribute::identifier("voice", "The voice's name.").required()],
    ..Element::record("voice-change", || {
        ClauseKind::VoiceChange(Default::default())
    })
};

#[cfg(test)]
mod tests {
    use crate::ClauseKind;
    use crate::schema::testing::one;

    #[test]
    fn the_voice_is_kept() {
        let kind = one("<voice-change time='1' voice=' don_diphone '/>");
        let ClauseKind::VoiceChange(change) = kind else {
            panic!("{kind:?}")
        };
        assert_eq!(change.voice, "don_diphone");
    }
}
