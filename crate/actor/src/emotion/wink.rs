//! A wink (AU 46; F&H figure 4.7): for a moment, where its emotion is full.

use raconteur_base::curve::{lerp, smooth};
use raconteur_body::face::FaceControls;

/// Closing, closed and opening, seconds. *Designed*: slower than a blink by so much that it is
/// seen as meant.
const CLOSING_SECS: f64 = 0.12;
const CLOSED_SECS: f64 = 0.2;
const OPENING_SECS: f64 = 0.25;
/// From this intensity on the eye closes fully. *Designed*: a weaker joke winks less.
const FULL_FROM: f64 = 0.4;

/// How far an emotion of an intensity with so much of a wink closes the eye, 0 to 1.
pub(super) fn amount(share: f64, intensity: f64) -> f64 {
    (share * intensity / FULL_FROM).clamp(0.0, 1.0)
}

/// How far the eye is closed at a time from the apex of the emotion, 0 to 1: closed from the apex on.
pub(super) fn closure(since_apex_secs: f64) -> f64 {
    let shut = smooth(1.0 + since_apex_secs / CLOSING_SECS);
    shut - smooth((since_apex_secs - CLOSED_SECS) / OPENING_SECS)
}

/// Closes the lid of the eye that winks, from wherever it is.
pub(super) fn close(share: f64, controls: &mut FaceControls) {
    controls.upper_lid[0] = lerp(controls.upper_lid[0], 1.0, share);
}
