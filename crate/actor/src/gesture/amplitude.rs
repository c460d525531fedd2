//! Size of strokes by the tension of the story (Rühlemann 2024, doi:10.3389/fpsyg.2024.1477263).

use raconteur_base::Side;
use raconteur_base::curve::lerp;

use super::second_hand::{ByStart, touches};
use super::{ArmScript, GesturePhase, GestureStroke};
use crate::discourse::Discourse;

/// Size of a stroke at tension 0, 0.5 and 1. Designed.
const SIZE_BY_TENSION: [f64; 3] = [0.85, 1.0, 1.35];

/// Scales the movement of each stroke about its first place. Strokes in which hands meet, and those
/// at places in the world, keep their places. `scale` is the stature over 1.7 m.
pub(crate) fn scale_by_tension(scripts: &mut [ArmScript; 2], discourse: &Discourse, scale: f64) {
    let fixed = Side::BOTH.map(|side| {
        let others = ByStart::new(&scripts[side.opposite().index()].strokes);
        let is_fixed = |stroke: &GestureStroke| {
            stroke.phase != GesturePhase::Stroke
                || stroke.is_transcribed
                || stroke.pace.is_some()
                || stroke.keys.iter().any(|key| key.stays_in_world)
                || others
                    .simultaneous(stroke)
                    .any(|other| touches(stroke, other, side, scale))
        };
        let strokes = scripts[side.index()].strokes.iter();
        strokes.map(is_fixed).collect::<Vec<bool>>()
    });
    for (script, fixed) in scripts.iter_mut().zip(fixed) {
        let free = script
            .strokes
            .iter_mut()
            .zip(fixed)
            .filter(|(_, fixed)| !fixed);
        for (stroke, _) in free {
            resize(stroke, size_at(discourse.tension_at(stroke.start_secs)));
        }
    }
}

/// Returns the size of a stroke at a tension.
fn size_at(tension: f64) -> f64 {
    let [least, usual, most] = SIZE_BY_TENSION;
    if tension < 0.5 {
        lerp(least, usual, 2.0 * tension)
    } else {
        lerp(usual, most, 2.0 * tension - 1.0)
    }
}

/// Scales the movement of a stroke about its first place.
fn resize(stroke: &mut GestureStroke, size: f64) {
    let Some(first) = stroke.keys.iter().find_map(|key| key.wrist_in_world) else {
        return;
    };
    for wrist in stroke
        .keys
        .iter_mut()
        .filter_map(|key| key.wrist_in_world.as_mut())
    {
        *wrist = first + (*wrist - first) * size;
    }
}
