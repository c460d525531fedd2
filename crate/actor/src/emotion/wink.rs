//! Wink (AU 46; F&H figure 4.7): a short closure at the apex of its emotion.

use raconteur_base::curve::{lerp, smooth};
use raconteur_body::face::FaceControls;

/// Durations of closing, closed and opening, seconds. *Designed*: slower than a blink by enough to
/// be seen as intended.
const CLOSING_SECS: f64 = 0.12;
const CLOSED_SECS: f64 = 0.2;
const OPENING_SECS: f64 = 0.25;
/// Intensity of an emotion from which the eye closes fully. *Designed*: a weaker joke winks less.
const FULL_FROM: f64 = 0.4;

/// Returns the eye closure of an emotion of a given intensity and share of wink, 0 to 1.
pub(super) fn amount(share: f64, intensity: f64) -> f64 {
    (share * intensity / FULL_FROM).clamp(0.0, 1.0)
}

/// Returns the eye closure at a time from the apex of the emotion, 0 to 1; closed from the apex on.
pub(super) fn closure(since_apex_secs: f64) -> f64 {
    let shut = smooth(1.0 + since_apex_secs / CLOSING_SECS);
    shut - smooth((since_apex_secs - CLOSED_SECS) / OPENING_SECS)
}

/// Closes the lid of the winking eye from its present position.
pub(super) fn close(share: f64, controls: &mut FaceControls) {
    controls.upper_lid[0] = lerp(controls.upper_lid[0], 1.0, share);
}
