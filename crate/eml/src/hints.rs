//! Hints for names in a lesson: likely meanings and duplicates.

use crate::suggest::{MAX_HINTS, nearest, quoted};
use crate::{Diagnostic, Span};

/// Hints that are looked for in one document, which bounds their cost.
const MAX_LOOKS: usize = 64;

/// Number of name suggestions that may still be searched; limits the work for hints.
#[derive(Default)]
pub(crate) struct SuggestionBudget(usize);

impl SuggestionBudget {
    /// Returns a suggestion for a misspelt name.
    pub(crate) fn suggest<'n>(
        &mut self,
        name: &str,
        known: impl IntoIterator<Item = &'n &'n str>,
    ) -> Option<String> {
        if !self.take_budget() {
            return None;
        }
        nearest(name, known.into_iter().copied().take(MAX_HINTS)).map(str::to_owned)
    }

    /// Returns true if another suggestion is within the budget, and counts it.
    pub(crate) fn take_budget(&mut self) -> bool {
        self.0 += 1;
        self.0 <= MAX_LOOKS
    }
}

/// Returns the diagnostic with its suggestion.
pub(crate) fn hinted(diagnostic: Diagnostic, near: Option<String>) -> Diagnostic {
    match near {
        Some(near) => diagnostic.hint(format!("did you mean `{near}`?")),
        None => diagnostic,
    }
}

/// Returns the diagnostic of a duplicate name.
pub(crate) fn twice(what: &str, name: &str, span: Span) -> Diagnostic {
    let message = format!("a second {what} with the name {}", quoted(name));
    Diagnostic::error("eml::duplicate-name", span, message)
}
