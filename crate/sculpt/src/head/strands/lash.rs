//! Lashes: fine hairs that curve up and out, whose tips meet in groups.

use raconteur_base::{DVec3, Side};

use super::super::rig::smooth;
use super::{BrowParams, Strand, StrandRandom};

/// Lid from which lashes grow.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Row {
    Upper,
    Lower,
}

/// Lashes of an upper lid, and their usual length, mm.
const COUNT: f64 = 60.0;
const LENGTH_MM: f64 = 7.5;
/// Number, length and strength of the lower lid's against those of the upper.
const LOWER: f64 = 0.4;
/// Half width of a lash at its root, mm.
const HALF_WIDTH_MM: f64 = 0.10;
/// Lashes of a clump.
const CLUMP: f64 = 4.2;
/// Segments of an upper and a lower lash.
const SEGMENTS: [usize; 2] = [3, 2];

/// A lid's edge from the inner to the outer corner.
struct Edge<'a> {
    points: &'a [DVec3],
    globe: DVec3,
    row: Row,
    side: Side,
}

impl Edge<'_> {
    /// Returns the point at a share of its point indices.
    fn sample(&self, s: f64) -> DVec3 {
        let x = s * (self.points.len() - 1) as f64;
        let i = (x.floor() as usize).min(self.points.len() - 2);
        self.points[i].lerp(self.points[i + 1], x - i as f64)
    }

    /// Returns the end of an isolated lash of length 1 from there, and the direction in which it
    /// leaves the lid.
    fn growth(&self, s: f64) -> (DVec3, DVec3) {
        let out = (self.sample(s) - self.globe).normalize();
        // The inner ones lean in less than the outer ones lean out.
        let lean = s - 0.42;
        let fan = lean * if lean < 0.0 { 0.6 } else { 0.95 } * self.side.sign();
        // Those at the outer corner would otherwise point down.
        let corner = 1.0 - 0.6 * smooth(0.7, 1.0, s);
        let (down, curl) = match self.row {
            Row::Upper => (-0.46 * corner, DVec3::new(0.08 * fan, 0.84, -0.20)),
            Row::Lower => (-0.40, DVec3::new(0.05 * fan, -0.10, 0.08)),
        };
        let leave = DVec3::new(out.x * 0.5 + fan, out.y * 0.9 + down, out.z * 0.95).normalize();
        ((leave + curl), leave)
    }
}

/// Returns the position at which the tips of the lash's clump meet, as a share of the lid.
fn clump(s: f64, clumps: f64, seed: u64) -> f64 {
    let number = (s * clumps).floor().clamp(0.0, clumps - 1.0);
    let mut dice = StrandRandom {
        seed: seed ^ 78,
        hair: number as u64,
        next: 0,
    };
    (number + 0.5 + 0.3 * dice.signed()) / clumps
}

/// Builds lashes along a lid's edge, given as points from the inner to the outer corner, mm.
pub(super) fn lashes(
    points: &[DVec3],
    globe: DVec3,
    row: Row,
    side: Side,
    seed: u64,
    p: &BrowParams,
) -> Vec<Strand> {
    let edge = Edge {
        points,
        globe,
        row,
        side,
    };
    let share = if row == Row::Upper { 1.0 } else { LOWER };
    let count = (COUNT * share) as u64;
    let seed = seed ^ 77 ^ (side.index() as u64 * 5000) ^ (1000 * u64::from(row == Row::Upper));
    (0..count)
        .map(|hair| {
            let mut dice = StrandRandom {
                seed,
                hair,
                next: 0,
            };
            let s = (hair as f64 + 0.5 + 0.45 * dice.signed()) / count as f64;
            let s = 0.08 + 0.90 * s;
            let meet = clump(s, (count as f64 / CLUMP).round(), seed);
            lash(&edge, s, meet, share, p, &mut dice)
        })
        .collect()
}

/// Builds one lash, with its tip pulled towards those that leave the lid at `meet`.
fn lash(
    edge: &Edge<'_>,
    s: f64,
    meet: f64,
    share: f64,
    p: &BrowParams,
    dice: &mut StrandRandom,
) -> Strand {
    // Longest over the outer third.
    let ends = (0.40 + 0.60 * smooth(0.0, 0.68, s)) * (1.0 - 0.36 * smooth(0.82, 1.0, s));
    let length = LENGTH_MM * share * p.lash_length * ends * (0.74 + 0.36 * dice.unit());
    let root = edge.sample(s);
    let (own_end, leave) = edge.growth(s);
    let (their_end, _) = edge.growth(meet);
    let loose = 0.25 + 0.35 * dice.unit();
    // Otherwise the lashes would lie one behind the other in a side view.
    let shaken = DVec3::new(
        0.04 * dice.signed(),
        0.12 * dice.signed(),
        0.06 * dice.signed(),
    );
    let together = (edge.sample(meet) + their_end * length).lerp(root + own_end * length, loose);
    let tip = together + shaken * length;
    let out = (root - edge.globe).normalize();
    let from = root - out * 0.1;
    let segments = SEGMENTS[usize::from(edge.row == Row::Lower)];
    let way = leave * length;
    // A parabola that leaves the lid in its direction and ends at the tip.
    let bend = tip - from - way;
    let at = |i: usize| {
        let v = i as f64 / segments as f64;
        from + way * v + bend * (v * v)
    };
    Strand {
        points: (0..=segments).map(at).collect(),
        half_width: HALF_WIDTH_MM * (0.8 + 0.4 * dice.unit()) * share.sqrt(),
        facing: if edge.row == Row::Upper {
            DVec3::Y
        } else {
            DVec3::Z
        },
        shade: 0.75 + 0.5 * dice.unit(),
        cover: if edge.row == Row::Upper { 0.95 } else { 0.65 },
    }
}
