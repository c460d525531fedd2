//! Course of one parameter through a story.

use std::sync::Arc;

use raconteur_base::curve::{lerp, smooth};

use super::clip::ParameterClip;
use super::script::PlaybackStyle;

/// Transition time of a set value, and of an animation that takes over, seconds. Designed: a step
/// looks immediate, and no muscle jumps.
pub const SET_SECS: f64 = 0.15;
/// The shortest time in which a phase changes the value, seconds: one frame of film.
pub const STEP_SECS: f64 = 0.04;

/// Change of a control parameter that applies from a time on.
#[derive(Clone, Debug)]
pub(super) enum ParameterChange {
    /// Eases to a value in [`SET_SECS`] and holds it.
    Ease(f64),
    /// Moves linearly to a value in this time, seconds, and holds it.
    Line(f64, f64),
    /// Follows a track of an animation, and holds its last value.
    Clip {
        clip: Arc<ParameterClip>,
        place: usize,
        style: PlaybackStyle,
        gain: f64,
    },
}

/// Value of one control parameter over story time; 0 before its first command. A later command
/// starts from the present value.
#[derive(Clone, Debug, Default)]
pub struct Curve {
    /// Start times of the courses, ascending.
    starts: Vec<f64>,
    /// The value that each begins with.
    values: Vec<f64>,
    changes: Vec<ParameterChange>,
    /// The least value; the greatest is 1.
    least: f64,
}

impl Curve {
    pub(super) fn new(least: f64) -> Self {
        Self {
            least,
            ..Self::default()
        }
    }

    /// Adds a change of the parameter from a time on, discarding all changes planned from that time
    /// on.
    pub(super) fn push(&mut self, start_secs: f64, course: ParameterChange) {
        let value = self.sample(start_secs);
        while self.starts.pop_if(|s| *s >= start_secs).is_some() {
            self.values.pop();
            self.changes.pop();
        }
        self.starts.push(start_secs);
        self.values.push(value);
        self.changes.push(course);
    }

    /// Adds linear moves through values, each reached at its time; a value takes at least
    /// [`STEP_SECS`] to change.
    pub(super) fn append_keys(&mut self, start_secs: f64, keys: &[(f64, f64)]) {
        let mut now = start_secs;
        for (at, value) in keys {
            let from = self.sample(now);
            let least = if (from - value).abs() > 1e-9 {
                STEP_SECS
            } else {
                0.0
            };
            let end = at.max(now + least);
            self.push(now, ParameterChange::Line(*value, end - now));
            now = end;
        }
    }

    /// Returns the parameter's value at a story time, seconds. O(log n), no allocation.
    #[must_use]
    pub fn sample(&self, time_secs: f64) -> f64 {
        let Some(i) = raconteur_base::curve::last_at_or_before(&self.starts, time_secs) else {
            return 0.0;
        };
        let (since, from) = (time_secs - self.starts[i], self.values[i]);
        let eased = smooth(since / SET_SECS);
        let value = match &self.changes[i] {
            ParameterChange::Ease(to) => lerp(from, *to, eased),
            ParameterChange::Line(to, secs) if since < *secs => lerp(from, *to, since / secs),
            ParameterChange::Line(to, _) => *to,
            ParameterChange::Clip {
                clip,
                place,
                style,
                gain,
            } => {
                let at = style.place(since, clip.duration_secs());
                lerp(from, gain * clip.value(*place, at), eased)
            }
        };
        value.clamp(self.least, 1.0)
    }

    /// Returns the start times of the parameter's changes, ascending, seconds.
    pub(crate) fn starts(&self) -> &[f64] {
        &self.starts
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_comes_later_takes_over_from_where_the_value_is() {
        let mut curve = Curve::new(0.0);
        curve.append_keys(1.0, &[(2.0, 1.0), (4.0, 0.0)]);
        curve.push(3.0, ParameterChange::Ease(0.8));
        for (t, value) in [
            (0.0, 0.0),
            (1.5, 0.5),
            (2.0, 1.0),
            (2.5, 0.75),
            (3.0, 0.5),
            (3.0 + 0.5 * SET_SECS, 0.65),
            (3.2, 0.8),
            (9.0, 0.8),
        ] {
            assert!(
                (curve.sample(t) - value).abs() < 1e-12,
                "{t}: {}",
                curve.sample(t)
            );
        }
    }

    #[test]
    fn steps_take_a_frame_and_the_phase_after_them_ends_when_it_should() {
        let mut curve = Curve::new(0.0);
        curve.append_keys(1.0, &[(1.0, 1.0), (1.5, 0.5), (1.5, 0.5), (1.5, 0.0)]);
        assert!(
            (curve.sample(1.0 + STEP_SECS) - 1.0).abs() < 1e-12,
            "the step is complete after one frame"
        );
        assert!(
            (curve.sample(1.5) - 0.5).abs() < 1e-12,
            "the phase ends halfway at 1.5 s"
        );
        assert!(
            curve.sample(1.5 + STEP_SECS).abs() < 1e-12,
            "the step after the phase is complete"
        );
    }

    #[test]
    fn values_stay_in_their_range() {
        let mut curve = Curve::new(0.0);
        curve.push(0.0, ParameterChange::Ease(7.0));
        curve.push(1.0, ParameterChange::Ease(-7.0));
        for i in 0..200 {
            assert!(
                (0.0..=1.0).contains(&curve.sample(f64::from(i) * 0.01)),
                "the curve stays between 0 and 1"
            );
        }
        let mut both = Curve::new(-1.0);
        both.push(0.0, ParameterChange::Ease(-0.5));
        assert_eq!(both.sample(1.0), -0.5);
    }
}
