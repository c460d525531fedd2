//! Extremum of the pitch contour.

/// Extremum of the pitch contour of speech; head and brows are raised at maxima.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Extreme {
    /// Story time, seconds.
    pub(super) at_secs: f64,
    /// Relative height of a maximum in the speaker's pitch range, above 0 to 1; 0 for a minimum.
    pub(super) height: f64,
    /// True if the extremum marks a question.
    pub(super) is_question: bool,
}
