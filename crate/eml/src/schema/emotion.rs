//! `emotion`: elicits an emotion.

use super::{Attribute, Element};
use crate::{ClauseKind, EmotionKind, EmotionSpace};

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text("Elicits an emotion, expressed by face, voice and environment: camera, light and music."),
    decision: super::reference_text("GEVH elicits emotions but has no clause for it. It does not bound the scale of potentials; here it ends at 10. The voice expresses the emotion from this point in the document until the next emotion or neutral; 5 is the strength of F&H table 4.4. A given dimension overrides that of the type; the expression is then blended from the point alone. Without a type, omitted dimensions are 0."),
    source: super::reference_text("Extension; GEVH 3.5.4; F&H 4.4"),
    example: super::reference_text("<eml xmlns:r='urn:raconteur:eml:1'><body><r:emotion time='0' type='joy' potential='3'/></body></eml>"),
    extension: true,
    one_of: &["type", "activation", "evaluation", "power"],
    attributes: &[Attribute::choice("type", EmotionKind::WORDS, "The emotion: one of those of Ortony, Clore and Collins, one that F&H add, or neutral. Other emotion words (`jealousy`, `bored`, `curiosity` …) are expressed at their point on the disc, with a diagnostic."),
Attribute::between("activation", -100.0, 100.0, "How active (100) or passive (-100) the emotion is."),
Attribute::between("evaluation", -100.0, 100.0, "How positive (100) or negative (-100) the emotion is."),
Attribute::between("power", -100.0, 100.0, "How dominant (100) or submissive (-100) the emotion is."),
Attribute::choice("space", EmotionSpace::WORDS, "How the expression is made: `sphere`, the word's own expression or else a blend by all three dimensions; `disc`, a blend by activation and evaluation only, as in F&H 4.4.3.").default("sphere"),
Attribute::between("potential", 0.0, 10.0, "Its potential, that is its strength. The thresholds of GEVH 3.5.4.1 for shots are 1.5, 2.5 and 4.5.").default("5"),
Attribute::between("threshold", 0.0, 10.0, "The part of the potential that is not expressed; the intensity is the rest.").default("0"),
Attribute::seconds("duration", "The time for which it is held before it decays.").default("0"),
Attribute::seconds("decay", "The duration of its decay if nothing follows.").default("4")],
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
