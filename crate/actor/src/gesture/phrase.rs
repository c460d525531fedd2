//! Conversion from a script to phrases: strokes sorted by time, cut to the spans of active
//! gestures, with overlapping strokes merged.

use raconteur_base::order::sort_by_number;
use raconteur_base::{DQuat, DVec3};

use super::pace::MoveDurations;
use super::{ArmScript, GesturePhase, HandKey, TimeSpan};

/// Tolerance within which two keys count as simultaneous, seconds.
const SAME_SECS: f64 = 1e-6;
/// Preparation time of a feature that joins a gesture during its hold, seconds. Designed.
const JOIN_SECS: f64 = 0.5;

/// Run of hand keys performed as one unit within an enabled interval, with the hold time after the
/// last key.
pub(super) struct Phrase {
    pub(super) phase: GesturePhase,
    /// Start time: the first key, or the phase.
    pub(super) start: f64,
    pub(super) keys: Vec<HandKey>,
    pub(super) hold_until: f64,
    /// The switch-off: no later than this the hand begins to return.
    pub(super) must_end: f64,
}

impl Phrase {
    /// Returns the first key that has a feature; `None` if no key has it.
    pub(super) fn first_key(&self, has: fn(&HandKey) -> bool) -> Option<&HandKey> {
        self.keys.iter().find(|k| has(k))
    }

    /// Returns the time of a feature's first key, if it has one.
    pub(super) fn first(&self, has: fn(&HandKey) -> bool) -> Option<f64> {
        self.first_key(has).map(|k| k.time_secs)
    }

    /// Returns true if the path to a feature's first key is part of the script, from the beginning
    /// of the phrase, and not the planner's preparation: in a phase other than a stroke, or if the
    /// key comes later than the stroke and defines its transition.
    pub(super) fn includes_approach(&self, feature: usize) -> bool {
        let Some(first) = self.keys.iter().find(|k| FEATURES[feature].0(k)) else {
            return false;
        };
        let course = [first.wrist_course, first.hand_course, first.shape_course][feature];
        let scripted = self.phase != GesturePhase::Stroke || course.profile.is_some();
        scripted && first.time_secs > self.start + SAME_SECS
    }

    /// Returns the time at which the first motion begins.
    fn begins(&self) -> f64 {
        match self.keys.first() {
            Some(key) if !(0..FEATURES.len()).any(|f| self.includes_approach(f)) => key.time_secs,
            Some(key) => key.time_secs.min(self.start),
            None => self.start,
        }
    }
}

pub(super) fn has_wrist(key: &HandKey) -> bool {
    key.wrist_in_world.is_some()
}

pub(super) fn has_hand(key: &HandKey) -> bool {
    key.hand_in_world.is_some()
}

pub(super) fn has_shape(key: &HandKey) -> bool {
    key.shape.is_some()
}

/// Indices in [`FEATURES`].
pub(super) const WRIST: usize = 0;
pub(super) const HAND: usize = 1;
pub(super) const SHAPE: usize = 2;

/// A feature of a key: a predicate for its presence, and a function that removes it.
type Feature = (fn(&HandKey) -> bool, fn(&mut HandKey));

/// Features that a key may set.
const FEATURES: [Feature; 3] = [
    (has_wrist, |k| k.wrist_in_world = None),
    (has_hand, |k| k.hand_in_world = None),
    (has_shape, |k| k.shape = None),
];

/// Returns the phrases of an arm script, sorted by time.
pub(super) fn phrases(script: &ArmScript) -> Vec<Phrase> {
    let always = [TimeSpan {
        start_secs: f64::NEG_INFINITY,
        end_secs: f64::INFINITY,
    }];
    let spans = if script.on.is_empty() {
        &always[..]
    } else {
        &script.on
    };
    let mut all: Vec<Phrase> = script
        .strokes
        .iter()
        .filter_map(|stroke| {
            let mut keys: Vec<HandKey> =
                stroke.keys.iter().filter(|k| usable(k)).copied().collect();
            sort_by_number(&mut keys, |k| k.time_secs);
            let first = match keys.first() {
                Some(key) => key.time_secs,
                None if stroke.phase == GesturePhase::Stroke => return None,
                None => stroke.start_secs,
            };
            if !first.is_finite() {
                return None;
            }
            let span = spans
                .iter()
                .find(|s| s.start_secs <= first && first <= s.end_secs)?;
            keys.retain(|k| k.time_secs <= span.end_secs);
            let last = keys.last().map_or(first, |k| k.time_secs);
            let end = finite_or(stroke.end_secs, last);
            Some(Phrase {
                phase: stroke.phase,
                start: finite_or(stroke.start_secs, first),
                keys,
                hold_until: end.max(last).min(span.end_secs),
                must_end: span.end_secs,
            })
        })
        .collect();
    sort_by_number(&mut all, Phrase::begins);
    let mut out: Vec<Phrase> = Vec::with_capacity(all.len());
    for phrase in all {
        if let Some(before) = out.last_mut() {
            before.turn_back_for(&phrase);
        }
        match out.last_mut() {
            Some(before) if before.overlaps(&phrase) => {
                if let Some(phrase) = before.yield_to(phrase) {
                    out.push(phrase);
                }
            }
            _ => out.push(phrase),
        }
    }
    out.retain(|p| !p.keys.is_empty() || p.phase != GesturePhase::Stroke);
    out
}

fn finite_or(value: f64, other: f64) -> f64 {
    if value.is_finite() { value } else { other }
}

fn usable(key: &HandKey) -> bool {
    key.time_secs.is_finite()
        && key.wrist_in_world.is_none_or(DVec3::is_finite)
        && key.hand_in_world.is_none_or(DQuat::is_finite)
}

impl Phrase {
    /// Returns true if a phrase that begins no earlier conflicts with this one: it begins before
    /// this one is over, or a stroke ends in a different place than the next begins at the same
    /// instant.
    fn overlaps(&self, next: &Self) -> bool {
        let gap = next.begins() - self.hold_until;
        let strokes = self.phase == GesturePhase::Stroke && next.phase == GesturePhase::Stroke;
        let last = self
            .keys
            .last()
            .filter(|k| k.time_secs > next.begins() - SAME_SECS);
        let elsewhere = last
            .zip(next.keys.first())
            .is_some_and(|(a, b)| a.wrist_in_world != b.wrist_in_world);
        gap < -SAME_SECS || (gap <= SAME_SECS && strokes && elsewhere)
    }

    /// Shortens a stroke that ends in a different place than the next begins at the same instant,
    /// as in a repeated stroke. It ends earlier by the time of the way back: the unhurried time, or
    /// its share of the time since the last key but one. Where that is too short for both
    /// movements, or the stroke has one key only, nothing changes.
    fn turn_back_for(&mut self, next: &Self) {
        let [.., before, last] = &mut self.keys[..] else {
            return;
        };
        let Some(first) = next.keys.first() else {
            return;
        };
        let at_once = (last.time_secs - next.begins()).abs() <= SAME_SECS
            && (first.time_secs - last.time_secs).abs() <= SAME_SECS;
        if !at_once || self.phase != GesturePhase::Stroke || next.phase != GesturePhase::Stroke {
            return;
        }
        let (there, back) = (before.needs_to(last), last.needs_to(first));
        let secs = last.time_secs - before.time_secs;
        if back.min_secs <= 0.0 || there.min_secs + back.min_secs > secs {
            return;
        }
        let share = back.min_secs / (there.min_secs + back.min_secs);
        last.time_secs -= back.easy_secs.min(share * secs);
    }

    /// Yields to a phrase that begins before this one is over: for each feature in both, the later
    /// phrase takes over from its first key on. Merges the other when the remainder continues in
    /// parallel, and returns it when it follows.
    fn yield_to(&mut self, mut next: Self) -> Option<Self> {
        let begins = next.begins();
        let goes_back = matches!(
            next.phase,
            GesturePhase::Retraction | GesturePhase::PartialRetraction
        );
        // Start time of the other stroke, and whether it removed keys.
        let mut joined: [Option<f64>; 3] = [None; 3];
        for ((has, forget), joined) in FEATURES.into_iter().zip(&mut joined) {
            let first = next.first(has);
            let from = if goes_back { Some(begins) } else { first };
            let Some(from) = from else { continue };
            *joined = Some(from);
            for key in &mut self.keys {
                if has(key) && key.time_secs >= from - SAME_SECS {
                    forget(key);
                    *joined = None;
                }
            }
        }
        self.keys.retain(|k| FEATURES.iter().any(|(has, _)| has(k)));
        let goes_on = self.keys.iter().any(|k| k.time_secs >= begins);
        if goes_back || (!goes_on && next.first(has_wrist).is_some()) {
            self.hold_until = self.hold_until.min(begins);
            return Some(next);
        }
        for (feature, from) in joined.into_iter().enumerate() {
            if let Some(from) = from {
                self.stay_until(feature, from - JOIN_SECS);
            }
        }
        self.keys.append(&mut next.keys);
        sort_by_number(&mut self.keys, |k| k.time_secs);
        self.keys.dedup_by(|later, earlier| {
            let one = later.time_secs - earlier.time_secs < SAME_SECS;
            if one {
                earlier.merge(later);
            }
            one
        });
        self.hold_until = self.hold_until.max(next.hold_until);
        None
    }

    /// Holds a feature at its last key until it must depart for the first key of a joining phrase.
    fn stay_until(&mut self, feature: usize, leaves_secs: f64) {
        let has = FEATURES[feature].0;
        let Some(last) = self.keys.iter().rev().find(|k| has(k)) else {
            return;
        };
        if leaves_secs <= last.time_secs {
            return;
        }
        let mut key = HandKey {
            time_secs: leaves_secs,
            ..HandKey::default()
        };
        match feature {
            WRIST => {
                key.wrist_in_world = last.wrist_in_world;
                key.stays_in_world = last.stays_in_world;
            }
            HAND => key.hand_in_world = last.hand_in_world,
            _ => key.shape = last.shape,
        }
        self.keys.push(key);
        sort_by_number(&mut self.keys, |k| k.time_secs);
    }
}

impl HandKey {
    /// Returns the time to another key, over all features that both set.
    fn needs_to(&self, to: &Self) -> MoveDurations {
        let wrist = self.wrist_in_world.zip(to.wrist_in_world);
        let hand = self.hand_in_world.zip(to.hand_in_world);
        let fingers = self.shape.as_ref().zip(to.shape.as_ref());
        let wrist = wrist.map_or_else(MoveDurations::default, |(a, b)| {
            MoveDurations::by_wrist(a, b)
        });
        let hand = hand.map_or_else(MoveDurations::default, |(a, b)| {
            MoveDurations::by_hand(a, b)
        });
        let fingers = fingers.map_or_else(MoveDurations::default, |(a, b)| {
            MoveDurations::by_fingers(a, b)
        });
        wrist.and(hand).and(fingers)
    }

    /// Takes over the features of another key at the same time.
    fn merge(&mut self, other: &Self) {
        if other.wrist_in_world.is_some() {
            (self.wrist_in_world, self.wrist_course) = (other.wrist_in_world, other.wrist_course);
            self.stays_in_world = other.stays_in_world;
        }
        if other.hand_in_world.is_some() {
            (self.hand_in_world, self.hand_course) = (other.hand_in_world, other.hand_course);
        }
        if other.shape.is_some() {
            (self.shape, self.shape_course) = (other.shape, other.shape_course);
        }
    }
}
