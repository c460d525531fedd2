//! Measures of each hand: speed and acceleration of the wrist, movements, holds, use of the hands.

use std::ops::Range;

use raconteur_base::{Length, Side};

use super::recording::{CUTOFF_HZ, Recording};
use super::signal::{Distribution, second_rates};
use super::{Measure, RATE_HZ, people};

/// Cut-off of the low pass for movements, Hz, as for the values of people.
const MOVEMENT_CUTOFF_HZ: f64 = 4.0;
/// Peak speed that a movement exceeds, metres per second.
const MOVEMENT_PEAK_M_S: f64 = 0.4;
/// Share of the peak speed below which the ends of a movement do not count: the low pass would
/// lengthen movements that begin or end at a standstill. The usual criterion for their onset.
const ONSET_SHARE: f64 = 0.05;
/// Maximum speed in a hold, metres per second.
const HOLD_SPEED_M_S: f64 = 0.1;
/// Time that a hold exceeds, seconds.
const HOLD_SECS: f64 = 0.15;
/// Speed above which a hand is in use, metres per second.
const USE_SPEED_M_S: f64 = 0.2;

/// A movement of a hand: from one minimum of its speed to the next.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Movement {
    secs: f64,
    /// Peak speed relative to the mean speed.
    peak_to_mean: f64,
    /// Time of the peak as a share of the duration.
    peak_place: f64,
}

/// Returns the measures of both hands, the right one first, and of their use.
pub(super) fn measures(recording: &Recording) -> Vec<Measure> {
    let speeds = recording
        .wrists
        .each_ref()
        .map(|places| recording.speeds_m_s(places, CUTOFF_HZ));
    let mut all = Vec::new();
    for side in [Side::Right, Side::Left] {
        all.extend(wrist_measures(recording, side, &speeds[side.index()]));
        all.extend(movement_measures(recording, side));
        all.extend(hold_measures(recording, side, &speeds[side.index()]));
    }
    all.extend(use_measures(&speeds));
    all
}

fn name(side: Side) -> &'static str {
    match side {
        Side::Left => "left",
        Side::Right => "right",
    }
}

fn wrist_measures(recording: &Recording, side: Side, speeds: &[f64]) -> Vec<Measure> {
    let speed = Distribution::new(speeds.iter().copied());
    let values = [
        ("mean", speed.mean()),
        ("median", speed.median()),
        ("p90", speed.quantile(0.9)),
        ("p95", speed.quantile(0.95)),
        ("p99", speed.quantile(0.99)),
        ("max", speed.max()),
    ];
    let hand = name(side);
    let lively = people::WRIST_SPEED_M_S[side.index()];
    let speeds = values.into_iter().zip(lively).map(|((what, v), lively)| {
        Measure::new(format!("{hand}-wrist-speed-{what}"), "m/s", v).with_amount(lively)
    });
    let smoothed = recording.smoothed(&recording.wrists[side.index()]);
    let second = second_rates(&smoothed, &recording.runs);
    let acceleration = Distribution::new(second.into_iter().map(Length::magnitude));
    let shares = [("median", 0.5), ("p90", 0.9), ("p95", 0.95), ("p99", 0.99)];
    let lively = people::WRIST_ACCELERATION_M_S2[side.index()];
    let named = shares.into_iter().zip(lively);
    let accelerations = named.map(|((what, share), lively)| {
        let value = acceleration.quantile(share);
        let name = format!("{hand}-wrist-acceleration-{what}");
        Measure::new(name, "m/s²", value).with_amount(lively)
    });
    speeds.chain(accelerations).collect()
}

fn movement_measures(recording: &Recording, side: Side) -> [Measure; 6] {
    let (i, hand) = (side.index(), name(side));
    let speeds = recording.speeds_m_s(&recording.wrists[i], MOVEMENT_CUTOFF_HZ);
    let movements: Vec<Movement> = recording
        .runs
        .iter()
        .flat_map(|run| movements(&speeds[run.clone()]))
        .collect();
    let secs = Distribution::new(movements.iter().map(|m| m.secs));
    let shape = Distribution::new(movements.iter().map(|m| m.peak_to_mean));
    let place = Distribution::new(movements.iter().map(|m| m.peak_place));
    let per_minute = recording.per_minute(secs.count());
    let new = |what: &str, unit, value| Measure::new(format!("{hand}-{what}"), unit, value);
    let [p25, median, p75] = people::MOVEMENT_SECS[i];
    [
        new("movements-per-minute", "/min", per_minute)
            .with_amount(people::MOVEMENTS_PER_MINUTE[i]),
        new("movement-duration-p25", "s", secs.quantile(0.25)).with_typical(p25),
        new("movement-duration-median", "s", secs.median()).with_typical(median),
        new("movement-duration-p75", "s", secs.quantile(0.75)).with_typical(p75),
        new("movement-peak-to-mean", "", shape.median()).with_typical(people::PEAK_TO_MEAN_SPEED),
        new("movement-peak-place", "", place.median()).with_typical(people::PEAK_PLACE),
    ]
}

fn hold_measures(recording: &Recording, side: Side, speeds: &[f64]) -> [Measure; 2] {
    let (i, hand) = (side.index(), name(side));
    let runs = recording.runs.iter();
    let holds = Distribution::new(runs.flat_map(|run| holds_secs(&speeds[run.clone()])));
    let per_minute = recording.per_minute(holds.count());
    [
        Measure::new(format!("{hand}-holds-per-minute"), "/min", per_minute)
            .with_typical(people::HOLDS_PER_MINUTE[i]),
        Measure::new(format!("{hand}-hold-duration-median"), "s", holds.median())
            .with_typical(people::HOLD_SECS[i]),
    ]
}

/// Returns the share of time in which a hand is in use, and the shares of that time in which both
/// or only one is.
fn use_measures(speeds: &[Vec<f64>; 2]) -> [Measure; 4] {
    let [left, right] = speeds;
    let (mut both, mut only, mut none) = (0.0, [0.0; 2], 0.0);
    for (left, right) in left.iter().zip(right) {
        match [*left > USE_SPEED_M_S, *right > USE_SPEED_M_S] {
            [true, true] => both += 1.0,
            [true, false] => only[0] += 1.0,
            [false, true] => only[1] += 1.0,
            [false, false] => none += 1.0,
        }
    }
    let used: f64 = both + only[0] + only[1];
    let percent = |part: f64, whole: f64| (whole > 0.0).then(|| 1e2 * part / whole);
    let [left_lively, right_lively] = people::ONE_HAND_PERCENT;
    [
        Measure::new("hands-in-use", "%", percent(used, used + none)),
        Measure::new("hands-both", "%", percent(both, used))
            .with_typical(people::BOTH_HANDS_PERCENT),
        Measure::new("hands-right-only", "%", percent(only[1], used)).with_typical(right_lively),
        Measure::new("hands-left-only", "%", percent(only[0], used)).with_typical(left_lively),
    ]
}

/// Returns the movements in a run of speeds, metres per second. Of a standstill, the last sample
/// begins a movement, and the first one ends it. At an end of the run a hand that moves is in the
/// middle of a movement, which does not count.
fn movements(speeds: &[f64]) -> Vec<Movement> {
    let Some(last) = speeds.len().checked_sub(1) else {
        return Vec::new();
    };
    let mut found = Vec::new();
    let mut from = None;
    for (i, speed) in speeds.iter().enumerate() {
        let beyond = if *speed < HOLD_SPEED_M_S {
            *speed
        } else {
            f64::NEG_INFINITY
        };
        let before = if i > 0 { speeds[i - 1] } else { beyond };
        let after = if i < last { speeds[i + 1] } else { beyond };
        if before > *speed
            && *speed <= after
            && let Some(from) = from.take()
        {
            found.extend(movement(&speeds[from..=i]));
        }
        if before >= *speed && *speed < after {
            from = Some(i);
        }
    }
    found
}

/// Measures a movement between two minima, without its slow ends; `None` if it is too slow to be
/// one.
fn movement(speeds: &[f64]) -> Option<Movement> {
    let peak = speeds.iter().copied().fold(0.0, f64::max);
    let is_under_way = |speed: &f64| *speed >= ONSET_SHARE * peak;
    let from = speeds.iter().position(is_under_way)?;
    let to = speeds.iter().rposition(is_under_way)?;
    // The movement begins and ends between this sample and its neighbour.
    let speeds = &speeds[from.saturating_sub(1)..speeds.len().min(to + 2)];
    let steps = speeds.len().checked_sub(1).filter(|n| *n > 0)? as f64;
    let at = speeds.iter().position(|s| *s == peak)? as f64;
    let path = speeds.windows(2).map(|w| 0.5 * (w[0] + w[1]));
    let mean = path.sum::<f64>() / steps;
    (peak > MOVEMENT_PEAK_M_S).then(|| Movement {
        secs: steps / RATE_HZ,
        peak_to_mean: peak / mean,
        peak_place: at / steps,
    })
}

/// Returns the durations of the holds in a run of speeds, seconds.
fn holds_secs(speeds: &[f64]) -> Vec<f64> {
    let mut spans: Vec<Range<usize>> = Vec::new();
    for (i, _) in speeds
        .iter()
        .enumerate()
        .filter(|(_, speed)| **speed < HOLD_SPEED_M_S)
    {
        match spans.last_mut() {
            Some(span) if span.end == i => span.end += 1,
            _ => spans.push(i..i + 1),
        }
    }
    let secs = spans.iter().map(|span| span.len() as f64 / RATE_HZ);
    secs.filter(|secs| *secs > HOLD_SECS).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use raconteur_base::ops;
    use std::f64::consts::PI;

    /// Speeds of two movements of 30 steps, 1 m/s and 0.3 m/s at most, between standstills of 20
    /// samples.
    fn speeds() -> Vec<f64> {
        let bell = |peak: f64| (0..=30).map(move |i| peak * ops::sin(PI * f64::from(i) / 30.0));
        let still = || std::iter::repeat_n(0.0, 20);
        let first = still().chain(bell(1.0)).chain(still());
        first
            .chain(bell(0.3))
            .chain(still())
            .map(|v| v.max(0.0))
            .collect()
    }

    #[test]
    fn a_movement_reaches_from_standstill_to_standstill_and_is_fast() {
        let found = movements(&speeds());
        assert_eq!(found.len(), 1, "{found:?}");
        let Movement {
            secs,
            peak_to_mean,
            peak_place,
        } = found[0];
        assert!((secs - 0.5).abs() < 0.02, "{secs} s");
        assert!((peak_to_mean - 0.5 * PI).abs() < 0.06, "{peak_to_mean}");
        assert!((peak_place - 0.5).abs() < 0.02, "{peak_place}");
    }

    #[test]
    fn a_movement_may_begin_or_end_with_the_run_unless_it_is_cut() {
        let bell = &speeds()[19..52];
        assert_eq!(movements(&bell[1..]).len(), 1);
        assert_eq!(movements(&bell[..32]).len(), 1);
        assert_eq!(movements(&bell[10..]).len(), 0);
        assert_eq!(movements(&bell[..22]).len(), 0);
        assert_eq!(movements(&[]).len(), 0);
    }

    #[test]
    fn holds_are_slow_and_long_enough() {
        let found = holds_secs(&speeds());
        assert_eq!(found.len(), 3, "{found:?}");
        assert!(found.iter().all(|secs| *secs > 20.0 / RATE_HZ), "{found:?}");
        assert_eq!(holds_secs(&[0.0; 9]), [0.0; 0]);
    }

    #[test]
    fn hands_are_in_use_together_or_alone() {
        let speeds = [vec![0.3, 0.3, 0.0, 0.0], vec![0.3, 0.0, 0.0, 0.0]];
        let values = use_measures(&speeds).map(|m| m.value);
        assert_eq!(values, [Some(50.0), Some(50.0), Some(0.0), Some(50.0)]);
    }
}
