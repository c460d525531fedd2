//! The named moments of a document: `timeId` and `tm`.

use crate::diagnostic::Sink;
use crate::suggest::quoted;
use crate::work::step;
use crate::{
    ClauseId, Diagnostic, Document, Durations, Mark, MarkEvent, Name, SortedMap, Span, VoiceTiming,
};
use std::cmp::Ordering;

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

/// What a walk over all clauses finds.
pub(super) struct Found {
    /// The times of everything that is spoken.
    pub(super) voices: SortedMap<ClauseId, VoiceTiming>,
    /// Every name.
    pub(super) names: Names,
    /// The groups, outer ones first.
    pub(super) groups: Vec<ClauseId>,
}

/// Every name of a document.
pub(super) struct Names {
    /// By name; of several moments with one name the first.
    moments: Vec<(Key, Moment)>,
}

/// A name and its first letters as a number, which tell most names apart.
struct Key {
    prefix: u64,
    name: Name,
}

impl Key {
    fn compare(&self, prefix: u64, name: &str) -> Ordering {
        step(1);
        let by_prefix = self.prefix.cmp(&prefix);
        by_prefix.then_with(|| self.name.as_str().cmp(name))
    }
}

/// The first eight bytes, the first one counting most: it orders as the text does.
fn prefix(name: &str) -> u64 {
    let mut bytes = [0; 8];
    let length = name.len().min(bytes.len());
    bytes[..length].copy_from_slice(&name.as_bytes()[..length]);
    u64::from_be_bytes(bytes)
}

impl Names {
    /// Asks for the times of every voice-text and collects every name, of several moments
    /// with one name the first, and the groups. One walk does it all, because a long
    /// script has to come from far memory each time.
    pub(super) fn collect(
        document: &Document,
        durations: &dyn Durations,
        sink: &mut Sink,
    ) -> Found {
        let mut voices = Vec::new();
        let mut groups = Vec::new();
        let mut moments: Vec<(Key, Moment)> = Vec::new();
        let mut define = |name: Name, moment: Moment| {
            let prefix = prefix(&name);
            moments.push((Key { prefix, name }, moment));
        };
        for (id, clause) in document.iter() {
            if let Some(name) = &clause.time_id {
                let moment = Moment {
                    clause: id,
                    offset_secs: 0.0,
                    span: clause.tag_span,
                };
                define(name.clone(), moment);
            }
            if clause.kind.group().is_some() {
                groups.push(id);
            }
            let Some(text) = clause.kind.spoken() else {
                continue;
            };
            let mut timing = durations.voice(&text);
            // Lengths that are no lengths count as 0.
            if !(timing.duration_secs >= 0.0 && timing.duration_secs.is_finite()) {
                timing.duration_secs = 0.0;
            }
            // Other clauses speak as well, but only a voice-text has markers.
            for mark in text.marks() {
                let moment = Moment {
                    clause: id,
                    offset_secs: offset(&mark, &timing, sink),
                    span: mark.span,
                };
                define(mark.name, moment);
            }
            voices.push((id, timing));
        }
        // Stable, so that of equal names the first in the document comes first.
        moments.sort_by(|(a, _), (b, _)| a.compare(b.prefix, &b.name));
        moments.dedup_by(|(key, moment), (first_key, first)| {
            let same = key.compare(first_key.prefix, &first_key.name) == Ordering::Equal;
            if same {
                report_duplicate(&key.name, moment, first, sink);
            }
            same
        });
        Found {
            voices: SortedMap::from_sorted(voices),
            names: Self { moments },
            groups,
        }
    }

    /// The moment of a name.
    pub(super) fn find(&self, name: &str) -> Option<&Moment> {
        let prefix = prefix(name);
        let found = self
            .moments
            .binary_search_by(|(key, _)| key.compare(prefix, name));
        found.ok().map(|at| &self.moments[at].1)
    }

    /// How many names there are.
    pub(super) fn len(&self) -> usize {
        self.moments.len()
    }

    /// All names in order.
    pub(super) fn iter(&self) -> impl Iterator<Item = &str> {
        self.moments.iter().map(|(key, _)| key.name.as_str())
    }

    /// The names with what `value` says of their moments.
    pub(super) fn map(self, value: impl Fn(&Moment) -> Option<f64>) -> SortedMap<Name, f64> {
        let moments = self.moments.into_iter();
        SortedMap::from_sorted(
            moments
                .filter_map(|(key, moment)| Some((key.name, value(&moment)?)))
                .collect(),
        )
    }
}

fn report_duplicate(name: &str, moment: &Moment, first: &Moment, sink: &mut Sink) {
    let message = format!("{} names two moments; the first one counts", quoted(name));
    sink.push(
        Diagnostic::error("eml::duplicate-name", moment.span, message)
            .related(first.span, "first named here"),
    );
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
                .find(|p| p.word == mark.word && p.symbol == **symbol);
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
