//! Conversion of `posture` clauses to commands of the actor.

use raconteur_actor::PostureCommand;
use raconteur_eml::{ClauseKind, Document, Timeline};

/// Returns the postures of spine and shoulders that a script sets, by time.
pub(crate) fn postures(document: &Document, timeline: &Timeline) -> Vec<PostureCommand> {
    let clauses = timeline.clauses.iter();
    let postures = clauses.filter_map(|timed| match &document.clause(timed.clause).kind {
        ClauseKind::Posture(posture) => Some(PostureCommand {
            start_secs: timed.start_secs,
            duration_secs: posture.duration_secs,
            lean_rad: posture.lean_deg.to_radians(),
            tilt_rad: posture.tilt_deg.to_radians(),
            turn_rad: posture.turn_deg.to_radians(),
            shoulders_rad: [posture.left_shoulder_deg, posture.right_shoulder_deg]
                .map(f64::to_radians),
        }),
        _ => None,
    });
    postures.collect()
}
