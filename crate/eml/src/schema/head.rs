//! `head`: configuration.

use super::{Content, Context, Element, Role};
use crate::{Environment, Performer, Set};

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text("Contains the configuration of the whole script."),
    source: super::reference_text("GEVH D.1.2"),
    example: super::reference_text("<eml><head/><body><null time='2'/></body></eml>"),
    content: Content::Elements,
    max_per_parent: Some(1),
    ..Element::new("head", &["eml"], Role::Structure)
};

/// Reads the head and its elements.
pub(crate) fn read(cx: &mut Context<'_>, node: usize, element: &'static Element) {
    let fields = cx.fields(node, element);
    let mut set = Set {
        span: fields.tag,
        ..Set::default()
    };
    let mut performer = Performer::default();
    let mut environment = Environment::default();
    match element.name {
        "set" => {
            if cx.record(node, &fields, &mut set) {
                cx.document.sets.push(set);
            }
        }
        "performer" => {
            if cx.record(node, &fields, &mut performer) {
                cx.document.performer = Some(performer);
                cx.document.performer_span = fields.tag;
            }
        }
        "environment" => {
            if cx.record(node, &fields, &mut environment) {
                cx.document.environment = Some(environment);
            }
        }
        // The head and its grouping elements; the table bounds the depth.
        _ => cx.children(node, element, read),
    }
}

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
