//! Irregular patterns in space: smooth noise and the cells of the skin's fine relief.

use raconteur_base::{DVec3, noise};

/// Returns a hash of a lattice point. Coordinates stay far below 2²⁰ cells.
fn lattice(seed: u64, x: i64, y: i64, z: i64) -> u64 {
    let id = (x & 0xF_FFFF) << 20 | (y & 0xF_FFFF);
    noise::hash(seed, id as u64, z)
}

/// Returns smooth value noise, −1..1, with one cell per unit.
pub(crate) fn space_noise(seed: u64, p: DVec3) -> f64 {
    let cell = p.floor();
    let f = p - cell;
    let s = f * f * (3.0 - 2.0 * f);
    let [x, y, z] = cell.to_array().map(|c| c as i64);
    let at = |dx: i64, dy: i64, dz: i64| {
        let h = lattice(seed, x + dx, y + dy, z + dz);
        (h >> 40) as f64 / f64::from(1u32 << 23) - 1.0
    };
    let mix = |a: f64, b: f64, t: f64| a + (b - a) * t;
    let plane = |dz: i64| {
        let low = mix(at(0, 0, dz), at(1, 0, dz), s.x);
        mix(low, mix(at(0, 1, dz), at(1, 1, dz), s.x), s.y)
    };
    mix(plane(0), plane(1), s.z)
}

/// Distances to the nearest and the second nearest of points scattered one to a cell
/// (Worley 1996, doi:10.1145/237170.237267), and a number 0..1 of the nearest.
pub(crate) fn cells(seed: u64, p: DVec3) -> (f64, f64, f64) {
    let cell = p.floor();
    let [x, y, z] = cell.to_array().map(|c| c as i64);
    let f = p - cell;
    let (mut first, mut second, mut name) = (9.0f64, 9.0f64, 0u64);
    for dx in -1..=1i64 {
        for dy in -1..=1i64 {
            for dz in -1..=1i64 {
                let h = lattice(seed, x + dx, y + dy, z + dz);
                // Three numbers of 20 bits.
                let part = |shift: u32| (h >> shift & 0xF_FFFF) as f64 / f64::from(1u32 << 20);
                let q = DVec3::new(
                    dx as f64 + part(0),
                    dy as f64 + part(20),
                    dz as f64 + part(40),
                );
                let d = q.distance_squared(f);
                if d < first {
                    (second, first, name) = (first, d, h);
                } else if d < second {
                    second = d;
                }
            }
        }
    }
    (
        first.sqrt(),
        second.sqrt(),
        (name >> 44) as f64 / f64::from(1u32 << 20),
    )
}

/// Smooth step from 0 at `a` to 1 at `b`.
pub(crate) fn rise(a: f64, b: f64, x: f64) -> f64 {
    let t = ((x - a) / (b - a)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// Blends two colours linearly.
pub(crate) fn mix(a: [f64; 3], b: [f64; 3], t: f64) -> [f64; 3] {
    core::array::from_fn(|i| a[i] + (b[i] - a[i]) * t)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn patterns_are_bounded_and_continuous() {
        let mut last = (0.0, 0.0);
        for i in 0..4000 {
            let p = DVec3::new(0.01, 0.004, -0.007) * f64::from(i) - DVec3::splat(11.3);
            let n = space_noise(4, p);
            let (a, b, name) = cells(5, p);
            assert!(
                n.abs() <= 1.0 && a <= b && a < 1.8 && (0.0..=1.0).contains(&name),
                "the noise and the pattern stay in their ranges"
            );
            if i > 0 {
                assert!(
                    (n - last.0).abs() < 0.08 && (a - last.1).abs() < 0.02,
                    "the noise and the pattern are continuous"
                );
            }
            last = (n, a);
        }
    }
}
