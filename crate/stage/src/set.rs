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
    /// Whether a curtain hangs and boards lie; otherwise an even wall runs into the floor, as
    /// in a photographer's studio.
    pub curtain: bool,
}

impl Default for Set {
    fn default() -> Self {
        // A warm evening stage: plum above, amber pool behind the speaker. Chosen by eye.
        Self {
            floor: [0.17, 0.088, 0.050],
            backdrop_low: [0.036, 0.0065, 0.0105],
            backdrop_high: [0.011, 0.0045, 0.011],
            glow: [0.150, 0.050, 0.021],
            curtain: true,
        }
    }
}
