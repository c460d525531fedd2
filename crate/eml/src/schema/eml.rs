//! `eml`: the root.

use super::{Attribute, Content, Element, Role};
use crate::RunUp;

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text("The root of a script."),
    decision: super::reference_text(
        "A list of clauses without eml and body is read as a script, with a warning; a mind may send such a list during a performance. A hand needs up to 0.9 s to reach its first position from rest. The thesis lets a script begin at 0 and does not mention this delay (GEVH D.2.1), so the author chooses how to resolve the conflict. By default the script waits, and a diagnostic reports it.",
    ),
    source: super::reference_text("GEVH D.1.1, D.2.1, 3.5.2"),
    example: super::reference_text("<eml name='a story'><body><null time='2'/></body></eml>"),
    content: Content::Elements,
    attributes: &[
        Attribute::text("name", "The name of the document."),
        Attribute::choice(
            "lead",
            RunUp::WORDS,
            "How to resolve a gesture that begins before the hand can reach its first position. delay: the whole script waits for the hand, including words and events. late: all times stay, and the stroke comes late. snap: all times stay, and the hand starts in position, already moving before the first frame.",
        )
        .extension(),
    ],
    required_children: &["body"],
    max_per_parent: Some(1),
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
