//! Marks on the skin: lines and spots, found by position.
//!
//! A mark is a short stroke between two points, or a spot if both coincide. Long lines are chains
//! of strokes that taper, tremble and break off as real ones do.

use raconteur_base::{DVec3, noise, ops};

/// A stroke on the surface.
#[derive(Clone, Copy, Debug)]
struct Stroke {
    from: DVec3,
    to: DVec3,
    /// Strength at both ends.
    strength: [f64; 2],
    /// Radius at which it has fallen to 1/e, mm.
    width: f64,
}

/// Side of a search cell, mm.
const CELL_MM: f64 = 4.0;
/// Reach of a stroke, in widths.
const REACH: f64 = 3.2;
/// Strokes further than this along the surface's normal are on another fold of the skin, mm.
const DEPTH_MM: f64 = 5.0;

/// Effect of skin marks at a position: the mark itself and the raised bank next to it.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct MarkCoverage {
    /// The strongest mark, its strength times exp(−(distance / width)²).
    pub(crate) core: f64,
    /// Strength of the bank next to it, on the same scale.
    pub(crate) bank: f64,
}

/// Drawing style of a mark's line: strength, width and irregularity.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pen {
    /// Strength in the middle of the line.
    pub(crate) strength: f64,
    /// Width of its strokes, mm.
    pub(crate) width: f64,
    /// Lateral wander, mm.
    pub(crate) wander: f64,
    /// Share of its length that is lost to gaps, 0..1.
    pub(crate) broken: f64,
    /// Variation of its strength along the line, 0..1.
    pub(crate) unsteady: f64,
    /// Seed of the line.
    pub(crate) seed: u64,
}

/// Set of skin marks with a spatial grid, for fast lookup by position.
#[derive(Clone, Debug, Default)]
pub(crate) struct Marks {
    strokes: Vec<Stroke>,
    low: DVec3,
    size: [usize; 3],
    /// Strokes of each cell: `listed[starts[c]..starts[c + 1]]`.
    starts: Vec<u32>,
    listed: Vec<u32>,
}

impl Marks {
    /// Adds a spot.
    pub(crate) fn spot(&mut self, at: DVec3, strength: f64, radius: f64) {
        self.strokes.push(Stroke {
            from: at,
            to: at,
            strength: [strength; 2],
            width: radius,
        });
    }

    /// Adds a line through a few points: rounded, tapered at both ends, trembling.
    pub(crate) fn line(&mut self, through: &[DVec3], pen: Pen) {
        if pen.strength <= 0.0 || through.len() < 2 {
            return;
        }
        let smooth = rounded(through);
        let whole: f64 = smooth.windows(2).map(|w| w[0].distance(w[1])).sum();
        let mut gone = 0.0;
        let mut last: Option<(DVec3, f64)> = None;
        for (i, &p) in smooth.iter().enumerate() {
            if i > 0 {
                gone += p.distance(smooth[i - 1]);
            }
            let t = gone / whole.max(1e-9);
            let wave = |id: u64, mm: f64| noise::perlin(pen.seed, id, gone / mm + 0.37);
            let sway = DVec3::new(wave(1, 7.0), wave(2, 7.0), wave(3, 7.0)) * pen.wander
                + DVec3::new(wave(4, 2.3), wave(5, 2.3), wave(6, 2.3)) * (0.3 * pen.wander);
            let taper = (ops::sin(core::f64::consts::PI * t.clamp(0.0, 1.0)).max(0.0)).sqrt();
            let gap = 1.0 - 1.6 * pen.broken * (0.55 + wave(7, 9.0)).clamp(0.0, 1.0);
            let vary = 1.0 + pen.unsteady * wave(8, 4.0);
            let strength = pen.strength * taper * gap.clamp(0.0, 1.0) * vary;
            let now = (p + sway, strength);
            if let Some(before) = last {
                self.strokes.push(Stroke {
                    from: before.0,
                    to: now.0,
                    strength: [before.1, now.1],
                    width: pen.width,
                });
            }
            last = Some(now);
        }
    }

    /// Sorts the strokes into cells; call once, after the last mark.
    pub(crate) fn finish(mut self) -> Self {
        let around = |s: &Stroke| {
            let r = DVec3::splat(REACH * s.width);
            // Along the normal the search must reach further.
            let r = r.max(DVec3::splat(DEPTH_MM * 0.5));
            (s.from.min(s.to) - r, s.from.max(s.to) + r)
        };
        let Some(first) = self.strokes.first() else {
            return self;
        };
        let (mut low, mut high) = around(first);
        for s in &self.strokes {
            let (a, b) = around(s);
            (low, high) = (low.min(a), high.max(b));
        }
        self.low = low;
        self.size = ((high - low) / CELL_MM).to_array().map(|x| x as usize + 1);
        let mut pairs: Vec<(u32, u32)> = Vec::new();
        for (i, s) in (0u32..).zip(&self.strokes) {
            let (a, b) = around(s);
            let [a, b] = [a, b].map(|p| ((p - low) / CELL_MM).to_array().map(|x| x as usize));
            for x in a[0]..=b[0] {
                for y in a[1]..=b[1] {
                    for z in a[2]..=b[2] {
                        pairs.push((self.cell([x, y, z]) as u32, i));
                    }
                }
            }
        }
        pairs.sort_unstable();
        let cells: usize = self.size.iter().product();
        self.starts = Vec::with_capacity(cells + 1);
        let mut at = 0;
        for cell in 0..=cells {
            while at < pairs.len() && (pairs[at].0 as usize) < cell {
                at += 1;
            }
            self.starts.push(at as u32);
        }
        self.listed = pairs.into_iter().map(|p| p.1).collect();
        self
    }

    fn cell(&self, [x, y, z]: [usize; 3]) -> usize {
        (x * self.size[1] + y) * self.size[2] + z
    }

    /// Returns the marks at a position of the surface with a unit normal.
    pub(crate) fn sample(&self, p: DVec3, normal: DVec3) -> MarkCoverage {
        let mut felt = MarkCoverage::default();
        let q = (p - self.low) / CELL_MM;
        if self.starts.is_empty() || q.min_element() < 0.0 {
            return felt;
        }
        let index = q.to_array().map(|x| x as usize);
        if (0..3).any(|i| index[i] >= self.size[i]) {
            return felt;
        }
        let cell = self.cell(index);
        let range = self.starts[cell] as usize..self.starts[cell + 1] as usize;
        for &i in &self.listed[range] {
            let s = &self.strokes[i as usize];
            let along = s.to - s.from;
            let t = ((p - s.from).dot(along) / along.length_squared().max(1e-12)).clamp(0.0, 1.0);
            let off = p - s.from - along * t;
            let lift = off.dot(normal);
            if lift.abs() > DEPTH_MM {
                continue;
            }
            let d2 = (off.length_squared() - lift * lift).max(0.0) / (s.width * s.width);
            if d2 > REACH * REACH {
                continue;
            }
            let strength = s.strength[0] + (s.strength[1] - s.strength[0]) * t;
            felt.core = felt.core.max(strength * ops::exp(-d2));
            let beside = d2.sqrt() - 1.9;
            felt.bank = felt.bank.max(strength * ops::exp(-beside * beside * 1.8));
        }
        felt
    }
}

/// Returns a Catmull–Rom line through the points, a step every 0.8 mm.
fn rounded(through: &[DVec3]) -> Vec<DVec3> {
    let n = through.len();
    let mut out = vec![through[0]];
    for i in 0..n - 1 {
        let (b, c) = (through[i], through[i + 1]);
        let a = if i == 0 { b * 2.0 - c } else { through[i - 1] };
        let d = if i + 2 == n {
            c * 2.0 - b
        } else {
            through[i + 2]
        };
        let steps = (b.distance(c) / 0.8).ceil().clamp(1.0, 400.0) as usize;
        for k in 1..=steps {
            let t = k as f64 / steps as f64;
            let (t2, t3) = (t * t, t * t * t);
            out.push(
                (b * 2.0
                    + (c - a) * t
                    + (a * 2.0 - b * 5.0 + c * 4.0 - d) * t2
                    + (b * 3.0 - a - c * 3.0 + d) * t3)
                    * 0.5,
            );
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn marks_are_felt_where_they_lie_and_nowhere_else() {
        let mut marks = Marks::default();
        let pen = Pen {
            strength: 1.0,
            width: 0.5,
            wander: 0.0,
            broken: 0.0,
            unsteady: 0.45,
            seed: 1,
        };
        marks.line(&[DVec3::ZERO, DVec3::X * 20.0], pen);
        marks.spot(DVec3::new(0.0, 9.0, 0.0), 0.7, 1.0);
        let marks = marks.finish();
        let at = |x: f64, y: f64, z: f64| marks.sample(DVec3::new(x, y, z), DVec3::Z).core;
        assert!(
            at(10.0, 0.0, 0.0) > 0.5,
            "the mark is visible at its centre"
        );
        // Height over the surface does not count; the other side of a fold does.
        assert!(
            (at(10.0, 0.0, 1.0) - at(10.0, 0.0, 0.0)).abs() < 1e-9,
            "the height above the surface does not count"
        );
        assert_eq!(at(10.0, 0.0, 8.0), 0.0);
        assert_eq!(at(10.0, 3.0, 0.0), 0.0);
        assert!(
            (at(0.0, 9.0, 0.0) - 0.7).abs() < 1e-9,
            "the strength of the spot"
        );
        assert_eq!(at(500.0, 0.0, 0.0), 0.0);
        assert_eq!(
            Marks::default().finish().sample(DVec3::ZERO, DVec3::Z).core,
            0.0
        );
    }
}
