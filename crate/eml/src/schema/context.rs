//! Traversal of the tree by the table: allowed elements and their attributes.

mod fields;
mod tally;

pub(crate) use self::fields::Fields;
pub(crate) use self::tally::Tally;
use super::lookup::same;
use super::meant::{element_meant, unprefixed};
use super::{Attribute, Content, Element, Presence, Tree, find, find_extension, variant_in};
use crate::diagnostic::Sink;
use crate::markup::{self, NodeKind};
use crate::namespaces::{self, Namespaces, Owner, local_name};
use crate::suggest::{nearest, quoted};
use crate::work::step;
use crate::{Diagnostic, Document, Limits, Span};
use std::cell::Cell;

/// Upper bound of the number of attributes of any element.
pub(super) const MAX_ATTRIBUTES: usize = 24;

/// Upper bound of the number of required child kinds of any element.
pub(super) const MAX_REQUIRED: usize = 4;

const ABSENT: u16 = u16::MAX;

/// Parsing context passed to the functions that read elements: tree, diagnostics, document and
/// limits.
pub(crate) struct Context<'t> {
    pub(crate) tree: &'t Tree<'t>,
    pub(crate) sink: &'t mut Sink,
    pub(crate) document: &'t mut Document,
    pub(crate) limits: &'t Limits,
    /// Length of the whole source.
    pub(crate) source_bytes: usize,
    pub(crate) namespaces: &'t Namespaces<'t>,
    /// True if the limit of clauses has been reported.
    pub(crate) reported_clauses: bool,
    /// True if the text is read for a performance in progress.
    pub(crate) is_fragment: bool,
    /// Activation and evaluation of an emotion whose word has only a place, while its element is
    /// read.
    pub(crate) placed: Option<[f64; 2]>,
}

impl<'t> Context<'t> {
    /// Returns the span of a node including its end tag.
    pub(crate) fn full_span(&self, node: usize) -> Span {
        let node = &self.tree.nodes[node];
        Span::new(node.span.start, node.end)
    }

    /// Returns the span of the name in a node's start tag.
    pub(crate) fn name_span(&self, node: usize) -> Span {
        let node = &self.tree.nodes[node];
        let start = node.span.start as usize + 1;
        Span::from_offsets(start, start + node.text.len())
    }

    /// Calls `visit` with every legal child element of a node, and reports the others, surplus
    /// ones, missing ones and stray text.
    pub(crate) fn children(
        &mut self,
        node: usize,
        element: &'static Element,
        visit: impl FnMut(&mut Self, usize, &'static Element),
    ) {
        let is_leaf = self.tree.nodes[node].subtree_end as usize == node + 1;
        if !(is_leaf && element.required_children.is_empty()) {
            self.children_counted(node, &mut Tally::new(element), visit);
        }
    }

    /// Visits the children of an element, see [`Context::children`], with counts that may include
    /// earlier children.
    pub(crate) fn children_counted(
        &mut self,
        node: usize,
        tally: &mut Tally,
        mut visit: impl FnMut(&mut Self, usize, &'static Element),
    ) {
        let tree = self.tree;
        let end = tree.nodes[node].subtree_end as usize;
        let mut child = node + 1;
        while child < end {
            match tree.nodes[child].kind {
                NodeKind::Element(found) => {
                    if let Some(entry) = self.admit_counted(tally, child, found) {
                        visit(self, child, entry);
                    }
                }
                NodeKind::Malformed => {}
                NodeKind::Text | NodeKind::Reference(_) => {
                    self.stray_text(child, tally.parent);
                }
            }
            child = tree.nodes[child].subtree_end as usize;
        }
        self.report_missing(node, tally);
    }

    /// [`Context::admit`], with a check of the number of occurrences.
    pub(crate) fn admit_counted(
        &mut self,
        tally: &mut Tally,
        child: usize,
        found: Option<&'static Element>,
    ) -> Option<&'static Element> {
        let entry = self.admit(child, found, tally.parent)?;
        let required = tally.parent.required_children.iter();
        if let Some(i) = required.clone().position(|name| same(name, entry.name)) {
            tally.missing -= usize::from(!std::mem::replace(&mut tally.seen[i], true));
        }
        if entry
            .max_per_parent
            .is_some_and(|most| tally.count(entry) > most)
        {
            self.surplus(child, entry, tally.parent);
            return None;
        }
        Some(entry)
    }

    /// Reports the children that an element must have and has not.
    pub(crate) fn report_missing(&mut self, node: usize, tally: &Tally) {
        if tally.missing == 0 {
            return;
        }
        for (&required, seen) in tally.parent.required_children.iter().zip(tally.seen) {
            if !seen {
                let name = tally.parent.name;
                let message = format!("`{name}` needs at least one `{required}` in it");
                let span = self.tree.nodes[node].span;
                self.sink
                    .push(Diagnostic::error("eml::missing-child", span, message));
            }
        }
    }

    /// Returns the table entry of a child of `parent`, if it is allowed there.
    pub(crate) fn admit(
        &mut self,
        child: usize,
        found: Option<&'static Element>,
        parent: &'static Element,
    ) -> Option<&'static Element> {
        let written = self.tree.nodes[child].text;
        let span = self.name_span(child);
        let found = self.resolve(child, found, parent)?;
        let Some(entry) = variant_in(found, parent.name) else {
            let message = format!(
                "`{}` is not allowed in `{}`; it is dropped",
                found.name, parent.name
            );
            let extension = find_extension(found.name).filter(|e| e.is_allowed_in(parent.name));
            let hint = match found.parents {
                _ if let Some(extension) = extension => unprefixed(extension.name),
                [] => "it is the root of the document".to_owned(),
                parents => format!("it belongs in {}", list(parents)),
            };
            self.sink
                .push(Diagnostic::error("eml::wrong-parent", span, message).hint(hint));
            return None;
        };
        self.report_spelling(written, entry.name, span);
        Some(entry)
    }

    /// Returns the table entry of a node by its namespace, in any context; reports unknown
    /// elements.
    pub(crate) fn resolve(
        &mut self,
        node: usize,
        found: Option<&'static Element>,
        parent: &'static Element,
    ) -> Option<&'static Element> {
        // A name of the table has no prefix, so only bindings can change its owner.
        if found.is_some() && self.namespaces.is_empty() {
            return found;
        }
        let written = self.tree.nodes[node].text;
        let span = self.name_span(node);
        let (owner, local) = self.namespaces.owner(written, node, true);
        match owner {
            Owner::Language => {
                if found.is_some() {
                    return found;
                }
            }
            Owner::Extensions => {
                let found = find_extension(local);
                if found.is_some() {
                    return found;
                }
            }
            Owner::Foreign => {
                let message = format!("{} is of another namespace; it is dropped", quoted(written));
                self.sink
                    .push(Diagnostic::warning("eml::foreign-element", span, message));
                return None;
            }
            Owner::Unbound => {
                self.sink
                    .push(namespaces::unbound(written, span, "the element is dropped"));
                return None;
            }
        }
        let what = if parent.content == Content::Mixed {
            "only its text is used"
        } else {
            "it is dropped"
        };
        let message = format!("unknown element {}; {what}", quoted(written));
        // Not looked up where it will not be read.
        let hint = (!self.sink.is_full_of("eml::unknown-element"))
            .then(|| element_meant(local, owner == Owner::Extensions, parent))
            .flatten();
        self.push_with_hint(
            Diagnostic::warning("eml::unknown-element", span, message),
            hint,
        );
        None
    }

    /// Warns of an alias or another case.
    pub(crate) fn report_spelling(&mut self, written: &str, name: &str, span: Span) {
        if written == name || local_name(written) == name {
            return;
        }
        let written = local_name(written);
        let (code, what) = if written.eq_ignore_ascii_case(name) {
            ("eml::letter-case", "case matters in EML")
        } else {
            ("eml::alias", "this is an alternative spelling")
        };
        let message = format!("{} is read as `{name}`", quoted(written));
        self.sink
            .push(Diagnostic::warning(code, span, message).hint(what));
    }

    /// Finds the attributes of an element in the table and reports unknown and missing
    /// ones.
    pub(crate) fn fields(&mut self, node: usize, element: &'static Element) -> Fields<'t> {
        step(1);
        let tree = self.tree;
        let timed = element.timed();
        // The time comes first; it is the first of the attributes of all clauses.
        let first = if timed.is_empty() {
            0
        } else {
            element.attributes.len()
        };
        let mut fields = Fields {
            element,
            tag: tree.nodes[node].span,
            name: self.name_span(node),
            attributes: tree.attributes_of(node),
            slots: [ABSENT; MAX_ATTRIBUTES],
            count: element.attributes.len() + timed.len(),
            next: Cell::new(first),
            complete: true,
            extended: false,
        };
        for (index, attribute) in fields.attributes.iter().enumerate() {
            let slot = match fields.slot(attribute.name) {
                Some((slot, entry)) if !entry.extension => slot,
                _ => match self.slot_by_spelling(node, element, attribute) {
                    Some((slot, entry)) => {
                        fields.extended |= entry.extension;
                        slot
                    }
                    None => continue,
                },
            };
            if fields.slots[slot] == ABSENT {
                fields.slots[slot] = u16::try_from(index).unwrap_or(ABSENT);
            } else {
                let message = format!("{} is given twice", quoted(attribute.name));
                let span = attribute.name_span();
                self.sink
                    .push(Diagnostic::error("eml::duplicate-attribute", span, message));
            }
        }
        fields.next.set(first);
        // None of `TIMED` is required.
        for (attribute, &index) in element.attributes.iter().zip(&fields.slots) {
            if index == ABSENT && matches!(attribute.default, Presence::Required) {
                fields.complete = false;
                let message = format!(
                    "`{}` lacks `{}`; it is dropped",
                    element.name, attribute.name
                );
                let diagnostic = Diagnostic::error("eml::missing-attribute", fields.tag, message);
                self.push_with_hint(
                    diagnostic,
                    (!attribute.doc.is_empty()).then(|| attribute.doc.to_owned()),
                );
            }
        }
        if !element.one_of.is_empty() && !element.one_of.iter().any(|name| fields.has(name)) {
            fields.complete = false;
            let message = format!(
                "`{}` needs {}; it is dropped",
                element.name,
                list(element.one_of)
            );
            self.sink.push(Diagnostic::error(
                "eml::missing-attribute",
                fields.tag,
                message,
            ));
        }
        fields
    }

    /// Returns the slot of an attribute written with a prefix, in another case or as an alias.
    fn slot_by_spelling(
        &mut self,
        node: usize,
        element: &'static Element,
        attribute: &markup::Attribute<'_>,
    ) -> Option<(usize, &'static Attribute)> {
        let written = attribute.name;
        if written == "xmlns" {
            return None;
        }
        let span = attribute.name_span();
        let (owner, local) = self.namespaces.owner(written, node, false);
        let extension = match owner {
            // An element owns its unprefixed attributes, regardless of its namespace.
            Owner::Language => false,
            Owner::Extensions => true,
            Owner::Foreign => return None,
            Owner::Unbound => {
                self.sink.push(namespaces::unbound(
                    written,
                    span,
                    "the attribute is ignored",
                ));
                return None;
            }
        };
        let belongs = |a: &&Attribute| a.extension == extension;
        let found = element.all_attributes().enumerate().find(|(_, a)| {
            a.extension == extension
                && (a.name.eq_ignore_ascii_case(local)
                    || a.aliases
                        .iter()
                        .any(|alias| alias.eq_ignore_ascii_case(local)))
        });
        if let Some((_, entry)) = found {
            self.report_spelling(written, entry.name, span);
            return found;
        }
        let message = format!("`{}` has no attribute {}", element.name, quoted(written));
        let meant = element
            .all_attributes()
            .find(|a| a.extension && !extension && a.name.eq_ignore_ascii_case(local));
        let hint = match meant {
            // It will not be read.
            _ if self.sink.is_full_of("eml::unknown-attribute") => None,
            Some(a) => Some(format!(
                "`{}` is an extension: write {prefix}:{} and bind xmlns:{prefix}='{}' on `eml`",
                a.name,
                a.name,
                namespaces::EXTENSIONS,
                prefix = namespaces::EXTENSIONS_PREFIX,
            )),
            None => nearest(
                local,
                element.all_attributes().filter(belongs).map(|a| a.name),
            )
            .map(|near| format!("did you mean `{near}`?")),
        };
        self.push_with_hint(
            Diagnostic::warning("eml::unknown-attribute", span, message),
            hint,
        );
        None
    }

    pub(crate) fn push_with_hint(&mut self, diagnostic: Diagnostic, hint: Option<String>) {
        self.sink.push(match hint {
            Some(hint) => diagnostic.hint(hint),
            None => diagnostic,
        });
    }

    fn surplus(&mut self, child: usize, entry: &Element, parent: &Element) {
        let most = entry.max_per_parent.unwrap_or(0);
        let message = format!(
            "more than {most} `{}` in one `{}`; this one is dropped",
            entry.name, parent.name
        );
        let span = self.name_span(child);
        self.sink
            .push(Diagnostic::error("eml::surplus-element", span, message));
    }

    /// Reports text in an element that has no meaning for it.
    pub(crate) fn stray_text(&mut self, node: usize, parent: &Element) {
        self.stray_text_at(node, &format!("in `{}`", parent.name), parent);
    }

    /// Reports text where none is allowed: at `place`, in `parent`.
    pub(crate) fn stray_text_at(&mut self, node: usize, place: &str, parent: &Element) {
        let node = &self.tree.nodes[node];
        let text = node.text.trim();
        if text.is_empty() {
            return;
        }
        let start = node.span.start as usize + (node.text.len() - node.text.trim_start().len());
        let message = format!("text {place} has no meaning: {}", quoted(text));
        let diagnostic = Diagnostic::warning(
            "eml::stray-text",
            Span::from_offsets(start, start + text.len()),
            message,
        );
        let hint = find("voice-text")
            .filter(|voice| voice.is_allowed_in(parent.name))
            .map(|_| "spoken text goes into `voice-text`".to_owned());
        self.push_with_hint(diagnostic, hint);
    }
}

/// Joins words for a message, as in `a`, `b` or `c`.
pub(super) fn list(words: &[&str]) -> String {
    let mut out = String::new();
    for (i, word) in words.iter().enumerate() {
        if i > 0 {
            out.push_str(if i + 1 == words.len() { " or " } else { ", " });
        }
        out.push('`');
        out.push_str(word);
        out.push('`');
    }
    out
}
