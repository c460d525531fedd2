//! Values on a regular grid in space, interpolated between its points.

use raconteur_base::DVec3;

/// Regular box lattice of points in the frame of the hair, on which fields are sampled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Lattice {
    pub(super) low: DVec3,
    /// Distance of neighbours, metres.
    pub(super) pitch: f64,
    /// Points along x, y and z.
    pub(super) size: [usize; 3],
}

impl Lattice {
    pub(super) fn count(&self) -> usize {
        self.size.iter().product()
    }

    /// Returns the linear index of the lattice point at the cell x, y, z.
    pub(super) fn number(&self, [x, y, z]: [usize; 3]) -> usize {
        (x * self.size[1] + y) * self.size[2] + z
    }

    pub(super) fn cell(&self, number: usize) -> [usize; 3] {
        let [_, ny, nz] = self.size;
        [number / (ny * nz), number / nz % ny, number % nz]
    }

    pub(super) fn place(&self, [x, y, z]: [usize; 3]) -> DVec3 {
        self.low + DVec3::new(x as f64, y as f64, z as f64) * self.pitch
    }

    /// Returns the cell that contains a position and the offset in it, 0..1; clamped to the box.
    pub(super) fn below(&self, p: DVec3) -> ([usize; 3], DVec3) {
        let q = (p - self.low) / self.pitch;
        let last = self.size.map(|n| n as f64 - 1.001);
        let held = q.clamp(DVec3::ZERO, DVec3::from_array(last));
        let cell = held.floor();
        (cell.to_array().map(|c| c as usize), held - cell)
    }

    pub(super) fn contains(&self, p: DVec3) -> bool {
        let q = (p - self.low) / self.pitch;
        let last = DVec3::from_array(self.size.map(|n| n as f64 - 1.0));
        q.cmpge(DVec3::ZERO).all() && q.cmplt(last).all()
    }
}

/// Scalar field sampled at the points of a lattice.
#[derive(Clone, Debug)]
pub(super) struct Grid {
    pub(super) lattice: Lattice,
    pub(super) values: Vec<f32>,
}

impl Grid {
    pub(super) fn new(lattice: Lattice, at: impl Fn(usize) -> f32) -> Self {
        Self {
            lattice,
            values: (0..lattice.count()).map(at).collect(),
        }
    }

    /// Samples the grid at a position; clamped to the border outside the box.
    pub(super) fn sample(&self, p: DVec3) -> f64 {
        let ([x, y, z], f) = self.lattice.below(p);
        let [_, ny, nz] = self.lattice.size;
        let first = (x * ny + y) * nz + z;
        let row = |i: usize| {
            let (a, b) = (f64::from(self.values[i]), f64::from(self.values[i + 1]));
            a + (b - a) * f.z
        };
        let mix = |a: f64, b: f64, t: f64| a + (b - a) * t;
        mix(
            mix(row(first), row(first + nz), f.y),
            mix(row(first + ny * nz), row(first + ny * nz + nz), f.y),
            f.x,
        )
    }

    /// Returns the unit gradient of the field at a position: the direction in which values grow.
    pub(super) fn slope(&self, p: DVec3) -> DVec3 {
        let h = self.lattice.pitch;
        let along = |d: DVec3| self.sample(p + d) - self.sample(p - d);
        DVec3::new(
            along(DVec3::X * h),
            along(DVec3::Y * h),
            along(DVec3::Z * h),
        )
        .normalize_or(DVec3::Y)
    }

    /// Adds an amount to the eight grid points around a position, by trilinear weights.
    pub(super) fn splat(&mut self, p: DVec3, amount: f64) {
        if !self.lattice.contains(p) {
            return;
        }
        let (cell, f) = self.lattice.below(p);
        for corner in 0..8usize {
            let bit = |k: usize| corner >> k & 1;
            let share = |k: usize, f: f64| if bit(k) == 1 { f } else { 1.0 - f };
            let w = share(0, f.x) * share(1, f.y) * share(2, f.z);
            let at = [cell[0] + bit(0), cell[1] + bit(1), cell[2] + bit(2)];
            self.values[self.lattice.number(at)] += (amount * w) as f32;
        }
    }

    /// Returns the field blurred by three box filters of half width `reach` points: nearly a
    /// Gaussian of variance `reach (reach + 1)` in points.
    pub(super) fn blurred(&self, reach: usize) -> Self {
        let mut out = self.clone();
        let [nx, ny, nz] = self.lattice.size;
        let mut line = Vec::new();
        for (count, stride, others) in [
            (nx, ny * nz, [ny, nz]),
            (ny, nz, [nx, nz]),
            (nz, 1, [nx, ny]),
        ] {
            for a in 0..others[0] {
                for b in 0..others[1] {
                    let first = match stride {
                        1 => (a * ny + b) * nz,
                        s if s == nz => a * ny * nz + b,
                        _ => a * nz + b,
                    };
                    line.clear();
                    line.extend((0..count).map(|i| out.values[first + i * stride]));
                    for _ in 0..3 {
                        box_blur(&mut line, reach);
                    }
                    for (i, &x) in line.iter().enumerate() {
                        out.values[first + i * stride] = x;
                    }
                }
            }
        }
        out
    }
}

/// Replaces each value of a line by the mean over `reach` neighbours to either side; end values
/// extend beyond the ends.
fn box_blur(line: &mut [f32], reach: usize) {
    let n = line.len();
    let before = line.to_vec();
    let at = |i: isize| f64::from(before[i.clamp(0, n as isize - 1) as usize]);
    let r = reach as isize;
    let mut sum: f64 = (-r..=r).map(at).sum();
    let share = 1.0 / (2 * reach + 1) as f64;
    for (i, x) in (0..).zip(line.iter_mut()) {
        *x = (sum * share) as f32;
        sum += at(i + r + 1) - at(i - r);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lattice() -> Lattice {
        Lattice {
            low: DVec3::new(-1.0, -1.0, -1.0),
            pitch: 0.25,
            size: [9, 10, 11],
        }
    }

    #[test]
    fn between_points_numbers_are_linear() {
        let l = lattice();
        let f = |p: DVec3| 1.0 + 2.0 * p.x - p.y + 0.5 * p.z;
        let grid = Grid::new(l, |i| f(l.place(l.cell(i))) as f32);
        for p in [DVec3::new(0.1, 0.3, -0.7), DVec3::new(-0.9, 0.99, 0.2)] {
            assert!(
                (grid.sample(p) - f(p)).abs() < 1e-5,
                "the sample between grid points is linear"
            );
            let slope = DVec3::new(2.0, -1.0, 0.5).normalize();
            assert!(
                grid.slope(DVec3::ZERO).distance(slope) < 1e-4,
                "the slope at the centre of the grid"
            );
        }
    }

    #[test]
    fn blurring_keeps_what_is_even_and_the_sum_of_a_point() {
        let l = lattice();
        let even = Grid::new(l, |_| 3.0).blurred(2);
        assert!(
            even.values.iter().all(|x| (x - 3.0).abs() < 1e-5),
            "blurring keeps a constant field"
        );
        let mut dot = Grid::new(l, |_| 0.0);
        dot.splat(DVec3::ZERO, 1.0);
        let sum: f32 = dot.blurred(1).values.iter().sum();
        assert!((sum - 1.0).abs() < 1e-4, "{sum}");
    }
}
