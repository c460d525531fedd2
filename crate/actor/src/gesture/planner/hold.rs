//! Holds: what a hand does where it stays, and how it sinks between strokes.

use raconteur_base::curve::smooth;
use raconteur_base::{DQuat, DVec3, Length};

use super::{FLOW_SECS, FREE, HOLD_DRIFT_M, HOLD_SECS, Planner};
use crate::gesture::RestPostures;
use crate::gesture::phrase::Phrase;

/// Share of the way to the ready place that a hand sinks between two strokes. Designed.
const SINK_SHARE: f64 = 0.55;
/// Share of a fast stroke that the hand springs back, its largest distance, metres, the mean speeds
/// between which it sets in, m/s, and its duration, seconds. Designed: the follow-through of strong
/// effort (Chi, Costa, Zhao and Badler 2000, doi:10.1145/344779.352172).
const REBOUND_SHARE: f64 = 0.14;
const REBOUND_M: f64 = 0.03;
const REBOUND_M_S: [f64; 2] = [0.25, 0.8];
const REBOUND_SECS: f64 = 0.24;
/// Share by which the fingers of a held hand relax towards their relaxed shape. Designed.
const HOLD_SOFTENING: f64 = 0.16;
impl Planner<'_> {
    /// Moves about half-way towards the ready place.
    pub(super) fn sink(&mut self, place: DVec3, time: f64) {
        let wrist = place.lerp(self.rest.ready(), SINK_SHARE);
        let hand = self.out.hand.last().unwrap_or(DQuat::IDENTITY);
        let hand = hand.slerp(self.rig.relaxed_hand(wrist), 0.4);
        let there = self.push_wrist(time, Some(self.space.project_outside(wrist)), FREE);
        let there = there.max(self.push_hand(time, Some(hand), FREE));
        if let Some(shape) = self.out.fingers.last() {
            let eased = shape.lerp(&RestPostures::shape(), 0.5);
            self.out.fingers.push(there, Some(eased), None);
        }
    }

    /// Lets the hand spring back a little from the end of a fast stroke, before a hold until a time.
    pub(super) fn rebound(&mut self, until_secs: f64) {
        let track = &self.out.wrist;
        let Some(last) = track.nodes.len().checked_sub(1).filter(|i| *i > 0) else {
            return;
        };
        let (Some(from), Some(to)) = (track.nodes[last - 1].place, track.nodes[last].place) else {
            return;
        };
        let secs = track.times[last] - track.times[last - 1];
        let time_secs = track.times[last] + REBOUND_SECS;
        if secs <= 0.0 || until_secs < time_secs + REBOUND_SECS || !track.is_free(last - 1) {
            return;
        }
        let way = to - from;
        let [slow, fast] = REBOUND_M_S;
        let strength = smooth(((way.magnitude() / secs - slow) / (fast - slow)).clamp(0.0, 1.0));
        let back = (way * (REBOUND_SHARE * strength * self.amount)).clamp_length_max(REBOUND_M);
        if back.magnitude() > HOLD_DRIFT_M {
            let place = self.space.project_outside(to - back);
            self.push_wrist(time_secs, Some(place), FREE);
        }
    }

    /// Holds the present features until a later time, all features to the same. A held hand sinks
    /// slightly, and its fingers relax; `share` scales this.
    pub(super) fn settle(&mut self, until: f64, share: f64) {
        let out = &mut self.out;
        let Some(place) = out.wrist.last() else {
            return;
        };
        let until = until.max(out.wrist.last_secs()).max(out.hand.last_secs());
        let held_secs = until - out.wrist.last_secs();
        let share = share * self.amount * (held_secs / HOLD_SECS).min(1.0);
        if held_secs > 0.0 {
            let sunk = place - DVec3::Y * (HOLD_DRIFT_M * share);
            out.wrist.push(self.rig, until, Some(sunk), FREE);
        }
        if until > out.hand.last_secs() {
            let hand = out.hand.last();
            out.hand.push(until, hand, FREE);
        }
        if let Some(shape) = out.fingers.last()
            && until > out.fingers.last_secs()
        {
            // Fingers that have keys of their own to the end of a stroke begin to ease there.
            let from = (until - held_secs).max(out.fingers.last_secs());
            out.fingers.push(from, Some(shape), None);
            let eased = shape.lerp(&RestPostures::shape(), HOLD_SOFTENING * share);
            out.fingers.push(until, Some(eased), None);
        }
    }

    /// Performs a scripted hold.
    pub(super) fn hold(&mut self, phrase: &Phrase, next: Option<&Phrase>) {
        if phrase.start - self.planned_secs() <= FLOW_SECS {
            self.settle(self.held_until(phrase, next), 0.0);
        }
    }
}
