//! Rendering costs of an image.

/// Number of draw calls and triangles in one image.
#[derive(Default)]
pub(crate) struct Counts {
    pub(crate) draw_calls: u32,
    /// Number of draw calls for figures.
    pub(crate) figure_draw_calls: u32,
    pub(crate) triangles: u32,
}

impl Counts {
    pub(crate) fn add(&mut self, triangles: u32) {
        self.draw_calls += 1;
        self.triangles += triangles;
    }

    pub(crate) fn add_figure(&mut self, triangles: u32) {
        self.add(triangles);
        self.figure_draw_calls += 1;
    }
}
