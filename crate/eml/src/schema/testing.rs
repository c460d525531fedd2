//! Helpers shared by the elements' tests.

use crate::{ClauseKind, Markup, Parsed, TextSegment, parse};

/// Returns the diagnostic codes of a whole document, for tests.
pub(super) fn codes(text: &str) -> Vec<&'static str> {
    parse(text).diagnostics.iter().map(|d| d.code).collect()
}

/// Returns the diagnostic codes of a body with this content, for tests.
pub(super) fn clause_codes(clauses: &str) -> Vec<&'static str> {
    codes(&format!(
        "<eml><body><null time='1'/>{clauses}</body></eml>"
    ))
}

/// Returns the first clause of a body with this content, for tests; it must have no diagnostics.
pub(super) fn one(clause: &str) -> ClauseKind {
    first(&parse(&format!("<eml><body>{clause}</body></eml>")))
}

/// Returns the first clause as [`one`] does, with the extensions bound to `x`.
pub(super) fn extended(clause: &str) -> ClauseKind {
    first(&parse(&format!(
        "<eml xmlns:x='urn:raconteur:eml:1'><body>{clause}</body></eml>"
    )))
}

fn first(parsed: &Parsed) -> ClauseKind {
    assert!(parsed.diagnostics.is_empty(), "{:?}", parsed.diagnostics);
    parsed.document.clauses[0].kind.clone()
}

/// Returns the first container of a speech with this content, and its diagnostic codes, for tests;
/// the extensions are bound to `x`.
pub(super) fn markup(inner: &str) -> (Markup, Vec<&'static str>) {
    let parsed = parse(&format!(
        "<eml xmlns:x='urn:raconteur:eml:1'><body><voice-text time='0'>{inner}</voice-text>\
         </body></eml>"
    ));
    let codes = parsed.diagnostics.iter().map(|d| d.code).collect();
    let ClauseKind::VoiceText(voice) = &parsed.document.clauses[0].kind else {
        panic!("{codes:?}")
    };
    let markup = voice.pieces.iter().find_map(|piece| match piece {
        TextSegment::Start { markup, .. } => Some(markup.as_ref().clone()),
        _ => None,
    });
    (markup.unwrap_or_else(|| panic!("{codes:?}")), codes)
}
