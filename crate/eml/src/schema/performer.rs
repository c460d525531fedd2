//! `performer`: who performs, in what voice, language and manner.

use super::{Attribute, Element, Kind};
use crate::{Expressions, PreferredHand};

pub(super) static ELEMENT: Element = Element {
    doc: super::shown(
        "Says who performs the script, in what voice and language, and how much the character moves its face and head when it speaks. Whoever shows or bakes the story may choose another figure, voice and language.",
    ),
    decision: super::shown(
        "What accompanies speech is made from its sound where the writer says nothing (F&H section 4.2), and an utterance whose pitch is not known from its text (4.3). Amounts are shares of what F&H publish; none, also of zero, changes the lips. Where a figure cannot be had, the one that performs when none is named does.",
    ),
    source: super::shown("Extension; GEVH 3.1, 3.4; F&H 4.2, 4.3"),
    example: super::shown(
        "<eml xmlns:r='urn:raconteur:eml:1'><head><r:performer figure='papous' expressions='text' brows='0.6'/></head><body><null time='1'/></body></eml>",
    ),
    extension: true,
    one_of: &[
        "figure",
        "voice",
        "language",
        "handedness",
        "expressions",
        "head",
        "brows",
        "blinks",
        "gaze",
    ],
    most_per_parent: Some(1),
    attributes: &[
        Attribute::new(
            "figure",
            Kind::Path,
            "The figure: a name of the library, or a file beside the story.",
        ),
        Attribute::identifier(
            "voice",
            "The voice of what names no other: VOICE or ENGINE:VOICE for the baker, or the name of a voice of the browser.",
        ),
        Attribute::identifier(
            "language",
            "The language of what names no other, as in BCP 47.",
        ),
        Attribute::choice(
            "handedness",
            PreferredHand::WORDS,
            "The dominant hand, which the script is written for; right when left out. Whoever shows the story may choose the other one, and so may the figure where the script does not say: gestures of the dominant and the other hand are then mirrored.",
        ),
        Attribute::choice(
            "expressions",
            Expressions::WORDS,
            "What expressions beside speech are made from: its sound or its text.",
        ),
        Attribute::between(
            "head",
            0.0,
            1.0,
            "How far the head is raised and tilted, against the published amount.",
        ),
        Attribute::between(
            "brows",
            0.0,
            2.0,
            "How far the brows are raised and drawn together.",
        ),
        Attribute::between(
            "blinks",
            0.0,
            4.0,
            "How often the eyes blink, against 22 times a minute in speech and 17 in silence.",
        ),
        Attribute::between("gaze", 0.0, 2.0, "How far the gaze goes aside."),
    ],
    ..Element::part("performer", &["head"])
};

#[cfg(test)]
mod tests {
    use crate::Expressions;

    #[test]
    fn the_choice_is_kept() {
        let text = "<eml xmlns:x='urn:raconteur:eml:1'><head><x:performer figure='papous' expressions='text' brows='2'/></head>\
                    <body><null time='1'/></body></eml>";
        let parsed = crate::parse(text);
        assert_eq!(parsed.diagnostics, []);
        let performer = parsed.document.performer.unwrap();
        assert_eq!(performer.figure.as_deref(), Some("papous"));
        assert_eq!(performer.expressions, Some(Expressions::Text));
        assert_eq!((performer.brows, performer.gaze), (Some(2.0), None));
    }
}
