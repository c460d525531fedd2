//! Posture of the body at one time, as angles that other motion is added to.

/// Lean, roll and yaw of one part of the body, radians: forwards, to the left side, to the left.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Turn {
    pub(crate) lean: f64,
    pub(crate) roll: f64,
    pub(crate) yaw: f64,
}

/// Contribution of posture to the body at one time.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct BodyPosture {
    /// Pelvis on the feet.
    pub(crate) pelvis: Turn,
    /// Lumbar spine on the pelvis.
    pub(crate) lumbar: Turn,
    /// Chest on the lumbar spine.
    pub(crate) thoracic: Turn,
    /// Elevation of the left and right shoulder, radians.
    pub(crate) shrug: [f64; 2],
}
