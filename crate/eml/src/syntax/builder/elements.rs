//! Start and end of elements.

use super::{Builder, MAX_DEPTH, is_name_start};
use crate::markup::NodeKind;
use crate::schema::{self, Content, Role, same};
use crate::suggest::quoted;
use crate::syntax::attributes::{self, Outcome};
use crate::{Diagnostic, Span};

impl<'a> Builder<'a, '_, '_> {
    /// Opens an element whose tag contains `raw` between `<` and `>`. Returns the restart position
    /// of a broken tag.
    pub(super) fn open(
        &mut self,
        raw: &'a str,
        name_len: usize,
        start: usize,
        end: usize,
        empty: bool,
    ) -> Option<usize> {
        if self.skipped_depth > 0 {
            self.skipped_depth += usize::from(!empty);
            return None;
        }
        let name = &raw[..name_len];
        if !name.starts_with(is_name_start) {
            let span = Span::from_offsets(start, start + 1);
            self.error(
                "eml::malformed",
                span,
                "`<` does not start a tag here; write `&lt;`",
            );
            return raw.find('<').map(|at| start + 1 + at);
        }
        if let Some(at) = name.bytes().position(|b| b == b'<') {
            self.not_closed(&name[..at], start);
            self.open_broken(&name[..at], &raw[..at], start);
            return Some(start + 1 + at);
        }
        if self.stack.len() >= self.most_depth() {
            if !std::mem::replace(&mut self.told_depth, true) {
                let depth = self.stack.len();
                self.error(
                    "eml::too-deep",
                    Span::from_offsets(start, end),
                    format!("nested deeper than {depth} elements; deeper elements are dropped"),
                );
            }
            self.skipped_depth = usize::from(!empty);
            return None;
        }
        let first_attribute = self.tree.attributes.len();
        let outcome = attributes::scan(
            name,
            &raw[name_len..],
            start + 1 + name_len,
            self.most_attributes(),
            &mut self.tree.attributes,
            self.sink,
        );
        match outcome {
            Outcome::Whole => {
                self.opened(name, first_attribute, start, end, empty);
                None
            }
            Outcome::Broken(next) => {
                self.tree.attributes.truncate(first_attribute);
                let stop = next.unwrap_or(end);
                self.open_broken(name, &self.source[start + 1..stop], start);
                next
            }
        }
    }

    /// Opens an element whose attributes have been read.
    fn opened(
        &mut self,
        name: &'a str,
        first_attribute: usize,
        start: usize,
        end: usize,
        empty: bool,
    ) {
        let kind = NodeKind::Element(schema::find(name));
        let index = self.push(kind, name, Span::from_offsets(start, end));
        let count = self.tree.attributes.len() - first_attribute;
        let node = &mut self.tree.nodes[index as usize];
        node.first_attribute = Span::from_offsets(first_attribute, 0).start;
        node.attribute_count = u16::try_from(count).unwrap_or(u16::MAX);
        self.meet_body(index, !empty);
        if empty {
            self.complete(index);
        } else {
            self.stack.push(index);
        }
    }

    fn most_depth(&self) -> usize {
        self.limits.depth.min(MAX_DEPTH)
    }

    fn most_attributes(&self) -> usize {
        self.limits.attributes.min(usize::from(u16::MAX))
    }

    /// Opens an element with a truncated tag; `raw` is its remaining text. Structural elements are
    /// kept without attributes, others are marked.
    pub(super) fn open_broken(&mut self, name: &'a str, raw: &str, start: usize) {
        let name = name.trim_end_matches(['/', '>']);
        let entry = schema::find(name);
        let kind = match entry {
            Some(element) if element.role == Role::Structure => NodeKind::Element(entry),
            _ => NodeKind::Malformed,
        };
        let index = self.push(
            kind,
            name,
            Span::from_offsets(start, start + 1 + raw.trim_end().len()),
        );
        let raw = raw.trim_end();
        let closed = raw.ends_with("/>")
            || (!raw.ends_with('>') && entry.is_none_or(|e| e.content == Content::Empty));
        self.meet_body(index, false);
        if closed {
            self.complete(index);
        } else {
            self.stack.push(index);
        }
    }

    /// Records the first body in the root before it is opened, if its content may be taken
    /// immediately: if nothing that can contain clauses precedes it.
    fn meet_body(&mut self, index: u32, well_formed: bool) {
        let &[root] = &self.stack[..] else { return };
        if self.met_body || !self.is(index, "body") || !self.is(root, "eml") {
            return;
        }
        self.met_body = true;
        let before = &self.tree.nodes[..root as usize];
        let only_text = before
            .iter()
            .all(|n| matches!(n.kind, NodeKind::Text | NodeKind::Reference(_)));
        if well_formed && only_text {
            self.tree.taken_from = Some(index);
        }
    }

    fn is(&self, index: u32, name: &str) -> bool {
        let kind = self.tree.nodes[index as usize].kind;
        matches!(kind, NodeKind::Element(Some(element)) if element.name == name)
    }

    /// Passes on a complete element of the body that is the last in the tree.
    fn complete(&mut self, index: u32) {
        let in_body = self.stack.len() == 2 && self.tree.taken_from == Some(self.stack[1]);
        let node = &self.tree.nodes[index as usize];
        if in_body && matches!(node.kind, NodeKind::Element(_)) {
            let first_attribute = node.first_attribute as usize;
            (self.take)(&self.tree, index as usize, self.sink);
            self.tree.nodes.truncate(index as usize);
            self.tree.attributes.truncate(first_attribute);
        }
    }

    pub(super) fn end_tag(&mut self, name: &str, start: usize, end: usize) {
        if self.skipped_depth > 0 {
            self.skipped_depth -= 1;
            return;
        }
        let text = |open: u32| self.tree.nodes[open as usize].text;
        let alike = |open: &u32| text(*open).eq_ignore_ascii_case(name);
        let mut open = self.stack.iter().rev().copied();
        let exact = open.clone().find(|&open| same(text(open), name));
        let Some(open) = exact.or_else(|| open.find(alike)) else {
            self.error(
                "eml::stray-end",
                Span::from_offsets(start, end),
                format!("{} has no start tag", quoted(&self.source[start..end])),
            );
            return;
        };
        if exact.is_none() {
            let opened = quoted(text(open));
            self.error(
                "eml::mismatched-end",
                Span::from_offsets(start, end),
                format!("{} is closed as {}", opened, quoted(name)),
            );
        }
        while let Some(top) = self.stack.pop() {
            if top == open {
                break;
            }
            self.close(top, start, Some(Span::from_offsets(start, end)));
        }
        let subtree_end = Span::from_offsets(self.tree.nodes.len(), 0).start;
        let node = &mut self.tree.nodes[open as usize];
        node.end = Span::from_offsets(end, end).end;
        node.subtree_end = subtree_end;
        self.complete(open);
    }

    /// Closes an element without its own end tag at byte `end`.
    pub(super) fn close(&mut self, open: u32, end: usize, by: Option<Span>) {
        let subtree_end = Span::from_offsets(self.tree.nodes.len(), 0).start;
        let node = &mut self.tree.nodes[open as usize];
        node.end = Span::from_offsets(end, end).end;
        node.subtree_end = subtree_end;
        if matches!(node.kind, NodeKind::Malformed) {
            return;
        }
        let message = format!("{} is not closed", quoted(node.text));
        let mut diagnostic = Diagnostic::error("eml::unclosed", node.span, message);
        if let Some(by) = by {
            diagnostic = diagnostic.related(by, "its parent ends here");
        }
        self.sink.push(diagnostic);
        self.complete(open);
    }
}
