//! `eml`: the root.

use super::{Attribute, Content, Element, Role};

pub(super) static ELEMENT: Element = Element {
    doc: super::shown("The root of a script."),
    decision: super::shown(
        "A list of clauses without eml and body is read as one, with a warning; what a mind sends during a performance may be such a list.",
    ),
    source: super::shown("GEVH D.1.1"),
    example: super::shown("<eml name='a story'><body><null time='2'/></body></eml>"),
    content: Content::Elements,
    attributes: &[Attribute::text("name", "The name of the document.")],
    required_children: &["body"],
    most_per_parent: Some(1),
    ..Element::new("eml", &[], Role::Structure)
};

#[cfg(test)]
mod tests {
    use crate::parse;

    #[test]
    fn the_name_is_kept_and_the_body_is_needed() {
        let parsed = parse("<eml name='a &amp; b'><body><null time='1'/></body></eml>");
        assert_eq!(parsed.document.name.as_deref(), Some("a & b"));
        let parsed = parse("<eml/>");
        assert_eq!(parsed.diagnostics[0].code, "eml::missing-child");
    }
}
