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
    /// Weight in addition to the stance's, −1 on the right foot to 1 on the left.
    pub(crate) weight: f64,
    /// Pelvis on the feet.
    pub(crate) pelvis: Turn,
    /// Lumbar spine on the pelvis.
    pub(crate) lumbar: Turn,
    /// Chest on the lumbar spine.
    pub(crate) thoracic: Turn,
    /// Elevation of the left and right shoulder, radians.
    pub(crate) shrug: [f64; 2],
}

/// Posture of spine and shoulder girdle from a time on, in addition to other motion; angles in
/// radians.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PostureCommand {
    /// Start of the movement to it, story time, seconds.
    pub start_secs: f64,
    /// Duration of the movement, seconds, at most 3.
    pub duration_secs: f64,
    /// Lean of the trunk to the front.
    pub lean_rad: f64,
    /// Tilt of the trunk to its left.
    pub tilt_rad: f64,
    /// Turn of the trunk to its left.
    pub turn_rad: f64,
    /// Elevation of the left and right shoulder.
    pub shoulders_rad: [f64; 2],
}
