//! Reader of the elements that consist only of their attributes and children.

use super::{Content, Context, Element, Fields, Presence};
use crate::Span;
use crate::markup::NodeKind;
use crate::record::{Field, List, Record, Value, Visit};
use std::borrow::Cow;

impl<'t> Context<'t> {
    /// Fills a record from the attributes and children of its element; false when the
    /// element must be dropped.
    pub(crate) fn record(
        &mut self,
        node: usize,
        fields: &Fields<'_>,
        record: &mut dyn Record,
    ) -> bool {
        let mut children = Vec::new();
        if matches!(fields.element.content, Content::Empty | Content::Elements) {
            self.children(node, fields.element, |_, child, entry| {
                children.push((child, entry));
            });
        }
        self.visit(fields, record, children)
    }

    /// Fills a record from the attributes of an element only; returns false if a required one is
    /// missing.
    pub(crate) fn attributes(&mut self, fields: &Fields<'_>, record: &mut dyn Record) -> bool {
        self.visit(fields, record, Vec::new())
    }

    /// Reads a record whose children were found before, see [`Context::record`].
    pub(crate) fn visit(
        &mut self,
        fields: &Fields<'_>,
        record: &mut dyn Record,
        children: Vec<(usize, &'static Element)>,
    ) -> bool {
        let mut reader = Reader {
            cx: self,
            fields,
            children,
            complete: fields.is_complete(),
        };
        record.visit(&mut reader);
        reader.complete
    }

    /// Returns the character data of an element with references resolved, and its span; reports
    /// elements in it.
    pub(crate) fn character_data(
        &mut self,
        node: usize,
        element: &'static Element,
    ) -> (Cow<'t, str>, Span) {
        let tree = self.tree;
        let mut text = Cow::Borrowed("");
        let mut place: Option<Span> = None;
        let mut child = node + 1;
        while child < tree.nodes[node].subtree_end as usize {
            let inner = &tree.nodes[child];
            match inner.kind {
                NodeKind::Text => text += inner.text,
                NodeKind::Reference(c) => text.to_mut().push(c),
                NodeKind::Element(found) => {
                    self.admit(child, found, element);
                }
                NodeKind::Malformed => {}
            }
            if matches!(inner.kind, NodeKind::Text | NodeKind::Reference(_)) {
                place = Some(place.map_or(inner.span, |place| place.to(inner.span)));
            }
            child = inner.subtree_end as usize;
        }
        (text, place.unwrap_or(tree.nodes[node].span))
    }
}

struct Reader<'c, 't, 'f> {
    cx: &'c mut Context<'t>,
    fields: &'c Fields<'f>,
    /// Children not yet taken by a list.
    children: Vec<(usize, &'static Element)>,
    complete: bool,
}

impl Visit for Reader<'_, '_, '_> {
    fn field(&mut self, name: &'static str, field: &mut dyn Field) {
        match self.cx.value(self.fields, name) {
            Value::None => {
                let required = |(a, _): (&super::Attribute, _)| a.default == Presence::Required;
                self.complete &= !self.fields.get(name).is_some_and(required);
            }
            value => field.set(value),
        }
    }

    fn children(&mut self, list: &mut dyn List) {
        let cx = &mut *self.cx;
        self.children.retain(|&(node, element)| {
            let Some(child) = list.add(element.name) else {
                return true;
            };
            child.place(cx.tree.nodes[node].span);
            let fields = cx.fields(node, element);
            if !cx.record(node, &fields, child) {
                list.remove_last();
            }
            false
        });
    }
}
