//! Extremum of the pitch contour.

/// An extremum of the pitch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Extreme {
    /// Story time, seconds.
    pub(super) at_secs: f64,
    /// Of a maximum its height in the speaker's range, above 0 to 1; 0 of a minimum.
    pub(super) height: f64,
    /// It marks a question.
    pub(super) is_question: bool,
}
