//! What draws the stage: one program for each place, compiled when a story first goes there.

use raconteur_stage::SetKind;
use wgpu::{Device, RenderPipeline};

use super::{
    BEHIND, PipelineDescription, Pipelines, SharedResources, full_screen, pipeline_layout,
};

/// What draws one place.
pub(crate) struct Theatre {
    entry: &'static str,
    /// Behind the figure.
    pub(crate) behind: RenderPipeline,
    /// As a still, where that is done.
    pub(crate) still: Option<RenderPipeline>,
}

/// The fragment shader of a place. Each is a program of its own, so that none pays for another's
/// branches where a rasteriser runs both sides.
fn theatre_entry(kind: SetKind) -> &'static str {
    match kind {
        SetKind::Curtain | SetKind::Studio => "fs_theatre",
        SetKind::Fireside => "fs_fireside",
        SetKind::Garden => "fs_garden",
        SetKind::Night => "fs_night",
        SetKind::School => "fs_school",
    }
}

impl Pipelines {
    /// Compiles what draws a place, if it was not drawn yet, and makes it the stage.
    pub(crate) fn prepare_theatre(
        &mut self,
        device: &Device,
        shared: &SharedResources,
        kind: SetKind,
    ) {
        let entry = theatre_entry(kind);
        if let Some(known) = self.theatres.iter().position(|t| t.entry == entry) {
            self.theatre = known;
            return;
        }
        let layout = pipeline_layout(device, "theatre", &[&shared.layouts.lit]);
        let make = |samples, depth| {
            PipelineDescription {
                label: "theatre",
                constants: &self.constants,
                vertex: "vs_theatre",
                fragment: Some(entry),
                samples,
                depth,
                ..full_screen(&shared.stage, &layout, self.target.format)
            }
            .build(device)
        };
        let theatre = Theatre {
            entry,
            behind: make(self.target.samples, BEHIND),
            still: self.target.is_direct.then(|| make(1, None)),
        };
        self.theatre = self.theatres.len();
        self.theatres.push(theatre);
    }

    /// What draws the stage.
    pub(crate) fn theatre(&self) -> Option<&Theatre> {
        self.theatres.get(self.theatre)
    }
}
