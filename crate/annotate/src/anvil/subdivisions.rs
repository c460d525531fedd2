//! Elements of subdivisions, which lie inside an element of their parent.

use raconteur_eml::{Diagnostic, quoted};

use super::{Annotation, Track, TrackElement, TrackKind};
use crate::gestura::{Cover, Interval};

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
        let parents = Cover::new(elements.filter_map(|e| interval(parent, e)));
        for element in &track.elements {
            let Some(inner) = interval(track, element) else {
                continue;
            };
            if !parents.contains(inner, TOLERANCE_SECS) {
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
