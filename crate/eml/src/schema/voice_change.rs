//! `voice-change`: another voice.

use super::{Attribute, Element};
use crate::ClauseKind;

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text("Changes the voice of what is spoken from now on."),
    decision: super::reference_text(
        "From now on means further down in the document, as one reads it, whatever the times are: what a voice says decides when clauses are, and so cannot depend on it.",
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
