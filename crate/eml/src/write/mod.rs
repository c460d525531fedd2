//! Writer of documents as EML text.
//!
//! Each document has one text: two spaces per level, attributes in the order of the table, defaults
//! omitted, numbers as short as possible, all times specified. Reading it gives the document again,
//! except for its positions in a text (see [`normal_form`]).

mod comments;
mod normal;
mod tag;
#[cfg(test)]
mod tests;
mod voice;

use crate::RunUp;
use crate::namespaces::{EXTENSIONS, EXTENSIONS_PREFIX};
use crate::time_expr::MAX_SECS;
use crate::{Clause, ClauseId, ClauseKind, Document, TimeExpr};
use comments::Comment;
pub use normal::normal_form;
use tag::Tag;

/// Codes of diagnostics with which rewriting a document loses nothing: another spelling, or content
/// that is kept unchanged.
pub const HARMLESS: &[&str] = &[
    "eml::alias",
    "eml::letter-case",
    "eml::missing-time",
    "eml::no-root",
    "eml::late-key",
    "eml::key-order",
    "eml::empty-body",
    "eml::empty-voice",
    "eml::ignored-attribute",
    "eml::duplicate-argument",
    "eml::duplicate-player",
    "eml::unknown-set",
    "eml::unknown-player",
    "eml::unknown-body-group",
];

/// Returns the canonical EML text of a document.
#[must_use]
pub fn write(document: &Document) -> String {
    Writer::new(document, Vec::new()).write(&[], &[])
}

/// Returns the canonical text of a document parsed from `source`, with the comments of that text,
/// each before the clause that it preceded or was in.
#[must_use]
pub fn write_with_comments(document: &Document, source: &str) -> String {
    let found = comments::collect_comments(source);
    Writer::new(document, found.inside).write(&found.before, &found.after)
}

struct Writer<'d> {
    document: &'d Document,
    /// The comments that still wait for their clause, last ones first.
    comments: Vec<Comment<'d>>,
    out: String,
    depth: usize,
    extended: bool,
}

impl<'d> Writer<'d> {
    fn new(document: &'d Document, mut comments: Vec<Comment<'d>>) -> Self {
        comments.reverse();
        Self {
            document,
            comments,
            out: String::new(),
            depth: 0,
            extended: false,
        }
    }

    fn write(mut self, before: &[Comment<'_>], after: &[Comment<'_>]) -> String {
        self.depth = 1;
        self.head();
        self.line("<body>");
        self.depth += 1;
        for &root in &self.document.roots {
            self.clause(root);
        }
        self.comments_before(u32::MAX);
        self.depth -= 1;
        self.line("</body>");
        let mut root = Tag::new("eml");
        root.text("name", self.document.name.as_deref());
        let run_up = self.document.run_up;
        root.word("lead", run_up.map(RunUp::word));
        self.extended |= root.is_extended();
        let mut whole = String::new();
        for comment in before {
            whole.push_str(comment.text);
            whole.push('\n');
        }
        whole.push_str("<eml");
        whole.push_str(&root.attributes());
        if self.extended {
            whole.push_str(&format!(" xmlns:{EXTENSIONS_PREFIX}='{EXTENSIONS}'"));
        }
        whole.push_str(">\n");
        whole.push_str(&self.out);
        whole.push_str("</eml>\n");
        for comment in after {
            whole.push_str(comment.text);
            whole.push('\n');
        }
        whole
    }

    fn head(&mut self) {
        let mut children = Vec::new();
        if !self.document.sets.is_empty() {
            let mut sets = Tag::new("sets-configuration");
            for set in &self.document.sets {
                sets.children.push(Tag::from_record(&mut set.clone()));
            }
            let mut configuration = Tag::new("body-expression-configuration");
            configuration.children.push(sets);
            children.push(configuration);
        }
        if let Some(performer) = &self.document.performer {
            children.push(Tag::from_record(&mut performer.clone()));
        }
        if let Some(environment) = &self.document.environment {
            children.push(Tag::from_record(&mut environment.clone()));
        }
        if !children.is_empty() {
            let mut head = Tag::new("head");
            head.children = children;
            self.tag(&head);
        }
    }

    /// Writes a clause and its members. Groups recurse; parsing limits the depth, and a
    /// document made otherwise is as deep as its maker chose.
    fn clause(&mut self, id: ClauseId) {
        let clause = self.document.clause(id);
        let group = clause.kind.group();
        self.comments_before(if group.is_some() {
            clause.tag_span.end
        } else {
            clause.span.end
        });
        let tag = clause_tag(clause);
        match &clause.kind {
            ClauseKind::VoiceText(text) => {
                let (content, extended) = voice::content(text);
                self.extended |= extended;
                self.around(&tag, &content);
            }
            ClauseKind::VoiceSay(say) => self.around(&tag, &tag::escaped(&say.content)),
            ClauseKind::Event { payload, .. } => self.around(&tag, &tag::escaped(payload)),
            _ => match group {
                None => self.tag(&tag),
                Some(group) if group.children.is_empty() => self.tag(&tag),
                Some(group) => {
                    self.extended |= tag.is_extended();
                    self.line(&format!("<{}{}>", tag.name(), tag.attributes()));
                    self.depth += 1;
                    for part in &tag.children {
                        self.tag(part);
                    }
                    for &child in &group.children {
                        self.clause(child);
                    }
                    self.comments_before(clause.span.end);
                    self.depth -= 1;
                    self.line(&format!("</{}>", tag.name()));
                }
            },
        }
    }

    /// Writes a tag with its content, a line each.
    fn tag(&mut self, tag: &Tag) {
        self.extended |= tag.is_extended();
        let start = format!("<{}{}", tag.name(), tag.attributes());
        if tag.children.is_empty() {
            self.line(&format!("{start}/>"));
            return;
        }
        self.line(&format!("{start}>"));
        self.depth += 1;
        for child in &tag.children {
            self.tag(child);
        }
        self.depth -= 1;
        self.line(&format!("</{}>", tag.name()));
    }

    /// Writes a tag around text, in which space counts.
    fn around(&mut self, tag: &Tag, content: &str) {
        self.extended |= tag.is_extended();
        let (name, attributes) = (tag.name(), tag.attributes());
        if content.is_empty() {
            self.line(&format!("<{name}{attributes}/>"));
        } else {
            self.line(&format!("<{name}{attributes}>{content}</{name}>"));
        }
    }

    fn comments_before(&mut self, end: u32) {
        while let Some(comment) = self.comments.pop_if(|comment| comment.start < end) {
            self.line(comment.text);
        }
    }

    fn line(&mut self, text: &str) {
        for _ in 0..self.depth {
            self.out.push_str("  ");
        }
        self.out.push_str(text);
        self.out.push('\n');
    }
}

/// Returns the tag of a clause, without contained clauses and text.
fn clause_tag(clause: &Clause) -> Tag {
    let mut kind = clause.kind.clone();
    let mut tag = match kind.record() {
        Some(record) => Tag::from_record(record),
        None => {
            let mut tag = Tag::new(clause.kind.name());
            match &clause.kind {
                ClauseKind::GestureIsOn(is_on) => tag.flag("isOn", *is_on),
                ClauseKind::GestureKey(gesture) => tag.gesture(gesture),
                ClauseKind::Event { kind, .. } => tag.text("type", kind.as_deref()),
                ClauseKind::Seq(group) | ClauseKind::Par(group) => {
                    tag.number("repetitionCount", Some(f64::from(group.repetition_count)));
                    tag.number("duration", group.iteration_secs);
                }
                _ => {}
            }
            tag
        }
    };
    tag.time(&time(&clause.start), clause.time_id.as_deref());
    tag
}

/// Returns the text of a time expression: its names, then its seconds.
fn time(expr: &TimeExpr) -> String {
    let mut out = String::new();
    for name in &expr.names {
        match (name.negative, out.is_empty()) {
            (true, _) => out.push('-'),
            (false, false) => out.push('+'),
            (false, true) => {}
        }
        out.push_str(&name.name);
    }
    let mut left = expr.offset_secs;
    // One number may not be larger than this; their sum may.
    while left.abs() > MAX_SECS {
        let part = MAX_SECS.copysign(left);
        out.push_str(&signed(part, out.is_empty()));
        left -= part;
    }
    if left != 0.0 || out.is_empty() {
        out.push_str(&signed(left, out.is_empty()));
    }
    out
}

fn signed(number: f64, is_first: bool) -> String {
    let number = tag::number(number);
    if is_first || number.starts_with('-') {
        number
    } else {
        format!("+{number}")
    }
}
