//! Visible parts of a figure, for inspection (GEVH D.3.4).

/// Way in which the figure's surface is rendered: solid, by its edges or by its points.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Fill {
    /// The surface.
    #[default]
    Solid,
    /// The edges of its triangles.
    Wireframe,
    /// Their corners.
    Points,
}

/// Rendering switches. A story shows only the body, in its materials.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(
    clippy::struct_excessive_bools,
    reason = "switches that know nothing of each other"
)]
pub struct Visibility {
    /// Fill mode of the body's surface.
    pub fill: Fill,
    /// Shows the body.
    pub body: bool,
    /// The bones, over the body.
    pub bones: bool,
    /// The axes of every bone's frame, over the body: x red, y green, z blue.
    pub frames: bool,
    /// The joint of every bone, over the body.
    pub centers: bool,
    /// Renders the body in its materials if true, else as a clay model.
    pub materials: bool,
    /// Enables the textures of its materials.
    pub textures: bool,
    /// Enables rendering of the manipulators' targets over the body:
    /// [`Frame::handles`](crate::Frame).
    pub manipulators: bool,
    /// The springs of the face's tissue, over the body: [`Frame::lines`](crate::Frame).
    pub springs: bool,
    /// The fibres of the face's muscles, over the body: [`Frame::lines`](crate::Frame).
    pub muscles: bool,
    /// The bone under the face's tissue, over the body: [`Frame::lines`](crate::Frame).
    pub skull: bool,
}

impl Default for Visibility {
    fn default() -> Self {
        Self {
            fill: Fill::Solid,
            body: true,
            bones: false,
            frames: false,
            centers: false,
            materials: true,
            textures: true,
            manipulators: false,
            springs: false,
            muscles: false,
            skull: false,
        }
    }
}

impl Visibility {
    /// Returns true if anything is rendered over the body.
    #[must_use]
    pub fn has_overlay(&self) -> bool {
        self.bones || self.frames || self.centers || self.manipulators
    }
}
