//! What the elements' tests share.

use crate::{ClauseKind, parse};

/// The codes of the diagnostics of a whole document.
pub(super) fn codes(text: &str) -> Vec<&'static str> {
    parse(text).diagnostics.iter().map(|d| d.code).collect()
}

/// The first clause of a body with this content, which must be without fault.
pub(super) fn one(clause: &str) -> ClauseKind {
    let parsed = parse(&format!("<eml><body>{clause}</body></eml>"));
    assert!(parsed.diagnostics.is_empty(), "{:?}", parsed.diagnostics);
    parsed.document.clauses[0].kind.clone()
}
