//! Postures of spine and shoulder girdle that a script sets.

use crate::body_posture::{BodyPosture, PostureCommand};
use crate::superposition::SuperposedTrack;

/// Shares of pelvis, lumbar spine and chest in lean, tilt and turn.
const LEAN_SHARES: [f64; 3] = [0.25, 0.4, 0.35];
const TILT_SHARES: [f64; 3] = [0.0, 0.5, 0.5];
const TURN_SHARES: [f64; 3] = [0.3, 0.3, 0.4];

/// Returns the postures over time: lean, tilt, turn and both shoulders. Commands with other than
/// finite numbers are left out.
pub(super) fn track(commands: &[PostureCommand]) -> SuperposedTrack<5> {
    let targets = commands.iter().map(|command| {
        let [left, right] = command.shoulders_rad;
        let angles = [
            command.lean_rad,
            command.tilt_rad,
            command.turn_rad,
            left,
            right,
        ];
        (command.start_secs, command.duration_secs, angles)
    });
    SuperposedTrack::new(targets.collect())
}

/// Adds a posture of [`track`].
pub(super) fn add([lean, tilt, turn, left, right]: [f64; 5], posture: &mut BodyPosture) {
    let parts = [
        &mut posture.pelvis,
        &mut posture.lumbar,
        &mut posture.thoracic,
    ];
    for (i, part) in parts.into_iter().enumerate() {
        part.lean += LEAN_SHARES[i] * lean;
        part.roll += TILT_SHARES[i] * tilt;
        part.yaw += TURN_SHARES[i] * turn;
    }
    posture.shrug[0] += left;
    posture.shrug[1] += right;
}
