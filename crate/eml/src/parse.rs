//! Parser from text to document.

use crate::diagnostic::Sink;
use crate::markup::NodeKind;
use crate::namespaces::{Namespaces, Owner};
use crate::record::Field as _;
use crate::schema::{self, Content, Context, Element, Fields, Role, Tally};
use crate::suggest::quoted;
use crate::syntax;
use crate::{Clause, ClauseId, ClauseKind, Diagnostic, Document, Limits, Span, TimeExpr};
use raconteur_base::encoding;

/// Parsed document with the diagnostics of its text.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Parsed {
    /// The document, without unreadable parts.
    pub document: Document,
    /// Problems, in the order of the text.
    pub diagnostics: Vec<Diagnostic>,
}

/// Parses a script with the default limits. Never fails: faulty clauses are reported and the rest
/// is kept.
#[must_use]
pub fn parse(source: &str) -> Parsed {
    parse_with(source, &Limits::default())
}

/// Parses a script with the given limits.
#[must_use]
pub fn parse_with(source: &str, limits: &Limits) -> Parsed {
    read(source, limits, false)
}

/// Parses a fragment sent by a mind during a performance: a list of clauses, or a whole script.
/// With the default limits.
#[must_use]
pub fn parse_fragment(source: &str) -> Parsed {
    parse_fragment_with(source, &Limits::default())
}

/// Parses a fragment with the given limits, see [`parse_fragment`].
#[must_use]
pub fn parse_fragment_with(source: &str, limits: &Limits) -> Parsed {
    read(source, limits, true)
}

fn read(source: &str, limits: &Limits, fragment: bool) -> Parsed {
    let mut sink = Sink::new(limits.diagnostics);
    let mut document = Document::default();
    if source.len() > limits.bytes.min(u32::MAX as usize) {
        let message = format!(
            "{} bytes are more than the limit of {}",
            source.len(),
            limits.bytes
        );
        sink.push(Diagnostic::error(
            "eml::too-large",
            Span::new(0, 0),
            message,
        ));
        return Parsed {
            document,
            diagnostics: sink.finish(),
        };
    }
    if let Some(what) = reject_binary(source) {
        let message = format!("this is {what}, not UTF-8 text; it is not read");
        let diagnostic = Diagnostic::error("eml::not-utf8", Span::new(0, 0), message);
        sink.push(diagnostic.hint(encoding::SAVE_AS_UTF8));
        return Parsed {
            document,
            diagnostics: sink.finish(),
        };
    }
    report_controls(source, &mut sink);
    let mut taken = PartialBody::default();
    let mut namespaces = Namespaces::new(source);
    let tree = syntax::build(source, limits, &mut sink, &mut |tree, node, sink| {
        namespaces.enter(tree, node, sink);
        let mut cx = Context {
            namespaces: &namespaces,
            tree,
            sink,
            document: &mut document,
            limits,
            source_bytes: source.len(),
            reported_clauses: taken.told_clauses,
            is_fragment: fragment,
            placed: None,
        };
        cx.read_early(node, &mut taken);
        taken.told_clauses = cx.reported_clauses;
    });
    namespaces.finish(&tree, &mut sink);
    let mut cx = Context {
        tree: &tree,
        sink: &mut sink,
        document: &mut document,
        limits,
        source_bytes: source.len(),
        namespaces: &namespaces,
        reported_clauses: taken.told_clauses,
        is_fragment: fragment,
        placed: None,
    };
    cx.root(fragment, taken);
    crate::words::enforce_limits(&mut document, limits, &mut sink);
    crate::check::clauses(&document, fragment, &mut sink);
    Parsed {
        document,
        diagnostics: sink.finish(),
    }
}

/// Part of the body read before the rest of the tree was complete.
#[derive(Default)]
struct PartialBody {
    tally: Option<Tally>,
    told_clauses: bool,
}

/// Returns the type of a binary file from its first characters, so it is not parsed.
pub(crate) fn reject_binary(source: &str) -> Option<&'static str> {
    if encoding::is_utf16(source.as_bytes()) {
        return Some("UTF-16");
    }
    let mut begin = source.chars().take(256);
    let is_binary =
        begin.clone().any(|c| c == '\0') && begin.any(|c| c == char::REPLACEMENT_CHARACTER);
    is_binary.then_some("a binary file")
}

/// Reports the first control character that XML does not allow, which indicates a file that is not
/// text.
fn report_controls(source: &str, sink: &mut Sink) {
    let control = |b: u8| b < 0x20 && !matches!(b, b'\t' | b'\n' | b'\r');
    // A pass without branches over everything is much faster than a search.
    if source.bytes().fold(false, |any, b| any | control(b)) {
        let at = source.bytes().position(control).unwrap_or(0);
        let message = format!(
            "control character {:#04x} in the text",
            source.as_bytes()[at]
        );
        let span = Span::from_offsets(at, at + 1);
        sink.push(Diagnostic::error("eml::control-character", span, message));
    }
}

/// Default distance between the answers to a question, seconds: cues of skipped answers are not
/// delivered.
const ANSWERS_APART_SECS: f64 = 1.0;

/// Default lead of a condition's evaluation before its clauses, seconds.
const CONDITION_APART_SECS: f64 = 0.1;

/// Minimum number of clauses for estimating the rest of the script.
const FEW_CLAUSES: usize = 64;

impl Context<'_> {
    /// Reads from the top of the tree.
    fn root(&mut self, fragment: bool, mut taken: PartialBody) {
        let tree = self.tree;
        let mut root: Option<Span> = None;
        let mut bare: Option<Span> = None;
        let mut elements = 0_u32;
        let mut node = 0;
        while node < tree.nodes.len() {
            let next = tree.nodes[node].subtree_end as usize;
            let NodeKind::Element(found) = tree.nodes[node].kind else {
                elements += u32::from(matches!(tree.nodes[node].kind, NodeKind::Malformed));
                node = next;
                continue;
            };
            elements += 1;
            let span = self.name_span(node);
            // Only a list of clauses has extensions at the top.
            let found = match self.namespaces.owner(tree.nodes[node].text, node, true) {
                (Owner::Extensions, local) => schema::find_extension(local),
                _ => found,
            };
            match found {
                Some(element) if element.name == "eml" && root.is_none() => {
                    root = Some(span);
                    self.script(node, element, taken.tally.take());
                }
                Some(element) if element.name == "eml" => {
                    self.sink.push(
                        Diagnostic::error("eml::surplus-element", span, "a second root element")
                            .related(root.unwrap_or(span), "the first one"),
                    );
                }
                Some(element) if element.is_clause() => {
                    bare.get_or_insert(span);
                    if let Some(id) = self.clause(node, element, None) {
                        self.document.roots.push(id);
                    }
                }
                Some(element) if element.name == "body" => {
                    bare.get_or_insert(span);
                    self.body(node, element, None);
                }
                _ => {
                    let name = quoted(tree.nodes[node].text);
                    let message = format!("expected `eml` as the root, found {name}");
                    self.sink
                        .push(Diagnostic::error("eml::wrong-root", span, message));
                }
            }
            node = next;
        }
        self.top_text();
        if elements == 0 {
            self.sink.push(
                Diagnostic::error(
                    "eml::not-xml",
                    Span::new(0, 0),
                    "this is not an EML document",
                )
                .hint("a story starts with <eml><body> and ends with </body></eml>"),
            );
        } else if let (Some(span), None, false) = (bare, root, fragment) {
            self.sink.push(Diagnostic::warning(
                "eml::no-root",
                span,
                "a script starts with `eml` and `body`; these clauses are read as one",
            ));
        }
    }

    /// Reports text outside the root element, unless all is text.
    fn top_text(&mut self) {
        let tree = self.tree;
        let Some(eml) = schema::find("eml") else {
            return;
        };
        let mut node = 0;
        let any_element = tree
            .nodes
            .iter()
            .any(|n| matches!(n.kind, NodeKind::Element(_)));
        while any_element && node < tree.nodes.len() {
            if matches!(
                tree.nodes[node].kind,
                NodeKind::Text | NodeKind::Reference(_)
            ) {
                self.stray_text_at(node, "outside `eml`", eml);
            }
            node = tree.nodes[node].subtree_end as usize;
        }
    }

    fn script(&mut self, node: usize, element: &'static Element, mut tally: Option<Tally>) {
        self.report_spelling(
            self.tree.nodes[node].text,
            element.name,
            self.name_span(node),
        );
        let fields = self.fields(node, element);
        self.document.name = self.text(&fields, "name").map(Into::into);
        let lead = self.value(&fields, "lead");
        self.document.run_up.set(lead);
        self.children(node, element, |cx, child, entry| match entry.name {
            "body" => cx.body(child, entry, tally.take()),
            _ => schema::read_head(cx, child, entry),
        });
    }

    /// Reads an element of the body while the rest of the document is not there yet.
    fn read_early(&mut self, node: usize, taken: &mut PartialBody) {
        let tree = self.tree;
        let body = tree.taken_from.map(|body| tree.nodes[body as usize].kind);
        let (Some(NodeKind::Element(Some(body))), NodeKind::Element(found)) =
            (body, tree.nodes[node].kind)
        else {
            return;
        };
        let tally = taken.tally.get_or_insert_with(|| Tally::new(body));
        if let Some(entry) = self.admit_counted(tally, node, found) {
            self.body_child(node, entry);
        }
    }

    fn body_child(&mut self, node: usize, entry: &'static Element) {
        if let Some(id) = self.clause(node, entry, None) {
            self.document.roots.push(id);
        }
    }

    /// Reads the body except `taken`, the part read before.
    fn body(&mut self, node: usize, element: &'static Element, taken: Option<Tally>) {
        self.fields(node, element);
        // White space is not in the tree.
        let end = self.tree.nodes[node].subtree_end as usize;
        let is_empty = taken.is_none() && end == node + 1;
        let mut tally = taken.unwrap_or_else(|| Tally::new(element));
        self.children_counted(node, &mut tally, Self::body_child);
        if is_empty {
            let span = self.name_span(node);
            self.sink.push(Diagnostic::warning(
                "eml::empty-body",
                span,
                "the body is empty",
            ));
        }
    }

    /// Reads a clause and its members. Groups recurse; the tree's depth is
    /// limited.
    fn clause(
        &mut self,
        node: usize,
        element: &'static Element,
        parent: Option<ClauseId>,
    ) -> Option<ClauseId> {
        if self.document.clauses.len() >= self.limits.clauses {
            if !std::mem::replace(&mut self.reported_clauses, true) {
                let message = format!(
                    "more than {} clauses; the rest is dropped",
                    self.limits.clauses
                );
                let span = self.name_span(node);
                self.sink
                    .push(Diagnostic::error("eml::too-many-clauses", span, message));
            }
            return None;
        }
        let fields = self.fields(node, element);
        let start = self.time(&fields);
        let time_id = self.text(&fields, "timeId");
        self.warn_of_missing_time(&fields, parent);
        let mut clause = Clause {
            span: self.full_span(node),
            tag_span: fields.tag,
            start: TimeExpr::default(),
            time_id,
            parent,
            kind: ClauseKind::Null,
        };
        let id = ClauseId(u32::try_from(self.document.clauses.len()).unwrap_or(u32::MAX));
        match element.role {
            Role::Clause(build) => {
                if element.content == Content::Empty {
                    self.children(node, element, |_, _, _| {});
                }
                let kind = build(self, node, &fields);
                clause.start = start.ok()?;
                if !fields.is_complete() {
                    return None;
                }
                clause.kind = kind?;
                self.push_clause(clause);
            }
            Role::Record(blank) => {
                clause.kind = blank();
                if let Some(record) = clause.kind.record()
                    && !self.record(node, &fields, record)
                {
                    return None;
                }
                clause.start = start.ok()?;
                self.push_clause(clause);
            }
            Role::Group(wrap) => {
                let mut group = schema::read_group(self, &fields);
                // A group without a time removes its clauses.
                clause.start = start.ok()?;
                self.push_clause(clause);
                self.children(node, element, |cx, child, entry| {
                    group.children.extend(cx.clause(child, entry, Some(id)));
                });
                self.document.clauses[id.index()].kind = wrap(group);
            }
            Role::Scene(blank) => {
                clause.kind = blank();
                clause.start = start.ok()?;
                if !fields.has("time") {
                    clause.start.offset_secs = match element.name {
                        "answer" => ANSWERS_APART_SECS,
                        "if" => CONDITION_APART_SECS,
                        _ => 0.0,
                    };
                }
                self.scene(node, &fields, clause, id)?;
            }
            _ => return None,
        }
        Some(id)
    }

    /// Reads a clause that has parts and clauses inside.
    fn scene(
        &mut self,
        node: usize,
        fields: &Fields<'_>,
        mut clause: Clause,
        id: ClauseId,
    ) -> Option<()> {
        // The sender of the question then handles the effects of an answer.
        if self.is_fragment && fields.element.name != "ask" {
            let message =
                "questions and branching are only allowed in stories, not in a live performance";
            self.sink
                .push(Diagnostic::error("eml::wrong-parent", fields.tag, message));
            return None;
        }
        let (mut parts, mut inside) = (Vec::new(), Vec::new());
        self.children(node, fields.element, |_, child, entry| {
            let list = if entry.is_clause() {
                &mut inside
            } else {
                &mut parts
            };
            list.push((child, entry));
        });
        let record = clause.kind.record()?;
        if !self.visit(fields, record, parts) {
            return None;
        }
        self.push_clause(clause);
        let members = inside.into_iter();
        let members = members.filter_map(|(child, entry)| self.clause(child, entry, Some(id)));
        let members: Vec<ClauseId> = members.collect();
        if let Some(group) = self.document.clauses[id.index()].kind.group_mut() {
            group.children = members;
        }
        Some(())
    }

    /// Adds a clause to the document. Capacity is estimated from the script so far, so few clauses
    /// are moved and little memory is left over.
    fn push_clause(&mut self, clause: Clause) {
        let clauses = &mut self.document.clauses;
        let count = clauses.len();
        if count == clauses.capacity() && count >= FEW_CLAUSES {
            let read = u64::from(clause.tag_span.start).max(1);
            let expected = count as u64 * self.source_bytes as u64 / read;
            let expected = usize::try_from(expected).unwrap_or(usize::MAX);
            let more = expected.min(self.limits.clauses).saturating_sub(count);
            // At least a quarter, so that an increasingly dense script stays linear.
            clauses.reserve_exact((more + more / 16).max(count / 4));
        }
        clauses.push(clause);
    }

    /// Warns about a top-level clause without a time: it starts at 0, which is seldom intended.
    /// Events are exempt, as in the example of GEVH D.1.4.
    fn warn_of_missing_time(&mut self, fields: &Fields<'_>, parent: Option<ClauseId>) {
        let exempt = fields.element.name == "event";
        if parent.is_none() && !exempt && !fields.has("time") {
            let message = format!("`{}` has no `time`; it starts at 0", fields.element.name);
            self.sink.push(Diagnostic::warning(
                "eml::missing-time",
                fields.tag,
                message,
            ));
        }
    }
}
