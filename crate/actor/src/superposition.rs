//! Superposed movements: a value that moves from target to target, each movement starting before
//! the previous one has ended (Flash and Henis 1991, doi:10.1162/jocn.1991.3.3.220).

use raconteur_base::curve::minimum_jerk;
use raconteur_base::order::sort_by_number;

/// Longest movement of a track, seconds; longer ones are shortened.
pub(crate) const MAX_MOVE_SECS: f64 = 3.0;

/// Movement of a track: every component moves by its difference, with minimum jerk.
#[derive(Clone, Copy, Debug)]
struct Move<const N: usize> {
    start_secs: f64,
    secs: f64,
    by: [f64; N],
    /// Sum of all movements that start earlier.
    before: [f64; N],
}

/// Values over time as a sum of minimum-jerk movements; smooth to the second derivative. Starts at
/// zero.
#[derive(Clone, Debug)]
pub(crate) struct SuperposedTrack<const N: usize> {
    moves: Vec<Move<N>>,
}

impl<const N: usize> Default for SuperposedTrack<N> {
    fn default() -> Self {
        Self { moves: Vec::new() }
    }
}

impl<const N: usize> SuperposedTrack<N> {
    /// Creates a track from targets: start time and duration of the movement, seconds, and the
    /// values at its end if no later movement follows. Targets with other than finite numbers are
    /// left out.
    pub(crate) fn new(mut targets: Vec<(f64, f64, [f64; N])>) -> Self {
        targets.retain(|(start, secs, to)| {
            start.is_finite() && secs.is_finite() && to.iter().all(|value| value.is_finite())
        });
        sort_by_number(&mut targets, |(start, ..)| *start);
        let mut before = [0.0; N];
        let moves = targets
            .into_iter()
            .map(|(start_secs, secs, to)| {
                let step = Move {
                    start_secs,
                    secs: secs.clamp(1e-3, MAX_MOVE_SECS),
                    by: core::array::from_fn(|k| to[k] - before[k]),
                    before,
                };
                before = to;
                step
            })
            .collect();
        Self { moves }
    }

    /// Creates a track of pulses in addition to each other: each leaves zero at a time, is complete
    /// after a rise time, and returns within a fall time, seconds.
    pub(crate) fn of_pulses(pulses: &[(f64, [f64; 2], [f64; N])]) -> Self {
        let mut changes: Vec<(f64, f64, [f64; N])> = pulses
            .iter()
            .flat_map(|&(start, [rise, fall], size)| {
                [
                    (start, rise, size),
                    (start + rise, fall, size.map(|value| -value)),
                ]
            })
            .collect();
        sort_by_number(&mut changes, |(start, ..)| *start);
        let mut sum = [0.0; N];
        for (.., by) in &mut changes {
            for (sum, by) in sum.iter_mut().zip(by.iter_mut()) {
                *sum += *by;
                *by = *sum;
            }
        }
        Self::new(changes)
    }

    /// Returns the values at a time. O(log n), apart from simultaneous movements.
    pub(crate) fn sample(&self, time_secs: f64) -> [f64; N] {
        let begun = self.moves.partition_point(|m| m.start_secs <= time_secs);
        let active = self
            .moves
            .partition_point(|m| m.start_secs <= time_secs - MAX_MOVE_SECS);
        let Some(first) = self.moves.get(active.min(begun.saturating_sub(1))) else {
            return [0.0; N];
        };
        if begun == 0 {
            return [0.0; N];
        }
        let mut sum = first.before;
        for step in &self.moves[active.min(begun - 1)..begun] {
            let share = minimum_jerk((time_secs - step.start_secs) / step.secs);
            for (sum, by) in sum.iter_mut().zip(step.by) {
                *sum += by * share;
            }
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn movements_add_up_and_end_at_the_last_target() {
        let track = SuperposedTrack::new(vec![
            (1.0, 1.0, [2.0]),
            (1.5, 1.0, [-1.0]),
            (f64::NAN, 1.0, [9.0]),
            (20.0, 1.0, [4.0]),
        ]);
        let at = |t: f64| track.sample(t)[0];
        assert_eq!([at(0.0), at(1.0)], [0.0, 0.0]);
        assert!((at(1.5) - 1.0).abs() < 1e-12, "half of the first movement");
        assert!(
            (at(2.0) - 0.5).abs() < 1e-12,
            "the first movement is complete, the second half complete"
        );
        assert_eq!([at(2.5), at(10.0), at(19.9)], [-1.0; 3]);
        assert_eq!(at(30.0), 4.0);
        assert_eq!(SuperposedTrack::<2>::default().sample(3.0), [0.0; 2]);
    }

    #[test]
    fn pulses_return_to_zero_and_overlap() {
        let track =
            SuperposedTrack::of_pulses(&[(0.0, [0.2, 0.4], [1.0]), (0.1, [0.2, 0.2], [0.5])]);
        let at = |t: f64| track.sample(t)[0];
        assert!(at(0.2) > 1.0, "both pulses add up");
        assert!(at(0.7).abs() < 1e-12, "both pulses are over");
    }

    #[test]
    fn the_speed_has_no_jumps() {
        let targets = (0..40).map(|i| {
            let i = f64::from(i);
            (
                0.3 * i,
                0.5 + 0.03 * i,
                [if i % 2.0 < 1.0 { 1.0 } else { -1.0 }],
            )
        });
        let track = SuperposedTrack::new(targets.collect());
        let step = 1e-3;
        let speed = |t: f64| (track.sample(t + step)[0] - track.sample(t)[0]) / step;
        for i in 0..13_000 {
            let t = f64::from(i) * step;
            let jump = speed(t + step) - speed(t);
            assert!(jump.abs() < 0.2, "{t}: {jump}");
        }
    }
}
