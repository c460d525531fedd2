//! Scripts under construction, and their times.

use raconteur_eml::{
    Clause, ClauseId, ClauseKind, Diagnostic, Document, Group, Name, NameTerm, Span, TimeExpr,
};

/// SABLE's emphasis of text outside `emph`.
pub(crate) const UNSTRESSED: f64 = 0.5;

/// Script under construction, with the problems met on the way.
#[derive(Default)]
pub(crate) struct Builder {
    pub(crate) document: Document,
    pub(crate) problems: Vec<Diagnostic>,
    /// Open groups, the innermost last.
    open: Vec<ClauseId>,
}

impl Builder {
    /// Adds a clause to the innermost open group, else to the body.
    pub(crate) fn push(&mut self, start: TimeExpr, kind: ClauseKind) {
        self.push_named(start, None, kind);
    }

    /// Adds a clause with a name for its start.
    pub(crate) fn push_named(&mut self, start: TimeExpr, time_id: Option<Name>, kind: ClauseKind) {
        let clauses = &mut self.document.clauses;
        let id = ClauseId(u32::try_from(clauses.len()).unwrap_or(u32::MAX));
        clauses.push(Clause {
            span: Span::default(),
            tag_span: Span::default(),
            start,
            time_id,
            parent: self.open.last().copied(),
            kind,
        });
        match self.group() {
            Some(group) => group.children.push(id),
            None => self.document.roots.push(id),
        }
    }

    fn group(&mut self) -> Option<&mut Group> {
        let id = self.open.last()?.index();
        match &mut self.document.clauses.get_mut(id)?.kind {
            ClauseKind::Seq(group) | ClauseKind::Par(group) => Some(group),
            _ => None,
        }
    }

    /// Adds a seq or par at the start of its group; clauses belong to it until it is closed.
    pub(crate) fn open(&mut self, time_id: Option<Name>, kind: ClauseKind) {
        let id = ClauseId(u32::try_from(self.document.clauses.len()).unwrap_or(u32::MAX));
        self.push_named(seconds(0.0), time_id, kind);
        self.open.push(id);
    }

    /// Closes the innermost open group.
    pub(crate) fn close(&mut self) {
        self.open.pop();
    }

    /// Reports how something missing was filled in.
    pub(crate) fn note(&mut self, code: &'static str, span: Span, message: impl Into<String>) {
        self.problems.push(Diagnostic::warning(code, span, message));
    }
}

/// Returns the expression of a number of seconds.
pub(crate) fn seconds(secs: f64) -> TimeExpr {
    TimeExpr {
        offset_secs: rounded(secs),
        ..TimeExpr::default()
    }
}

/// Returns the expression of a time after a mark.
pub(crate) fn after(name: Name, secs: f64) -> TimeExpr {
    TimeExpr {
        offset_secs: rounded(secs),
        names: vec![NameTerm {
            name,
            negative: false,
            span: Span::default(),
        }],
        span: Span::default(),
    }
}

/// Rounds to microseconds, so that differences do not fill scripts with digits.
pub(crate) fn rounded(secs: f64) -> f64 {
    (secs * 1e6).round() / 1e6
}

/// Returns a text without the characters that XML forbids. Byte offsets stay the same.
pub(crate) fn permitted(text: &str) -> String {
    let replaced = |c: char| match c {
        '\t' | '\n' | '\r' => c,
        '\0'..' ' => ' ',
        '\u{fffe}' | '\u{ffff}' => char::REPLACEMENT_CHARACTER,
        _ => c,
    };
    text.chars().map(replaced).collect()
}
