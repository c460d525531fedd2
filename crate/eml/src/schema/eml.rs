//! `eml`: the root.

use super::{Attribute, Content, Element, Kind, Presence, Role};

pub(super) static ELEMENT: Element = Element {
    name: "eml",
    aliases: &[],
    doc: "The root of a script.",
    source: "GEVH D.1.1",
    parents: &[],
    content: Content::Elements,
    attributes: &[Attribute {
        name: "name",
        aliases: &[],
        kind: Kind::Text,
        default: Presence::Optional,
        doc: "The name of the document.",
    }],
    required_children: &["body"],
    most_per_parent: Some(1),
    role: Role::Structure,
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
