//! Pauses between utterances in the voice of a bundle.

use raconteur_eml::{ClauseId, ClauseKind, Document, VoiceTiming};

use crate::script::rounded;

/// Starts utterances earlier by the silence at their beginning and at the end of the one before, so
/// that words are as far apart as in the annotation. `voice` gives the times of an utterance; `None`
/// if it is not baked.
pub fn fit_pauses(document: &mut Document, voice: impl Fn(ClauseId) -> Option<VoiceTiming>) {
    let mut trailing_secs = 0.0;
    for index in 0..document.clauses.len() {
        let clause = &mut document.clauses[index];
        if !matches!(clause.kind, ClauseKind::VoiceText(_)) {
            continue;
        }
        let timing = voice(ClauseId(u32::try_from(index).unwrap_or(u32::MAX)));
        let spoken = timing.as_ref().and_then(|timing| {
            let (first, last) = (timing.words.first()?, timing.words.last()?);
            Some((first.start_secs, timing.duration_secs - last.end_secs))
        });
        let (leading_secs, end_secs) = spoken.unwrap_or_default();
        let is_relative = !clause.start.names.is_empty();
        let early_secs = leading_secs + if is_relative { trailing_secs } else { 0.0 };
        let start_secs = rounded(clause.start.offset_secs - early_secs);
        // Silences may overlap; only the script has a beginning.
        clause.start.offset_secs = if is_relative {
            start_secs
        } else {
            start_secs.max(0.0)
        };
        trailing_secs = end_secs;
    }
}
