//! `emotion`: elicits an emotion.

use super::{Attribute, Element};
use crate::{ClauseKind, EmotionKind, EmotionSpace};

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text("Elicits an emotion, which face, voice and the environment express: camera, light and music."),
    decision: super::reference_text("GEVH elicits emotions but has no clause for it. The scale of potentials, which it does not bound, ends at 10. The voice is in it further down in the document until the next one or neutral; 5 is the strength of F&H table 4.4. A dimension that is given takes the place of that of the type; with one, the expression is blended from the place alone. What is not given of a place without a type is 0."),
    source: super::reference_text("Extension; GEVH 3.5.4; F&H 4.4"),
    example: super::reference_text("<eml xmlns:r='urn:raconteur:eml:1'><body><r:emotion time='0' type='joy' potential='3'/></body></eml>"),
    extension: true,
    one_of: &["type", "activation", "evaluation", "power"],
    attributes: &[Attribute::choice("type", EmotionKind::WORDS, "Which one: of the emotions of Ortony, Clore and Collins, of those that F&H name besides, or neutral. Another word of emotion (`jealousy`, `bored`, `curiosity` …) is felt at its place on the disc, which is told."),
Attribute::between("activation", -100.0, 100.0, "How active (100) or passive (-100) it is."),
Attribute::between("evaluation", -100.0, 100.0, "How positive (100) or negative (-100) it is."),
Attribute::between("power", -100.0, 100.0, "How dominant (100) or submissive (-100) one is in it."),
Attribute::choice("space", EmotionSpace::WORDS, "How the expression comes about: `sphere`, a look of the word's own or else a blend by all three dimensions; `disc`, a blend by activation and evaluation alone, as F&H 4.4.3 has it.").default("sphere"),
Attribute::between("potential", 0.0, 10.0, "Its potential: how strong it is. The bounds of GEVH 3.5.4.1 for shots are 1.5, 2.5 and 4.5.").default("5"),
Attribute::between("threshold", 0.0, 10.0, "How much of the potential is not felt: its intensity is the rest.").default("0"),
Attribute::seconds("duration", "How long it is kept up before it decays.").default("0"),
Attribute::seconds("decay", "How long it takes to go where nothing follows.").default("4")],
    ..Element::record("emotion", || ClauseKind::Emotion(Default::default()))
};

#[cfg(test)]
mod tests {
    use crate::schema::testing::extended;
    use crate::{ClauseKind, EmotionKind, EmotionSpace};

    #[test]
    fn emotions_are_read() {
        let kind = extended("<x:emotion time='0' type='fears-confirmed' duration='2'/>");
        let ClauseKind::Emotion(emotion) = kind else {
            panic!("{kind:?}")
        };
        assert_eq!(emotion.kind, Some(EmotionKind::FearsConfirmed));
        assert_eq!((emotion.power, emotion.space), (None, EmotionSpace::Sphere));
        assert_eq!((emotion.potential, emotion.duration_secs), (5.0, 2.0));
        assert_eq!((emotion.threshold, emotion.decay_secs), (0.0, 4.0));
    }

    #[test]
    fn a_place_needs_no_word() {
        let kind = extended("<x:emotion time='0' activation='60' power='-20' space='disc'/>");
        let ClauseKind::Emotion(emotion) = kind else {
            panic!("{kind:?}")
        };
        assert_eq!((emotion.kind, emotion.evaluation), (None, None));
        assert_eq!(
            (emotion.activation, emotion.power),
            (Some(60.0), Some(-20.0))
        );
        assert_eq!(emotion.space, EmotionSpace::Disc);
    }
}
