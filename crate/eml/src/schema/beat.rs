//! `beat`: the tension of the story.

use super::{Attribute, Element};
use crate::ClauseKind;

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text(
        "Sets the tension of the story from here on: voices speak tense parts faster and with shorter pauses.",
    ),
    decision: super::reference_text(
        "From here on means later in the document, as for voice-change. Without a beat, and after one without a tension, punctuation, paragraphs and direct speech determine the tension.",
    ),
    source: super::reference_text("Extension"),
    example: super::reference_text(
        "<eml xmlns:r='urn:raconteur:eml:1'><body><r:beat time='0' tension='0.8'/><voice-text time='0'>He ran.</voice-text></body></eml>",
    ),
    extension: true,
    attributes: &[Attribute::between(
        "tension",
        0.0,
        1.0,
        "From 0, relaxed, to 1, the climax; by default derived from the text.",
    )],
    ..Element::record("beat", || ClauseKind::Beat(Default::default()))
};

#[cfg(test)]
mod tests {
    use crate::ClauseKind;
    use crate::schema::testing::extended;

    #[test]
    fn tension_is_read_and_may_be_left_to_the_text() {
        for (eml, tension) in [
            ("<x:beat time='1' tension='0.25'/>", Some(0.25)),
            ("<x:beat time='1'/>", None),
        ] {
            let ClauseKind::Beat(beat) = extended(eml) else {
                panic!("{eml}")
            };
            assert_eq!(beat.tension, tension);
        }
    }
}
