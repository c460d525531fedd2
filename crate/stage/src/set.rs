//! Floor and backdrop.

/// Colours of the stage, linear RGB.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Set {
    /// The floor near the figure.
    pub floor: [f32; 3],
    /// The backdrop at the horizon.
    pub backdrop_low: [f32; 3],
    /// The backdrop above.
    pub backdrop_high: [f32; 3],
    /// The pool of light behind the figure, added around the middle of the backdrop.
    pub glow: [f32; 3],
}

impl Default for Set {
    fn default() -> Self {
        // A warm evening stage: plum above, amber pool behind the speaker. Chosen by eye.
        Self {
            floor: [0.15, 0.085, 0.055],
            backdrop_low: [0.115, 0.060, 0.062],
            backdrop_high: [0.022, 0.018, 0.035],
            glow: [0.26, 0.135, 0.065],
        }
    }
}
