//! Scripts under construction, and their times.

use raconteur_eml::{
    Clause, ClauseId, ClauseKind, Diagnostic, Document, Name, NameTerm, Span, TimeExpr,
};

/// Script under construction, with the problems met on the way.
#[derive(Default)]
pub(crate) struct Builder {
    pub(crate) document: Document,
    pub(crate) problems: Vec<Diagnostic>,
}

impl Builder {
    /// Adds a clause to the body.
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
            parent: None,
            kind,
        });
        self.document.roots.push(id);
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
