//! `it`: a member of a set: a body group by its name, or a layer by its name or number.

use super::{Attribute, Element};

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text(
        "A member of a set: a body group by its name, or a layer by its name or number.",
    ),
    source: super::reference_text("GEVH D.3.3"),
    example: super::reference_text(
        "<eml><head><body-expression-configuration><sets-configuration><set name='arms' type='bodyGroup'><it name='left_arm'/><it name='right_arm'/></set><set name='upperBody' type='bodyGroup'><it name='torso'/><ref name='arms'/></set></sets-configuration></body-expression-configuration></head><body><null time='1'/></body></eml>",
    ),
    attributes: &[Attribute::identifier(
        "name",
        "The name of the body group or layer, or the number of the layer.",
    )
    .required()],
    ..Element::part("it", &["set"])
};

#[cfg(test)]
mod tests {
    use crate::schema::testing::clause_codes;

    #[test]
    fn it_needs_a_name() {
        assert_eq!(
            clause_codes(
                "<body-player-add time='0' name='p' type='pose'><bones><it name='head'/></bones></body-player-add>"
            ),
            ["eml::wrong-parent"]
        );
    }
}
