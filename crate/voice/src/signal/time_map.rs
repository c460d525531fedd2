//! Mapping between times before and after a change of audio.

/// Map from times before an audio change to times after it: piecewise linear, increasing, starting
/// at (0, 0). Beyond the ends it continues with slope 1.
#[derive(Clone, Debug, PartialEq)]
pub struct TimeMap {
    /// Knees as (seconds before, seconds after), both rising strictly.
    knees: Vec<(f64, f64)>,
}

impl TimeMap {
    /// Returns the identity map.
    #[must_use]
    pub fn identity() -> Self {
        Self {
            knees: vec![(0.0, 0.0)],
        }
    }

    /// Returns a map of stretches in order: duration before in seconds, and its growth factor.
    /// Stretches whose length or factor is not positive and finite are skipped.
    #[must_use]
    pub fn from_stretches(stretches: impl IntoIterator<Item = (f64, f64)>) -> Self {
        let mut knees = vec![(0.0, 0.0)];
        let (mut before, mut after, mut slope) = (0.0, 0.0, f64::NAN);
        for (secs, factor) in stretches {
            let good = secs > 0.0 && factor > 0.0 && (secs * factor).is_finite();
            if !good || before + secs <= before || after + secs * factor <= after {
                continue;
            }
            before += secs;
            after += secs * factor;
            // An interval of the same factor extends the previous one.
            if factor == slope {
                knees.pop();
            }
            slope = factor;
            knees.push((before, after));
        }
        Self { knees }
    }

    /// Returns the knees (vertices) of the map as (seconds before, seconds after), from (0, 0) to
    /// the end.
    #[must_use]
    pub fn knees(&self) -> &[(f64, f64)] {
        &self.knees
    }

    /// Converts a time before the change to the time after it, seconds.
    #[must_use]
    pub fn after(&self, before_secs: f64) -> f64 {
        through(
            &self.knees,
            before_secs,
            |&(before, _)| before,
            |&(_, after)| after,
        )
    }

    /// Converts a time after the change to the time before it, seconds.
    #[must_use]
    pub fn before(&self, after_secs: f64) -> f64 {
        through(
            &self.knees,
            after_secs,
            |&(_, after)| after,
            |&(before, _)| before,
        )
    }
}

/// Interpolates linearly between the knots next to `at`, with slope 1 outside.
fn through(
    knees: &[(f64, f64)],
    at: f64,
    from: impl Fn(&(f64, f64)) -> f64,
    to: impl Fn(&(f64, f64)) -> f64,
) -> f64 {
    let above = knees.partition_point(|knee| from(knee) <= at);
    let low = &knees[above.saturating_sub(1)];
    match knees.get(above) {
        Some(high) if above > 0 => {
            let part = (at - from(low)) / (from(high) - from(low));
            to(low) + part * (to(high) - to(low))
        }
        _ => to(low) + (at - from(low)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn there_and_back_is_where_it_began() {
        let map = TimeMap::from_stretches([(1.0, 1.0), (0.5, 2.0), (0.5, 2.0), (1.0, 0.25)]);
        assert_eq!(
            map.knees(),
            &[(0.0, 0.0), (1.0, 1.0), (2.0, 3.0), (3.0, 3.25)]
        );
        assert!((map.after(1.5) - 2.0).abs() < 1e-12, "the mapped time");
        for i in -10..50 {
            let t = f64::from(i) * 0.1;
            assert!(
                (map.before(map.after(t)) - t).abs() < 1e-12,
                "the mapped time round trips"
            );
        }
        assert_eq!(map.after(4.0), 4.25);
        assert_eq!(TimeMap::identity().after(0.7), 0.7);
    }

    #[test]
    fn stretches_that_are_none_are_left_out() {
        let odd = [
            (f64::NAN, 1.0),
            (1.0, 0.0),
            (-1.0, 2.0),
            (1.0, f64::INFINITY),
        ];
        assert_eq!(TimeMap::from_stretches(odd), TimeMap::identity());
    }
}
