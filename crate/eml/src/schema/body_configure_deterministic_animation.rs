//! `body-configure-deterministic-animation`: the order and transitions of animations.

use super::{Attribute, Element};
use crate::ClauseKind;

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text("Specifies the transition from one keyframe animation to the next."),
    decision: super::reference_text(
        "A cross-fade takes 0.4 s by default, and 0.08 s with smooth='false': GEVH means no transition at all, but no joint should jump.",
    ),
    source: super::reference_text("GEVH D.3.5"),
    example: super::reference_text(
        "<body-configure-deterministic-animation time='0' smooth='true' swapTime='0.5'/>",
    ),
    attributes: &[
        Attribute::flag("smooth", "Whether animations cross-fade."),
        Attribute::seconds_up_to("swapTime", 60.0, "The duration of a cross-fade."),
    ],
    ..Element::record("body-configure-deterministic-animation", || {
        ClauseKind::DeterministicAnimation(Default::default())
    })
};

#[cfg(test)]
mod tests {
    use crate::ClauseKind;
    use crate::schema::testing::one;

    #[test]
    fn the_example_of_the_source_is_read() {
        let kind =
            one("<body-configure-deterministic-animation time='0' smooth='false' swapTime='0.5'/>");
        let ClauseKind::DeterministicAnimation(animation) = kind else {
            panic!("{kind:?}")
        };
        assert_eq!(
            (animation.smooth, animation.swap_secs),
            (Some(false), Some(0.5))
        );
    }
}
