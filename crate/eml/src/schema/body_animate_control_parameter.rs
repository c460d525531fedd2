//! `body-animate-control-parameter`: plays from the library.

use super::{Attribute, Element};
use crate::{ClauseKind, Style};

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text("Plays an animation of control parameters from the library."),
    decision: super::reference_text(
        "GEVH calls value the parameter value, which fits another clause; here it is a gain. The example belongs to body-set-control-parameter.",
    ),
    source: super::reference_text("GEVH D.3.30"),
    example: super::reference_text(
        "<body-animate-control-parameter time='5' animationId='blink' style='pingPong'/>",
    ),
    attributes: &[
        Attribute::identifier("animationId", "The animation.").required(),
        Attribute::choice("style", Style::WORDS, "The playback direction.").default("forward"),
        Attribute::number(
            "value",
            "A factor for its values; results are clamped to the range of the parameter.",
        )
        .default("1"),
    ],
    ..Element::record("body-animate-control-parameter", || {
        ClauseKind::AnimateControlParameter(Default::default())
    })
};

#[cfg(test)]
mod tests {
    use crate::schema::testing::one;
    use crate::{ClauseKind, Style};

    #[test]
    fn it_plays_forward_at_full_strength() {
        let kind = one("<body-animate-control-parameter time='5' animationId='blink'/>");
        let ClauseKind::AnimateControlParameter(animate) = kind else {
            panic!("{kind:?}")
        };
        assert_eq!((animate.style, animate.gain), (Style::Forward, 1.0));
    }
}
