//! `event`: tells listeners that something happened.

use super::{Attribute, CLAUSE_PARENTS, Content, Context, Element, Fields, Kind, Presence, Role};
use crate::ClauseKind;
use crate::syntax::NodeKind;
use std::borrow::Cow;

pub(super) static ELEMENT: Element = Element {
    name: "event",
    aliases: &[],
    doc: "Raises an event. Its character data is passed on with it.",
    source: "GEVH D.1.4",
    parents: CLAUSE_PARENTS,
    content: Content::Text,
    attributes: &[Attribute {
        name: "type",
        // The table of GEVH D.1.4 says `type`, its example writes `key`.
        aliases: &["key"],
        kind: Kind::Text,
        default: Presence::Optional,
        doc: "The category of the event, by which listeners choose what they hear.",
    }],
    required_children: &[],
    most_per_parent: None,
    role: Role::Clause(build),
};

fn build(cx: &mut Context<'_>, node: usize, fields: &Fields<'_>) -> Option<ClauseKind> {
    let kind = cx.label(fields, "type");
    let tree = cx.tree;
    let mut payload = Cow::Borrowed("");
    let mut child = node + 1;
    while child < tree.nodes[node].subtree_end as usize {
        let inner = &tree.nodes[child];
        match inner.kind {
            NodeKind::Text => payload += inner.text,
            NodeKind::Reference(c) => payload.to_mut().push(c),
            NodeKind::Element(found) => {
                cx.admit(child, found, &ELEMENT);
            }
            NodeKind::Malformed => {}
        }
        child = inner.subtree_end as usize;
    }
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
