//! Builder of the tree from `quick-xml`'s events. It has its own stack, so that deep nesting causes
//! a diagnostic instead of a stack overflow, and it restarts the reader after unreadable markup.

mod elements;

use super::attributes::{self, Outcome};
use crate::diagnostic::Sink;
use crate::markup::{Node, NodeKind, bare_ampersand, character};
use crate::schema::{Element, Tree};
use crate::suggest::quoted;
use crate::work::step;
use crate::{Diagnostic, Limits, Span};
use quick_xml::Reader;
use quick_xml::errors::{Error, SyntaxError};
use quick_xml::events::Event;

/// Bounds the memory of the tree: about 150 MB at worst.
const MAX_NODES: usize = 2_000_000;

/// Maximum depth of recursion over the tree, whatever the limits.
const MAX_DEPTH: usize = 256;

/// Callback for each completed element of the body: the tree, the index of its node, and the
/// diagnostics.
pub(crate) type TakeEvent<'a, 's> = dyn FnMut(&Tree<'a>, usize, &mut Sink) + 's;

/// Parses `source` into a tree. In a document with a valid beginning, the elements of the body are
/// passed to `take` one after another and removed from the tree, so a long script needs no more
/// memory than its longest clause.
pub(crate) fn build<'a>(
    source: &'a str,
    limits: &Limits,
    sink: &mut Sink,
    take: &mut TakeEvent<'a, '_>,
) -> Tree<'a> {
    let mut builder = Builder {
        source,
        limits,
        sink,
        take,
        tree: Tree::default(),
        stack: Vec::new(),
        met_body: false,
        skipped_depth: 0,
        told_depth: false,
        // Reading the same bytes again after a slip must stay linear in all.
        reread_budget: 4 * source.len() + (64 << 10),
    };
    builder.run();
    builder.tree
}

struct Builder<'a, 's, 't> {
    source: &'a str,
    limits: &'s Limits,
    sink: &'s mut Sink,
    take: &'s mut TakeEvent<'a, 't>,
    tree: Tree<'a>,
    /// True after the first body in the root.
    met_body: bool,
    /// Indices of the open elements.
    stack: Vec<u32>,
    /// Number of open elements below the depth limit.
    skipped_depth: usize,
    told_depth: bool,
    reread_budget: usize,
}

/// The events of a source from a byte on.
struct Events<'a> {
    reader: Reader<&'a [u8]>,
    base: usize,
}

impl<'a> Events<'a> {
    fn new(source: &'a str, base: usize) -> Self {
        let mut reader = Reader::from_str(&source[base..]);
        let config = reader.config_mut();
        config.check_end_names = false;
        config.allow_unmatched_ends = true;
        config.allow_dangling_amp = true;
        Self { reader, base }
    }

    /// Converts an offset of the reader to a byte offset in the source.
    fn position(&self, offset: u64) -> usize {
        self.base + usize::try_from(offset).unwrap_or(usize::MAX)
    }

    /// Returns the byte offset after the last event.
    fn offset(&self) -> usize {
        self.position(self.reader.buffer_position())
    }
}

/// Reason why the reader stopped before the end of the source.
struct Restart {
    /// Offset at which to continue.
    at: usize,
    /// Offset up to which bytes have been scanned.
    reached: usize,
}

impl<'a> Builder<'a, '_, '_> {
    fn run(&mut self) {
        let mut start = if self.source.starts_with('\u{feff}') {
            3
        } else {
            0
        };
        while let Some(restart) = self.read_from(start) {
            let again = restart.reached.saturating_sub(restart.at);
            if again > self.reread_budget {
                let span = Span::from_offsets(restart.at, restart.at + 1);
                self.error(
                    "eml::malformed",
                    span,
                    "too much is malformed; reading stops here",
                );
                break;
            }
            self.reread_budget -= again;
            start = restart.at;
        }
        while let Some(open) = self.stack.pop() {
            self.close(open, self.source.len(), None);
        }
    }

    fn read_from(&mut self, base: usize) -> Option<Restart> {
        let (mut events, mut at) = self.events(base);
        while at < self.source.len() {
            if self.tree.nodes.len() >= MAX_NODES {
                self.error(
                    "eml::too-large",
                    Span::from_offsets(at, at + 1),
                    "too many elements; reading stops here",
                );
                return None;
            }
            let start = at;
            at = match self.read_event(&mut events, at) {
                Ok(next) => next,
                Err(restart) => return restart,
            };
            step(at - start);
        }
        None
    }

    /// Returns the events from byte `base` on, and their start. A byte order mark at `base` is kept
    /// as text, since the reader would drop it.
    fn events(&mut self, base: usize) -> (Events<'a>, usize) {
        let mut at = base;
        if self.source[at..].starts_with('\u{feff}') {
            let markup = self.source[at..].find(['<', '&']);
            at = markup.map_or(self.source.len(), |found| at + found);
            self.text(base, at);
        }
        (Events::new(self.source, at), at)
    }

    /// Reads the event at byte `start`. Returns its end, or the restart position, if any, of an
    /// unterminated event.
    fn read_event(
        &mut self,
        events: &mut Events<'a>,
        start: usize,
    ) -> Result<usize, Option<Restart>> {
        let source = self.source;
        let event = events.reader.read_event();
        let end = events.offset();
        match event {
            Ok(Event::Start(tag)) => {
                let raw = &source[start + 1..end - 1];
                if let Some(at) = self.open(raw, tag.name().as_ref().len(), start, end, false) {
                    return Err(Some(Restart { at, reached: end }));
                }
            }
            Ok(Event::Empty(tag)) => {
                let raw = &source[start + 1..end - 2];
                if let Some(at) = self.open(raw, tag.name().as_ref().len(), start, end, true) {
                    return Err(Some(Restart { at, reached: end }));
                }
            }
            Ok(Event::End(_)) => {
                let name = source[start + 2..end - 1].trim_end();
                self.end_tag(name, start, end);
            }
            Ok(Event::Text(_)) => self.text(start, end),
            Ok(Event::CData(_)) => self.text(start + 9, end - 3),
            Ok(Event::GeneralRef(_)) => {
                let span = Span::from_offsets(start, end);
                let name = &source[start + 1..end - 1];
                if let Some(c) = character(name, span, self.sink) {
                    self.push(NodeKind::Reference(c), &source[start..end], span);
                }
            }
            Ok(Event::DocType(_)) => self.doctype(start, end),
            Ok(Event::Comment(_) | Event::PI(_) | Event::Decl(_)) => {}
            Ok(Event::Eof) => return Err(None),
            Err(Error::IllFormed(_)) => {
                // At least the `<` is read.
                let end = end.max(start + 1);
                self.doctype(start, end);
                let (rest, begin) = self.events(end);
                *events = rest;
                return Ok(begin);
            }
            Err(error) => {
                step(end - start);
                let at = events.position(events.reader.error_position());
                return Err(self.recover(&error, at));
            }
        }
        Ok(end)
    }

    /// Continues after unterminated markup at byte `at`.
    fn recover(&mut self, error: &Error, at: usize) -> Option<Restart> {
        let rest = self.source.get(at + 1..)?;
        let next = rest.find('<').map(|i| at + 1 + i);
        step(next.unwrap_or(self.source.len()) - at);
        let stop = next.unwrap_or(self.source.len());
        let restart = next.map(|at| Restart {
            at,
            reached: self.source.len(),
        });
        let span = Span::from_offsets(at, at + 1);
        match error {
            Error::Syntax(SyntaxError::UnclosedComment) => {
                self.error(
                    "eml::malformed",
                    span,
                    "the comment that opens here is not closed",
                );
                return None;
            }
            Error::Syntax(SyntaxError::UnclosedCData) => {
                self.error(
                    "eml::malformed",
                    span,
                    "the CDATA section that opens here is not closed",
                );
                return None;
            }
            Error::Syntax(SyntaxError::UnclosedDoctype) => self.doctype(at, stop),
            Error::Syntax(
                SyntaxError::UnclosedTag
                | SyntaxError::UnclosedSingleQuotedAttributeValue
                | SyntaxError::UnclosedDoubleQuotedAttributeValue,
            ) if rest.starts_with(is_name_start) => {
                let raw = &self.source[at + 1..stop];
                let name_len = raw
                    .find(|c: char| c.is_ascii_whitespace())
                    .unwrap_or(raw.len());
                let name = &raw[..name_len];
                // An open quote includes the `>`; its position is more precise than the tag's.
                let mut slips = Sink::new(self.limits.attributes);
                let after_name = &raw[name_len..];
                let start = at + 1 + name_len;
                let outcome =
                    attributes::scan(name, after_name, start, 0, &mut Vec::new(), &mut slips);
                match (outcome, slips.finish().pop()) {
                    (Outcome::Broken(_), Some(quote)) => self.sink.push(quote),
                    _ => self.not_closed(name, at),
                }
                self.open_broken(name, raw, at);
            }
            _ => self.error("eml::malformed", span, "`<` does not start any markup here"),
        }
        restart
    }

    fn text(&mut self, start: usize, end: usize) {
        if self.skipped_depth > 0 {
            return;
        }
        let text = &self.source[start..end];
        if text.starts_with('&') {
            // The reader hands a reference without its `;` over as text.
            bare_ampersand(Span::from_offsets(start, start + 1), self.sink);
        }
        if self.keeps_space() || !text.bytes().all(|b| b.is_ascii_whitespace()) {
            self.push_text(start, end);
        }
    }

    fn push_text(&mut self, start: usize, end: usize) {
        if self.skipped_depth == 0 {
            let text = &self.source[start..end];
            self.push(NodeKind::Text, text, Span::from_offsets(start, end));
        }
    }

    /// Returns true if white space is significant at the reader's position.
    fn keeps_space(&self) -> bool {
        let Some(&open) = self.stack.last() else {
            return false;
        };
        match self.tree.nodes[open as usize].kind {
            NodeKind::Element(Some(element)) => element.content.has_text(),
            NodeKind::Element(None) => true,
            _ => false,
        }
    }

    fn push(&mut self, kind: NodeKind<&'static Element>, text: &'a str, span: Span) -> u32 {
        let index = Span::from_offsets(self.tree.nodes.len(), 0).start;
        self.tree.nodes.push(Node {
            kind,
            text,
            span,
            end: span.end,
            subtree_end: index + 1,
            first_attribute: Span::from_offsets(self.tree.attributes.len(), 0).start,
            attribute_count: 0,
        });
        index
    }

    /// Reports a tag without its `>` at byte `start`.
    fn not_closed(&mut self, name: &str, start: usize) {
        let span = Span::from_offsets(start, start + 1 + name.len());
        let message = format!("the tag of {} is not closed; it is dropped", quoted(name));
        self.error("eml::malformed-tag", span, message);
    }

    fn doctype(&mut self, start: usize, end: usize) {
        self.sink.push(
            Diagnostic::error(
                "eml::doctype",
                Span::from_offsets(start, end),
                "EML has no document type; the declaration is ignored",
            )
            .hint("nothing outside the story is read, so entities cannot be declared"),
        );
    }

    fn error(&mut self, code: &'static str, span: Span, message: impl Into<String>) {
        self.sink.push(Diagnostic::error(code, span, message));
    }
}

fn is_name_start(c: char) -> bool {
    c.is_alphabetic() || c == '_'
}
