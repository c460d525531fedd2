//! Gestures of the head: nods on accents, shakes at negations, tilts in questions, and the posture
//! that it takes for each phrase.
//!
//! They are added to the raises with the pitch (F&H section 4.2.1). Hadar, Steiner, Grant and Rose
//! 1983 (doi:10.1016/0167-9457(83)90004-0) describe narrow movements at stressed syllables and wide
//! ones in pauses; McClave 2000 (doi:10.1016/S0378-2166(99)00079-X) shakes at negation and lateral
//! shifts in direct speech.

use raconteur_base::noise;

use super::Manner;
use super::speech_features::{BoundaryKind, SpeechFeatures};
use crate::discourse::{Discourse, RoleSpan};
use crate::idle::stream;
use crate::superposition::SuperposedTrack;

/// Depth of a nod at an accent, radians: least, and what chance adds. Designed.
const NOD_RAD: [f64; 2] = [0.04, 0.075];
/// Time down and up again, seconds. Designed; fast nods are 2.6 to 6.5 Hz.
const NOD_SECS: [f64; 2] = [0.2, 0.34];
/// Share of accents with a nod, and the time between two at least, seconds. Designed.
const NOD_SHARE: f64 = 0.6;
const NOD_APART_SECS: f64 = 0.5;
/// Amplitude of a shake, radians, and the time of half of it, seconds. Designed.
const SHAKE_RAD: f64 = 0.095;
const SHAKE_SECS: f64 = 0.26;
/// Time between two shakes at least, seconds. Designed.
const SHAKE_APART_SECS: f64 = 1.6;
/// Tilt in a question, radians. Designed.
const TILT_RAD: f64 = 0.1;
/// Posture of the head for a phrase, largest: pitch (down), yaw, roll, radians. Designed; standard
/// deviations of people's heads in lively telling are 8, 12 and 5°.
const POSTURE_RAD: [f64; 3] = [0.15, 0.24, 0.085];
/// Shortest time between two postures, seconds. Designed.
const POSTURE_APART_SECS: f64 = 1.15;
/// Time from the start of a turn to the first posture, seconds. Designed.
const SETTLED_SECS: f64 = 0.8;
/// Shortest and longest movement from posture to posture, seconds. Designed.
const POSTURE_SECS: [f64; 2] = [0.45, 0.85];
/// Head's part in the turn to the side of a character, radians. Designed.
const ROLE_RAD: f64 = 0.12;
/// Time in which the head returns at the end of a turn, seconds. Designed.
const RETURN_SECS: f64 = 1.1;

/// Planned gestures of the head: pitch (down), yaw (left) and roll (left) over time, radians.
#[derive(Clone, Debug, Default)]
pub(crate) struct HeadGestures {
    nods: SuperposedTrack<1>,
    shakes: SuperposedTrack<1>,
    tilts: SuperposedTrack<1>,
    postures: SuperposedTrack<3>,
}

impl HeadGestures {
    /// Plans the gestures of the head for the features of speech.
    pub(super) fn new(
        heard: &SpeechFeatures,
        discourse: &Discourse,
        manner: &Manner,
        seed: u64,
    ) -> Self {
        let size = |t: f64| manner.head * discourse.size_at(t);
        Self {
            nods: nods(heard, &size, seed),
            shakes: shakes(heard, &size),
            tilts: tilts(heard, &size, seed),
            postures: postures(heard, discourse, &size, seed),
        }
    }

    /// Returns pitch, yaw and roll at a time; `liveliness` scales them, 1 as planned.
    pub(crate) fn sample(&self, time_secs: f64, liveliness: f64) -> [f64; 3] {
        let [pitch, yaw, roll] = self.postures.sample(time_secs);
        [
            pitch + self.nods.sample(time_secs)[0],
            yaw + self.shakes.sample(time_secs)[0],
            roll + self.tilts.sample(time_secs)[0],
        ]
        .map(|angle| liveliness * angle)
    }
}

/// Returns the bucket of a time for random numbers, milliseconds: the same time has the same
/// numbers, whatever else is said.
fn bucket(time_secs: f64) -> i64 {
    (1e3 * time_secs).round() as i64
}

/// Plans the nods: each begins at the end of an accented syllable, after the raise at its highest
/// pitch.
fn nods(heard: &SpeechFeatures, size: &dyn Fn(f64) -> f64, seed: u64) -> SuperposedTrack<1> {
    let mut pulses = Vec::new();
    let mut last = f64::NEG_INFINITY;
    for stress in &heard.stresses {
        let r = |id: u64| noise::unit(seed, stream::NOD + id, bucket(stress.start_secs));
        let start = 0.5 * (stress.start_secs + stress.end_secs);
        if start - last < NOD_APART_SECS || r(0) > NOD_SHARE {
            continue;
        }
        last = start;
        let depth = size(start) * (NOD_RAD[0] + NOD_RAD[1] * r(1));
        pulses.push((start, NOD_SECS, [depth]));
    }
    SuperposedTrack::of_pulses(&pulses)
}

/// Plans the shakes: left and right twice, smaller each time.
fn shakes(heard: &SpeechFeatures, size: &dyn Fn(f64) -> f64) -> SuperposedTrack<1> {
    let mut targets = Vec::new();
    let mut last = f64::NEG_INFINITY;
    for &at in &heard.negations {
        if at - last < SHAKE_APART_SECS {
            continue;
        }
        last = at;
        let size = SHAKE_RAD * size(at);
        let start = at - 0.08;
        for (k, share) in [1.0, -1.0, 0.75, -0.5, 0.0].into_iter().enumerate() {
            let begins = start + 0.85 * SHAKE_SECS * k as f64;
            targets.push((begins, SHAKE_SECS, [size * share]));
        }
    }
    SuperposedTrack::new(targets)
}

/// Plans the tilts of questions.
fn tilts(heard: &SpeechFeatures, size: &dyn Fn(f64) -> f64, seed: u64) -> SuperposedTrack<1> {
    let mut targets = Vec::new();
    for question in &heard.questions {
        let [last, end] = question.last_word_secs;
        let start = question.start_secs.max(last - 1.2);
        let is_left = noise::unit(seed, stream::NOD + 2, bucket(question.start_secs)) < 0.5;
        let tilt = if is_left { TILT_RAD } else { -TILT_RAD };
        targets.push((start, (end - start).clamp(0.4, 0.9), [size(start) * tilt]));
        targets.push((end + 0.35, 0.8, [0.0]));
    }
    SuperposedTrack::new(targets)
}

/// Plans the postures: a new one at each phrase, and at an accent in a long one.
fn postures(
    heard: &SpeechFeatures,
    discourse: &Discourse,
    size: &dyn Fn(f64) -> f64,
    seed: u64,
) -> SuperposedTrack<3> {
    let phrases = heard
        .pauses
        .iter()
        .filter(|p| p.parts >= BoundaryKind::Phrases)
        .map(|p| p.end_secs);
    let starts = heard.turns.iter().map(|turn| turn[0] + SETTLED_SECS);
    let accents = heard.stresses.iter().map(|s| s.start_secs);
    let begins = heard
        .turns
        .first()
        .map_or(0.0, |turn| turn[0] + SETTLED_SECS);
    let mut times: Vec<f64> = phrases.chain(starts).chain(accents).collect();
    raconteur_base::order::sort_by_number(&mut times, |t| *t);
    let mut targets: Vec<(f64, f64, [f64; 3])> = Vec::new();
    let (mut last, mut yaw_side) = (f64::NEG_INFINITY, 1.0);
    for at in times {
        if at < begins || at - last < POSTURE_APART_SECS {
            continue;
        }
        last = at;
        let r = |id: u64| noise::signed(seed, stream::POSTURE + id, bucket(at));
        // Mostly to the other side.
        if r(3) < 0.4 {
            yaw_side = -yaw_side;
        }
        let [pitch, yaw, roll] = POSTURE_RAD;
        let size = size(at);
        let side = RoleSpan::side_at(&discourse.roles, at + 0.1);
        // Between characters, the head keeps to the side of the one who speaks.
        let yaw = match side {
            Some(side) => ROLE_RAD * side + 0.45 * yaw * r(0),
            None => yaw_side * yaw * (0.35 + 0.65 * r(0).abs()),
        };
        let secs = POSTURE_SECS[0] + (POSTURE_SECS[1] - POSTURE_SECS[0]) * r(4).abs();
        let to = [pitch * (0.75 * r(1) - 0.1), yaw, roll * r(2)];
        targets.push((at - 0.3, secs, to.map(|angle| size * angle)));
    }
    targets.extend(
        heard
            .turns
            .iter()
            .map(|turn| (turn[2] + 0.3, RETURN_SECS, [0.0; 3])),
    );
    SuperposedTrack::new(targets)
}
