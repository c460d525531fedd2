//! Seeded randomness as a pure function of (seed, id, time bucket).
//!
//! No generator has a running state, because playing to a time and seeking to it must give the same
//! value.

/// Returns a 64-bit hash of the three arguments (SplitMix64 finaliser, Steele et al. 2014,
/// doi:10.1145/2660193.2660195), the base of all seeded noise. `bucket` is usually a time step.
#[must_use]
pub fn hash(seed: u64, id: u64, bucket: i64) -> u64 {
    let mut z = seed
        .wrapping_add(id.wrapping_mul(0x9E37_79B9_7F4A_7C15))
        .wrapping_add((bucket as u64).wrapping_mul(0xD1B5_4A32_D192_ED03));
    for _ in 0..2 {
        z = z.wrapping_add(0x9E37_79B9_7F4A_7C15);
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^= z >> 31;
    }
    z
}

/// Returns a uniform pseudorandom number in [0, 1) for seed, stream `id` and time `bucket`.
#[must_use]
pub fn unit(seed: u64, id: u64, bucket: i64) -> f64 {
    (hash(seed, id, bucket) >> 11) as f64 / (1u64 << 53) as f64
}

/// Returns a uniform pseudorandom number in [−1, 1) for seed, stream `id` and time `bucket`.
#[must_use]
pub fn signed(seed: u64, id: u64, bucket: i64) -> f64 {
    2.0 * unit(seed, id, bucket) - 1.0
}

/// Returns an approximately normal number with mean 0 and variance 1, within ±3.5, from four
/// uniform numbers in [0, 1), each with variance 1/12.
#[must_use]
pub fn normal(uniform: [f64; 4]) -> f64 {
    let sum: f64 = uniform.iter().sum();
    (sum - 2.0) * 1.732
}

/// Returns one-dimensional gradient noise (Perlin 2002, doi:10.1145/566570.566636) within [−1, 1]:
/// smooth to the second derivative, zero at the integers. `x` has a period of about 1; scale time
/// by the frequency before calling.
#[must_use]
pub fn perlin(seed: u64, id: u64, x: f64) -> f64 {
    let cell = x.floor();
    let f = x - cell;
    let bucket = cell as i64;
    let left = signed(seed, id, bucket) * f;
    let right = signed(seed, id, bucket.wrapping_add(1)) * (f - 1.0);
    let fade = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
    // In the worst case, two gradients of at most 1 meet at 0.5.
    2.0 * (left + (right - left) * fade)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_of_four_have_the_moments_of_a_normal_distribution() {
        let n = 20_000;
        let draw = |i| normal(core::array::from_fn(|k| unit(7, k as u64, i)));
        let moment = |power| (0..n).map(|i| draw(i).powi(power)).sum::<f64>() / n as f64;
        // Standard errors of the mean and of the variance: 1 / sqrt(n) = 0.007, sqrt(1.7 / n) = 0.009.
        assert!(moment(1).abs() < 0.03, "mean {}", moment(1));
        assert!((moment(2) - 1.0).abs() < 0.04, "variance {}", moment(2));
        let ends = [normal([0.0; 4]), normal([1.0; 4])];
        assert_eq!(ends, [-3.464, 3.464]);
    }

    #[test]
    fn unit_values_are_uniform_enough() {
        let n = 20_000;
        let mean = (0..n).map(|i| unit(7, 3, i)).sum::<f64>() / n as f64;
        // Standard error of the mean of n uniforms is 0.289 / sqrt(n) = 0.002.
        assert!((mean - 0.5).abs() < 0.01, "mean {mean}");
    }

    #[test]
    fn perlin_is_bounded_and_continuous() {
        let mut last = perlin(1, 2, -3.0);
        for i in 1..6000 {
            let v = perlin(1, 2, -3.0 + f64::from(i) * 1e-3);
            assert!(v.abs() <= 1.0, "the noise stays between -1 and 1");
            assert!((v - last).abs() < 0.01, "the noise is continuous");
            last = v;
        }
    }
}
