//! Adjacent and repeated strokes: the motion between them fits into the hold, at a human speed, and
//! nothing is late where the time suffices.

use std::sync::Arc;

use raconteur_actor::gesture::{ArmPlan, ArmScript, GestureStroke, HandKey, IdleSettings};
use raconteur_actor::palm;
use raconteur_actor::{ArmRig, Build};
use raconteur_base::{DVec3, Side, noise};
use raconteur_body::Skeleton;
use raconteur_body::hand_shape::HandShape;

/// No idle life.
const STILL: IdleSettings = IdleSettings {
    seed: 1,
    amount: 0.0,
    dominant: Side::Right,
};
const RATE_HZ: f64 = 480.0;
/// Ratio of peak to mean speed of a minimum-jerk movement; its greatest acceleration in units of
/// distance over the square of time (Flash and Hogan 1985, doi:10.1523/JNEUROSCI.05-07-01688.1985).
const PEAK: f64 = 1.875;
const ACCELERATION: f64 = 5.774;
/// Fastest mean speed of a wrist that the planner plans, m/s: with [`PEAK`] 4.1 m/s, somewhat
/// above the fastest wrist of recorded story tellers (3.6 m/s).
const MAX_SPEED_M_S: f64 = 2.2;
/// Shortest duration of an unhurried movement, seconds.
const EASY_SECS: f64 = 0.35;
/// Path-length factor: paths are slightly curved and pass through keys, a sixth longer than
/// straight ones from rest to rest.
const ROOM: f64 = 1.17;

/// One script of an arm: all strokes, and true if each begins exactly at the end of the last.
struct Case {
    strokes: Vec<GestureStroke>,
    side: Side,
}

fn unit(seed: u64, id: u64, i: i64) -> f64 {
    noise::unit(seed, id, i)
}

fn place(seed: u64, side: Side, id: u64, i: i64, size_m: f64) -> DVec3 {
    let v = |k| noise::signed(seed, id + k, i) * size_m;
    DVec3::new(side.sign() * (0.28 + v(0)), 1.32 + v(1), 0.40 + 0.5 * v(2))
}

/// A stroke repeated, or strokes of their own, with pauses or without.
fn case(seed: u64) -> Case {
    let u = |id, i| unit(seed, id, i);
    let side = Side::BOTH[usize::from(u(0, 0) < 0.5)];
    let repeated = u(1, 0) < 0.6;
    let count = 2 + (5.0 * u(2, 0)) as i64;
    let size_m = 0.02 + 0.14 * u(3, 0);
    let secs = 0.2 + 1.2 * u(4, 0) * u(4, 0);
    let gap_secs = (0.9 * u(5, 0) - 0.45).max(0.0);
    // Position of the last key in the stroke: at its end or before a hold.
    let last = if u(6, 0) < 0.5 {
        1.0
    } else {
        0.3 + 0.6 * u(7, 0)
    };
    let (turns, shapes) = (u(8, 0) < 0.4, u(9, 0) < 0.4);
    let keys = 1 + (3.0 * u(10, 0)) as i64;
    let mut t = 2.0;
    let strokes = (0..count)
        .map(|i| {
            let which = if repeated { 0 } else { 10 * i };
            let key = |k: i64| {
                let share = last * k as f64 / (keys - 1).max(1) as f64;
                let normal = place(seed, side, 40, which + k, 1.0) - DVec3::Y;
                HandKey {
                    time_secs: t + secs * share,
                    wrist_in_world: Some(place(seed, side, 30, which + k, size_m)),
                    hand_in_world: turns
                        .then(|| palm::hand_rotation(side, normal, 0.4 * k as f64))
                        .flatten(),
                    shape: HandShape::get((60.0 * u(50, which + k)) as u8)
                        .filter(|_| shapes)
                        .map(|s| *s.angles()),
                    ..HandKey::default()
                }
            };
            let stroke = GestureStroke {
                start_secs: t,
                end_secs: t + secs,
                keys: (0..keys).map(key).collect(),
                ..GestureStroke::default()
            };
            t += secs + gap_secs;
            stroke
        })
        .collect();
    Case { strokes, side }
}

/// Returns the reported case: four times 0.6 s in which the hand rises by a distance, then holds.
fn raised(up_m: f64, share: f64) -> Case {
    let low = DVec3::new(-0.25, 1.2, 0.4);
    let strokes = (0..4).map(|i| {
        let start_secs = 2.0 + 0.6 * f64::from(i);
        let key = |secs: f64, y: f64| HandKey {
            time_secs: start_secs + secs,
            wrist_in_world: Some(low + DVec3::Y * y),
            ..HandKey::default()
        };
        GestureStroke {
            start_secs,
            end_secs: start_secs + 0.6,
            keys: vec![key(0.0, 0.0), key(0.6 * share, up_m)],
            ..GestureStroke::default()
        }
    });
    Case {
        strokes: strokes.collect(),
        side: Side::Right,
    }
}

/// An interval in which the hand moves.
struct PathSpan {
    from_secs: f64,
    to_secs: f64,
    way_m: f64,
    /// Shortest possible duration.
    secs: f64,
}

/// Returns the minimum time in which fingers and palms change, which the planner may use as well.
fn others_secs(a: &HandKey, b: &HandKey) -> f64 {
    let turn = a.hand_in_world.zip(b.hand_in_world);
    let turn = turn.map_or(0.0, |(a, b)| a.angle_between(b) / 15.0);
    let shapes = a.shape.zip(b.shape);
    turn.max(shapes.map_or(0.0, |(a, b)| a.greatest_difference(&b) / 18.0))
}

/// Returns all movements of a case; `None` when one is too long for its time.
fn path_spans(case: &Case) -> Option<Vec<PathSpan>> {
    let far = |a: &HandKey, b: &HandKey| {
        a.wrist_in_world
            .zip(b.wrist_in_world)
            .map_or(0.0, |(a, b)| a.distance(b))
    };
    let mut all = Vec::new();
    let suffices =
        |way_m: f64, others: f64, secs: f64| way_m / MAX_SPEED_M_S <= secs && others <= secs;
    for (i, stroke) in case.strokes.iter().enumerate() {
        for pair in stroke.keys.windows(2) {
            let (from_secs, to_secs) = (pair[0].time_secs, pair[1].time_secs);
            let (way_m, secs) = (far(&pair[0], &pair[1]), to_secs - from_secs);
            if !suffices(way_m, others_secs(&pair[0], &pair[1]), secs) {
                return None;
            }
            all.push(PathSpan {
                from_secs,
                to_secs,
                way_m,
                secs,
            });
        }
        let Some(next) = case.strokes.get(i + 1).map(|s| &s.keys[0]) else {
            continue;
        };
        let last = &stroke.keys[stroke.keys.len() - 1];
        let secs = next.time_secs - last.time_secs;
        if secs > 1e-6 {
            if !suffices(far(last, next), others_secs(last, next), secs) {
                return None;
            }
            all.push(PathSpan {
                from_secs: last.time_secs,
                to_secs: next.time_secs,
                way_m: far(last, next),
                secs: secs.min(EASY_SECS),
            });
        } else {
            // Both directions within the time of the last path there.
            let way = all.pop()?;
            let before = &stroke.keys[stroke.keys.len() - 2];
            let way_m = way.way_m + far(last, next);
            let others = others_secs(before, last) + others_secs(last, next);
            // Each feature takes its share of the time; the longest one determines the shares.
            let least = (way.way_m / MAX_SPEED_M_S).max(others_secs(before, last))
                + (far(last, next) / MAX_SPEED_M_S).max(others_secs(last, next));
            if !suffices(way_m, others, way.secs) || least > 0.6 * way.secs {
                return None;
            }
            all.push(PathSpan {
                way_m: 2.0 * way.way_m.max(far(last, next)),
                secs: 0.6 * way.secs.min(2.0 * EASY_SECS),
                ..way
            });
        }
    }
    Some(all)
}

fn plan(case: &Case) -> ArmPlan {
    let script = ArmScript {
        strokes: case.strokes.clone(),
        on: Vec::new(),
    };
    let skeleton = Skeleton::example();
    let rig = Arc::new(ArmRig::new(&skeleton, case.side, &Build::default()));
    ArmPlan::new(&script, &skeleton, rig, &STILL)
}

/// Returns true if all targets are within the arm's reach.
fn is_in_reach(case: &Case, plan: &ArmPlan) -> bool {
    let mut asked = case.strokes.iter().flat_map(|s| &s.keys);
    let planned = |p: DVec3| {
        let mut places = plan.keys().iter().filter_map(|k| k.wrist_in_world);
        places.any(|q| q.distance(p) < 1e-6)
    };
    asked.all(|k| k.wrist_in_world.is_none_or(planned))
}

/// Everything that is wrong with the performance of a case.
fn faults(case: &Case, plan: &ArmPlan, ways: &[PathSpan]) -> Vec<String> {
    let mut found = Vec::new();
    for key in plan.keys() {
        let late = key.arrives_secs - key.time_secs;
        if late > 1e-3 {
            found.push(format!("{:.0} ms late at {:.3}", 1e3 * late, key.time_secs));
        }
    }
    let at = |t: f64| plan.sample(t).wrist;
    for stroke in &case.strokes {
        let first = &stroke.keys[0];
        let off = first
            .wrist_in_world
            .map_or(0.0, |p| p.distance(at(first.time_secs)));
        if off > 1e-3 {
            found.push(format!("{off} m off the beginning at {}", first.time_secs));
        }
        // Every key is reached, the last one perhaps earlier.
        let least = |from: f64, to: f64, p: DVec3| {
            let n = ((to - from) * RATE_HZ).ceil() as i64;
            (0..=n)
                .map(|i| at(from + i as f64 / RATE_HZ).distance(p))
                .fold(f64::INFINITY, f64::min)
        };
        for key in &stroke.keys {
            let Some(p) = key.wrist_in_world else {
                continue;
            };
            let off = least(stroke.start_secs, key.time_secs, p);
            if off > 4e-3 {
                found.push(format!("{off:.4} m off the key at {:.3}", key.time_secs));
            }
        }
    }
    for way in ways {
        let speed = |t: f64| at(t).distance(at(t + 1.0 / RATE_HZ)) * RATE_HZ;
        let n = ((way.to_secs - way.from_secs) * RATE_HZ).floor() as i64;
        // A held hand sinks slightly.
        let most = ROOM * PEAK * way.way_m / way.secs + 0.06;
        let change = 2.0 * ACCELERATION * way.way_m / (way.secs * way.secs) / RATE_HZ + 0.01;
        let mut last: Option<f64> = None;
        for i in 0..n {
            let t = way.from_secs + i as f64 / RATE_HZ;
            let v = speed(t);
            if v > most {
                found.push(format!("{v:.2} m/s, not {most:.2}, at {t:.3}"));
                break;
            }
            if last.is_some_and(|last| (v - last).abs() > change) {
                found.push(format!("from {last:?} to {v:.3} m/s at {t:.3}"));
                break;
            }
            last = Some(v);
        }
    }
    found
}

#[test]
fn a_raised_hand_comes_down_within_the_hold() {
    // Up to the end of the stroke, and up within its first half, by four units and more.
    for share in [1.0, 0.75, 0.5, 0.25] {
        for up_m in [0.02, 0.088, 0.15] {
            let case = raised(up_m, share);
            let ways = path_spans(&case).expect("there is time for it");
            let found = faults(&case, &plan(&case), &ways);
            assert_eq!(found, [""; 0], "{up_m} m by {share}");
        }
    }
}

#[test]
fn hands_are_neither_late_nor_hasty_between_strokes() {
    let (mut count, mut turned_back, mut wrong) = (0, 0, Vec::new());
    for seed in 0..800 {
        let case = case(seed);
        let Some(ways) = path_spans(&case) else {
            continue;
        };
        let plan = plan(&case);
        if !is_in_reach(&case, &plan) {
            continue;
        }
        count += 1;
        let [a, b] = [&case.strokes[0], &case.strokes[1]];
        let last = a.keys[a.keys.len() - 1].time_secs;
        turned_back += i32::from((b.keys[0].time_secs - last).abs() < 1e-6);
        let found = faults(&case, &plan, &ways);
        if let Some(first) = found.first() {
            wrong.push(format!(
                "case {seed}: {first}, and {} more",
                found.len() - 1
            ));
        }
    }
    assert!(count > 250 && turned_back > 25, "{count}, {turned_back}");
    assert!(
        wrong.is_empty(),
        "{} of {count}\n{}",
        wrong.len(),
        wrong.join("\n")
    );
}
