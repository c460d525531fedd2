//! `body-animate-control-parameter`: plays from the library.

use super::{Attribute, Element};
use crate::{ClauseKind, Style};

pub(super) static ELEMENT: Element = Element {
    doc: doc!("Plays an animation of control parameters from the library."),
    decision: doc!(
        "GEVH calls value the parameter value, which fits another clause; it is read as a gain. The example belongs to body-set-control-parameter."
    ),
    source: doc!("GEVH D.3.30"),
    example: doc!(
        "<body-animate-control-parameter time='5' animationId='blink' style='pingPong'/>"
    ),
    attributes: &[
        Attribute::identifier("animationId", doc!("The animation.")).required(),
        Attribute::choice("style", Style::WORDS, doc!("In which direction.")).default("forward"),
        Attribute::number("value", doc!("By what its values are multiplied.")).default("1"),
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
