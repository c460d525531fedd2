//! Engagement of trunk and shoulders in the strokes of the hands (EMOTE's torso; GEVH section 3.5).
//!
//! Each key of a stroke has a posture of its own: turned to the side of the hands, leaning after
//! them, the shoulder raised with a high hand. Pelvis, chest and shoulders move to it one after
//! the other, the pelvis first.

use raconteur_base::curve::smooth;
use raconteur_base::order::sort_by_number;
use raconteur_base::{DVec3, Length, noise};
use raconteur_speech::emotion::EmotionPoint;

use super::{SentenceSpan, Vigour};
use crate::body_posture::{BodyPosture, Turn};
use crate::gesture::ArmPlan;
use crate::idle::stream;
use crate::superposition::SuperposedTrack;

/// Turn of the trunk for hands to a side, radians for each share of the reach: 15° for an arm
/// stretched out sideways. Designed: 5 to 15° by the size of the stroke.
const YAW_ASIDE_RAD: f64 = 0.34;
/// Turn of the trunk for one hand in front, whose shoulder goes with it, radians for each share of
/// the reach. Designed.
const YAW_AHEAD_RAD: f64 = 0.16;
/// Turn for two hands that do the same, alternately to both sides, radians: at rest and for each
/// share of the reach that the stroke is long. Designed.
const YAW_BOTH_RAD: [f64; 2] = [0.035, 0.1];
/// Lean for hands far in front and for high hands, radians for each share of the reach. Designed.
const LEAN_AHEAD_RAD: f64 = 0.13;
const LEAN_HIGH_RAD: f64 = -0.16;
/// Roll away from a high hand, radians for each share of the reach. Designed.
const ROLL_HIGH_RAD: f64 = 0.12;
/// Weight on the foot of the side that the trunk turns to, for each radian. Designed.
const WEIGHT_BY_YAW: f64 = 3.5;
/// Elevation of a shoulder for each share of the reach that its hand is above mid-trunk, radians.
/// Designed.
const SHRUG_RAD: f64 = 0.07;
/// Shares of the pelvis in yaw, lean and roll; the chest has the rest. People's hips turn by two
/// thirds of the chest's turn, and hardly lean (computed from ZeroEGGS "067_Speech_2").
const PELVIS_SHARE: [f64; 3] = [0.42, 0.2, 0.3];
/// Share of the lumbar spine in what the chest does on the pelvis.
const LUMBAR_SHARE: f64 = 0.4;
/// Shortest and longest movement of the trunk to a key, seconds. Designed.
const MOVE_SECS: [f64; 2] = [0.42, 0.9];
/// Lead of pelvis, chest and shoulders before the hand's arrival, seconds. Designed: successive,
/// from the weight outwards.
const LEAD_SECS: [f64; 3] = [0.16, 0.06, 0.0];
/// Time after a key from which the trunk returns if no other key follows, and the time before the
/// next key that ends the return, seconds. Designed.
const RELEASE_SECS: [f64; 2] = [0.9, 1.3];
/// Share of the engagement that remains after the return, until the next stroke.
const RELEASED_SHARE: f64 = 0.3;
/// Share by which the trunk goes beyond its posture in a strong stroke, before it settles, and the
/// speeds of the hand between which a stroke becomes strong, shares of the reach a second. Designed:
/// overshoot of strong effort (EMOTE).
const OVERSHOOT: f64 = 0.22;
const STRONG: [f64; 2] = [0.25, 1.0];
/// Time in which the trunk settles after a strong stroke, seconds. Designed.
const SETTLE_SECS: f64 = 0.5;
/// Time within which keys of both hands belong together, seconds.
const TOGETHER_SECS: f64 = 0.7;
/// Largest shift at a sentence: lean, roll, yaw, radians. Designed; people's chest leans with a
/// standard deviation of 3.5° and rolls with 5.3°.
const SHIFT_RAD: [f64; 3] = [0.035, 0.055, 0.075];
/// Duration of a shift, seconds. Designed.
const SHIFT_SECS: f64 = 1.1;
/// Shortest time between two shifts, seconds. Designed.
const SHIFT_APART_SECS: f64 = 2.2;

/// Motion of pelvis, chest and shoulders with the strokes of both hands.
#[derive(Clone, Debug, Default)]
pub(crate) struct Engagement {
    /// Yaw, lean, roll, and the weight, −1 on the right foot to 1 on the left.
    pelvis: SuperposedTrack<4>,
    /// Yaw, lean, roll.
    chest: SuperposedTrack<3>,
    shrugs: SuperposedTrack<2>,
}

/// Key of one hand in the figure's own measures: from the middle of the shoulders, in shares of
/// the reach.
#[derive(Clone, Copy, Debug)]
struct HandPlace {
    at_secs: f64,
    side: usize,
    place: DVec3,
    /// Distance from the previous key of the hand, share of the reach.
    path: f64,
}

impl Engagement {
    /// Plans the engagement for the keys of both arms.
    pub(super) fn new(plans: &[ArmPlan; 2], vigour: &Vigour<'_>, seed: u64) -> Self {
        let places = places(plans);
        let mut targets: Vec<(f64, f64, [f64; 6])> = Vec::new();
        let mut latest: [Option<HandPlace>; 2] = [None; 2];
        let mut before = f64::NEG_INFINITY;
        for (i, key) in places.iter().enumerate() {
            latest[key.side] = Some(*key);
            let other = latest[1 - key.side].filter(|k| key.at_secs - k.at_secs < TOGETHER_SECS);
            let next = places.get(i + 1);
            // Of two hands that arrive together the second one sets the posture.
            if next.is_some_and(|next| next.at_secs - key.at_secs < 0.05) {
                continue;
            }
            let size = vigour.size_at(key.at_secs);
            let target = posture_for(key, other.as_ref(), seed).map(|x| size * x);
            let secs = (key.at_secs - before).clamp(MOVE_SECS[0], MOVE_SECS[1]);
            let speed = key.path.max(other.map_or(0.0, |k| k.path)) / secs;
            let strength =
                smooth(((size * speed - STRONG[0]) / (STRONG[1] - STRONG[0])).clamp(0.0, 1.0));
            let beyond = target.map(|x| (1.0 + OVERSHOOT * strength) * x);
            targets.push((key.at_secs - secs, secs, beyond));
            if strength > 0.0 {
                targets.push((key.at_secs + 0.05, SETTLE_SECS, target));
            }
            let next_secs = next.map_or(f64::INFINITY, |next| next.at_secs);
            if next_secs - key.at_secs > RELEASE_SECS[0] + RELEASE_SECS[1] {
                let rest = target.map(|x| RELEASED_SHARE * x);
                targets.push((key.at_secs + RELEASE_SECS[0], RELEASE_SECS[1], rest));
            }
            before = key.at_secs;
        }
        let part = |lead_secs: f64| move |start: f64| start - lead_secs;
        let [pelvis, chest, shrugs] = LEAD_SECS.map(part);
        Self {
            pelvis: SuperposedTrack::new(
                targets
                    .iter()
                    .map(|(start, secs, to)| {
                        let [yaw, lean, roll] = [0, 1, 2].map(|k| PELVIS_SHARE[k] * to[k]);
                        (pelvis(*start), 1.15 * secs, [yaw, lean, roll, to[5]])
                    })
                    .collect(),
            ),
            chest: SuperposedTrack::new(
                targets
                    .iter()
                    .map(|(start, secs, to)| {
                        let share = [0, 1, 2].map(|k| (1.0 - PELVIS_SHARE[k]) * to[k]);
                        (chest(*start), *secs, share)
                    })
                    .collect(),
            ),
            shrugs: SuperposedTrack::new(
                targets
                    .iter()
                    .map(|(start, secs, to)| (shrugs(*start), *secs, [to[3], to[4]]))
                    .collect(),
            ),
        }
    }

    /// Returns the posture at a time.
    pub(super) fn sample(&self, time_secs: f64) -> BodyPosture {
        let turn = |[yaw, lean, roll]: [f64; 3], share: f64| Turn {
            lean: share * lean,
            roll: share * roll,
            yaw: share * yaw,
        };
        let chest = self.chest.sample(time_secs);
        let [yaw, lean, roll, weight] = self.pelvis.sample(time_secs);
        BodyPosture {
            weight,
            pelvis: turn([yaw, lean, roll], 1.0),
            lumbar: turn(chest, LUMBAR_SHARE),
            thoracic: turn(chest, 1.0 - LUMBAR_SHARE),
            shrug: self.shrugs.sample(time_secs),
        }
    }
}

/// Returns the keys of both hands, sorted by time.
fn places(plans: &[ArmPlan; 2]) -> Vec<HandPlace> {
    let shoulders = plans.each_ref().map(|plan| plan.rig().shoulder_in_world());
    let middle = (shoulders[0] + shoulders[1]) * 0.5;
    let mut places = Vec::new();
    for (side, plan) in plans.iter().enumerate() {
        let reach = plan.rig().reach_m();
        let mut last: Option<DVec3> = None;
        for key in plan.keys() {
            let Some(wrist) = key.wrist_in_world else {
                continue;
            };
            let place = (wrist - middle) / reach;
            let path = last.map_or(0.0, |last| last.distance_to(place));
            last = Some(place);
            places.push(HandPlace {
                at_secs: key.arrives_secs,
                side,
                place,
                path,
            });
        }
    }
    sort_by_number(&mut places, |key| key.at_secs);
    places
}

/// Returns the posture for a key, and one of the other hand at the same time: yaw, lean, roll,
/// elevation of left and right shoulder, radians; weight, −1 to 1.
fn posture_for(key: &HandPlace, other: Option<&HandPlace>, seed: u64) -> [f64; 6] {
    /// Height of mid-trunk below the shoulders, share of the reach.
    const MIDDLE: f64 = -0.45;
    let hands = [Some(key), other];
    let count = if other.is_some() { 2.0 } else { 1.0 };
    let mean = hands.into_iter().flatten().map(|k| k.place).sum::<DVec3>() / count;
    let mut yaw = YAW_ASIDE_RAD * mean.x;
    let sign = |side: usize| if side == 0 { 1.0 } else { -1.0 };
    match other {
        // The shoulder of one hand goes forwards with it.
        None => yaw -= YAW_AHEAD_RAD * sign(key.side) * (mean.z - 0.35),
        Some(other) => {
            let bucket = (key.at_secs / 1.6).floor() as i64;
            let alternate = if bucket.rem_euclid(2) == 0 { 1.0 } else { -1.0 };
            let chance = 0.6 + 0.8 * noise::unit(seed, stream::ENGAGEMENT, bucket);
            let path = key.path.max(other.path).min(1.0);
            yaw += alternate * chance * (YAW_BOTH_RAD[0] + YAW_BOTH_RAD[1] * path);
        }
    }
    let high = |k: &HandPlace| k.place.y - MIDDLE;
    let mut posture = [
        yaw,
        LEAN_AHEAD_RAD * (mean.z - 0.4) + LEAN_HIGH_RAD * (mean.y - MIDDLE).max(0.0),
        0.0,
        0.0,
        0.0,
        (WEIGHT_BY_YAW * yaw).clamp(-1.0, 1.0),
    ];
    for hand in hands.into_iter().flatten() {
        posture[2] -= ROLL_HIGH_RAD * sign(hand.side) * high(hand);
        posture[3 + hand.side] = SHRUG_RAD * high(hand).clamp(-0.3, 1.0);
    }
    posture
}

/// Returns the shifts of the trunk at sentences: lean, roll, yaw.
pub(super) fn shifts(
    sentences: &[SentenceSpan],
    vigour: &Vigour<'_>,
    seed: u64,
) -> SuperposedTrack<3> {
    let mut targets = Vec::new();
    let mut last_secs = f64::NEG_INFINITY;
    let mut side = 1.0;
    for (i, sentence) in sentences.iter().enumerate() {
        let start = sentence.start_secs;
        // The posture at the beginning is that of waiting.
        if i == 0 || start - last_secs < SHIFT_APART_SECS {
            continue;
        }
        last_secs = start;
        let bucket = (1e3 * start).round() as i64;
        let r = |id: u64| noise::unit(seed, stream::SHIFT + id, bucket);
        side = -side;
        let size = vigour.size_at(start);
        let [lean, roll, yaw] = SHIFT_RAD.map(|x| size * x);
        targets.push((
            start - 0.3,
            SHIFT_SECS,
            [
                lean * (2.0 * r(0) - 1.0),
                side * roll * (0.3 + 0.7 * r(1)),
                -side * yaw * (0.3 + 0.7 * r(2)),
            ],
        ));
        let next = sentences.get(i + 1).map_or(f64::INFINITY, |s| s.start_secs);
        if next - sentence.end_secs > 2.0 {
            targets.push((sentence.end_secs + 0.6, 1.6, [0.0; 3]));
        }
    }
    SuperposedTrack::new(targets)
}

/// Returns lean and shoulder elevation of an emotion, radians: forward with dominant activation,
/// back from what overwhelms or surprises, collapsed in sorrow (Wallbott 1998,
/// doi:10.1002/(SICI)1099-0992(1998110)28:6<879::AID-EJSP901>3.0.CO;2-W; amounts designed).
pub(super) fn posture_of_emotion(felt: &EmotionPoint) -> [f64; 2] {
    let [active, good, strong] =
        [felt.activation, felt.evaluation, felt.power].map(|x| (x / 100.0).clamp(-1.0, 1.0));
    let excited = active.max(0.0);
    let low = super::sorrow(felt);
    let frightened = excited * (-strong).max(0.0) * (-good).max(0.0);
    // Activation without a sign of good or strong is surprise.
    let surprised = excited * (1.0 - good.abs() - strong.abs()).max(0.0);
    [
        0.09 * excited * strong - 0.1 * surprised + 0.13 * low,
        0.12 * frightened - 0.05 * low,
    ]
}
