//! `body-expression-configuration`: configures the body.

use super::{Content, Element};

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text("Contains the configuration of body expression."),
    source: super::reference_text("GEVH D.3.1"),
    example: super::reference_text(
        "<eml><head><body-expression-configuration/></head><body><null time='1'/></body></eml>",
    ),
    content: Content::Elements,
    max_per_parent: Some(1),
    ..Element::part("body-expression-configuration", &["head"])
};

#[cfg(test)]
mod tests {
    use crate::schema::testing::clause_codes;

    #[test]
    fn it_stands_in_the_head_only() {
        assert_eq!(
            clause_codes("<body-expression-configuration/>"),
            ["eml::wrong-parent"]
        );
    }
}
