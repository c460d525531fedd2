//! Elements of subdivisions, which lie inside an element of their parent.

use raconteur_eml::{Diagnostic, quoted};

use super::{Annotation, Track, TrackElement, TrackKind};
use crate::gestura::Interval;

/// Tolerance of times that should coincide, seconds: files round to milliseconds.
const TOLERANCE_SECS: f64 = 0.001;

/// Returns a report of each element of a subdivision that lies in no element of its parent. The
/// function tells the times of an element of a track.
pub(super) fn check(
    annotation: &Annotation,
    interval: impl Fn(&Track, &TrackElement) -> Option<Interval>,
) -> Vec<Diagnostic> {
    let mut problems = Vec::new();
    for track in &annotation.tracks {
        let TrackKind::Subdivision(name) = &track.kind else {
            continue;
        };
        let Some(parent) = annotation.track(name) else {
            continue;
        };
        let elements = parent.elements.iter();
        let mut reach: Vec<Interval> = elements.filter_map(|e| interval(parent, e)).collect();
        reach.sort_by(|a, b| a.start_secs.total_cmp(&b.start_secs));
        // The latest end of all that begin so early tells whether one of them contains a later time.
        let mut end_secs = f64::NEG_INFINITY;
        for interval in &mut reach {
            end_secs = end_secs.max(interval.end_secs);
            interval.end_secs = end_secs;
        }
        for element in &track.elements {
            let Some(inner) = interval(track, element) else {
                continue;
            };
            let early =
                reach.partition_point(|i| i.start_secs <= inner.start_secs + TOLERANCE_SECS);
            let outer = early.checked_sub(1).map(|last| reach[last]);
            if !outer.is_some_and(|outer| outer.contains(inner, TOLERANCE_SECS)) {
                let message = format!("the element lies in no element of {}", quoted(name));
                problems.push(Diagnostic::warning(
                    "gestura::outside-parent",
                    element.span,
                    message,
                ));
            }
        }
    }
    problems
}
