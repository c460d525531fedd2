//! The second hand of two-handed gestures: a little later and smaller than the dominant one.
//!
//! A script that gives one track for both hands mirrors it exactly. People's hands do not move like
//! mirror images (sideways velocities of one speaker's hands correlate by −0.52; computed from
//! ZeroEGGS "067_Speech_2"), unless they touch or hold something between them.

use raconteur_base::order::sort_by_number;
use raconteur_base::{DQuat, DVec3, Length, Side, mirror_vector, noise};

use super::{ArmScript, GesturePhase, GestureStroke, HandKey};
use crate::idle::stream;
use crate::palm::zero_fingers;

/// Delay of the second hand, least and largest, seconds. Designed.
const DELAY_SECS: [f64; 2] = [0.06, 0.15];
/// Size of its movement, least and largest, as a share. Designed.
const SIZE: [f64; 2] = [0.82, 0.94];
/// Displacement of its first place, for a stature of 1.7 m: upwards and to the front, metres.
/// Designed.
const OFFSET_M: [f64; 2] = [-0.016, -0.012];
/// Distance of the fingertips below which the hands touch, for a stature of 1.7 m, metres.
const TOUCH_M: f64 = 0.1;
/// Length of a hand for a stature of 1.7 m, metres.
const HAND_M: f64 = 0.17;
/// Distance within which two places mirror each other, metres.
const MIRRORED_M: f64 = 1e-6;
/// Largest share of the time to the next key that a delay takes.
const MAX_SHARE: f64 = 0.5;

/// Delays and reduces the mirrored strokes of the hand that is not dominant. `scale` is the
/// stature over 1.7 m.
pub(crate) fn vary(scripts: &mut [ArmScript; 2], dominant: Side, (seed, scale): (u64, f64)) {
    let [leading, following] = [dominant.index(), dominant.opposite().index()];
    let leads = ByStart::new(&scripts[leading].strokes);
    for stroke in &mut scripts[following].strokes {
        let partner = leads
            .simultaneous(stroke)
            .find(|lead| mirrors(lead, stroke));
        if let Some(lead) = partner
            && !touches(stroke, lead, dominant.opposite(), scale)
        {
            let bucket = (1e3 * stroke.start_secs).round() as i64;
            let r = |id: u64| noise::unit(seed, stream::SECOND_HAND + id, bucket);
            delay(
                stroke,
                DELAY_SECS[0] + (DELAY_SECS[1] - DELAY_SECS[0]) * r(0),
            );
            reduce(stroke, SIZE[0] + (SIZE[1] - SIZE[0]) * r(1), scale);
        }
    }
}

/// Strokes of one arm by their start.
pub(super) struct ByStart(Vec<GestureStroke>);

impl ByStart {
    /// Sorts strokes in any order.
    pub(super) fn new(strokes: &[GestureStroke]) -> Self {
        let mut strokes = strokes.to_vec();
        strokes.retain(|stroke| stroke.start_secs.is_finite());
        sort_by_number(&mut strokes, |stroke| stroke.start_secs);
        Self(strokes)
    }

    /// Returns the strokes that start with another one.
    pub(super) fn simultaneous(
        &self,
        stroke: &GestureStroke,
    ) -> impl Iterator<Item = &GestureStroke> {
        let start_secs = stroke.start_secs;
        let first = self
            .0
            .partition_point(|other| other.start_secs < start_secs);
        self.0[first..]
            .iter()
            .take_while(move |other| other.start_secs == start_secs)
    }
}

/// Returns true if two strokes are mirror images.
fn mirrors(a: &GestureStroke, b: &GestureStroke) -> bool {
    let both = a.phase == GesturePhase::Stroke && b.phase == GesturePhase::Stroke;
    let moves = |stroke: &GestureStroke| stroke.keys.iter().any(|k| k.wrist_in_world.is_some());
    both && !a.is_transcribed
        && a.pace.is_none()
        && moves(a)
        && a.keys.len() == b.keys.len()
        && a.keys.iter().zip(&b.keys).all(|(a, b)| mirror_keys(a, b))
}

fn mirror_keys(a: &HandKey, b: &HandKey) -> bool {
    let places = match (a.wrist_in_world, b.wrist_in_world) {
        (Some(a), Some(b)) => mirror_vector(a).distance_to(b) < MIRRORED_M,
        (None, None) => true,
        _ => false,
    };
    places && a.time_secs == b.time_secs && !a.stays_in_world && !b.stays_in_world
}

/// Returns true if the hands of two strokes touch at a key, or nearly so.
pub(super) fn touches(
    stroke: &GestureStroke,
    lead: &GestureStroke,
    side: Side,
    scale: f64,
) -> bool {
    let mut hands: [Option<DQuat>; 2] = [None; 2];
    stroke.keys.iter().zip(&lead.keys).any(|(own, other)| {
        hands = [
            own.hand_in_world.or(hands[0]),
            other.hand_in_world.or(hands[1]),
        ];
        let (Some(own), Some(other)) = (own.wrist_in_world, other.wrist_in_world) else {
            return false;
        };
        let tip = |wrist: DVec3, hand: Option<DQuat>, side: Side| {
            let fingers = hand.map_or(DVec3::ZERO, |hand| hand * zero_fingers(side));
            wrist + fingers * (HAND_M * scale)
        };
        let tips = tip(own, hands[0], side).distance_to(tip(other, hands[1], side.opposite()));
        tips.min(own.distance_to(other)) < TOUCH_M * scale
    })
}

/// Delays the keys of a stroke, each at most by a share of the time to the next one.
fn delay(stroke: &mut GestureStroke, secs: f64) {
    let times: Vec<f64> = stroke.keys.iter().map(|key| key.time_secs).collect();
    let shortest = times
        .windows(2)
        .map(|pair| MAX_SHARE * (pair[1] - pair[0]))
        .fold(secs, f64::min)
        .max(0.0);
    for key in &mut stroke.keys {
        key.time_secs += shortest;
    }
    stroke.end_secs += shortest;
}

/// Reduces the movement of a stroke about its first place, which is a little nearer to rest.
fn reduce(stroke: &mut GestureStroke, size: f64, scale: f64) {
    let Some(first) = stroke.keys.iter().find_map(|key| key.wrist_in_world) else {
        return;
    };
    let [up, front] = OFFSET_M;
    let offset = DVec3::new(0.0, up, front) * scale;
    for key in &mut stroke.keys {
        if let Some(wrist) = &mut key.wrist_in_world {
            *wrist = first + offset + (*wrist - first) * size;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn both(x: f64) -> [ArmScript; 2] {
        Side::BOTH.map(|side| ArmScript {
            strokes: vec![GestureStroke {
                start_secs: 1.0,
                end_secs: 1.6,
                keys: [(1.0, 0.0), (1.5, 0.2)]
                    .map(|(time_secs, up)| HandKey {
                        time_secs,
                        wrist_in_world: Some(DVec3::new(side.sign() * x, 1.1 + up, 0.3)),
                        ..HandKey::default()
                    })
                    .to_vec(),
                ..GestureStroke::default()
            }],
            on: Vec::new(),
        })
    }

    #[test]
    fn the_second_hand_is_later_and_smaller() {
        let mut scripts = both(0.25);
        vary(&mut scripts, Side::Right, (1, 1.0));
        let before = both(0.25);
        assert_eq!(scripts[1], before[1]);
        let (second, old) = (&scripts[0].strokes[0].keys, &before[0].strokes[0].keys);
        let delay = second[0].time_secs - old[0].time_secs;
        assert!((0.06..=0.15).contains(&delay), "the delay is {delay} s");
        let path = |keys: &[HandKey]| {
            let [a, b] = [0, 1].map(|i| keys[i].wrist_in_world.expect("a place"));
            a.distance(b)
        };
        let size = path(second) / path(old);
        assert!((0.8..0.95).contains(&size), "the size is {size}");
    }

    #[test]
    fn hands_that_touch_and_hands_that_differ_are_left_alone() {
        for mut scripts in [both(0.04), both(0.25)] {
            scripts[1].strokes[0].keys[1].wrist_in_world = if scripts[0] == both(0.25)[0] {
                Some(DVec3::new(-0.3, 1.0, 0.3))
            } else {
                scripts[1].strokes[0].keys[1].wrist_in_world
            };
            let before = scripts.clone();
            vary(&mut scripts, Side::Right, (1, 1.0));
            assert_eq!(scripts, before);
        }
    }
}
