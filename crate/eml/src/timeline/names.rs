//! Named times of a document: `timeId` and `tm`.

use crate::diagnostic::Sink;
use crate::suggest::quoted;
use crate::work::step;
use crate::{
    ClauseId, Diagnostic, Document, Durations, Mark, MarkEvent, Name, SortedMap, Span, VoiceTiming,
};
use std::cmp::Ordering;

/// Named time of a document: the clause that defines it and the offset from its start.
#[derive(Clone, Copy, Debug)]
pub(super) struct NamedTime {
    /// The clause that it belongs to.
    pub(super) clause: ClauseId,
    /// Seconds after the start of that clause.
    pub(super) offset_secs: f64,
    /// Span of the name.
    pub(super) span: Span,
}

/// Data collected in one pass over all clauses of a document: voice timings, named times and
/// groups.
pub(super) struct ClauseIndex {
    /// Timings of all speech.
    pub(super) voices: SortedMap<ClauseId, VoiceTiming>,
    /// All named times.
    pub(super) names: Names,
    /// The groups, outer ones first.
    pub(super) groups: Vec<ClauseId>,
    /// Clauses whose start names markers.
    pub(super) absolute: Vec<ClauseId>,
    /// True if there is asynchronous speech.
    pub(super) asynchronous: bool,
}

/// Named times of a document with fast lookup by name.
pub(super) struct Names {
    /// Named times in document order.
    moments: Vec<(Name, NamedTime)>,
    /// Markers by name; the first of several with one name.
    order: Vec<Key>,
}

/// First letters of a name as a number, which distinguish most names, and the index of its marker.
/// Sorting and searching use these only, which are much smaller than the markers.
type Key = (u64, u32);

/// Returns the first eight bytes, most significant first: ordered like the text.
fn prefix(name: &str) -> u64 {
    let mut bytes = [0; 8];
    let length = name.len().min(bytes.len());
    bytes[..length].copy_from_slice(&name.as_bytes()[..length]);
    u64::from_be_bytes(bytes)
}

impl Names {
    /// Collects the timings of every voice-text, every name (the first of several equal ones), and
    /// the groups. It is a single pass, because a long script does not fit in the cache.
    pub(super) fn collect(
        document: &Document,
        durations: &dyn Durations,
        sink: &mut Sink,
    ) -> ClauseIndex {
        let mut voices = Vec::new();
        let mut asynchronous = false;
        let mut groups = Vec::new();
        let mut absolute = Vec::new();
        let mut moments: Vec<(Name, NamedTime)> = Vec::new();
        for (id, clause) in document.iter() {
            if let Some(name) = &clause.time_id {
                let moment = NamedTime {
                    clause: id,
                    offset_secs: 0.0,
                    span: clause.tag_span,
                };
                moments.push((name.clone(), moment));
            }
            if clause.start.is_absolute() {
                absolute.push(id);
            }
            if clause.kind.group().is_some() {
                groups.push(id);
            }
            let Some(text) = clause.kind.spoken_text() else {
                continue;
            };
            asynchronous |=
                matches!(&clause.kind, crate::ClauseKind::VoiceSay(say) if !say.is_waited_for());
            let mut timing = durations.voice(id, &text);
            // Lengths that are no lengths count as 0.
            if !(timing.duration_secs >= 0.0 && timing.duration_secs.is_finite()) {
                timing.duration_secs = 0.0;
            }
            // Other clauses speak too, but only a voice-text has markers.
            text.each_mark(&mut |mark| {
                let moment = NamedTime {
                    clause: id,
                    offset_secs: offset(&mark, &timing, sink),
                    span: mark.span,
                };
                moments.push((mark.name, moment));
            });
            voices.push((id, timing));
        }
        let mut order: Vec<Key> = (0..)
            .zip(&moments)
            .map(|(place, (name, _))| (prefix(name), place))
            .collect();
        // Among equal names, the first in the document comes first.
        order.sort_unstable_by(|a, b| {
            step(1);
            match a.0.cmp(&b.0) {
                Ordering::Equal => by_name(&moments, *a, *b),
                different => different,
            }
        });
        order.dedup_by(|again, first| {
            let name = name_at(&moments, *again);
            let same = again.0 == first.0 && name == name_at(&moments, *first);
            if same {
                let [moment, first] = [again, first].map(|key| &moments[key.1 as usize].1);
                report_duplicate(name, moment, first, sink);
            }
            same
        });
        ClauseIndex {
            voices: SortedMap::from_sorted(voices),
            names: Self { moments, order },
            groups,
            absolute,
            asynchronous,
        }
    }

    /// Returns the marker of a name.
    pub(super) fn find(&self, name: &str) -> Option<&NamedTime> {
        let prefix = prefix(name);
        let found = self.order.binary_search_by(|key| {
            step(1);
            let names = || name_at(&self.moments, *key).cmp(name);
            key.0.cmp(&prefix).then_with(names)
        });
        let (_, place) = self.order[found.ok()?];
        Some(&self.moments[place as usize].1)
    }

    /// Returns the number of names.
    pub(super) fn len(&self) -> usize {
        self.order.len()
    }

    /// Returns all names in sorted order.
    pub(super) fn iter(&self) -> impl Iterator<Item = &str> {
        self.order.iter().map(|&key| name_at(&self.moments, key))
    }

    /// Returns the names with the value that `value` gives to their markers.
    pub(super) fn map(mut self, value: impl Fn(&NamedTime) -> Option<f64>) -> SortedMap<Name, f64> {
        let mut marks = Vec::with_capacity(self.order.len());
        for (_, place) in self.order {
            let (name, moment) = &mut self.moments[place as usize];
            if let Some(value) = value(moment) {
                marks.push((std::mem::take(name), value));
            }
        }
        SortedMap::from_sorted(marks)
    }
}

/// Compares two markers whose names have equal prefixes; separate from the sort, so its inner loop
/// stays small.
#[cold]
#[inline(never)]
fn by_name(moments: &[(Name, NamedTime)], a: Key, b: Key) -> Ordering {
    let names = name_at(moments, a).cmp(name_at(moments, b));
    names.then(a.1.cmp(&b.1))
}

/// Returns the name of a key.
fn name_at(moments: &[(Name, NamedTime)], key: Key) -> &str {
    &moments[key.1 as usize].0
}

fn report_duplicate(name: &str, moment: &NamedTime, first: &NamedTime, sink: &mut Sink) {
    let message = format!("{} names two times; the first one counts", quoted(name));
    sink.push(
        Diagnostic::error("eml::duplicate-name", moment.span, message)
            .related(first.span, "first named here"),
    );
}

/// Returns the offset of a marker, in seconds from the start of its utterance.
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
                    "the next word has no phone {}; its start is used",
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
