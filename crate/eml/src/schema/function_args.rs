//! `function-args`: the arguments of a function.

use super::{Content, Element};

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text("Contains the arguments of a function."),
    source: super::reference_text("GEVH D.1.7"),
    example: super::reference_text(
        "<vh-move time='0' functionName='segment'><function-args><arg name='timePeriod' value='1'/></function-args></vh-move>",
    ),
    content: Content::Elements,
    max_per_parent: Some(1),
    ..Element::part(
        "function-args",
        &["vh-move", "body-non-deterministic-function"],
    )
};

#[cfg(test)]
mod tests {
    use crate::schema::testing::clause_codes;

    #[test]
    fn there_is_one_list_of_arguments() {
        assert_eq!(
            clause_codes(
                "<vh-move time='0' functionName='f'><function-args/><function-args/></vh-move>"
            ),
            ["eml::surplus-element"]
        );
    }
}
