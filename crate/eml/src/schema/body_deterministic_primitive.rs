//! `body-deterministic-primitive`: the stack of animations.

use super::{Attribute, Content, Element};
use crate::{ClauseKind, PrimitiveKind};

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text(
        "Pushes an animation onto the stack of a player, exchanges or removes it.",
    ),
    decision: super::reference_text(
        "The example writes operation for primitive. Without tracks, all tracks are used; without a style, the animation loops.",
    ),
    source: super::reference_text("GEVH D.3.17"),
    example: super::reference_text(
        "<body-deterministic-primitive time='0.1' primitive='push' animationSetName='stepStance'><animation-style playbackStyle='pingPong'/></body-deterministic-primitive>",
    ),
    content: Content::Elements,
    attributes: &[
        Attribute::choice("primitive", PrimitiveKind::WORDS, "The operation.")
            .required()
            .aliases(&["operation"]),
        Attribute::identifier("player", "The player; by default the first one."),
        Attribute::identifier(
            "animationSetName",
            "The animation, for push and exchange: a name of the library or a path in the story's folder (docs/animation.md).",
        ),
    ],
    ..Element::record("body-deterministic-primitive", || {
        ClauseKind::DeterministicPrimitive(Default::default())
    })
};

#[cfg(test)]
mod tests {
    use crate::schema::testing::{clause_codes, one};
    use crate::{ClauseKind, PlaybackStyle};

    #[test]
    fn tracks_and_style_are_kept() {
        let kind = one(
            "<body-deterministic-primitive time='0' primitive='push' animationSetName='a'><tracks><bg name='head'/></tracks><animation-style playbackStyle='loopReverse'/></body-deterministic-primitive>",
        );
        let ClauseKind::DeterministicPrimitive(primitive) = kind else {
            panic!("{kind:?}")
        };
        assert_eq!(primitive.animation.as_deref(), Some("a"));
        assert_eq!(primitive.tracks.map(|t| t.members.len()), Some(1));
        assert_eq!(
            primitive.style.map(|s| s.style),
            Some(PlaybackStyle::LoopReverse)
        );
    }
    #[test]
    fn animations_and_operations_fit() {
        assert_eq!(
            clause_codes("<body-deterministic-primitive time='0' operation='pop'/>"),
            ["eml::alias"]
        );
        assert_eq!(
            clause_codes("<body-deterministic-primitive time='0' primitive='push'/>"),
            ["eml::missing-attribute"]
        );
        assert_eq!(
            clause_codes(
                "<body-deterministic-primitive time='0' primitive='pop' animationSetName='a'/>"
            ),
            ["eml::ignored-attribute"]
        );
    }
}
