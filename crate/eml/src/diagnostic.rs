//! Problems in a document, as data.

use crate::Span;
use std::collections::BTreeMap;

/// Severity of a diagnostic: error or warning.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Severity {
    /// Part of the document is lost: an element or a value was dropped. Names unknown to the
    /// language are warnings, since another version may know them.
    Error,
    /// The document plays as written or nearly so, but probably not as meant.
    Warning,
}

impl Severity {
    /// Returns the name of the severity, `error` or `warning`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Error => "error",
            Self::Warning => "warning",
        }
    }
}

/// Problem found in a document, with its location, message and hints.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// Machine-readable code of the problem: `eml::unknown-element` and so on.
    pub code: &'static str,
    /// Severity of the problem.
    pub severity: Severity,
    /// Location in the source that the diagnostic is about.
    pub span: Span,
    /// Message in one sentence, without line numbers.
    pub message: String,
    /// Hints for a fix.
    pub hints: Vec<String>,
    /// Related locations, each with a remark.
    pub related: Vec<(Span, String)>,
}

impl Diagnostic {
    /// Creates an error without hints.
    #[must_use]
    pub fn error(code: &'static str, span: Span, message: impl Into<String>) -> Self {
        Self {
            code,
            severity: Severity::Error,
            span,
            message: clipped(message.into()),
            hints: Vec::new(),
            related: Vec::new(),
        }
    }

    /// Creates a warning without hints.
    #[must_use]
    pub fn warning(code: &'static str, span: Span, message: impl Into<String>) -> Self {
        Self {
            severity: Severity::Warning,
            ..Self::error(code, span, message)
        }
    }

    /// Returns the diagnostic with one more hint.
    #[must_use]
    pub fn hint(mut self, hint: impl Into<String>) -> Self {
        self.hints.push(clipped(hint.into()));
        self
    }

    /// Returns the diagnostic with one more related location.
    #[must_use]
    pub fn related(mut self, span: Span, remark: impl Into<String>) -> Self {
        self.related.push((span, remark.into()));
        self
    }
}

/// The longest message, characters: longer quotations are cut.
const MAX_MESSAGE_LENGTH: usize = 400;

fn clipped(mut message: String) -> String {
    if let Some((end, _)) = message.char_indices().nth(MAX_MESSAGE_LENGTH) {
        message.truncate(end);
        message.push('…');
    }
    message
}

/// Maximum number of diagnostics of one kind that are reported individually.
pub const MAX_PER_KIND: usize = 20;

/// The code of the diagnostic that counts those left out.
const MORE: &str = "eml::more";

/// Thins the diagnostics of several readers of one document: keeps the first [`MAX_PER_KIND`] of
/// each kind, and counts the others in `eml::more`. In the order of the text.
#[must_use]
pub fn thinned(mut diagnostics: Vec<Diagnostic>) -> Vec<Diagnostic> {
    raconteur_base::order::sort_by_number(&mut diagnostics, |d| f64::from(d.span.start));
    let mut sink = Sink::new(usize::MAX);
    diagnostics.into_iter().for_each(|d| sink.push(d));
    sink.finish()
}

/// Count of the diagnostics with one code: reported, and left out.
#[derive(Debug, Default)]
struct Kind {
    told: usize,
    left_out: usize,
    /// The worst severity of those left out.
    worst: Option<Severity>,
    /// Location of the last of them.
    last: Span,
}

/// Collector of diagnostics, limited in total and per kind. It counts the rest, so a hostile file
/// cannot fill the memory with diagnostics.
#[derive(Debug)]
pub(crate) struct Sink {
    list: Vec<Diagnostic>,
    limit: usize,
    kinds: BTreeMap<&'static str, Kind>,
}

impl Sink {
    pub(crate) fn new(limit: usize) -> Self {
        Self {
            list: Vec::new(),
            limit,
            kinds: BTreeMap::new(),
        }
    }

    pub(crate) fn push(&mut self, diagnostic: Diagnostic) {
        if diagnostic.code == MORE {
            self.list.push(diagnostic);
            return;
        }
        let is_full = self.is_full_of(diagnostic.code);
        let kind = self.kinds.entry(diagnostic.code).or_default();
        if is_full {
            kind.left_out += 1;
            // Errors come first in the order of severities.
            let worst = kind.worst.unwrap_or(diagnostic.severity);
            kind.worst = Some(worst.min(diagnostic.severity));
            kind.last = kind.last.max(diagnostic.span);
        } else {
            kind.told += 1;
            self.list.push(diagnostic);
        }
    }

    /// Returns true if a problem within a span has been reported.
    pub(crate) fn concerns(&self, place: Span) -> bool {
        let within = |d: &Diagnostic| place.start <= d.span.start && d.span.end <= place.end;
        self.list.iter().any(within)
    }

    /// Returns true if further diagnostics of a kind are only counted, so their text does not
    /// matter.
    pub(crate) fn is_full_of(&self, code: &'static str) -> bool {
        let told = self.kinds.get(code).map_or(0, |kind| kind.told);
        self.list.len() >= self.limit || told >= MAX_PER_KIND
    }

    /// Returns the diagnostics in source order, followed by the counts of those left out.
    pub(crate) fn finish(mut self) -> Vec<Diagnostic> {
        raconteur_base::order::sort_by_number(&mut self.list, |d| f64::from(d.span.start));
        for (code, kind) in self.kinds {
            if let Some(worst) = kind.worst {
                let message = format!("and {} more of the kind {code}", kind.left_out);
                self.list.push(Diagnostic {
                    severity: worst,
                    ..Diagnostic::warning(MORE, kind.last, message)
                });
            }
        }
        self.list
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// Checks, for any input, that few of a kind are reported, none is lost in the counts, and
        /// an omitted error leaves an error behind.
        #[test]
        fn all_are_told_or_counted(
            kinds in prop::collection::vec((0_usize..4, any::<bool>(), 0_u32..99), 0..300),
            limit in 0_usize..100,
        ) {
            const CODES: [&str; 4] = ["a", "b", "c", "d"];
            let mut sink = Sink::new(limit);
            let one = |&(kind, bad, at): &(usize, bool, u32)| {
                let make = if bad { Diagnostic::error } else { Diagnostic::warning };
                make(CODES[kind], Span::new(at, at), String::new())
            };
            kinds.iter().for_each(|kind| sink.push(one(kind)));
            // Repeated thinning changes only the order of the counts.
            let told = sink.finish();
            prop_assert_eq!(thinned(told.clone()).len(), told.len());
            prop_assert!(told.iter().filter(|d| d.code != MORE).count() <= limit);
            for code in CODES {
                let of_kind = told.iter().filter(|d| d.code == code).count();
                prop_assert!(of_kind <= MAX_PER_KIND);
                let suffix = format!(" more of the kind {code}");
                let counted = told.iter().filter(|d| d.code == MORE).find_map(|d| {
                    d.message.strip_prefix("and ")?.strip_suffix(&suffix)?.parse::<usize>().ok()
                });
                let all = kinds.iter().filter(|(kind, ..)| CODES[*kind] == code).count();
                prop_assert_eq!(of_kind + counted.unwrap_or(0), all);
            }
            let any_error = |list: &[Diagnostic]| list.iter().any(|d| d.severity == Severity::Error);
            prop_assert_eq!(any_error(&told), kinds.iter().any(|(_, bad, _)| *bad));
        }
    }

    #[test]
    fn messages_are_not_as_long_as_what_they_quote() {
        let long =
            Diagnostic::error("a", Span::default(), "é".repeat(10_000)).hint("x".repeat(999));
        assert_eq!(long.message.chars().count(), MAX_MESSAGE_LENGTH + 1);
        assert_eq!(long.hints[0].len(), MAX_MESSAGE_LENGTH + '…'.len_utf8());
    }

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
            ("eml::more", "and 3 more of the kind eml::test")
        );
    }
}
