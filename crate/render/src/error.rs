//! Rendering errors.

/// Error returned when an image cannot be rendered.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RenderError {
    /// No graphics adapter is available: no driver, or it is blocked.
    #[error("no graphics adapter: {0}")]
    NoAdapter(String),
    /// The adapter refused a device.
    #[error("the graphics adapter gives no device: {0}")]
    NoDevice(String),
    /// The canvas does not support rendering.
    #[error("the canvas cannot be drawn to: {0}")]
    Surface(String),
    /// More joints than the shader's table holds.
    #[error("the figure has {found} joints; at most {limit} can be drawn")]
    TooManyJoints {
        /// Joints of the figure.
        found: usize,
        /// Joints that fit.
        limit: usize,
    },
    /// A mesh contradicts itself.
    #[error("mesh `{mesh}`: {problem}")]
    BadMesh {
        /// Name of the mesh.
        mesh: String,
        /// Description of the problem.
        problem: &'static str,
    },
    /// Unusable image of a material.
    #[error("a material's picture of {width}x{height} cannot be used: {problem}")]
    BadImage {
        /// Width of the image, pixels.
        width: u32,
        /// Height of the image, pixels.
        height: u32,
        /// Description of the problem.
        problem: &'static str,
    },
    /// An empty image, or one larger than the device's textures.
    #[error("a picture of {width}x{height} cannot be drawn; the device's limit is {limit}")]
    BadSize {
        /// Requested width, pixels.
        width: u32,
        /// Requested height, pixels.
        height: u32,
        /// Largest side, pixels.
        limit: u32,
    },
    /// The shaders or pipelines were refused; a defect of this crate or of the driver.
    #[error("the driver refused the renderer: {0}")]
    Refused(String),
    /// The image could not be read back.
    #[error("the picture cannot be read back: {0}")]
    ReadBack(String),
    /// The device was lost; a new one must be made.
    #[error("the graphics device was lost")]
    DeviceLost,
}
