//! Keyed curves over the time of a clip for rotations, positions and angles.

use raconteur_base::curve::hermite;
use raconteur_base::{DQuat, Length};

/// Interpolation of a clip track between its keys.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Ease {
    /// Smoothly through, without overshoot: the speed at a key is the harmonic mean of those
    /// around it, and zero where the direction turns.
    #[default]
    Flow,
    /// Coming to rest at each key.
    Rest,
    /// Linear interpolation between keys, at constant speed.
    Linear,
    /// Holds each value until the next key.
    Step,
}

impl Ease {
    /// Names of the interpolation modes in the clip format.
    pub const WORDS: [(&'static str, Self); 4] = [
        ("flow", Self::Flow),
        ("rest", Self::Rest),
        ("linear", Self::Linear),
        ("step", Self::Step),
    ];
}

/// Keyed curve of four numbers over clip time, seconds; holds rotations, positions and angles. A
/// rotation is x, y, z, w and is normalised after reading.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Curve {
    times: Vec<f64>,
    values: Vec<[f64; 4]>,
    /// Change per second at each key; empty for linear and held curves.
    slopes: Vec<[f64; 4]>,
    held: bool,
}

impl Curve {
    /// Creates a curve through keys with ascending times, seconds. With `period` the curve is
    /// closed: the last key, one period earlier, precedes the first. `times` and `values` have the
    /// same non-zero length.
    #[must_use]
    pub fn new(times: &[f64], values: &[[f64; 4]], ease: Ease, period: Option<f64>) -> Self {
        let mut times = times.to_vec();
        let mut values = values.to_vec();
        if let Some(period) = period {
            close(&mut times, &mut values, period);
        }
        let slopes = match ease {
            Ease::Linear | Ease::Step => Vec::new(),
            Ease::Rest => vec![[0.0; 4]; times.len()],
            Ease::Flow => flowing(&times, &values, period),
        };
        Self {
            times,
            values,
            slopes,
            held: ease == Ease::Step,
        }
    }

    /// Creates the curve from rotations. Neighbouring keys are taken on one half of the sphere, so
    /// the interpolation follows the short path.
    #[must_use]
    pub fn of_rotations(
        times: &[f64],
        rotations: &[DQuat],
        ease: Ease,
        period: Option<f64>,
    ) -> Self {
        let mut last = DQuat::IDENTITY;
        let values: Vec<[f64; 4]> = rotations
            .iter()
            .map(|&q| {
                last = if last.dot(q) < 0.0 { -q } else { q };
                last.to_array()
            })
            .collect();
        Self::new(times, &values, ease, period)
    }

    /// Returns the value at a time, seconds; the first key's before it, the last key's after it.
    /// O(log n).
    #[must_use]
    pub fn sample(&self, time_secs: f64) -> [f64; 4] {
        let next = self.times.partition_point(|&t| t <= time_secs);
        let Some(i) = next.checked_sub(1) else {
            return self.values[0];
        };
        if next >= self.times.len() || self.held {
            return self.values[i];
        }
        let length = self.times[next] - self.times[i];
        let s = (time_secs - self.times[i]) / length;
        let (a, b) = (&self.values[i], &self.values[next]);
        core::array::from_fn(|k| {
            if self.slopes.is_empty() {
                a[k] + (b[k] - a[k]) * s
            } else {
                let [from, to] = [i, next].map(|key| self.slopes[key][k] * length);
                hermite(a[k], from, b[k], to, s)
            }
        })
    }

    /// Returns the curve's value at a time, seconds, as a unit quaternion.
    #[must_use]
    pub fn rotation_at(&self, time_secs: f64) -> DQuat {
        let next = self.times.partition_point(|&t| t <= time_secs);
        if self.slopes.is_empty() && !self.held && next > 0 && next < self.times.len() {
            // Componentwise, the speed would not be constant.
            let [from, to] = [next - 1, next].map(|i| DQuat::from_array(self.values[i]));
            let s = (time_secs - self.times[next - 1]) / (self.times[next] - self.times[next - 1]);
            return from.slerp(to, s);
        }
        let q = DQuat::from_array(self.sample(time_secs));
        if q.length_squared() > 1e-12 {
            q.normalized()
        } else {
            DQuat::IDENTITY
        }
    }
}

/// Difference below which two key times count as equal, seconds.
const SAME_SECS: f64 = 1e-6;

/// Adds the keys just outside a period, so the period begins and ends within keys.
fn close(times: &mut Vec<f64>, values: &mut Vec<[f64; 4]>, period: f64) {
    let n = times.len();
    let (first, last) = (times[0], times[n - 1]);
    let (at_first, at_last) = (values[0], values[n - 1]);
    // q and −q are the same rotation; the nearer sign avoids an extra turn.
    let near = |v: [f64; 4], to: [f64; 4]| {
        let dot: f64 = v.iter().zip(to).map(|(a, b)| a * b).sum();
        let unit = |q: [f64; 4]| (q.iter().map(|x| x * x).sum::<f64>() - 1.0).abs() < 1e-9;
        if dot < 0.0 && unit(v) && unit(to) {
            v.map(|x| -x)
        } else {
            v
        }
    };
    if last < period - SAME_SECS {
        times.push(first + period);
        values.push(near(at_first, at_last));
    }
    if first > SAME_SECS {
        times.insert(0, last - period);
        values.insert(0, near(at_last, at_first));
    }
}

/// Slopes that pass through the keys without overshoot (the harmonic mean of Fritsch and
/// Butland 1984, doi:10.1137/0905021).
fn flowing(times: &[f64], values: &[[f64; 4]], period: Option<f64>) -> Vec<[f64; 4]> {
    let n = times.len();
    let secant = |i: usize, k: usize| {
        let h = times[i + 1] - times[i];
        (values[i + 1][k] - values[i][k]) / h
    };
    let mean = |a: f64, b: f64| {
        if a * b > 0.0 {
            2.0 * a * b / (a + b)
        } else {
            0.0
        }
    };
    let spans_period =
        period.is_some_and(|p| n > 2 && (times[n - 1] - times[0] - p).abs() < SAME_SECS);
    let mut slopes: Vec<[f64; 4]> = (0..n)
        .map(|i| {
            core::array::from_fn(|k| {
                if i > 0 && i + 1 < n {
                    mean(secant(i - 1, k), secant(i, k))
                } else if spans_period {
                    mean(secant(n - 2, k), secant(0, k))
                } else {
                    0.0
                }
            })
        })
        .collect();
    if period.is_some() && n > 3 && !spans_period {
        // The keys outside the period are the last and the first ones again.
        slopes[0] = slopes[n - 2];
        slopes[n - 1] = slopes[1];
    }
    slopes
}

#[cfg(test)]
mod tests {
    use super::*;

    fn curve(times: &[f64], values: &[f64], ease: Ease, period: Option<f64>) -> Curve {
        let values: Vec<[f64; 4]> = values.iter().map(|v| [*v, 0.0, 0.0, 0.0]).collect();
        Curve::new(times, &values, ease, period)
    }

    #[test]
    fn keys_are_met_and_never_overshot() {
        let times = [0.0, 0.5, 0.7, 2.0];
        let values = [1.0, 4.0, 4.5, -2.0];
        for (_, ease) in Ease::WORDS {
            let c = curve(&times, &values, ease, None);
            for (t, v) in times.iter().zip(values) {
                assert!((c.sample(*t)[0] - v).abs() < 1e-12, "{ease:?} at {t}");
            }
            for i in 0..=200 {
                let v = c.sample(f64::from(i) * 0.01)[0];
                assert!((-2.0..=4.5).contains(&v), "{ease:?} {v}");
            }
        }
        assert_eq!(
            curve(&times, &values, Ease::Step, None).sample(0.49)[0],
            1.0
        );
        assert_eq!(
            curve(&times, &values, Ease::Flow, None).sample(9.0)[0],
            -2.0
        );
    }

    #[test]
    fn a_closed_curve_meets_itself_in_value_and_speed() {
        for times in [&[0.0, 0.3, 0.6, 1.0][..], &[0.1, 0.4, 0.8, 0.9]] {
            let values = if times[0] == 0.0 {
                [0.0, 2.0, -1.0, 0.0]
            } else {
                [0.5, 2.0, -1.0, 0.0]
            };
            let c = curve(times, &values, Ease::Flow, Some(1.0));
            let h = 1e-6;
            assert!(
                (c.sample(0.0)[0] - c.sample(1.0 - 1e-12)[0]).abs() < 1e-9,
                "a closed curve has the same value at both ends"
            );
            let start = (c.sample(h)[0] - c.sample(0.0)[0]) / h;
            let end = (c.sample(1.0 - h)[0] - c.sample(1.0 - 2.0 * h)[0]) / h;
            assert!((start - end).abs() < 1e-3, "{start} {end}");
        }
    }

    #[test]
    fn rotations_take_the_short_way() {
        let a = DQuat::from_rotation_x(0.2);
        let b = -DQuat::from_rotation_x(1.0);
        let c = Curve::of_rotations(&[0.0, 1.0], &[a, b], Ease::Rest, None);
        for i in 0..=10 {
            let q = c.rotation_at(f64::from(i) * 0.1);
            assert!(q.is_normalized(), "the rotation is normalised");
            assert!(
                q.angle_between(DQuat::from_rotation_x(0.6)) < 0.41,
                "the interpolated rotation takes the short way"
            );
        }
    }
}
