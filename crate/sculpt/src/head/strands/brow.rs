//! Brows: hairs that lie on the ridge, over shorter and finer ones that fill the gaps.

use raconteur_base::{DVec3, Side, mirror_vector, noise, ops};

use super::super::rig::smooth;
use super::super::scalp_binding::ScalpBinding;
use super::super::surface::nearest;
use super::{BrowParams, Strand, StrandRandom};

/// Middle line of the left brow on the unshifted head, mm, from its inner end; half width.
const BROW: [[f64; 4]; 8] = [
    [12.0, 43.2, 95.5, 3.0],
    [17.5, 45.4, 95.2, 3.6],
    [24.0, 47.0, 93.6, 3.6],
    [31.0, 48.4, 91.2, 3.3],
    [38.0, 49.0, 88.0, 2.8],
    [45.5, 47.8, 82.8, 2.1],
    [52.0, 45.0, 77.5, 1.5],
    [56.0, 43.0, 72.5, 0.9],
];
/// Middle line and half width of the brow at parameters t in 0..7, warped to the person.
#[derive(Clone, Debug)]
pub(crate) struct BrowLine {
    knots: Vec<(DVec3, f64)>,
}

/// Height of the middle of the brow hairs above the crest of the brow, mm.
const ABOVE_CREST_MM: f64 = 2.0;

/// Returns the point on a polyline at a share of its length.
fn along(line: &[DVec3], share: f64) -> DVec3 {
    let total: f64 = line.windows(2).map(|w| w[0].distance(w[1])).sum();
    let mut left = share * total;
    for w in line.windows(2) {
        let step = w[0].distance(w[1]);
        if left <= step {
            return w[0].lerp(w[1], left / step.max(1e-9));
        }
        left -= step;
    }
    line.last().copied().unwrap_or_default()
}

impl BrowLine {
    /// Builds the line above a crest, given from its inner end.
    pub(crate) fn above(crest: &[DVec3]) -> Self {
        let mut line = crest.to_vec();
        if let [inner, next, ..] = &mut line[..] {
            // The crest begins nearer to the midline than the hair.
            let (y, z) = (0.88 * next.y + 0.12 * inner.y, 0.7 * next.z + 0.3 * inner.z);
            *inner = DVec3::new(next.x + 0.35 * (inner.x - next.x), y, z);
        }
        let at = |i: usize| DVec3::new(BROW[i][0], BROW[i][1], BROW[i][2]);
        let whole: Vec<DVec3> = (0..BROW.len()).map(at).collect();
        let length = |part: &[DVec3]| -> f64 { part.windows(2).map(|w| w[0].distance(w[1])).sum() };
        let knots = BROW
            .iter()
            .enumerate()
            .map(|(i, &[.., w])| {
                let share = length(&whole[..=i]) / length(&whole);
                let up = DVec3::Y * ABOVE_CREST_MM;
                (along(&line, 0.02 + 0.98 * share) + up, w * 1.05)
            })
            .collect();
        Self { knots }
    }

    /// Returns position and half width at `t`, interpolated with a Catmull–Rom spline through the
    /// knots.
    fn sample(&self, t: f64) -> (DVec3, f64) {
        let last = self.knots.len() - 1;
        let i = (t.floor().max(0.0) as usize).min(last - 1);
        let f = t - i as f64;
        let k = |j: isize| self.knots[j.clamp(0, last as isize) as usize];
        let i = i as isize;
        let (a, b, c, d) = (k(i - 1), k(i), k(i + 1), k(i + 2));
        let p = b.0 * 2.0
            + (c.0 - a.0) * f
            + (a.0 * 2.0 - b.0 * 5.0 + c.0 * 4.0 - d.0) * (f * f)
            + (b.0 * 3.0 - a.0 - c.0 * 3.0 + d.0) * (f * f * f);
        (p / 2.0, b.1 + (c.1 - b.1) * f)
    }

    /// Returns the tint of the skin by the shadow of short brow hairs at a position, 0..1.
    pub(crate) fn stain(&self, p: DVec3) -> f64 {
        let q = DVec3::new(p.x.abs(), p.y, p.z);
        if q.z < 45.0 || (q.y - self.knots[4].0.y).abs() > 20.0 {
            return 0.0;
        }
        let mut best = 0.0_f64;
        for i in 0..=56 {
            let t = f64::from(i) / 8.0;
            let (c, w) = self.sample(t);
            // The hairs rise from their roots.
            let d = (c + DVec3::Y * (0.25 * w) - q).truncate().length() / w;
            let ends = smooth(-0.6, 1.8, t) * smooth(7.2, 5.0, t);
            best = best.max(ops::exp(-d * d * 0.95) * ends);
        }
        best
    }
}

/// Long hairs of a usual brow, and the short ones between them.
const LONG_HAIRS: f64 = 180.0;
const SHORT_HAIRS: f64 = 160.0;

/// The most a brow may have of both against the usual.
const MAX_DENSITY: f64 = 1.6;

/// Growth by share of the brow's length: angle of hairs to the brow's line, rad; rotation towards
/// the middle by the hair's row; length, mm.
const GROWTH: [[f64; 4]; 6] = [
    [0.0, 0.98, 0.10, 4.6],
    [0.10, 0.80, 0.30, 6.4],
    [0.30, 0.50, 0.55, 7.2],
    [0.60, 0.20, 0.60, 7.0],
    [0.85, 0.04, 0.45, 5.8],
    [1.0, -0.04, 0.30, 4.0],
];

/// Heights of a long hair's points over the skin, mm: the root is below the skin, the tip stands
/// off.
const LONG_LIFT_MM: [f64; 3] = [-0.15, 0.45, 0.45];
const SHORT_LIFT_MM: [f64; 2] = [-0.1, 0.3];

/// Interpolates `GROWTH` at a share of the brow's length.
fn growth(s: f64) -> [f64; 3] {
    let i = GROWTH[1..GROWTH.len() - 1].partition_point(|row| row[0] < s);
    let (a, b) = (GROWTH[i], GROWTH[i + 1]);
    let f = ((s - a[0]) / (b[0] - a[0])).clamp(0.0, 1.0);
    [1, 2, 3].map(|k| a[k] + (b[k] - a[k]) * f)
}

/// Skin under a brow, in frontal view.
struct BrowSkin<'a> {
    ride: &'a ScalpBinding,
    vertices: Vec<u32>,
    flat: Vec<DVec3>,
}

impl<'a> BrowSkin<'a> {
    fn new(ride: &'a ScalpBinding, side: Side) -> Self {
        let at = |v: u32| ride.positions[v as usize] * 1e3;
        let near = |v: &u32| {
            let p = at(*v);
            p.z > 40.0 && p.x * side.sign() > 0.0 && p.y > 28.0 && p.y < 76.0
        };
        let vertices: Vec<u32> = (0..ride.positions.len() as u32).filter(near).collect();
        let flat = vertices.iter().map(|&v| at(v).with_z(0.0)).collect();
        Self {
            ride,
            vertices,
            flat,
        }
    }

    /// Returns the skin point in front of a position, mm, and its normal.
    fn below(&self, place: DVec3) -> (DVec3, DVec3) {
        let (mut z, mut normal) = (0.0, DVec3::ZERO);
        for (i, share) in nearest(&self.flat, place.with_z(0.0), 4, 0.1) {
            let v = self.vertices[i as usize] as usize;
            let (p, n) = (self.ride.positions[v] * 1e3, self.ride.normals[v]);
            // Each vertex defines a plane through itself.
            let slope = (n.x * (place.x - p.x) + n.y * (place.y - p.y)) / n.z.max(0.2);
            z += share * (p.z - slope);
            normal += n * share;
        }
        (place.with_z(z), normal.normalize())
    }
}

/// Shares of the brow's length by equal shares of its hairs: in proportion to its width, and
/// fewer at the ends.
struct Spread {
    sums: Vec<f64>,
}

impl Spread {
    const STEPS: usize = 96;

    fn new(line: &BrowLine) -> Self {
        let mut sum = 0.0;
        let step = |i| {
            let s = (i as f64 + 0.5) / Self::STEPS as f64;
            let ends = smooth(-0.10, 0.26, s) * smooth(1.10, 0.78, s);
            sum += line.sample(7.0 * s).1 * ends;
            sum
        };
        Self {
            sums: (0..Self::STEPS).map(step).collect(),
        }
    }

    fn sample(&self, share: f64) -> f64 {
        let wanted = share * self.sums.last().copied().unwrap_or_default();
        let i = self
            .sums
            .partition_point(|&s| s < wanted)
            .min(Self::STEPS - 1);
        let before = if i > 0 { self.sums[i - 1] } else { 0.0 };
        (i as f64 + (wanted - before) / (self.sums[i] - before)) / Self::STEPS as f64
    }
}

/// A brow that is about to grow.
struct Brow<'a> {
    ground: BrowSkin<'a>,
    line: &'a BrowLine,
    spread: Spread,
    side: Side,
    seed: u64,
    params: &'a BrowParams,
    /// Difference in height and thickness from the other brow, -1..1.
    own: f64,
}

impl Brow<'_> {
    /// Converts a direction or position on the left brow to this one.
    fn turned(&self, v: DVec3) -> DVec3 {
        if self.side == Side::Left {
            v
        } else {
            mirror_vector(v)
        }
    }

    /// Builds hair number `hair`, whose root lies where `share` of the hairs are nearer to the
    /// inner end.
    fn strand(&self, hair: u64, share: f64, is_long: bool) -> Strand {
        let mut dice = StrandRandom {
            seed: self.seed ^ self.side.index() as u64,
            hair: hair + if is_long { 0 } else { 10_000 },
            next: 0,
        };
        let p = self.params;
        let s = self.spread.sample(share);
        let (middle, width) = self.line.sample(7.0 * s);
        let width = width * p.height * (1.0 + 0.16 * self.own);
        let along = self.line.sample(7.0 * s + 0.05).0 - self.line.sample(7.0 * s - 0.05).0;
        let along = along.with_z(0.0).normalize();
        let row = (0.50 * dice.normal()).clamp(-1.25, 1.25);
        let aside = DVec3::new(-along.y, along.x, 0.0);
        let root = middle + aside * (row * width * 0.85) + DVec3::Y * (0.7 * self.own);
        let [stand, meet, length] = growth(s);
        let stray = (0.06 + 0.24 * p.unruly) * dice.normal();
        let angle = stand - meet * row + stray;
        let toward = along * ops::cos(angle) + aside * ops::sin(angle);
        let (length, lift): (f64, &[f64]) = if is_long {
            (
                length * (0.68 + 0.42 * dice.unit()) * p.length,
                &LONG_LIFT_MM,
            )
        } else {
            (length * (0.30 + 0.25 * dice.unit()), &SHORT_LIFT_MM)
        };
        // They curve outward and down, back to the brow's line.
        let bend = (along * 0.30 - aside * (0.14 * (1.0 + row))) * ops::sin(angle).abs();
        let unruly = 1.0 + 0.9 * p.unruly * dice.unit();
        let last = (lift.len() - 1) as f64;
        let mut facing = DVec3::ZERO;
        let points = lift.iter().enumerate().map(|(i, &lift)| {
            let v = i as f64 / last;
            let place = root + (toward * v + bend * (v * v)) * length;
            let (skin, n) = self.ground.below(self.turned(place));
            facing += n;
            skin + n * (lift * unruly)
        });
        Strand {
            points: points.collect(),
            half_width: if is_long { 0.13 } else { 0.10 } * (0.75 + 0.5 * dice.unit()),
            facing: facing.normalize(),
            shade: 0.75 + 0.5 * dice.unit(),
            // Fainter at the brow's edges and its inner end.
            cover: if is_long { 0.95 } else { 0.62 }
                * (1.0 - 0.30 * row.abs())
                * (0.45 + 0.55 * smooth(-0.02, 0.14, s)),
        }
    }
}

/// Grows all hairs of a brow.
pub(super) fn brow(
    ride: &ScalpBinding,
    line: &BrowLine,
    side: Side,
    seed: u64,
    params: &BrowParams,
) -> Vec<Strand> {
    let brow = Brow {
        ground: BrowSkin::new(ride, side),
        line,
        spread: Spread::new(line),
        side,
        seed,
        params,
        own: 0.5 * params.asymmetry * side.sign() * (noise::unit(seed, 91, 0) + 0.5),
    };
    let grown = |usual: f64, is_long: bool| {
        let count = (usual * params.density.clamp(0.1, MAX_DENSITY)) as u64;
        let brow = &brow;
        (0..count).map(move |hair| {
            // Spread evenly, and shaken.
            let jitter = noise::unit(seed ^ 41, hair, side.index() as i64);
            brow.strand(hair, (hair as f64 + jitter) / count as f64, is_long)
        })
    };
    grown(SHORT_HAIRS, false)
        .chain(grown(LONG_HAIRS, true))
        .collect()
}
