//! Approximating B-spline curves over measured frames, and their extrema.

/// Frames between control points. Designed: 80 ms preserve the movement of an accent and remove
/// that of a phone.
const STEP: usize = 8;

/// Returns a cubic B-spline approximation of measured frames, one value per frame; each control
/// point is the mean of the frames around it. It adds no extremum beyond those of the control
/// points (variation diminishing; Schoenberg 1967).
pub(super) fn approximate(frames: &[f64]) -> Vec<f64> {
    if frames.is_empty() {
        return Vec::new();
    }
    let control = |j: usize| {
        // The first control point is one step before the first frame.
        let middle = (j * STEP).saturating_sub(STEP).min(frames.len() - 1);
        let from = middle.saturating_sub(STEP / 2);
        let around = &frames[from..(middle + STEP / 2 + 1).min(frames.len())];
        around.iter().sum::<f64>() / around.len() as f64
    };
    let controls: Vec<f64> = (0..frames.len() / STEP + 4).map(control).collect();
    let at = |i: usize| {
        let (c, u) = (&controls[i / STEP..], (i % STEP) as f64 / STEP as f64);
        let v = 1.0 - u;
        let near = |u: f64| 4.0 - 6.0 * u * u + 3.0 * u * u * u;
        (v * v * v * c[0] + near(u) * c[1] + near(v) * c[2] + u * u * u * c[3]) / 6.0
    };
    (0..frames.len()).map(at).collect()
}

/// Local extremum of a curve of measured frames.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Extremum {
    /// Index of the frame at which the extremum occurs.
    pub(super) frame: usize,
    /// True for a maximum.
    pub(super) is_max: bool,
}

/// Returns the extrema of a curve in order, alternating maxima and minima; its ends are extrema
/// too. A constant curve has none.
pub(super) fn extrema(curve: &[f64]) -> Vec<Extremum> {
    let mut found: Vec<Extremum> = Vec::new();
    for (i, pair) in curve.windows(2).enumerate() {
        if pair[0] == pair[1] {
            continue;
        }
        let is_max = pair[1] < pair[0];
        if found.last().is_none_or(|last| last.is_max != is_max) {
            let frame = if found.is_empty() { 0 } else { i };
            found.push(Extremum { frame, is_max });
        }
    }
    if let Some(&Extremum { is_max, .. }) = found.last() {
        found.push(Extremum {
            frame: curve.len() - 1,
            is_max: !is_max,
        });
    }
    found
}

/// Returns the frames of the inflection points on both sides of an extremum.
pub(super) fn between_turning_points(curve: &[f64], extremum: Extremum) -> (usize, usize) {
    let bends = |i: usize| {
        let Some([a, b, c]) = i.checked_sub(1).and_then(|from| curve.get(from..from + 3)) else {
            return false;
        };
        let bend = a - 2.0 * b + c;
        if extremum.is_max {
            bend <= 0.0
        } else {
            bend >= 0.0
        }
    };
    let (mut first, mut last) = (extremum.frame, extremum.frame);
    while bends(first) {
        first -= 1;
    }
    while bends(last) {
        last += 1;
    }
    (first, last)
}

#[cfg(test)]
mod tests {
    use super::*;
    use raconteur_base::ops;

    #[test]
    fn a_wave_keeps_its_extrema_and_loses_its_ripple() {
        let wave = |i: usize| {
            let t = i as f64 * 0.01;
            ops::sin(5.0 * t) + 0.05 * ops::sin(150.0 * t)
        };
        let frames: Vec<f64> = (0..400).map(wave).collect();
        let curve = approximate(&frames);
        assert_eq!(curve.len(), 400);
        let found = extrema(&curve);
        // Maxima of sin 5 t at 0.31, 1.57, 2.83; minima between; both ends.
        assert_eq!(found.len(), 8, "{found:?}");
        assert!(
            found.windows(2).all(|w| w[0].is_max != w[1].is_max),
            "maxima and minima alternate"
        );
        assert!(
            found[1].is_max && found[1].frame.abs_diff(31) < 3,
            "the second extremum is the maximum near frame 31"
        );
        let (first, last) = between_turning_points(&curve, found[3]);
        assert!(
            first.abs_diff(126) < 8 && last.abs_diff(188) < 8,
            "{first} {last}"
        );
    }

    #[test]
    fn little_or_nothing_has_a_curve_too() {
        assert!(approximate(&[]).is_empty(), "an empty contour has no curve");
        assert!(
            extrema(&approximate(&[1.0])).is_empty(),
            "one sample has no extremum"
        );
        assert!(
            extrema(&approximate(&[2.0; 100])).is_empty(),
            "a flat contour has no extremum"
        );
        let straight: Vec<f64> = (0..9).map(f64::from).collect();
        assert_eq!(approximate(&straight).len(), 9);
        let (first, last) = between_turning_points(
            &[1.0],
            Extremum {
                frame: 0,
                is_max: true,
            },
        );
        assert_eq!((first, last), (0, 0));
    }
}
