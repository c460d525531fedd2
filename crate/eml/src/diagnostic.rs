//! Problems in a document, as data.

use crate::Span;

/// How bad a problem is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Severity {
    /// Something of the document is lost: an element or a value was dropped. What the
    /// language does not know at all is a warning, since another version may.
    Error,
    /// The document plays as written or nearly so, but probably not as meant.
    Warning,
}

impl Severity {
    /// `error` or `warning`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Error => "error",
            Self::Warning => "warning",
        }
    }
}

/// A problem in a document and where it is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// What kind of problem, for machines: `eml::unknown-element` and so on.
    pub code: &'static str,
    /// How bad it is.
    pub severity: Severity,
    /// Where it is.
    pub span: Span,
    /// One sentence for people, without line numbers.
    pub message: String,
    /// What to do about it.
    pub hints: Vec<String>,
    /// Other places that have to do with it, each with a remark.
    pub related: Vec<(Span, String)>,
}

impl Diagnostic {
    /// An error without hints.
    #[must_use]
    pub fn error(code: &'static str, span: Span, message: impl Into<String>) -> Self {
        Self {
            code,
            severity: Severity::Error,
            span,
            message: message.into(),
            hints: Vec::new(),
            related: Vec::new(),
        }
    }

    /// A warning without hints.
    #[must_use]
    pub fn warning(code: &'static str, span: Span, message: impl Into<String>) -> Self {
        Self {
            severity: Severity::Warning,
            ..Self::error(code, span, message)
        }
    }

    /// The same with one more hint.
    #[must_use]
    pub fn hint(mut self, hint: impl Into<String>) -> Self {
        self.hints.push(hint.into());
        self
    }

    /// The same with one more related place.
    #[must_use]
    pub fn related(mut self, span: Span, remark: impl Into<String>) -> Self {
        self.related.push((span, remark.into()));
        self
    }
}

/// Collects diagnostics up to a limit and counts the rest, so that a hostile file
/// cannot fill the memory with complaints.
#[derive(Debug)]
pub(crate) struct Sink {
    list: Vec<Diagnostic>,
    limit: usize,
    left_out: usize,
    last: Span,
}

impl Sink {
    pub(crate) fn new(limit: usize) -> Self {
        Self {
            list: Vec::new(),
            limit,
            left_out: 0,
            last: Span::default(),
        }
    }

    pub(crate) fn push(&mut self, diagnostic: Diagnostic) {
        if self.is_full() {
            self.left_out += 1;
            self.last = diagnostic.span;
        } else {
            self.list.push(diagnostic);
        }
    }

    /// Whether a problem within a place has been told.
    pub(crate) fn tells_of(&self, place: Span) -> bool {
        let within = |d: &Diagnostic| place.start <= d.span.start && d.span.end <= place.end;
        self.list.iter().any(within)
    }

    /// Whether further diagnostics are only counted, so that what they say does not matter.
    pub(crate) fn is_full(&self) -> bool {
        self.list.len() >= self.limit
    }

    /// The diagnostics in the order of the text, then the count of those left out.
    pub(crate) fn finish(mut self) -> Vec<Diagnostic> {
        raconteur_base::order::sort_by_number(&mut self.list, |d| f64::from(d.span.start));
        if self.left_out > 0 {
            self.list.push(Diagnostic::warning(
                "eml::more",
                self.last,
                format!("and {} more", self.left_out),
            ));
        }
        self.list
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_full_sink_says_how_many_it_left_out() {
        let mut sink = Sink::new(2);
        for i in (0..5).rev() {
            sink.push(Diagnostic::error("eml::test", Span::new(i, i + 1), "x"));
        }
        let list = sink.finish();
        assert_eq!(list.len(), 3);
        assert_eq!((list[0].span.start, list[1].span.start), (3, 4));
        assert_eq!(
            (list[2].code, list[2].message.as_str()),
            ("eml::more", "and 3 more")
        );
    }
}
