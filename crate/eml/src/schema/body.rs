//! `body`: the clauses of a script.

use super::{Content, Element, Role};

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text(
        "Contains the clauses of a script. Their times count from its start.",
    ),
    source: super::reference_text("GEVH D.1.3"),
    example: super::reference_text("<eml><body><null time='2'/></body></eml>"),
    content: Content::Elements,
    max_per_parent: Some(1),
    ..Element::new("body", &["eml"], Role::Structure)
};

#[cfg(test)]
mod tests {
    use crate::schema::testing::codes;

    #[test]
    fn an_empty_body_and_a_second_one_are_reported() {
        assert_eq!(codes("<eml><body/></eml>"), ["eml::empty-body"]);
        let text = "<eml><body><null time='1'/></body><body/></eml>";
        assert_eq!(codes(text), ["eml::surplus-element"]);
    }
}
