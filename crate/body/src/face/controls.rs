//! What a face is asked to do at one moment.

use super::MUSCLES;

/// The four degrees of freedom of the lower jaw in speech (F&H section 3.1.1): pitch and yaw,
/// horizontal and vertical position.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Jaw {
    /// Turn about the figure's left, positive opens; radians, 0 to 0.35.
    pub pitch_rad: f64,
    /// Turn about up, positive to the figure's left; radians, −0.1 to 0.1.
    pub yaw_rad: f64,
    /// Slide forwards, metres, −0.004 to 0.008.
    pub forward_m: f64,
    /// Slide downwards, metres, 0 to 0.004.
    pub down_m: f64,
}

/// What a face is asked to do at one moment: contractions of its muscles, and direct
/// parameters for what no muscle moves here (F&H section 3.1.2). Values out of range are
/// brought into it by whoever moves the face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FaceControls {
    /// Contraction of each [`Muscle`](super::Muscle), 0 relaxed to 1.
    pub contraction: [f64; MUSCLES],
    /// Protrusion (positive) or retraction of the upper and of the lower lip by the ring of
    /// the mouth, −1 to 1.
    pub protrusion: [f64; 2],
    /// How firmly the ring of the mouth brings the lips together, whatever the jaw does: 0
    /// not at all, 1 they touch and press (p, b, m).
    pub seal: f64,
    /// How far the lower lip is at the edge of the upper teeth (f, v), 0 to 1.
    pub bite: f64,
    /// The lower jaw.
    pub jaw: Jaw,
    /// Left and right upper lid: 0 where the gaze has it, 1 closed, −1 wide open.
    pub upper_lid: [f64; 2],
    /// Left and right lower lid: 0 at rest, 1 raised as in a tight squint.
    pub lower_lid: [f64; 2],
    /// Tip of the tongue raised to the ridge behind the teeth, 0 to 1.
    pub tongue_tip: f64,
    /// Back of the tongue raised to the velum, 0 to 1.
    pub tongue_back: f64,
    /// Tongue between the teeth, 0 to 1.
    pub tongue_out: f64,
    /// More blood in the skin of the face than usual (blush, positive) or less (pallor), −1
    /// to 1.
    pub blush: f64,
}

impl Default for FaceControls {
    /// Nothing is asked.
    fn default() -> Self {
        Self {
            contraction: [0.0; MUSCLES],
            protrusion: [0.0; 2],
            seal: 0.0,
            bite: 0.0,
            jaw: Jaw::default(),
            upper_lid: [0.0; 2],
            lower_lid: [0.0; 2],
            tongue_tip: 0.0,
            tongue_back: 0.0,
            tongue_out: 0.0,
            blush: 0.0,
        }
    }
}
