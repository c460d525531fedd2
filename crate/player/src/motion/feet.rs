//! Measures of the feet: steps, and the slide of planted feet.
//!
//! A foot is planted while neither its ankle nor its metatarsal joint is more than 2 mm above the
//! height that it has in the zero pose. A lifted foot makes a step if one of both joints moves
//! farther than 2 cm from its place before the lift, and the foot is planted again.

use std::ops::Range;

use raconteur_base::{DVec3, Length};

use super::recording::{FootRecording, Recording};
use super::signal::Distribution;
use super::trunk::angles_deg;
use super::{Measure, RATE_HZ, people};

/// Height above its resting height up to which a joint of a planted foot is, metres.
const PLANTED_M: f64 = 0.002;
/// Distance that a joint of a foot moves in a step at least, metres.
const STEP_M: f64 = 0.02;

/// A step: horizontal distance of the ankle from lift to landing, and time off the ground.
struct Step {
    length_m: f64,
    secs: f64,
}

/// Returns the measures of the feet.
pub(super) fn measures(recording: &Recording) -> [Measure; 5] {
    let mut steps = Vec::new();
    let (mut slides_m, mut turns_deg) = (Vec::new(), Vec::new());
    for foot in &recording.feet {
        for run in &recording.runs {
            steps.extend(foot.steps(run));
            for span in foot.spans(run, true) {
                slides_m.push(foot.slide_m(&span));
                turns_deg.push(foot.turn_deg(&span));
            }
        }
    }
    let lengths = Distribution::new(steps.iter().map(|s| 1e2 * s.length_m));
    let durations = Distribution::new(steps.iter().map(|s| s.secs));
    let slide_mm = Distribution::new(slides_m.iter().map(|slide| 1e3 * slide)).max();
    let turn_deg = Distribution::new(turns_deg.into_iter()).max();
    [
        Measure::new(
            "steps-per-minute",
            "/min",
            recording.per_minute(lengths.count()),
        )
        .with_amount(people::STEPS_PER_MINUTE),
        Measure::new("step-length-median", "cm", lengths.median())
            .with_typical(people::STEP_LENGTH_CM),
        Measure::new("step-duration-median", "s", durations.median())
            .with_typical(people::STEP_SECS),
        Measure::new("foot-slide-max", "mm", slide_mm),
        Measure::new("foot-turn-max", "°", turn_deg),
    ]
}

impl FootRecording {
    fn is_planted(&self, sample: usize) -> bool {
        let heights = [self.ankle[sample].y, self.ball[sample].y];
        let mut pairs = heights.iter().zip(self.resting_m);
        pairs.all(|(height, resting)| height - resting <= PLANTED_M)
    }

    /// Returns the spans of a run in which the foot is planted, or those in which it is not.
    fn spans(&self, run: &Range<usize>, planted: bool) -> Vec<Range<usize>> {
        let mut spans: Vec<Range<usize>> = Vec::new();
        for sample in run.clone().filter(|s| self.is_planted(*s) == planted) {
            match spans.last_mut() {
                Some(span) if span.end == sample => span.end += 1,
                _ => spans.push(sample..sample + 1),
            }
        }
        spans
    }

    fn steps(&self, run: &Range<usize>) -> Vec<Step> {
        let lifted = self.spans(run, false).into_iter();
        // A foot that is still in the air at the end of the run has not landed.
        let landed = lifted.filter(|span| span.end < run.end);
        let steps = landed.filter_map(|span| {
            let from = span.start.max(run.start + 1) - 1;
            let moves = |joint: &[DVec3]| {
                let mut places = joint[span.clone()].iter();
                places.any(|p| p.distance_to(joint[from]) > STEP_M)
            };
            (moves(&self.ankle) || moves(&self.ball)).then(|| Step {
                length_m: self.horizontal_m(from, span.end),
                secs: span.len() as f64 / RATE_HZ,
            })
        });
        steps.collect()
    }

    /// Returns the horizontal distance of the ankle between two samples, metres.
    fn horizontal_m(&self, from: usize, to: usize) -> f64 {
        let offset = self.ankle[to] - self.ankle[from];
        offset.with_y(0.0).magnitude()
    }

    /// Returns the largest horizontal distance of the ankle from its place at the start of a span,
    /// metres.
    fn slide_m(&self, span: &Range<usize>) -> f64 {
        let offsets = span.clone().map(|i| self.horizontal_m(span.start, i));
        offsets.fold(0.0, f64::max)
    }

    /// Returns the largest turn of the foot about the vertical from the start of a span, degrees.
    fn turn_deg(&self, span: &Range<usize>) -> f64 {
        let [yaw, ..] = angles_deg(&self.turn[span.clone()]);
        let turns = yaw.iter().map(|y| (y - yaw[0]).abs());
        turns.fold(0.0, f64::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use raconteur_base::DQuat;

    /// A foot that stands, is lifted, and stands on: positions of its joints by place and height.
    fn foot(places: &[(f64, f64)]) -> FootRecording {
        let ankle = places.iter().map(|(x, y)| DVec3::new(*x, 0.1 + y, 0.0));
        let ball = places.iter().map(|(x, y)| DVec3::new(*x, 0.02 + y, 0.1));
        FootRecording {
            ankle: ankle.collect(),
            ball: ball.collect(),
            turn: places
                .iter()
                .map(|(x, _)| DQuat::from_rotation_y(*x))
                .collect(),
            resting_m: [0.1, 0.02],
        }
    }

    #[test]
    fn a_step_is_lifted_moves_and_lands() {
        let step = foot(&[
            (0.0, 0.0),
            (0.0, 0.001),
            (0.04, 0.03),
            (0.08, 0.004),
            (0.08, 0.0),
        ]);
        let found = step.steps(&(0..5));
        assert_eq!(found.len(), 1);
        assert!(
            (found[0].length_m - 0.08).abs() < 1e-9 && (found[0].secs - 2.0 / RATE_HZ).abs() < 1e-9,
            "the step has the length and time of the lifted foot"
        );
        assert_eq!(step.steps(&(0..4)).len(), 0);
        let raised = foot(&[(0.0, 0.0), (0.004, 0.01), (0.0, 0.0)]);
        assert_eq!(raised.steps(&(0..3)).len(), 0);
    }

    #[test]
    fn a_slide_is_the_motion_of_a_planted_foot() {
        let foot = foot(&[
            (0.0, 0.0),
            (-0.003, 0.0),
            (0.002, 0.001),
            (0.1, 0.03),
            (0.1, 0.0),
        ]);
        let spans = foot.spans(&(0..5), true);
        assert_eq!(spans, [0..3, 4..5]);
        assert!((foot.slide_m(&spans[0]) - 0.003).abs() < 1e-12, "3 mm");
        let turn = 0.003_f64.to_degrees();
        assert!(
            (foot.turn_deg(&spans[0]) - turn).abs() < 1e-9,
            "the planted foot turns by {turn}"
        );
        assert_eq!(foot.slide_m(&spans[1]), 0.0);
    }
}
