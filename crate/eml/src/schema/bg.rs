//! `bg`: refers to a body group.

use super::{Attribute, Element};

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text("Refers to a body group."),
    decision: super::reference_text("GEVH does not list its attribute; it is name, as for it and ref."),
    source: super::reference_text("GEVH D.3.9"),
    example: super::reference_text("<body-player-add time='0' name='upper' type='bodyGroup'><bones><bg name='torso'/></bones></body-player-add>"),
    attributes: &[Attribute::identifier("name", "The body group: head, torso, left_arm, right_arm, left_hand, right_hand, left_leg or right_leg.").required()],
    ..Element::part("bg", &["tracks", "bones"])
};

#[cfg(test)]
mod tests {
    use crate::schema::testing::clause_codes;

    #[test]
    fn a_group_must_exist() {
        assert_eq!(
            clause_codes(
                "<body-player-add time='0' name='p' type='pose'><bones><bg name='left-arm'/></bones></body-player-add>"
            ),
            ["eml::unknown-body-group"]
        );
    }
}
