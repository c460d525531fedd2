//! `head`: configuration.

use super::{Content, Element, Role};

pub(super) static ELEMENT: Element = Element {
    name: "head",
    aliases: &[],
    doc: "Holds configuration that applies to the whole script.",
    source: "GEVH D.1.2",
    parents: &["eml"],
    content: Content::Elements,
    attributes: &[],
    required_children: &[],
    most_per_parent: Some(1),
    role: Role::Structure,
};

#[cfg(test)]
mod tests {
    use crate::schema::testing::codes;

    #[test]
    fn an_empty_head_is_fine_and_holds_no_clauses() {
        assert_eq!(
            codes("<eml><head/><body><null time='1'/></body></eml>"),
            [""; 0]
        );
        let text = "<eml><head><null time='1'/></head><body><null time='1'/></body></eml>";
        assert_eq!(codes(text), ["eml::wrong-parent"]);
    }
}
