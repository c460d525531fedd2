//! `event`: notifies listeners of an event.

use super::{Attribute, Content, Context, Element, Fields};
use crate::ClauseKind;

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text("Raises an event. Its character data is passed on with it."),
    decision: super::reference_text(
        "The table in GEVH says type, its example writes key, which is an alias. The example also has no time: an event directly in the body may omit it, and starts at 0.",
    ),
    source: super::reference_text("GEVH D.1.4"),
    example: super::reference_text("<event time='2' type='alarm'>wake up!</event>"),
    content: Content::Text,
    attributes: &[Attribute::text(
        "type",
        "The category of the event, by which listeners filter.",
    )
    .aliases(&["key"])],
    ..Element::clause("event", build)
};

fn build(cx: &mut Context<'_>, node: usize, fields: &Fields<'_>) -> Option<ClauseKind> {
    let kind = cx.text(fields, "type");
    let (payload, _) = cx.character_data(node, &ELEMENT);
    Some(ClauseKind::Event {
        kind,
        payload: payload.into(),
    })
}

#[cfg(test)]
mod tests {
    use crate::ClauseKind;
    use crate::schema::testing::{codes, one};

    #[test]
    fn the_payload_is_the_character_data() {
        let kind = one("<event type='alarm'><![CDATA[<shout>]]> &amp; up</event>");
        let ClauseKind::Event { kind, payload } = kind else {
            panic!("{kind:?}")
        };
        assert_eq!(
            (kind.as_deref(), payload.as_str()),
            (Some("alarm"), "<shout> & up")
        );
    }

    #[test]
    fn the_example_of_the_thesis_is_accepted_with_a_warning() {
        let text = "<eml><body><event key='alarm'>wake up!</event></body></eml>";
        assert_eq!(codes(text), ["eml::alias"]);
    }
}
