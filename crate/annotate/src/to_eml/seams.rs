//! Seams between phases: places of one hand that contradict each other at one time.

use std::collections::BTreeSet;

use raconteur_base::Side;
use raconteur_eml::Diagnostic;

use super::phrases::Planned;
use super::{hands, phase};
use crate::gestura::{Hands, MIN_DISTANCE, Phase, PhaseKind, Vocabulary};
use crate::gsl::{Position, Value};

/// Time between two phases that follow each other without a gap, seconds.
const SEAM_SECS: f64 = 0.02;

/// Reports phases that begin at a distance from the place at which the phase before ends or is held.
pub(super) fn check(all: &[Planned<'_>], problems: &mut Vec<Diagnostic>) {
    let mut reported = BTreeSet::new();
    for side in Side::BOTH {
        let mut last: Option<(f64, Position)> = None;
        for planned in all.iter().filter(|p| hands::includes(p.hands, side)) {
            for phase in &planned.phases {
                let places = places(phase, planned.hands, side);
                let start_secs = phase.interval.start_secs;
                let distance = last
                    .filter(|(secs, _)| (start_secs - secs).abs() < SEAM_SECS)
                    .zip(places.filter(|_| phase.kind != PhaseKind::Preparation))
                    .map(|((_, before), (first, _))| before.distance(&first));
                if let Some(distance) = distance.filter(|distance| *distance > MIN_DISTANCE)
                    && reported.insert((phase.span, start_secs.to_bits()))
                {
                    let message = format!(
                        "at {start_secs:.2} s the {} begins {distance:.0} units from where the \
                         phase before leaves the hand; the hand goes there early",
                        phase.kind.word()
                    );
                    let problem = Diagnostic::warning("gestura::two-places", phase.span, message);
                    problems.push(problem.hint("begin with a preparation, or at the same place"));
                }
                last = match phase.kind {
                    PhaseKind::Stroke | PhaseKind::PreStrokeHold | PhaseKind::PostStrokeHold => {
                        let place = places.map(|(_, end)| end);
                        let place = place.or(last.map(|(_, place)| place));
                        place.map(|place| (phase.interval.end_secs, place))
                    }
                    // Preparations lead to what follows, and retractions to the rest.
                    _ => None,
                };
            }
        }
    }
}

/// Returns the first and the last place of a hand in a phase.
fn places(phase: &Phase, hands: Hands, side: Side) -> Option<(Position, Position)> {
    let motion = phase::motion(&phase.form)?;
    let is_mirrored =
        hands == Hands::Both && side == Side::Left && matches!(motion, Value::Common(_));
    let items = &motion.for_hand(side)?.items;
    let place = |item: &crate::gsl::Item<Position>| {
        let Position([x, y, z]) = item.feature;
        Position([if is_mirrored { -x } else { x }, y, z])
    };
    Some((place(items.first()?), place(items.last()?)))
}
