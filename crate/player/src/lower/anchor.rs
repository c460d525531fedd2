//! Clause that represents a live fragment's own start. Times of the story are counted from it; it
//! is not a clause of the script, so it is not reported.

use raconteur_eml::{Clause, ClauseId, ClauseKind, Document, Span, TimeExpr};

/// Names the fragment's own start; no document can write it.
pub(crate) const ANCHOR: &str = "";

/// Returns true if a clause is the anchor.
pub(crate) fn is_anchor(clause: &Clause) -> bool {
    clause.time_id.as_deref().is_some_and(is_anchor_name)
}

/// Returns true if a mark is the anchor's.
pub(crate) fn is_anchor_name(name: &str) -> bool {
    name == ANCHOR
}

/// Adds the anchor to a fragment.
pub(crate) fn add_anchor(document: &mut Document) {
    let id = ClauseId(u32::try_from(document.clauses.len()).unwrap_or(u32::MAX));
    document.roots.push(id);
    document.clauses.push(Clause {
        span: Span::default(),
        tag_span: Span::default(),
        start: TimeExpr::default(),
        time_id: Some(ANCHOR.into()),
        parent: None,
        kind: ClauseKind::Null,
    });
}
