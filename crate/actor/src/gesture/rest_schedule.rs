//! Schedule of rest postures: which posture each arm takes between gestures, and when it changes.
//!
//! Each gap between gestures gets a posture, never the same twice running, so that all are used
//! about equally often. An arm that rests while the other one gestures takes a posture of one arm.
//! After the last gesture the postures change at regular times, without end.

use raconteur_base::order::sort_by_number;
use raconteur_base::{Side, noise};

use super::{ArmScript, IdleSettings, TimeSpan};
use crate::idle::stream;

/// Maximum gap in which hands sink half-way to the ready place between strokes and do not rest,
/// seconds. Designed.
pub(super) const SINK_SECS: f64 = 2.9;
/// Time for changing from one posture to another, seconds. Designed.
pub(super) const CHANGE_SECS: f64 = 1.4;
/// Lag of the other hand behind the dominant one, seconds. Designed.
const LAG_SECS: f64 = 0.14;
/// Time for a posture between two others, seconds. Designed.
const BETWEEN_SECS: f64 = 2.2;
/// Time that a posture is kept without gestures, seconds. Designed.
const KEEP_SECS: f64 = 11.0;
/// Longest rest of one posture between two gestures, seconds; a longer gap has several. Designed.
const MAX_KEEP_SECS: f64 = 8.0;
/// Gap between gestures below which the hands stay near the body's middle, seconds. Designed.
const SHORT_SECS: f64 = 3.2;
/// Shortest time for arms folded or behind the back, and the time before the next gesture at which
/// they come free, seconds. Designed.
const LONG_SECS: f64 = 6.5;
const FREE_SECS: f64 = 2.6;
/// Time before the first key of a stroke at which its preparation begins, at most, seconds.
const PREPARE_SECS: f64 = 0.7;

/// Rest posture of one arm.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RestSpot {
    /// Hanging at the side.
    Hanging,
    /// In front of the belly, the fingertips near those of the other hand.
    Belly,
    /// In front of the hips, the hands loosely one over the other.
    Clasped,
    /// In front of the chest, fingertips together.
    Fingertips,
    /// One hand holds the other at the wrist; the dominant hand holds.
    WristHeld,
    /// On the hip.
    Hip,
    /// At the pocket, the fingers hidden by the hand's back.
    Pocket,
    /// Behind the back.
    Behind,
    /// Arms folded.
    Folded,
}

/// Rest posture of both arms.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RestPosture {
    /// Both arms hanging.
    Hanging,
    /// Both hands in front of the belly.
    Belly,
    /// Hands loosely clasped.
    Clasped,
    /// Fingertips together.
    Fingertips,
    /// One hand holding the other's wrist.
    WristHeld,
    /// One hand on the hip, the other hanging.
    OneOnHip,
    /// One hand at the pocket, the other hanging.
    OneInPocket,
    /// One hand in front of the belly, the other hanging.
    OneAtBelly,
    /// Both hands behind the back.
    Behind,
    /// Arms folded.
    Folded,
}

impl RestPosture {
    /// All postures.
    pub const ALL: [Self; 10] = [
        Self::Hanging,
        Self::Belly,
        Self::Clasped,
        Self::Fingertips,
        Self::WristHeld,
        Self::OneOnHip,
        Self::OneInPocket,
        Self::OneAtBelly,
        Self::Behind,
        Self::Folded,
    ];

    /// Returns the name of the posture in reports.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Hanging => "hanging",
            Self::Belly => "belly",
            Self::Clasped => "clasped",
            Self::Fingertips => "fingertips",
            Self::WristHeld => "wrist-held",
            Self::OneOnHip => "one-on-hip",
            Self::OneInPocket => "one-in-pocket",
            Self::OneAtBelly => "one-at-belly",
            Self::Behind => "behind",
            Self::Folded => "folded",
        }
    }

    /// Returns the posture of the left and right arm; `lead` is the arm of a one-handed posture.
    #[must_use]
    pub fn spots(self, lead: Side) -> [RestSpot; 2] {
        use RestSpot as S;
        let one = |spot: S| match lead {
            Side::Left => [spot, S::Hanging],
            Side::Right => [S::Hanging, spot],
        };
        match self {
            Self::Hanging => [S::Hanging; 2],
            Self::Belly => [S::Belly; 2],
            Self::Clasped => [S::Clasped; 2],
            Self::Fingertips => [S::Fingertips; 2],
            Self::WristHeld => [S::WristHeld; 2],
            Self::OneOnHip => one(S::Hip),
            Self::OneInPocket => one(S::Pocket),
            Self::OneAtBelly => one(S::Belly),
            Self::Behind => [S::Behind; 2],
            Self::Folded => [S::Folded; 2],
        }
    }

    /// Returns true if a gesture can begin from the posture without delay.
    fn is_near(self) -> bool {
        matches!(
            self,
            Self::Belly | Self::Clasped | Self::Fingertips | Self::OneAtBelly | Self::WristHeld
        )
    }
}

impl RestSpot {
    /// All rest postures of one arm, in the order of their numbers.
    pub const ALL: [Self; 9] = [
        Self::Hanging,
        Self::Belly,
        Self::Clasped,
        Self::Fingertips,
        Self::WristHeld,
        Self::Hip,
        Self::Pocket,
        Self::Behind,
        Self::Folded,
    ];

    /// Returns the posture by which an arm comes from one posture to another, if not directly:
    /// from behind the back it hangs first.
    fn between(self, to: Self) -> Option<Self> {
        let is_behind = self == Self::Behind || to == Self::Behind;
        (is_behind && self != to && self != Self::Hanging && to != Self::Hanging)
            .then_some(Self::Hanging)
    }

    /// Returns true if a gesture cannot begin from there without a detour.
    fn is_far(self) -> bool {
        matches!(self, Self::Behind | Self::Folded)
    }

    /// Returns true if one arm can rest like this while the other one gestures.
    fn is_single(self) -> bool {
        matches!(self, Self::Hanging | Self::Belly | Self::Hip | Self::Pocket)
    }
}

/// Change of one arm's rest posture.
#[derive(Clone, Copy, Debug)]
pub(super) struct RestChange {
    pub(super) at_secs: f64,
    pub(super) secs: f64,
    pub(super) to: RestSpot,
}

/// Rest postures of both arms over the whole story.
#[derive(Clone, Debug)]
pub struct RestSchedule {
    /// Changes of the left and right arm, ascending.
    changes: [Vec<RestChange>; 2],
    /// Time from which postures change regularly, seconds.
    tail_secs: f64,
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

impl RestSchedule {
    /// Plans the rests between the gestures of both arms.
    #[must_use]
    pub fn new(scripts: &[ArmScript; 2], life: &IdleSettings) -> Self {
        let busy = scripts.each_ref().map(busy_spans);
        let last = busy.iter().filter_map(|spans| spans.last());
        let tail_secs = last.map(|span| span.1).fold(f64::NEG_INFINITY, f64::max);
        let mut schedule = Self {
            changes: Default::default(),
            tail_secs: if tail_secs.is_finite() {
                tail_secs
            } else {
                0.0
            },
            seed: life.seed,
            amount: life.amount,
            dominant: life.dominant,
        };
        if life.amount > 0.0 {
            schedule.fill(&gaps(&busy));
        }
        schedule
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

    /// Returns the posture of both arms in a bucket of the regular changes.
    fn regular(&self, bucket: i64) -> [RestSpot; 2] {
        let count = RestPosture::ALL.len() as i64;
        // Steps that share no factor with the number of postures reach all, and none twice running.
        let stride = [3, 7][usize::from(noise::unit(self.seed, stream::REST, 0) < 0.5)];
        let first = (noise::unit(self.seed, stream::REST, 1) * count as f64) as i64;
        let index = (first + bucket.rem_euclid(count) * stride).rem_euclid(count);
        let posture = RestPosture::ALL[usize::try_from(index).unwrap_or(0)];
        posture.spots(self.lead(bucket))
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
    fn fill(&mut self, gaps: &[Gap]) {
        let mut used = [0.0_f64; RestPosture::ALL.len()];
        let mut last: Option<RestPosture> = None;
        let mut spots = [RestSpot::Hanging; 2];
        for gap in gaps {
            let length = gap.end_secs - gap.start_secs;
            if gap.busy == [true, true] {
                continue;
            }
            let bucket = (1e3 * gap.start_secs).round() as i64;
            if gap.busy != [false, false] {
                let arm = usize::from(gap.busy[0]);
                if !spots[arm].is_single() {
                    let chance = noise::unit(self.seed, stream::REST + 2, bucket);
                    let to = [RestSpot::Hanging, RestSpot::Belly, RestSpot::Pocket];
                    spots[arm] = to[((chance * 3.0) as usize).min(2)];
                    self.change(arm, gap.start_secs, CHANGE_SECS, spots[arm]);
                }
                continue;
            }
            let parts = (length / MAX_KEEP_SECS).ceil().clamp(1.0, 1e4) as usize;
            let part_secs = length / parts as f64;
            for part in 0..parts {
                let at_secs = gap.start_secs + part_secs * part as f64;
                let posture = self.choose(&used, last, part_secs, bucket + part as i64);
                used[posture as usize] += part_secs;
                last = Some(posture);
                let to = posture.spots(self.lead(bucket + part as i64));
                for arm in 0..2 {
                    if to[arm] != spots[arm] {
                        self.change(arm, at_secs, CHANGE_SECS, to[arm]);
                    }
                }
                spots = to;
            }
            // From postures that hold the arms back, they come free before the next gesture.
            if spots.iter().any(|spot| spot.is_far()) {
                spots = [RestSpot::Hanging; 2];
                for (arm, to) in spots.into_iter().enumerate() {
                    self.change(arm, gap.end_secs - FREE_SECS, CHANGE_SECS, to);
                }
            }
        }
    }

    /// Chooses the posture used least so far, with some chance, that fits the time.
    fn choose(
        &self,
        used: &[f64; RestPosture::ALL.len()],
        last: Option<RestPosture>,
        secs: f64,
        bucket: i64,
    ) -> RestPosture {
        let mut best = (f64::INFINITY, RestPosture::Belly);
        for posture in RestPosture::ALL {
            let is_far = posture.spots(Side::Left).iter().any(|spot| spot.is_far());
            let fits = posture.is_near() || secs >= if is_far { LONG_SECS } else { SHORT_SECS };
            if Some(posture) == last || !fits {
                continue;
            }
            let id = stream::REST + 3 + posture as u64;
            let cost = used[posture as usize] + 6.0 * noise::unit(self.seed, id, bucket);
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
        let mut at_secs = at_secs + lag_secs;
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

/// Returns the intervals between all changes of the busy arms, from the start to the last gesture.
fn gaps(busy: &[Vec<(f64, f64)>; 2]) -> Vec<Gap> {
    let mut times: Vec<f64> = busy
        .iter()
        .flatten()
        .flat_map(|(from, to)| [*from, *to])
        .collect();
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
