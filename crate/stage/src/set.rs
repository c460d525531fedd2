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
        // An evening stage, dark about the speaker: aubergine above, a low pool of warm light
        // behind. Chosen by eye.
        Self {
            floor: [0.115, 0.070, 0.046],
            backdrop_low: [0.0165, 0.0085, 0.0105],
            backdrop_high: [0.0065, 0.0050, 0.0085],
            glow: [0.080, 0.045, 0.032],
            curtain: true,
        }
    }
}
