//! `emotion`: elicits an emotion.

use super::{Attribute, Element};
use crate::{ClauseKind, EmotionKind};

pub(super) static ELEMENT: Element = Element {
    doc: doc!("Elicits an emotion, which face, voice and the environment express: camera, light and music."),
    decision: doc!("GEVH elicits emotions but has no clause for it. The scale of potentials, which it does not bound, ends at 10. The voice is in it further down in the document until the next one or neutral; 5 is the strength of F&H table 4.4."),
    source: doc!("Extension; GEVH 3.5.4"),
    example: doc!("<eml xmlns:r='urn:raconteur:eml:1'><body><r:emotion time='0' type='joy' potential='3'/></body></eml>"),
    extension: true,
    attributes: &[Attribute::choice("type", EmotionKind::WORDS, doc!("Which one of the emotions of Ortony, Clore and Collins, or neutral.")).required(),
Attribute::between("potential", 0.0, 10.0, doc!("Its potential: how strong it is. The bounds of GEVH 3.5.4.1 for shots are 1.5, 2.5 and 4.5.")).default("5"),
Attribute::seconds("duration", doc!("How long it is kept up before it decays.")).default("0")],
    ..Element::record("emotion", || ClauseKind::Emotion(Default::default()))
};

#[cfg(test)]
mod tests {
    use crate::schema::testing::extended;
    use crate::{ClauseKind, EmotionKind};

    #[test]
    fn emotions_are_read() {
        let kind = extended("<x:emotion time='0' type='fears-confirmed' duration='2'/>");
        let ClauseKind::Emotion(emotion) = kind else {
            panic!("{kind:?}")
        };
        assert_eq!(emotion.kind, EmotionKind::FearsConfirmed);
        assert_eq!((emotion.potential, emotion.duration_secs), (5.0, 2.0));
    }
}
