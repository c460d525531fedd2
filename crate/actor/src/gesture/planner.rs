//! Conversion from phrases to nodes of wrist, hand and fingers: preparation, holds, coarticulation,
//! retraction.

mod flow;
mod hold;

use raconteur_base::{DQuat, DVec3, Length, Side};

use super::fingers::FingerTrack;
use super::pace::{MAX_SPEED_M_S, MAX_TURN_SPEED_RAD_S, MoveDurations, SHAPING_SECS};
use super::path::reach_secs;
use super::phrase::{HAND, Phrase, SHAPE, WRIST, has_hand, has_shape, has_wrist, phrases};
use super::rest_schedule::SINK_SECS;
use super::tempo::Tempo;
use super::tracks::{HandTrack, WristTrack};
use super::{ArmScript, GesturePhase, HandKey, RestPostures, Transition};
use crate::ArmRig;
use crate::limb::BodySpace;

/// Hands flow directly into a stroke that begins this soon, seconds. Designed.
const FLOW_SECS: f64 = 1.3;
/// Longest gap that a hand spends at the end of a stroke and on its way to the next one, seconds; in a
/// longer one it sinks between them. Designed.
const STAY_SECS: f64 = 0.9;
/// Maximum hold after a stroke, seconds. Designed (holds of about 0.3 to 0.6 s are common).
const HOLD_SECS: f64 = 0.55;
/// Sinking of a held hand, metres: no one holds perfectly still.
const HOLD_DRIFT_M: f64 = 0.007;
/// Time for returning to rest, as a multiple of reaching the same distance: retractions
/// are slower than preparations.
const RETRACT_SLOWNESS: f64 = 1.25;
/// Shortest time in which a return to rest is worth while before the next stroke, seconds.
const MIN_RETURN_SECS: f64 = 0.35;
/// Longest time in which fingers form before a stroke, seconds. Designed.
const MAX_SHAPING_SECS: f64 = 0.9;
/// Maximum travel time to the next stroke, seconds: the hand departs later rather than travel
/// longer. Designed.
const MAX_TRAVEL_SECS: f64 = 0.85;

/// The course of everything that a script leaves to the planner.
const FREE: Transition = Transition {
    profile: None,
    space: None,
};

/// Output of the planner for one arm: wrist, hand and finger tracks, and the planned keys.
pub(super) struct PlannerOutput {
    pub(super) wrist: WristTrack,
    pub(super) hand: HandTrack,
    pub(super) fingers: FingerTrack,
    pub(super) keys: Vec<PlannedKey>,
}

/// Scripted hand key with its planned arrival, for reports.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlannedKey {
    /// Scripted arrival time, story time, seconds.
    pub time_secs: f64,
    /// Actual arrival time; later where the distance is too long for the time.
    pub arrives_secs: f64,
    /// Wrist position: the scripted place, limited to reach and outside the body, metres. `None`
    /// for keys that only turn the hand or move its fingers.
    pub wrist_in_world: Option<DVec3>,
    /// True if it begins a stroke.
    pub begins_stroke: bool,
}

/// Planner of the gesture motion of one arm; processes its phrases in order of time.
pub(super) struct Planner<'a> {
    rig: &'a ArmRig,
    space: &'a BodySpace,
    rest: &'a RestPostures,
    tempo: Tempo<'a>,
    side: Side,
    amount: f64,
    out: PlannerOutput,
    /// True while the hand is returning: it does not hold the reached position.
    returning: bool,
    /// Time at which gestures are switched off.
    must_end: f64,
}

impl<'a> Planner<'a> {
    pub(super) fn new(
        rig: &'a ArmRig,
        rest: &'a RestPostures,
        tempo: Tempo<'a>,
        amount: f64,
    ) -> Self {
        Self {
            rig,
            space: rig.space(),
            rest,
            tempo,
            side: rig.side(),
            amount,
            out: PlannerOutput {
                wrist: WristTrack::default(),
                hand: HandTrack::default(),
                fingers: FingerTrack::default(),
                keys: Vec::new(),
            },
            returning: false,
            must_end: f64::INFINITY,
        }
    }

    /// Plans a script.
    pub(super) fn plan(mut self, script: &ArmScript) -> PlannerOutput {
        let phrases = phrases(script);
        for (i, phrase) in phrases.iter().enumerate() {
            let next = phrases.get(i + 1);
            match phrase.phase {
                GesturePhase::Hold if phrase.keys.is_empty() => self.hold(phrase, next),
                GesturePhase::Retraction | GesturePhase::PartialRetraction
                    if self.out.wrist.last().is_some() =>
                {
                    self.return_to_rest(phrase, next);
                }
                _ => self.perform(phrase, next),
            }
            self.must_end = phrase.must_end;
        }
        self.finish();
        self.out
    }

    /// Performs a phrase after the planned ones, and before the next one.
    fn perform(&mut self, phrase: &Phrase, next: Option<&Phrase>) {
        let leads = phrase.includes_approach(WRIST) || phrase.includes_approach(HAND);
        let firsts = [phrase.first(has_wrist), phrase.first(has_hand)];
        if let Some(first) = firsts.into_iter().flatten().reduce(f64::min) {
            let begins = if leads { phrase.start } else { first };
            self.take_back_returns(begins);
            let flows = self.leave(begins, phrase);
            if !flows {
                self.set_out(phrase, leads);
            } else if leads {
                self.settle(phrase.start, 1.0);
            }
            self.push_wrists(phrase, flows);
            self.push_hands(phrase);
            self.returning = false;
        }
        self.push_shapes(phrase);
        if phrase.phase == GesturePhase::Stroke {
            self.rebound(self.held_until(phrase, next));
        }
        let sink = if phrase.phase == GesturePhase::Hold {
            0.0
        } else {
            1.0
        };
        self.settle(self.held_until(phrase, next), sink);
    }

    /// Returns the end of the hold in a phrase: its end, or the departure time for the next phrase,
    /// whose preparation takes place within the hold.
    fn held_until(&self, phrase: &Phrase, next: Option<&Phrase>) -> f64 {
        let sets_out = next.map_or(f64::INFINITY, |next| self.sets_out_secs(next));
        phrase.hold_until.min(sets_out)
    }

    /// Returns the latest departure time for beginning a phrase in time and unhurried. Infinite if
    /// the phrase defines its own departure, or nothing moves.
    fn sets_out_secs(&self, next: &Phrase) -> f64 {
        let mut latest = f64::INFINITY;
        let mut meet =
            |feature: usize, key: Option<&HandKey>, way: &dyn Fn(&HandKey) -> MoveDurations| {
                if let Some(key) = key
                    && !next.includes_approach(feature)
                {
                    let easy_secs = way(key).easy_secs / self.tempo.speed_at(key.time_secs);
                    latest = latest.min(key.time_secs - easy_secs);
                }
            };
        meet(WRIST, next.first_key(has_wrist), &|key| {
            let ends = self.out.wrist.last().zip(key.wrist_in_world);
            ends.map_or_else(MoveDurations::default, |(from, to)| {
                MoveDurations::by_wrist(from, self.reachable(to))
            })
        });
        meet(HAND, next.first_key(has_hand), &|key| {
            let ends = self.out.hand.last().zip(key.hand_in_world);
            ends.map_or_else(MoveDurations::default, |(from, to)| {
                MoveDurations::by_hand(from, to)
            })
        });
        meet(SHAPE, next.first_key(has_shape), &|key| {
            let ends = self.out.fingers.last().zip(key.shape);
            ends.map_or_else(MoveDurations::default, |(from, to)| {
                MoveDurations::by_fingers(&from, &to)
            })
        });
        latest
    }

    /// Removes a planned return to rest that cannot be completed before time `first`, seconds.
    fn take_back_returns(&mut self, first: f64) {
        let out = &mut self.out;
        while out.wrist.nodes.len() > 1
            && out.wrist.last().is_none()
            && out.wrist.last_secs() > first - MIN_RETURN_SECS
        {
            out.wrist.pop();
            out.hand.forget_after(out.wrist.last_secs());
            out.fingers.forget_after(out.wrist.last_secs());
        }
    }

    /// Returns the time up to which the motion is planned, seconds.
    fn planned_secs(&self) -> f64 {
        self.out.wrist.last_secs().max(self.out.hand.last_secs())
    }

    /// Leaves a hold towards a phrase that begins at `next`. Returns true if the phrase continues
    /// from there; otherwise the hand is at rest.
    fn leave(&mut self, next: f64, phrase: &Phrase) -> bool {
        let Some(place) = self.out.wrist.last() else {
            return false;
        };
        let held_until = self.planned_secs();
        let gap = next - held_until;
        if next > self.must_end || gap > SINK_SECS {
            self.retract();
            return false;
        }
        if gap <= STAY_SECS {
            // The hand holds until it must leave.
            let depart = (next - MAX_TRAVEL_SECS)
                .max(held_until + 0.35 * gap)
                .min(self.sets_out_secs(phrase));
            if depart > held_until + 0.05 {
                self.settle(depart, 1.0);
            }
            return true;
        }
        let hold = if self.returning {
            0.0
        } else {
            (0.25 * gap).min(0.4)
        };
        self.settle(held_until + hold, 1.0);
        self.sink(place, held_until + hold + 0.42 * gap);
        true
    }

    /// Sets out from rest, in time to be there or when the phrase begins.
    fn set_out(&mut self, phrase: &Phrase, leads: bool) {
        let first_hand = phrase.first(has_hand).unwrap_or(f64::INFINITY);
        let key = phrase.keys.iter().find(|k| has_wrist(k));
        let (first, to) = match key.and_then(|k| Some((k.time_secs, k.wrist_in_world?))) {
            Some((first, wrist)) => (first, self.reachable(wrist)),
            None => (first_hand, self.rest.ready()),
        };
        let from = self.rest.sample(first - 0.6);
        let way_secs = reach_secs(from.wrist.distance_to(to)) / self.tempo.speed_at(first);
        let turned = phrase.first_key(has_hand).and_then(|key| key.hand_in_world);
        let turn = turned.map_or_else(MoveDurations::default, |hand| {
            MoveDurations::by_hand(from.hand, hand)
        });
        let start = (first - way_secs).min(first_hand - turn.easy_secs.max(MIN_RETURN_SECS));
        let start = if leads { phrase.start } else { start };
        let start = start.max(self.planned_secs());
        self.out.wrist.push(self.rig, start, None, FREE);
        self.out.hand.push(start, None, FREE);
        if key.is_none() {
            self.push_wrist(first, Some(to), FREE);
        }
    }

    /// Returns the scripted place limited to reach and outside the body.
    fn reachable(&self, wrist: DVec3) -> DVec3 {
        self.rig.within_reach(self.space.project_outside(wrist))
    }

    fn push_wrists(&mut self, phrase: &Phrase, flows: bool) {
        let first_hand = phrase.first(has_hand);
        for key in &phrase.keys {
            let Some(wrist) = key.wrist_in_world else {
                continue;
            };
            // The path to the first key of a stroke is preparation and not part of its course.
            let first = Some(key.time_secs) == phrase.first(has_wrist);
            let prepared = first && !phrase.includes_approach(WRIST);
            let course = if prepared { FREE } else { key.wrist_course };
            let place = self.reachable(wrist);
            let arrives_secs = self.push_wrist(key.time_secs, Some(place), course);
            self.out.keys.push(PlannedKey {
                time_secs: key.time_secs,
                arrives_secs,
                wrist_in_world: Some(place),
                begins_stroke: prepared && phrase.phase == GesturePhase::Stroke,
            });
            // This hand has not been turned yet.
            if !flows && first_hand.is_none_or(|t| t > key.time_secs) {
                self.push_hand(arrives_secs, Some(self.rig.relaxed_hand(place)), FREE);
            }
        }
    }

    fn push_hands(&mut self, phrase: &Phrase) {
        for key in &phrase.keys {
            let Some(hand) = key.hand_in_world else {
                continue;
            };
            let first = Some(key.time_secs) == phrase.first(has_hand);
            let prepared = first && !phrase.includes_approach(HAND);
            let course = if prepared { FREE } else { key.hand_course };
            if first && !prepared && phrase.start > self.out.hand.last_secs() {
                let held = self.out.hand.last();
                self.push_hand(phrase.start, held, FREE);
            }
            let arrives = self.push_hand(key.time_secs, Some(hand), course);
            self.note(key.time_secs, arrives);
        }
    }

    fn push_shapes(&mut self, phrase: &Phrase) {
        for key in &phrase.keys {
            let Some(shape) = key.shape else { continue };
            let time = key.time_secs;
            let first = Some(time) == phrase.first(has_shape);
            let prepared = first && !phrase.includes_approach(SHAPE);
            if first {
                // Fingers form during the hand's motion, not during the preceding hold.
                let mut moves = self.out.wrist.times.iter().rev();
                let leaves = moves.find(|t| **t < time - 0.05).copied();
                let leaves = leaves
                    .unwrap_or(time)
                    .clamp(time - MAX_SHAPING_SECS, time - SHAPING_SECS);
                let leaves = if prepared { leaves } else { phrase.start };
                if leaves > self.out.fingers.last_secs() {
                    let held = self.out.fingers.last();
                    self.out.fingers.push(leaves, held, None);
                }
            }
            let profile = key.shape_course.profile.filter(|_| !prepared);
            let arrives = self.out.fingers.push(time, Some(shape), profile);
            self.note(time, arrives);
        }
    }

    /// Records a key that does not move the wrist, if it is late.
    fn note(&mut self, time_secs: f64, arrives_secs: f64) {
        if arrives_secs > time_secs {
            self.out.keys.push(PlannedKey {
                time_secs,
                arrives_secs,
                wrist_in_world: None,
                begins_stroke: false,
            });
        }
    }

    /// Adds a wrist position, no earlier than it can be reached. Returns its time.
    fn push_wrist(&mut self, time: f64, place: Option<DVec3>, course: Transition) -> f64 {
        let track = &mut self.out.wrist;
        let mut time = time;
        if let Some(before) = track.times.last().copied() {
            let at = |place: Option<DVec3>, t| place.unwrap_or_else(|| self.rest.sample(t).wrist);
            let way_m = at(track.last(), before).distance_to(at(place, time));
            time = time.max(before + way_m / MAX_SPEED_M_S);
        }
        track.push(self.rig, time, place, course);
        time
    }

    /// Adds a rotation of the hand, likewise.
    fn push_hand(&mut self, time: f64, hand: Option<DQuat>, course: Transition) -> f64 {
        let track = &mut self.out.hand;
        let mut time = time.max(track.last_secs());
        if let (Some(from), Some(to)) = (track.last(), hand) {
            let turn_rad = from.angle_between(to);
            time = time.max(track.last_secs() + turn_rad / MAX_TURN_SPEED_RAD_S);
        }
        track.push(time, hand, course);
        time
    }

    /// Performs a scripted return: after its keys to rest, or half-way there, by its end.
    fn return_to_rest(&mut self, phrase: &Phrase, next: Option<&Phrase>) {
        self.settle(phrase.start, 1.0);
        self.push_wrists(phrase, true);
        self.push_hands(phrase);
        self.push_shapes(phrase);
        let last = phrase.keys.last().map_or(phrase.start, |k| k.time_secs);
        let end = self.held_until(phrase, next).max(self.planned_secs());
        self.returning = true;
        if phrase.phase == GesturePhase::Retraction && end > last + 0.05 {
            self.arrive_at_rest(end);
        } else if phrase.keys.is_empty()
            && let Some(place) = self.out.wrist.last()
        {
            self.sink(place, end);
        }
        self.settle(end, 0.0);
    }

    /// Holds for a while, then returns to rest.
    fn retract(&mut self) {
        let from = self.planned_secs();
        let hold = if self.returning { 0.0 } else { HOLD_SECS };
        let start = (from + hold * self.tempo.hold_at(from)).min(self.must_end.max(from));
        self.settle(start, 1.0);
        let Some(place) = self.out.wrist.last() else {
            return;
        };
        let distance = place.distance_to(self.rest.sample(start + 1.0).wrist);
        self.arrive_at_rest(start + (reach_secs(distance) * RETRACT_SLOWNESS).min(1.15));
    }

    fn arrive_at_rest(&mut self, time: f64) {
        let there = self.push_wrist(time, None, FREE);
        self.out.hand.push(there, None, FREE);
        if self.out.fingers.last().is_some() {
            self.out.fingers.push(there, None, None);
        }
        self.returning = false;
    }

    /// Returns to rest after the last phrase, then shapes the path.
    fn finish(&mut self) {
        if self.out.wrist.last().is_some() {
            self.retract();
        } else if let Some(shape) = self.out.fingers.last() {
            // The fingers gesture without the wrist.
            let from = self.out.fingers.last_secs();
            let until = from + HOLD_SECS;
            self.out.fingers.push(until, Some(shape), None);
            self.out.fingers.push(until + 0.6, None, None);
        }
        self.pass_through();
        for i in 1..self.out.wrist.nodes.len() {
            if self.out.wrist.is_free(i - 1) {
                self.out.wrist.nodes[i - 1].arch = self.arch_between(i - 1, i);
            }
        }
        let (wrist, rig, rest) = (&self.out.wrist, self.rig, self.rest);
        self.out
            .hand
            .record_positions(|t| wrist.sample(rig, t, rest.sample(t).wrist).0);
    }
}
