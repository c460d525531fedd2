//! Another quality: at once, or without holding a picture up.

use raconteur_stage::StageSet;

use wgpu::Device;

use super::Renderer;
use crate::RenderOptions;
use crate::gpu_figure::GpuFigure;
use crate::pipeline::SharedResources;
use crate::tier::Tier;

impl Renderer {
    /// Draws as `options` say from the next picture on; the figure and its pictures stay.
    pub fn set_options(&mut self, options: RenderOptions) {
        self.coming = None;
        if self.tier.options.quality != options.quality {
            self.tier = self.make_tier(options);
            self.targets = None;
            self.compile(StageSet::Curtain);
        }
        self.update_tier();
    }

    /// As [`Self::set_options`], as soon as all is there: with each picture one program is compiled,
    /// and those that come meanwhile are drawn as before.
    pub fn set_options_soon(&mut self, options: RenderOptions) {
        let is_other = self.tier.options.quality != options.quality;
        self.coming = is_other.then(|| self.make_tier(options));
    }

    /// Whether another quality is on its way.
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

    /// Compiles one program of the quality that is on its way, and takes it when it has all.
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

    /// Compiles all that the present quality needs for a place and the figure.
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

/// Compiles the first program that a quality lacks for a place and a figure; whether one was missing.
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
