//! Scalar curves over a normalised parameter, and keyed values over time.

/// Returns the linear interpolation from `a` (`s` = 0) to `b` (`s` = 1).
#[must_use]
pub fn lerp(a: f64, b: f64, s: f64) -> f64 {
    a + (b - a) * s
}

/// Returns 0 below `from`, 1 above `to`, linear between. Equal ends give a step.
#[must_use]
pub fn ramp(from: f64, to: f64, x: f64) -> f64 {
    if to <= from {
        return if x < from { 0.0 } else { 1.0 };
    }
    ((x - from) / (to - from)).clamp(0.0, 1.0)
}

/// Returns the cubic Hermite step of `s` clamped to [0, 1]: 0 to 1 with zero slope at both ends.
#[must_use]
pub fn smooth(s: f64) -> f64 {
    let s = s.clamp(0.0, 1.0);
    s * s * (3.0 - 2.0 * s)
}

/// Returns the minimum-jerk position profile of `s` clamped to [0, 1] (Flash and Hogan 1985,
/// doi:10.1523/JNEUROSCI.05-07-01688.1985): speed and acceleration are zero at both ends, peak to
/// mean speed is 1.875.
#[must_use]
pub fn minimum_jerk(s: f64) -> f64 {
    let s = s.clamp(0.0, 1.0);
    s * s * s * (s * (s * 6.0 - 15.0) + 10.0)
}

/// Returns a cubic Hermite segment between values `a` and `b` with slopes `da` and `db` per unit of
/// `s` in [0, 1].
#[must_use]
pub fn hermite(a: f64, da: f64, b: f64, db: f64, s: f64) -> f64 {
    let s2 = s * s;
    let s3 = s2 * s;
    a * (2.0 * s3 - 3.0 * s2 + 1.0)
        + da * (s3 - 2.0 * s2 + s)
        + b * (3.0 * s2 - 2.0 * s3)
        + db * (s3 - s2)
}

/// Returns the index of the last entry of `times` (ascending) that is not after `t`, or `None` when
/// `t` lies before the first. O(log n).
#[must_use]
pub fn last_at_or_before(times: &[f64], t: f64) -> Option<usize> {
    times.partition_point(|&x| x <= t).checked_sub(1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn minimum_jerk_has_its_known_peak_to_mean_speed() {
        let n = 10_000;
        let h = 1.0 / f64::from(n);
        let peak = (0..n)
            .map(|i| (minimum_jerk(f64::from(i + 1) * h) - minimum_jerk(f64::from(i) * h)) / h)
            .fold(0.0, f64::max);
        assert!((peak - 1.875).abs() < 1e-3, "{peak}");
    }

    #[test]
    fn hermite_meets_values_and_slopes() {
        assert_eq!(hermite(2.0, 5.0, 3.0, -1.0, 0.0), 2.0);
        assert_eq!(hermite(2.0, 5.0, 3.0, -1.0, 1.0), 3.0);
        let h = 1e-6;
        let slope = (hermite(2.0, 5.0, 3.0, -1.0, h) - 2.0) / h;
        assert!(
            (slope - 5.0).abs() < 1e-4,
            "the slope at the end of the Hermite curve"
        );
    }

    #[test]
    fn a_search_before_the_first_key_finds_nothing() {
        assert_eq!(last_at_or_before(&[1.0, 2.0], 0.5), None);
        assert_eq!(last_at_or_before(&[1.0, 2.0], 1.0), Some(0));
        assert_eq!(last_at_or_before(&[1.0, 2.0], 9.0), Some(1));
    }
}
