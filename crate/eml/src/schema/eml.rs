//! `eml`: the root.

use super::{Attribute, Content, Element, Role};
use crate::RunUp;

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text("The root of a script."),
    decision: super::reference_text(
        "A list of clauses without eml and body is read as one, with a warning; what a mind sends during a performance may be such a list. A hand needs up to 0.9 s to come to its first place from rest. The thesis lets a script begin at 0 and says nothing of what it has to wait for (GEVH D.2.1), so the writer chooses what gives way; where nothing is written the script waits, and that is told.",
    ),
    source: super::reference_text("GEVH D.1.1, D.2.1, 3.5.2"),
    example: super::reference_text("<eml name='a story'><body><null time='2'/></body></eml>"),
    content: Content::Elements,
    attributes: &[
        Attribute::text("name", "The name of the document."),
        Attribute::choice(
            "lead",
            RunUp::WORDS,
            "What gives way where a gesture begins sooner than the hand can be at its first place: with delay the whole script waits for the hand, words and events too; with late all times stay and the stroke comes late; with snap all times stay and the hand is there, on its way before anybody looks.",
        )
        .extension(),
    ],
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
