//! Breath in speech: inhalations in the pauses between phrases, deep before a long one, and the
//! slow exhalation during it.
//!
//! Winkworth, Davis, Adams and Ellis 1995 (doi:10.1044/jshr.3801.124): most breaths are at clause
//! boundaries, and their depth follows the length to come. Rochet-Capellan and Fuchs 2013: breath
//! groups last 3.5 s.

use super::speech_features::{BoundaryKind, SpeechFeatures};
use crate::superposition::SuperposedTrack;

/// Shortest pause with an inhalation, seconds. Designed; catch breaths take 0.2 to 0.3 s.
const MIN_PAUSE_SECS: f64 = 0.26;
/// Shortest and longest inhalation, seconds. Designed.
const INHALE_SECS: [f64; 2] = [0.22, 0.75];
/// Time from the end of speech to the inhalation, seconds. Designed.
const DELAY_SECS: f64 = 0.06;
/// Depth of an inhalation before speech of no length, and for each second of it, up to the deepest;
/// 1 is a breath at rest. Designed.
const DEPTH: [f64; 3] = [0.35, 0.22, 1.6];
/// Lungs at the end of a breath group: exhaled.
const EMPTY: f64 = -0.7;

/// Plans the filling of the lungs, −1 (exhaled) to 1.6 (a deep breath), where the figure speaks.
pub(super) fn track(heard: &SpeechFeatures) -> SuperposedTrack<1> {
    let pauses = heard.pauses.iter().filter(|pause| {
        pause.parts >= BoundaryKind::Phrases
            && !pause.is_filled
            && pause.end_secs - pause.start_secs >= MIN_PAUSE_SECS
    });
    let mut starts: Vec<(f64, f64)> = pauses
        .map(|pause| (pause.start_secs + DELAY_SECS, pause.end_secs))
        .chain(
            heard
                .turns
                .iter()
                .map(|turn| (turn[0] - INHALE_SECS[1], turn[0])),
        )
        .collect();
    raconteur_base::order::sort_by_number(&mut starts, |(from, _)| *from);
    starts.dedup_by(|later, earlier| later.1 - earlier.1 < MIN_PAUSE_SECS);
    let mut targets = Vec::new();
    for (i, &(from, speech)) in starts.iter().enumerate() {
        let secs = (speech - from).clamp(INHALE_SECS[0], INHALE_SECS[1]);
        let over = heard.turns.partition_point(|turn| turn[2] <= speech);
        let end = heard.turns.get(over).map_or(f64::INFINITY, |turn| turn[2]);
        let next = starts.get(i + 1).map_or(end, |next| next.0.min(end));
        let spoken = (next - speech).clamp(0.0, 20.0);
        let depth = (DEPTH[0] + DEPTH[1] * spoken).min(DEPTH[2]);
        targets.push((speech - secs, secs, [depth]));
        targets.push((speech, spoken.max(0.3), [EMPTY]));
    }
    targets.extend(heard.turns.iter().map(|turn| (turn[2] + 0.3, 1.2, [0.0])));
    SuperposedTrack::new(targets)
}
