//! Tied hair: hanging tails and wound buns.

use std::f64::consts::TAU;

use raconteur_base::{DVec3, noise, ops};

use super::card::{Card, CardLayout};
use super::comb::step;
use super::grow::{sampled, smooth};
use super::locks::{Grower, normal};
use super::style::{NAPE, TIE};

/// Distance of a path's points, metres.
const STEP_M: f64 = 0.004;
/// Cards of a tail, and of a knot.
const TAIL_CARDS: i64 = 90;
const KNOT_CARDS: i64 = 110;
/// Length of a tail against which the person's counts, metres.
const TAIL_M: f64 = 0.20;
/// Radius of the knot's ring and of the strand that is wound to it, metres.
const KNOT_M: [f64; 2] = [0.019, 0.017];

/// Cards in each of a braid's three strands; the next constants are the reference length, half the
/// width, and the length along which one strand crosses and returns, metres.
const PLAIT_CARDS: i64 = 44;
const PLAIT_M: f64 = 0.24;
const PLAIT_HALF_M: f64 = 0.011;
const PLAIT_TURN_M: f64 = 0.052;
/// Radius of a strand, metres.
const PLAIT_STRAND_M: f64 = 0.0085;

/// Returns the thickness of a braid at a share of its length: it is bound near its end.
fn plait_thickness(t: f64) -> f64 {
    (0.75 + 0.25 * step(0.0, 0.15, t)) * (1.0 - 0.45 * step(0.3, 0.92, t))
        + 0.25 * step(0.93, 1.0, t)
}

impl Grower<'_> {
    /// Returns the middle of a strand of a plait, `s` metres below the start.
    fn plait_strand(&self, middle: &[DVec3], strand: i64, s: f64) -> DVec3 {
        let length = (middle.len() - 2) as f64 * STEP_M;
        let turn = TAU * (s / PLAIT_TURN_M + strand as f64 / 3.0);
        let thick = plait_thickness(s / length) * PLAIT_HALF_M;
        let at = sampled(middle, STEP_M, s.min(length), 1)[1];
        at + DVec3::new(ops::sin(turn), 0.0, 0.55 * ops::sin(2.0 * turn)) * thick
    }

    /// Returns the middle line of a plait down the back.
    fn plait_middle(&self) -> Vec<DVec3> {
        let length = PLAIT_M * self.params.length;
        let mut at = NAPE + DVec3::new(0.0, 0.012, -0.006);
        let mut path = vec![at];
        for k in 0..=(length / STEP_M) as usize + 1 {
            let s = k as f64 * STEP_M;
            let d = DVec3::new(0.0, -1.0, -0.9 + 0.9 * step(0.0, 0.035, s)).normalize();
            at = self.space.pushed(at + d * STEP_M, PLAIT_HALF_M + 0.004);
            path.push(at);
        }
        smooth(&mut path, 6);
        path
    }

    /// Builds a plait of three strands that starts at the nape.
    pub(super) fn plait(&self) -> Vec<Card> {
        let middle = self.plait_middle();
        let whole = (middle.len() - 2) as f64 * STEP_M;
        let seed = self.params.seed + 500;
        let mut out = Vec::new();
        for strand in 0..3 {
            let core: Vec<DVec3> = (0..)
                .map(|k| k as f64 * 0.5 * STEP_M)
                .take_while(|s| *s < whole)
                .map(|s| self.plait_strand(&middle, strand, s))
                .collect();
            let outward = |p: DVec3| {
                let far = |c: &&DVec3| c.distance_squared(p);
                let near = core.iter().min_by(|a, b| far(a).total_cmp(&far(b)));
                near.map_or(DVec3::NEG_Z, |c| (p - *c).normalize_or(DVec3::NEG_Z))
            };
            for i in 0..PLAIT_CARDS {
                let id = strand * PLAIT_CARDS + i;
                let dice = |k: u64| noise::unit(seed, k, id);
                let bell = |k: u64| normal(seed, 10 + k, id);
                let length = (0.05 * (0.8 + 0.5 * dice(0))).min(whole);
                let start = (whole - length) * (i as f64 + dice(1)) / PLAIT_CARDS as f64;
                let around = TAU * dice(2);
                let deep = 0.85 + 0.3 * dice(3);
                let count = (length / STEP_M) as usize + 3;
                let path: Vec<DVec3> = (0..count)
                    .map(|k| {
                        let s = (start + k as f64 * STEP_M).min(whole);
                        let angle = around + 14.0 * k as f64 * STEP_M;
                        let radius = PLAIT_STRAND_M * plait_thickness(s / whole) * deep;
                        let ring = DVec3::new(ops::cos(angle), 0.0, ops::sin(angle)) * radius;
                        self.plait_strand(&middle, strand, s) + ring
                    })
                    .collect();
                let card = Card::around(
                    &path,
                    STEP_M,
                    &outward,
                    &CardLayout {
                        length,
                        width: 0.0105 * (0.75 + 0.5 * dice(4)),
                        taper: [0.55, 1.0, 0.55],
                        spans: 6,
                        strip: if deep > 1.05 {
                            6 + (6.0 * dice(5)) as u32
                        } else {
                            (8.0 * dice(5)) as u32
                        },
                        is_mirrored: dice(6) < 0.5,
                        roll: 0.15 * bell(0),
                        tint: (0.5 + 0.18 * bell(1)).clamp(0.0, 1.0),
                        layer: if deep > 1.0 { 2 } else { 0 },
                        whole: 4.0 * length,
                    },
                );
                out.push(card.free());
            }
        }
        out
    }

    /// Builds a tail of hair that falls from the tie.
    pub(super) fn tail(&self) -> Vec<Card> {
        let seed = self.params.seed + 300;
        (0..TAIL_CARDS)
            .map(|i| {
                let dice = |k: u64| noise::unit(seed, k, i);
                let bell = |k: u64| normal(seed, 10 + k, i);
                let turn = TAU * dice(0);
                let out = dice(1).sqrt();
                let across = DVec3::new(ops::cos(turn), ops::sin(turn), 0.0) * out;
                let length = TAIL_M * self.params.length * (0.72 + 0.36 * dice(2));
                let mut at = TIE + across * 0.006 + DVec3::Z * 0.004;
                let mut d = (DVec3::new(0.35 * across.x, 0.25 + 0.3 * across.y, -1.0)).normalize();
                let mut path = vec![at];
                for k in 0..=(length / STEP_M) as usize + 1 {
                    let s = k as f64 * STEP_M;
                    // Thickest a third down.
                    let thick = 0.008 + 0.012 * step(0.0, 0.05, s) - 0.009 * step(0.08, 0.2, s);
                    let middle =
                        TIE + DVec3::new(0.0, 0.02 - s, -0.03 - 0.012 * step(0.0, 0.06, s));
                    let home = middle + DVec3::new(across.x, 0.0, across.y) * thick;
                    let pull = (home - at) * 9.0;
                    let wanted = DVec3::NEG_Y + DVec3::new(pull.x, 0.0, pull.z);
                    let turn = 0.10 + 0.16 * step(0.0, 0.04, s);
                    d = d.lerp(wanted.normalize_or(d), turn).normalize_or(d);
                    at = self.space.pushed(at + d * STEP_M, 0.003 + 0.008 * out);
                    path.push(at);
                }
                smooth(&mut path, 4);
                Card::along(
                    self.space,
                    &path,
                    STEP_M,
                    &CardLayout {
                        length,
                        width: 0.015 * (0.7 + 0.6 * dice(3)),
                        taper: [0.5, 1.0, 0.6],
                        spans: 12,
                        strip: if out > 0.8 {
                            5 + (7.0 * dice(4)) as u32
                        } else {
                            (8.0 * dice(4)) as u32
                        },
                        is_mirrored: dice(5) < 0.5,
                        roll: 0.25 * bell(0),
                        tint: (0.5 + 0.18 * bell(1)).clamp(0.0, 1.0),
                        layer: if out > 0.7 { 2 } else { 0 },
                        whole: length,
                    },
                )
                .free()
            })
            .collect()
    }

    /// Builds a knot: hair wound in a ring about the tie.
    pub(super) fn knot(&self) -> Vec<Card> {
        let seed = self.params.seed + 400;
        let [ring, strand] = KNOT_M.map(|r| r * self.params.volume);
        // The knot's axis points back and up.
        let axis = DVec3::new(0.0, 0.35, -1.0).normalize();
        let (e1, e2) = (DVec3::X, axis.cross(DVec3::X));
        let middle = TIE + axis * (0.7 * strand);
        (0..KNOT_CARDS)
            .map(|i| {
                let dice = |k: u64| noise::unit(seed, k, i);
                let bell = |k: u64| normal(seed, 10 + k, i);
                let (start, around) = (TAU * dice(0), TAU * dice(1));
                let depth = 0.72 + 0.30 * dice(2);
                let length = 0.055 * (0.7 + 0.6 * dice(3));
                let count = (length / STEP_M) as usize + 3;
                let path: Vec<DVec3> = (0..count)
                    .map(|k| {
                        let s = k as f64 * STEP_M;
                        let a = start + s / (ring + 0.6 * strand);
                        // The strand turns about itself as it is wound.
                        let b = around + 26.0 * s;
                        let out = e1 * ops::cos(a) + e2 * ops::sin(a);
                        middle
                            + out * (ring + strand * depth * ops::cos(b))
                            + axis * (strand * depth * ops::sin(b))
                    })
                    .collect();
                Card::around(
                    &path,
                    STEP_M,
                    &|p: DVec3| (p - middle).normalize_or(DVec3::Y),
                    &CardLayout {
                        length,
                        width: 0.013 * (0.7 + 0.6 * dice(4)),
                        taper: [0.55, 1.0, 0.55],
                        spans: 7,
                        strip: if depth > 0.95 {
                            5 + (6.0 * dice(5)) as u32
                        } else {
                            (8.0 * dice(5)) as u32
                        },
                        is_mirrored: dice(6) < 0.5,
                        roll: 0.2 * bell(0),
                        tint: (0.5 + 0.18 * bell(1)).clamp(0.0, 1.0),
                        layer: if depth > 0.9 { 2 } else { 0 },
                        whole: 3.0 * length,
                    },
                )
            })
            .collect()
    }
}
