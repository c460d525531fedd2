//! Property over time: constant values with linear transitions, and its integral.

use raconteur_base::curve::{last_at_or_before, ramp};

/// Piecewise linear function of time with its integral; holds properties of animation tracks such
/// as speed and weight.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct PiecewiseLinear {
    /// Start times of the transitions.
    from: Vec<f64>,
    segments: Vec<LinearSegment>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct LinearSegment {
    to_secs: f64,
    from: f64,
    to: f64,
    /// Integral of the value up to the beginning.
    before: f64,
}

impl LinearSegment {
    fn value(&self, from_secs: f64, t: f64) -> f64 {
        self.from + (self.to - self.from) * ramp(from_secs, self.to_secs, t)
    }

    /// Returns the integral from the start of the segment (`from_secs`) to time `t`.
    fn integral(&self, from_secs: f64, t: f64) -> f64 {
        let sloping = (t.min(self.to_secs) - from_secs).max(0.0);
        let mean = 0.5 * (self.from + self.value(from_secs, t.min(self.to_secs)));
        let level = t - from_secs - sloping;
        // The first value applies before time 0.
        if t < from_secs {
            return self.from * level;
        }
        mean * sloping + self.to * level
    }
}

impl PiecewiseLinear {
    /// Creates a function with the same value at all times.
    pub(crate) fn constant(value: f64) -> Self {
        Self {
            from: vec![0.0],
            segments: vec![LinearSegment {
                to_secs: 0.0,
                from: value,
                to: value,
                before: 0.0,
            }],
        }
    }

    fn piece(&self, t: f64) -> (f64, &LinearSegment) {
        let i = last_at_or_before(&self.from, t).unwrap_or(0);
        (self.from[i], &self.segments[i])
    }

    /// Returns the value at time `t`, seconds.
    pub(crate) fn sample(&self, t: f64) -> f64 {
        let (from_secs, piece) = self.piece(t);
        piece.value(from_secs, t)
    }

    /// Returns the integral from time 0 to `t`, seconds.
    pub(crate) fn integral(&self, t: f64) -> f64 {
        let (from_secs, piece) = self.piece(t);
        piece.before + piece.integral(from_secs, t)
    }

    /// Starts a transition to `value` at `t` that takes `length_secs`. `t` must not precede earlier
    /// transitions.
    pub(crate) fn set(&mut self, t: f64, value: f64, length_secs: f64) {
        let piece = LinearSegment {
            to_secs: t + length_secs,
            from: self.sample(t),
            to: value,
            before: self.integral(t),
        };
        self.from.push(t);
        self.segments.push(piece);
    }

    /// Returns the first time from `t` on at which the integral equals `target`; `None` if it never
    /// does.
    pub(crate) fn time_of_integral(&self, t: f64, target: f64) -> Option<f64> {
        let first = last_at_or_before(&self.from, t).unwrap_or(0);
        for i in first..self.segments.len() {
            let piece = &self.segments[i];
            let (begin, middle) = (self.from[i].max(t), piece.to_secs.max(self.from[i]).max(t));
            let end = self.from.get(i + 1).copied().unwrap_or(f64::INFINITY);
            for (a, b) in [(begin, middle.min(end)), (middle.min(end), end)] {
                if let Some(found) = self.crossing(a, b, target) {
                    return Some(found);
                }
            }
        }
        None
    }

    /// Returns the time at which the integral first reaches `target` between two times with linear
    /// value.
    fn crossing(&self, a: f64, b: f64, target: f64) -> Option<f64> {
        let missing = target - self.integral(a);
        if missing <= 0.0 {
            return Some(a);
        }
        let speed = self.sample(a);
        if b <= a {
            return None;
        }
        let acceleration = if b.is_finite() {
            (self.sample(b.next_down()) - speed) / (b - a)
        } else {
            0.0
        };
        // missing = speed · x + acceleration · x² / 2, in a form that bears a zero of either.
        let root = speed * speed + 2.0 * acceleration * missing;
        if root < 0.0 {
            return None;
        }
        let divisor = speed + root.sqrt();
        let x = 2.0 * missing / divisor;
        (divisor > 0.0 && a + x <= b).then_some(a + x)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_integral_is_that_of_the_value() {
        let mut r = PiecewiseLinear::constant(1.0);
        r.set(2.0, 3.0, 1.0);
        r.set(2.5, 0.0, 2.0);
        r.set(7.0, -1.0, 0.0);
        let (mut sum, h) = (0.0, 1e-4);
        for i in 0..100_000 {
            let t = f64::from(i) * h;
            assert!((r.integral(t) - sum).abs() < 1e-3, "at {t}");
            sum += h * r.sample(t + 0.5 * h);
        }
        assert_eq!(
            (r.sample(1.0), r.sample(2.25), r.sample(9.0)),
            (1.0, 1.5, -1.0)
        );
        assert!(
            (r.sample(2.5) - 2.0).abs() < 1e-12 && (r.sample(3.5) - 1.0).abs() < 1e-12,
            "the samples between keys are linear"
        );
        assert_eq!(r.integral(-1.0), -1.0);
    }

    #[test]
    fn the_time_of_a_sum_is_found() {
        let mut r = PiecewiseLinear::constant(1.0);
        r.set(2.0, 3.0, 1.0);
        r.set(5.0, 0.0, 2.0);
        for target in [0.5, 2.0, 2.7, 4.0, 9.0, 11.0, 12.9] {
            let t = r.time_of_integral(0.0, target).expect("reached");
            assert!((r.integral(t) - target).abs() < 1e-6, "{target}: {t}");
        }
        // 2 + 2 + 6 + 3: there is no more.
        assert_eq!(r.time_of_integral(0.0, 13.5), None);
        assert_eq!(r.time_of_integral(4.0, 1.0), Some(4.0));
    }
}
