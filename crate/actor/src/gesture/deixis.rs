//! Gestures that go back to the place of a referent (So, Kita and Goldin-Meadow 2009,
//! doi:10.1111/j.1551-6709.2008.01006.x): where the script leaves the hands free, an open hand
//! indicates the place with a later mention.

use std::sync::Arc;

use raconteur_base::order::sort_by_number;
use raconteur_base::{DVec3, Length, Side};
use raconteur_body::HandShape;

use super::{ArmScript, GestureStroke, HandKey};
use crate::ArmRig;
use crate::discourse::Mention;
use crate::palm;

/// Least direction of a place from straight ahead, as a sine. Nearer ones need no hand.
const ASIDE: f64 = 0.35;
/// Time before and after a mention in which no hand has a stroke, seconds: a preparation and a
/// return fit in. Designed.
const FREE_SECS: [f64; 2] = [1.1, 1.3];
/// Shortest time between two of these gestures, seconds. Designed.
const APART_SECS: f64 = 5.0;
/// Start of the stroke before the mention, its duration, and the hold, seconds. Designed.
const LEAD_SECS: f64 = 0.12;
const STROKE_SECS: f64 = 0.34;
const HOLD_SECS: f64 = 0.3;
/// Distance of the wrist from the shoulder towards the place at start and end, and its depth below
/// the shoulder, shares of the reach. Designed.
const TOWARDS: [f64; 2] = [0.36, 0.54];
const BELOW: [f64; 2] = [0.5, 0.36];
/// Directions of an open hand that offers a place: the fingers upwards of the place, and the palm's
/// normal to the middle and up. Designed.
const FINGERS_UP: f64 = 0.22;
const NORMAL: [f64; 2] = [-0.55, 0.75];
/// Hand shape, flat.
const FLAT: u8 = 1;

/// Adds the gestures to scripts whose arms are free. `mentions` are sorted by time.
pub(crate) fn indicate(
    scripts: &mut [ArmScript; 2],
    mentions: &[Mention],
    rigs: &[Arc<ArmRig>; 2],
) {
    let busy = BusyTimes::new(scripts);
    let mut last_secs = f64::NEG_INFINITY;
    for mention in mentions {
        let start_secs = mention.start_secs - LEAD_SECS;
        let end_secs = start_secs + STROKE_SECS + HOLD_SECS;
        let is_free = !busy.overlaps([start_secs - FREE_SECS[0], end_secs + FREE_SECS[1]]);
        if start_secs - last_secs < APART_SECS || !is_free {
            continue;
        }
        let side = if mention.place_in_figure.x > 0.0 {
            Side::Left
        } else {
            Side::Right
        };
        let script = &mut scripts[side.index()];
        let is_on = script.on.is_empty()
            || script
                .on
                .iter()
                .any(|span| span.start_secs <= start_secs && end_secs <= span.end_secs);
        if is_on && let Some(stroke) = stroke(mention, start_secs, &rigs[side.index()]) {
            script.strokes.push(stroke);
            last_secs = start_secs;
        }
    }
}

/// Returns the stroke towards a place; `None` for a place in front.
fn stroke(mention: &Mention, start_secs: f64, rig: &ArmRig) -> Option<GestureStroke> {
    let shoulder = rig.shoulder_in_world();
    let to = mention.place_in_figure - shoulder;
    let level = DVec3::new(to.x, 0.0, to.z.max(0.5 * to.x.abs())).try_normalized()?;
    if level.x * rig.side().sign() < ASIDE {
        return None;
    }
    let reach = rig.reach_m();
    let fingers = level + DVec3::Y * FINGERS_UP;
    let normal = DVec3::new(NORMAL[0] * rig.side().sign(), NORMAL[1], 0.0);
    let key = |i: usize| HandKey {
        time_secs: start_secs + if i == 0 { 0.0 } else { STROKE_SECS },
        wrist_in_world: Some(
            shoulder + level * (TOWARDS[i] * reach) - DVec3::Y * (BELOW[i] * reach),
        ),
        hand_in_world: palm::from_directions(rig.side(), fingers, normal),
        shape: HandShape::get(FLAT).map(|shape| *shape.angles()),
        ..HandKey::default()
    };
    Some(GestureStroke {
        start_secs,
        end_secs: start_secs + STROKE_SECS + HOLD_SECS,
        keys: vec![key(0), key(1)],
        ..GestureStroke::default()
    })
}

/// Times in which an arm has strokes.
struct BusyTimes {
    /// Start of each stroke, and the last end up to it; by start, seconds.
    strokes: Vec<[f64; 2]>,
}

impl BusyTimes {
    fn new(scripts: &[ArmScript; 2]) -> Self {
        let mut strokes: Vec<[f64; 2]> = scripts
            .iter()
            .flat_map(|script| &script.strokes)
            .map(|stroke| [stroke.start_secs, stroke.end_secs])
            .filter(|ends| ends.iter().all(|t| t.is_finite()))
            .collect();
        sort_by_number(&mut strokes, |ends| ends[0]);
        let mut last = f64::NEG_INFINITY;
        for ends in &mut strokes {
            last = last.max(ends[1]);
            ends[1] = last;
        }
        Self { strokes }
    }

    fn overlaps(&self, [from, to]: [f64; 2]) -> bool {
        let begun = self.strokes.partition_point(|ends| ends[0] < to);
        let last = begun.checked_sub(1).map(|i| self.strokes[i][1]);
        last.is_some_and(|end| end > from)
    }
}

#[cfg(test)]
mod tests {
    use raconteur_body::read::read_figure;

    use super::*;
    use crate::Build;

    fn mention(start_secs: f64, x: f64) -> Mention {
        Mention {
            start_secs,
            end_secs: start_secs + 0.4,
            place_in_figure: DVec3::new(x, 1.4, 1.2),
        }
    }

    #[test]
    fn free_hands_go_back_to_places() {
        let bytes = std::fs::read("../../assets/figures/nuno.glb").expect("the figure exists");
        let figure = read_figure("nuno", &bytes).expect("it is a figure");
        let rigs = ArmRig::both(&figure.skeleton, &Build::default());
        let mut scripts = <[ArmScript; 2]>::default();
        scripts[0].strokes.push(GestureStroke {
            start_secs: 20.0,
            end_secs: 21.0,
            ..GestureStroke::default()
        });
        let mentions = [
            (5.0, 1.5),
            (7.0, -1.5),
            (12.0, -1.5),
            (20.5, 1.5),
            (30.0, 0.1),
        ]
        .map(|(t, x)| mention(t, x));
        indicate(&mut scripts, &mentions, &rigs);
        let starts = |arm: usize| {
            let strokes = scripts[arm].strokes.iter();
            strokes
                .map(|s| s.start_secs + LEAD_SECS)
                .collect::<Vec<_>>()
        };
        assert_eq!(starts(0), [20.0 + LEAD_SECS, 5.0], "the left hand");
        assert_eq!(
            starts(1),
            [12.0],
            "the right hand: not soon after, not while the other is busy, not ahead"
        );
        let end = scripts[1].strokes[0].keys[1]
            .wrist_in_world
            .expect("a place");
        assert!(
            end.x < -0.25,
            "the hand is on the side of the place: {end:?}"
        );
    }
}
