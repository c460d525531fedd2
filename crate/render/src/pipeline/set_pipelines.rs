//! Stage pipelines: one program for each set, compiled at its first use in a story.

use raconteur_stage::StageSet;
use wgpu::{Device, RenderPipeline};

use super::{
    BEHIND, PipelineDescription, Pipelines, SharedResources, full_screen, pipeline_layout,
};

/// Pipelines that render one stage set, compiled when a story first uses it.
pub(crate) struct SetPipelines {
    entry: &'static str,
    /// Behind the figure.
    pub(crate) behind: RenderPipeline,
    /// Pipeline for a still, if used.
    pub(crate) still: Option<RenderPipeline>,
}

/// Returns the fragment shader of a set. Each is a separate program, so none pays for another's
/// branches where a rasteriser runs both sides.
fn theatre_entry(kind: StageSet) -> &'static str {
    match kind {
        StageSet::Curtain | StageSet::Studio => "fs_theatre",
        StageSet::Fireside => "fs_fireside",
        StageSet::Garden => "fs_garden",
        StageSet::Night => "fs_night",
        StageSet::School => "fs_school",
    }
}

impl Pipelines {
    /// Compiles the pipelines of a set, if missing, and selects it.
    pub(crate) fn prepare_theatre(
        &mut self,
        device: &Device,
        shared: &SharedResources,
        kind: StageSet,
    ) {
        while self.make_theatre(device, shared, kind) {}
        let entry = theatre_entry(kind);
        let known = self.theatres.iter().position(|t| t.entry == entry);
        self.theatre = known.unwrap_or_default();
    }

    /// Compiles the first missing pipeline of a set; returns true if there was one.
    pub(super) fn make_theatre(
        &mut self,
        device: &Device,
        shared: &SharedResources,
        kind: StageSet,
    ) -> bool {
        let entry = theatre_entry(kind);
        let target = self.target;
        let known = self.theatres.iter_mut().find(|t| t.entry == entry);
        if known
            .as_ref()
            .is_some_and(|t| t.still.is_some() || !target.is_direct)
        {
            return false;
        }
        let layout = pipeline_layout(device, "theatre", &[&shared.layouts.lit]);
        let make = |constants: &[(&str, f64)], samples, depth| {
            PipelineDescription {
                label: "theatre",
                constants,
                vertex: "vs_theatre",
                fragment: Some(entry),
                samples,
                depth,
                ..full_screen(&shared.stage, &layout, target.format)
            }
            .build(device)
        };
        match known {
            Some(theatre) => theatre.still = Some(make(&self.constants, 1, None)),
            None => {
                let behind = make(&self.constants, target.samples, BEHIND);
                self.theatres.push(SetPipelines {
                    entry,
                    behind,
                    still: None,
                });
            }
        }
        true
    }

    /// Returns the pipelines of the current set.
    pub(crate) fn theatre(&self) -> Option<&SetPipelines> {
        self.theatres.get(self.theatre)
    }
}
