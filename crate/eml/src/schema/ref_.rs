//! `ref`: refers to a named set.

use super::{Attribute, Element};

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text("Refers to a named set."),
    source: super::reference_text("GEVH D.3.3, D.3.8"),
    example: super::reference_text(
        "<eml><head><body-expression-configuration><sets-configuration><set name='arms' type='bodyGroup'><it name='left_arm'/><it name='right_arm'/></set><set name='upperBody' type='bodyGroup'><it name='torso'/><ref name='arms'/></set></sets-configuration></body-expression-configuration></head><body><null time='1'/></body></eml>",
    ),
    attributes: &[Attribute::identifier("name", "The name of the set.").required()],
    ..Element::part("ref", &["set", "tracks", "bones"])
};

#[cfg(test)]
mod tests {
    use crate::schema::testing::clause_codes;

    #[test]
    fn a_set_must_exist() {
        assert_eq!(
            clause_codes(
                "<body-player-add time='0' name='p' type='pose'><bones><ref name='x'/></bones></body-player-add>"
            ),
            ["eml::unknown-set"]
        );
    }
}
