//! Tests of a plan over an hour of generated speech and over the shipped stories.

mod rates;
mod safe;
pub(crate) mod speech;

use raconteur_base::ops;
use raconteur_body::face::{FaceControls, Muscle};

use super::{AT_LISTENER_RAD, NonVerbal};

/// Distance of the gaze from the listener, radians.
fn distance(plan: &NonVerbal, time_secs: f64) -> f64 {
    let [yaw, pitch] = plan.gaze(time_secs).eyes;
    ops::hypot(yaw, pitch)
}

fn is_at_listener(plan: &NonVerbal, time_secs: f64) -> bool {
    distance(plan, time_secs) <= AT_LISTENER_RAD
}

/// Contraction of a muscle.
fn muscle(plan: &NonVerbal, muscle: Muscle, time_secs: f64) -> f64 {
    let mut face = FaceControls::default();
    plan.face(time_secs, 1.0, &mut face);
    face.contraction[muscle.index()]
}
