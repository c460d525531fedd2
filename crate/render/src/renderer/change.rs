//! Change of quality: immediate, or without delaying a frame.

use raconteur_stage::StageSet;

use wgpu::Device;

use super::Renderer;
use crate::RenderOptions;
use crate::gpu_figure::GpuFigure;
use crate::pipeline::SharedResources;
use crate::tier::Tier;

impl Renderer {
    /// Sets the options from the next image on; the figure and its images are kept.
    pub fn set_options(&mut self, options: RenderOptions) {
        self.coming = None;
        if self.tier.options.quality != options.quality {
            self.tier = self.make_tier(options);
            self.targets = None;
            self.compile(StageSet::Curtain);
        }
        self.update_tier();
    }

    /// Sets the options like [`Self::set_options`] once all pipelines exist: one program is
    /// compiled per image, and images until then use the previous options.
    pub fn set_options_soon(&mut self, options: RenderOptions) {
        let is_other = self.tier.options.quality != options.quality;
        self.coming = is_other.then(|| self.make_tier(options));
    }

    /// Returns true while a change of quality is being prepared.
    #[must_use]
    pub fn is_changing(&self) -> bool {
        self.coming.is_some()
    }

    fn make_tier(&self, options: RenderOptions) -> Tier {
        let kind = self.target_kinds[options.quality as usize];
        Tier::new(
            &self.device,
            &self.shared,
            kind,
            &self.frame_buffer,
            options,
        )
    }

    /// Compiles one program of the pending quality, and switches to it when complete.
    pub(super) fn resume(&mut self, set: StageSet) {
        let Some(mut tier) = self.coming.take() else {
            return;
        };
        if compile_one(
            (&self.device, &self.shared),
            self.figure.as_ref(),
            &mut tier,
            set,
        ) {
            self.coming = Some(tier);
            return;
        }
        self.tier = tier;
        self.targets = None;
        self.update_tier();
    }

    /// Compiles all pipelines of the current quality for a set and the figure.
    pub(super) fn compile(&mut self, set: StageSet) {
        let figure = self.figure.as_ref();
        while compile_one((&self.device, &self.shared), figure, &mut self.tier, set) {}
    }

    pub(super) fn update_tier(&mut self) {
        let samples = self.tier.target.samples;
        self.info.options = self.tier.options;
        self.info.samples = samples;
        self.info.smooths_edges = samples == 1 && !self.tier.target.is_direct;
        self.info.shadow_texels = self.tier.shadow_texels;
    }
}

/// Compiles the first missing program of a quality for a set and a figure; returns true if there
/// was one.
fn compile_one(
    (device, shared): (&Device, &SharedResources),
    figure: Option<&GpuFigure>,
    tier: &mut Tier,
    set: StageSet,
) -> bool {
    let keys = figure.into_iter().flat_map(GpuFigure::pipeline_keys);
    tier.pipelines
        .make_next(device, shared, set, keys, tier.lights)
}
