//! The named moments of a document: `timeId` and `tm`.

use crate::diagnostic::Sink;
use crate::suggest::quoted;
use crate::{
    ClauseId, ClauseKind, Diagnostic, Document, Durations, Mark, MarkEvent, Span, VoiceTiming,
};
use std::collections::BTreeMap;

/// A named moment.
#[derive(Clone, Copy, Debug)]
pub(super) struct Moment {
    /// The clause that it belongs to.
    pub(super) clause: ClauseId,
    /// Seconds after the start of that clause.
    pub(super) offset_secs: f64,
    /// Where it is named.
    pub(super) span: Span,
}

/// Asks for the times of every voice-text. Lengths that are no lengths count as 0.
pub(super) fn voice_timings(
    document: &Document,
    durations: &dyn Durations,
) -> BTreeMap<ClauseId, VoiceTiming> {
    let voices = document.iter().filter_map(|(id, clause)| {
        let mut timing = durations.voice(clause.kind.spoken()?.as_ref());
        if !(timing.duration_secs >= 0.0 && timing.duration_secs.is_finite()) {
            timing.duration_secs = 0.0;
        }
        Some((id, timing))
    });
    // Not `collect`, which sorts: one more sort in the wasm file.
    let mut timings = BTreeMap::new();
    timings.extend(voices);
    timings
}

/// Collects every name. Of several moments with one name the first counts.
pub(super) fn collect(
    document: &Document,
    voices: &BTreeMap<ClauseId, VoiceTiming>,
    sink: &mut Sink,
) -> BTreeMap<String, Moment> {
    let mut names: BTreeMap<String, Moment> = BTreeMap::new();
    let mut define = |name: String, moment: Moment, sink: &mut Sink| {
        let Some(first) = names.get(&name) else {
            names.insert(name, moment);
            return;
        };
        let message = format!("{} names two moments; the first one counts", quoted(&name));
        sink.push(
            Diagnostic::error("eml::duplicate-name", moment.span, message)
                .related(first.span, "first named here"),
        );
    };
    for (id, clause) in document.iter() {
        if let Some(name) = &clause.time_id {
            let moment = Moment {
                clause: id,
                offset_secs: 0.0,
                span: clause.tag_span,
            };
            define(name.clone(), moment, sink);
        }
        let (ClauseKind::VoiceText(text), Some(timing)) = (&clause.kind, voices.get(&id)) else {
            continue;
        };
        for mark in text.marks() {
            let offset_secs = offset(&mark, timing, sink);
            define(
                mark.name,
                Moment {
                    clause: id,
                    offset_secs,
                    span: mark.span,
                },
                sink,
            );
        }
    }
    names
}

/// When a marker lies, in seconds from the start of its utterance.
fn offset(mark: &Mark, timing: &VoiceTiming, sink: &mut Sink) -> f64 {
    let Some(word) = timing.words.get(mark.word) else {
        return timing.duration_secs;
    };
    let secs = match &mark.event {
        MarkEvent::OnStart => word.start_secs,
        MarkEvent::OnEnd => word.end_secs,
        MarkEvent::OnPhone(symbol) => {
            let phone = timing
                .phones
                .iter()
                .find(|p| p.word == mark.word && p.symbol == *symbol);
            if phone.is_none() && !timing.estimated {
                let message = format!(
                    "the word that follows has no phone {}; its start is used",
                    quoted(symbol)
                );
                sink.push(Diagnostic::warning(
                    "eml::phone-not-in-word",
                    mark.span,
                    message,
                ));
            }
            phone.map_or(word.start_secs, |p| p.start_secs)
        }
    };
    if secs.is_finite() { secs } else { 0.0 }
}
