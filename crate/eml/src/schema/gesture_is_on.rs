//! `gesture-is-on`: the master switch of gestures.

use super::{Attribute, Context, Element, Fields};
use crate::ClauseKind;

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text(
        "Turns the gesture model on or off. Turning it off releases the arms.",
    ),
    decision: super::reference_text("The source prints is0n, with a zero, which is an alias."),
    source: super::reference_text("GEVH D.5.1"),
    example: super::reference_text("<gesture-is-on time='0' isOn='true'/>"),
    attributes: &[
        Attribute::flag("isOn", "Whether gestures move the arms and hands.")
            .aliases(&["is0n"])
            .required(),
    ],
    ..Element::clause("gesture-is-on", build)
};

fn build(cx: &mut Context<'_>, _: usize, fields: &Fields<'_>) -> Option<ClauseKind> {
    cx.boolean(fields, "isOn").map(ClauseKind::GestureIsOn)
}

#[cfg(test)]
mod tests {
    use crate::ClauseKind;
    use crate::schema::testing::{codes, one};

    #[test]
    fn booleans_have_four_spellings_in_any_case() {
        for (text, on) in [("true", true), ("1", true), ("FALSE", false), ("0", false)] {
            let kind = one(&format!("<gesture-is-on time='0' isOn='{text}'/>"));
            assert_eq!(kind, ClauseKind::GestureIsOn(on));
        }
    }

    #[test]
    fn other_values_and_spellings_are_reported() {
        let body = |x: &str| {
            format!("<eml><body><null time='1'/><gesture-is-on time='0' {x}/></body></eml>")
        };
        assert_eq!(codes(&body("isOn='yes'")), ["eml::bad-boolean"]);
        assert_eq!(codes(&body("")), ["eml::missing-attribute"]);
        assert_eq!(codes(&body("is0n='true'")), ["eml::alias"]);
        assert_eq!(codes(&body("ison='true'")), ["eml::letter-case"]);
    }
}
