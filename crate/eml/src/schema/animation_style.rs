//! `animation-style`: the playback of an animation.

use super::{Attribute, Element};
use crate::PlaybackStyle;

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text("Specifies how an animation plays."),
    decision: super::reference_text(
        "GEVH has styles that end after a number of iterations but no attribute for the number; it is an extension. Temporary animations leave the stack when they end.",
    ),
    source: super::reference_text("GEVH D.3.18"),
    example: super::reference_text(
        "<eml xmlns:r='urn:raconteur:eml:1'><body><body-deterministic-primitive time='0' primitive='push' animationSetName='nod'><animation-style playbackStyle='temporaryIterations' r:iterations='2'/></body-deterministic-primitive></body></eml>",
    ),
    max_per_parent: Some(1),
    attributes: &[
        Attribute::choice("playbackStyle", PlaybackStyle::WORDS, "The playback style.").required(),
        Attribute::integer(
            "iterations",
            1,
            100_000,
            "The number of iterations, for the styles with iterations.",
        )
        .default("1")
        .extension(),
    ],
    ..Element::part("animation-style", &["body-deterministic-primitive"])
};

#[cfg(test)]
mod tests {
    use crate::{AnimationStyle, ClauseKind};

    fn style(attributes: &str) -> AnimationStyle {
        let text = format!(
            "<eml xmlns:x='urn:raconteur:eml:1'><body><body-deterministic-primitive time='0' \
             primitive='push' animationSetName='a'><animation-style {attributes}/>\
             </body-deterministic-primitive></body></eml>"
        );
        let parsed = crate::parse(&text);
        assert_eq!(parsed.diagnostics, []);
        let ClauseKind::DeterministicPrimitive(primitive) = &parsed.document.clauses[0].kind else {
            panic!()
        };
        primitive.style.clone().unwrap()
    }

    #[test]
    fn it_plays_once_unless_an_extension_says_otherwise() {
        assert_eq!(style("playbackStyle='iterations'").iterations, 1);
        assert_eq!(
            style("playbackStyle='Iterations' x:iterations='3'").iterations,
            3
        );
    }
}
