//! Schedule of rest postures: which posture each arm takes between gestures, and when it changes.
//!
//! Each gap between gestures gets a posture, never the same twice running, so that all are used
//! about equally often. An arm that rests while the other one gestures takes a posture of one arm.
//! After the last gesture the postures change at regular times, without end.

use raconteur_base::order::sort_by_number;
use raconteur_base::{Side, noise};

use super::rest_choice::RestMood;
use super::rest_posture::{RestPosture, RestSpot};
use super::{ArmScript, IdleSettings, TimeSpan};
use crate::idle::stream;

/// Maximum gap in which hands sink half-way to the ready place between strokes and do not rest,
/// seconds. Designed.
pub(super) const SINK_SECS: f64 = 2.9;
/// Time for changing from one posture to another, seconds. Designed.
pub(super) const CHANGE_SECS: f64 = 1.4;
/// Lag of the other hand behind the dominant one, seconds. Designed.
const LAG_SECS: f64 = 0.14;
/// Time that a place between adds to a change, share of its duration. Designed.
const PART_LONGER: f64 = 0.5;
/// Time for a posture between two others, seconds. Designed.
const BETWEEN_SECS: f64 = 2.2;
/// Time that a posture is kept without gestures, seconds. Designed.
const KEEP_SECS: f64 = 11.0;
/// Longest rest of one posture between two gestures, seconds; a longer gap has several. Designed.
const MAX_KEEP_SECS: f64 = 8.0;
/// Gap between gestures below which the hands stay near the body's middle, seconds. Designed.
const SHORT_SECS: f64 = 3.2;
/// Shortest time for hands that touch, seconds. Designed.
const TOUCHING_SECS: f64 = 4.5;
/// Shortest time for arms folded or behind the back, and the time before the next gesture at which
/// they come free, seconds. Designed.
const LONG_SECS: f64 = 6.5;
const FREE_SECS: f64 = 2.6;
/// Time from the start of a story to the first change of posture, seconds. Designed.
const SETTLED_SECS: f64 = 2.0;
/// Postures of an arm that rests while the other one gestures, by their frequency. Designed: mostly
/// in front of the body, where it moves along.
const SINGLE: [RestSpot; 5] = [
    RestSpot::Belly,
    RestSpot::Hanging,
    RestSpot::Belly,
    RestSpot::Hip,
    RestSpot::Belly,
];
/// Time before the first key of a stroke at which its preparation begins, at most, seconds.
const PREPARE_SECS: f64 = 0.7;

/// Change of one arm's rest posture.
#[derive(Clone, Copy, Debug)]
pub(super) struct RestChange {
    pub(super) at_secs: f64,
    pub(super) secs: f64,
    pub(super) to: RestSpot,
}

impl RestChange {
    /// Returns the duration of the change from a posture, with its detours, seconds.
    pub(super) fn length_secs(&self, before: RestSpot) -> f64 {
        let detours = if before == self.to {
            0
        } else {
            [before, self.to]
                .iter()
                .filter(|spot| spot.is_far())
                .count()
        };
        self.secs * (1.0 + PART_LONGER * detours as f64)
    }
}

/// Rest postures of both arms over the whole story.
#[derive(Clone, Debug)]
pub struct RestSchedule {
    /// Changes of the left and right arm, ascending.
    changes: [Vec<RestChange>; 2],
    /// Time from which postures change regularly, seconds.
    tail_secs: f64,
    /// Last posture of both arms before that time.
    last: Option<RestPosture>,
    seed: u64,
    amount: f64,
    dominant: Side,
}

/// Interval in which the arms in use do not change.
struct Gap {
    start_secs: f64,
    end_secs: f64,
    /// True for each arm that gestures.
    busy: [bool; 2],
}

/// Rests that are planned so far.
#[derive(Default)]
struct RestsSoFar {
    /// Time in each posture, seconds.
    used_secs: [f64; RestPosture::ALL.len()],
    /// The last posture of both arms.
    last: Option<RestPosture>,
    /// The posture of each arm.
    spots: [RestSpot; 2],
}

impl RestSchedule {
    /// Plans the rests between the gestures of both arms, without feeling.
    #[must_use]
    pub fn new(scripts: &[ArmScript; 2], life: &IdleSettings) -> Self {
        Self::in_mood(scripts, life, f64::NEG_INFINITY, &|_| RestMood::default())
    }

    /// Plans the rests between the gestures of both arms, and those until the end of the speech,
    /// seconds; `mood_at` gives the mood at a time.
    pub(crate) fn in_mood(
        scripts: &[ArmScript; 2],
        life: &IdleSettings,
        told_secs: f64,
        mood_at: &dyn Fn(f64) -> RestMood,
    ) -> Self {
        let busy = scripts.each_ref().map(busy_spans);
        let last = busy.iter().filter_map(|spans| spans.last());
        let tail_secs = last.map(|span| span.1).fold(told_secs, f64::max);
        let mut schedule = Self {
            changes: Default::default(),
            tail_secs: if tail_secs.is_finite() {
                tail_secs
            } else {
                0.0
            },
            last: None,
            seed: life.seed,
            amount: life.amount,
            dominant: life.dominant,
        };
        if life.amount > 0.0 {
            schedule.fill(&gaps(&busy, told_secs), mood_at);
        }
        schedule
    }

    /// Returns the planned changes of an arm, seconds.
    pub(super) fn planned_changes(&self, side: Side) -> Vec<(f64, f64)> {
        let mut before = RestSpot::default();
        let changes = self.changes[side.index()].iter();
        changes
            .map(|change| {
                let length_secs = change.length_secs(before);
                before = change.to;
                (change.at_secs, change.at_secs + length_secs)
            })
            .collect()
    }

    /// Returns the change of an arm's posture that is in force at a time, and the posture before
    /// it.
    pub(super) fn change_at(&self, side: Side, time_secs: f64) -> (RestChange, RestSpot) {
        let changes = &self.changes[side.index()];
        let planned = |i: usize| {
            let before = i
                .checked_sub(1)
                .map_or(RestSpot::Hanging, |i| changes[i].to);
            (changes[i], before)
        };
        let begun = changes.partition_point(|change| change.at_secs <= time_secs);
        let last = changes.last().map_or(RestSpot::Hanging, |change| change.to);
        let since = (time_secs - self.tail_secs) * self.amount;
        if since < KEEP_SECS {
            return begun.checked_sub(1).map_or(
                (
                    RestChange {
                        at_secs: f64::NEG_INFINITY,
                        secs: 1.0,
                        to: RestSpot::Hanging,
                    },
                    RestSpot::Hanging,
                ),
                planned,
            );
        }
        let bucket = (since / KEEP_SECS).floor();
        let to = self.regular(bucket as i64)[side.index()];
        let before = if bucket < 1.5 {
            last
        } else {
            self.regular(bucket as i64 - 1)[side.index()]
        };
        let lag_secs = if side == self.dominant { 0.0 } else { LAG_SECS };
        let at_secs = self.tail_secs + bucket * KEEP_SECS / self.amount + lag_secs;
        let change = |at_secs: f64, to: RestSpot| RestChange {
            at_secs,
            secs: CHANGE_SECS,
            to,
        };
        match before.between(to) {
            Some(between) if time_secs < at_secs + BETWEEN_SECS => {
                (change(at_secs, between), before)
            }
            Some(between) => (change(at_secs + BETWEEN_SECS, to), between),
            None => (change(at_secs, to), before),
        }
    }

    /// Returns the posture of both arms in a bucket of the regular changes. The first is not the last
    /// posture before them.
    fn regular(&self, bucket: i64) -> [RestSpot; 2] {
        let count = RestPosture::ALL.len() as i64;
        // Steps that share no factor with the number of postures reach all, and none twice running.
        let stride = [3, 7][usize::from(noise::unit(self.seed, stream::REST, 0) < 0.5)];
        let begins = (noise::unit(self.seed, stream::REST, 1) * count as f64) as i64;
        let numbered = |bucket: i64| {
            let index = (begins + bucket.rem_euclid(count) * stride).rem_euclid(count);
            RestPosture::ALL[usize::try_from(index).unwrap_or(0)]
        };
        let repeats = Some(numbered(1)) == self.last;
        numbered(bucket + i64::from(repeats)).spots(self.lead(bucket))
    }

    /// Returns the arm of a one-handed posture: mostly the other than the dominant one.
    fn lead(&self, bucket: i64) -> Side {
        if noise::unit(self.seed, stream::REST + 1, bucket) < 0.6 {
            self.dominant.opposite()
        } else {
            self.dominant
        }
    }

    /// Plans the postures of all gaps.
    fn fill(&mut self, gaps: &[Gap], mood_at: &dyn Fn(f64) -> RestMood) {
        let mut so_far = RestsSoFar::default();
        for gap in gaps {
            match gap.busy {
                [true, true] => {}
                [false, false] => self.rest_both(gap, mood_at, &mut so_far),
                [left, _] => self.rest_one(usize::from(left), gap, &mut so_far),
            }
        }
        self.last = so_far.last;
    }

    /// Lets one arm rest while the other one gestures.
    fn rest_one(&mut self, arm: usize, gap: &Gap, so_far: &mut RestsSoFar) {
        let is_long = gap.end_secs - gap.start_secs > SHORT_SECS;
        if so_far.spots[arm].is_single() && !is_long {
            return;
        }
        let chance = noise::unit(self.seed, stream::REST + 2, milliseconds(gap.start_secs));
        let to = SINGLE[((chance * SINGLE.len() as f64) as usize).min(SINGLE.len() - 1)];
        if to != so_far.spots[arm] {
            so_far.spots[arm] = to;
            self.change(arm, gap.start_secs, CHANGE_SECS, to);
        }
    }

    /// Lets both arms rest, in several postures if the gap is long.
    fn rest_both(&mut self, gap: &Gap, mood_at: &dyn Fn(f64) -> RestMood, so_far: &mut RestsSoFar) {
        let length = gap.end_secs - gap.start_secs;
        // A later end of the gap changes nothing before it.
        let parts = ((length - SHORT_SECS) / MAX_KEEP_SECS)
            .ceil()
            .clamp(1.0, 1e4) as usize;
        for part in 0..parts {
            let at_secs = gap.start_secs + MAX_KEEP_SECS * part as f64;
            let part_secs = if part + 1 < parts {
                MAX_KEEP_SECS
            } else {
                gap.end_secs - at_secs
            };
            let bucket = milliseconds(gap.start_secs) + part as i64;
            let posture = self.choose(so_far, &mood_at(at_secs), part_secs, bucket);
            so_far.used_secs[posture as usize] += part_secs;
            so_far.last = Some(posture);
            let to = posture.spots(self.lead(bucket));
            if to[0] != to[1] {
                // The other arm hangs.
                so_far.used_secs[RestPosture::Hanging as usize] += 0.5 * part_secs;
            }
            for (arm, to) in to.into_iter().enumerate() {
                if to != so_far.spots[arm] {
                    self.change(arm, at_secs, CHANGE_SECS, to);
                }
            }
            so_far.spots = to;
        }
        // From postures that hold the arms back, they come free before the next gesture.
        if so_far.spots.iter().any(|spot| spot.is_far()) {
            so_far.spots = [RestSpot::Hanging; 2];
            for arm in 0..2 {
                self.change(
                    arm,
                    gap.end_secs - FREE_SECS,
                    CHANGE_SECS,
                    RestSpot::Hanging,
                );
            }
        }
    }

    /// Chooses the posture used least so far, with some liking of the mood and some chance, that
    /// fits the time.
    fn choose(&self, so_far: &RestsSoFar, mood: &RestMood, secs: f64, bucket: i64) -> RestPosture {
        let mut best = (f64::INFINITY, RestPosture::Belly);
        for posture in RestPosture::ALL {
            let is_far = posture.spots(Side::Left).iter().any(|spot| spot.is_far());
            let least_secs = match (is_far, posture.touches()) {
                (true, _) => LONG_SECS,
                (false, true) => TOUCHING_SECS,
                (false, false) => SHORT_SECS,
            };
            let fits = posture.is_near() || secs >= least_secs;
            if Some(posture) == so_far.last || !fits {
                continue;
            }
            let id = stream::REST + 3 + posture as u64;
            let cost = so_far.used_secs[posture as usize] - mood.liking_secs(posture)
                + 6.0 * noise::unit(self.seed, id, bucket);
            if cost < best.0 {
                best = (cost, posture);
            }
        }
        best.1
    }

    /// Adds a change of one arm.
    fn change(&mut self, arm: usize, at_secs: f64, secs: f64, to: RestSpot) {
        let lag_secs = if arm == self.dominant.index() {
            0.0
        } else {
            LAG_SECS
        };
        let changes = &mut self.changes[arm];
        let before = changes.last().map_or(RestSpot::Hanging, |change| change.to);
        // A change begins where the one before it has ended.
        let ended_secs = changes.last().map_or(f64::NEG_INFINITY, |last| {
            let earlier = changes.len().checked_sub(2).map(|i| changes[i].to);
            last.at_secs + last.length_secs(earlier.unwrap_or_default())
        });
        let mut at_secs = (at_secs + lag_secs).max(ended_secs);
        if let Some(between) = before.between(to) {
            changes.push(RestChange {
                at_secs,
                secs,
                to: between,
            });
            at_secs += BETWEEN_SECS;
        }
        changes.push(RestChange { at_secs, secs, to });
    }
}

/// Returns a time in whole milliseconds, which number what is left to chance.
fn milliseconds(time_secs: f64) -> i64 {
    (1e3 * time_secs).round() as i64
}

/// Returns the intervals in which an arm gestures, sorted, from the start of the preparation to the
/// end of the stroke.
fn busy_spans(script: &ArmScript) -> Vec<(f64, f64)> {
    let mut spans: Vec<(f64, f64)> = script
        .strokes
        .iter()
        .filter(|stroke| {
            let is_in = |span: &TimeSpan| {
                span.start_secs <= stroke.start_secs && stroke.start_secs <= span.end_secs
            };
            script.on.is_empty() || script.on.iter().any(is_in)
        })
        .filter_map(|stroke| {
            let times = stroke.keys.iter().map(|key| key.time_secs);
            let all = times.chain([stroke.start_secs, stroke.end_secs]);
            let (from, to) = all
                .filter(|t| t.is_finite())
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(from, to), t| {
                    (from.min(t), to.max(t))
                });
            let moves = stroke.keys.iter().any(|key| key.wrist_in_world.is_some());
            (moves && from.is_finite()).then_some((from - PREPARE_SECS, to))
        })
        .collect();
    sort_by_number(&mut spans, |span| span.0);
    let mut joined: Vec<(f64, f64)> = Vec::with_capacity(spans.len());
    for (from, to) in spans {
        match joined.last_mut() {
            Some(last) if from - last.1 < SINK_SECS => last.1 = last.1.max(to),
            _ => joined.push((from, to)),
        }
    }
    joined
}

/// Returns the intervals between all changes of the busy arms, from the start to the last gesture or
/// the end of the speech.
fn gaps(busy: &[Vec<(f64, f64)>; 2], told_secs: f64) -> Vec<Gap> {
    let mut times: Vec<f64> = busy
        .iter()
        .flatten()
        .flat_map(|(from, to)| [*from, *to])
        .collect();
    let first_secs = times.iter().copied().fold(told_secs, f64::min);
    if told_secs.is_finite() && first_secs > SETTLED_SECS + SHORT_SECS {
        times.push(SETTLED_SECS);
    }
    let last_secs = times.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    if told_secs.is_finite() && told_secs > last_secs + SHORT_SECS {
        times.push(told_secs);
    }
    sort_by_number(&mut times, |t| *t);
    times.dedup();
    let is_busy = |arm: usize, t: f64| {
        let begun = busy[arm].partition_point(|span| span.0 <= t);
        begun.checked_sub(1).is_some_and(|i| t < busy[arm][i].1)
    };
    times
        .windows(2)
        .map(|ends| {
            let middle = 0.5 * (ends[0] + ends[1]);
            Gap {
                start_secs: ends[0],
                end_secs: ends[1],
                busy: [is_busy(0, middle), is_busy(1, middle)],
            }
        })
        .collect()
}
