//! Shader modules, layouts and pipelines.

mod description;
mod entries;
mod set_pipelines;

use raconteur_stage::{Fill, StageSet, Visibility};
use wgpu::{
    BlendState, CompareFunction, Device, Face, PrimitiveTopology, RenderPipeline, ShaderModule,
    TextureFormat, VertexBufferLayout,
};

use crate::Quality;
use crate::figure::{AlphaMode, PipelineKey, Shadow};
use crate::layouts::Layouts;
use crate::lines::LineInstance;
use crate::morph::SHAPE_LAYOUT;
use crate::overlay::OverlayVertex;
use crate::sources::{STAGE, TONE_MAP};
use crate::target::TargetKind;
use crate::tissue::TissueVertex;
use crate::vertices::FixedVertex;
use description::{BEHIND, PipelineDescription, full_screen, pipeline_layout};
use entries::{figure_entry, fragment_entry, material_entry};
use set_pipelines::SetPipelines;

/// Resources that all quality tiers of a device share: layouts and shader modules.
pub(crate) struct SharedResources {
    pub(crate) layouts: Layouts,
    stage: ShaderModule,
    tone_map: ShaderModule,
    output: TextureFormat,
}

impl SharedResources {
    /// Creates the resources for targets of the format `output`.
    pub(crate) fn new(device: &Device, output: TextureFormat) -> Self {
        let module = |label, parts: &[&str]| {
            device.create_shader_module(wgpu::ShaderModuleDescriptor {
                label: Some(label),
                source: wgpu::ShaderSource::Wgsl(parts.concat().into()),
            })
        };
        Self {
            layouts: Layouts::new(device),
            stage: module("stage", &STAGE),
            tone_map: module("tone map", &TONE_MAP),
            output,
        }
    }
}

/// Compiled render pipelines of one quality tier.
pub(crate) struct Pipelines {
    /// Pipelines of the requested sets.
    theatres: Vec<SetPipelines>,
    /// Index of the current set.
    theatre: usize,
    /// Pipeline that composites the backdrop as a still, if used.
    pub(crate) with_layout: Option<RenderPipeline>,
    pub(crate) tone_map: Option<RenderPipeline>,
    target: TargetKind,
    /// True if surfaces use the shaders of the lowest quality.
    simple: bool,
    constants: Vec<(&'static str, f64)>,
    /// Pipelines of materials, for the keys that figures have used.
    materials: Vec<(PipelineKey, RenderPipeline)>,
    /// Pipelines of the shadow map, by the light's number, with true for vertices bound to tissue.
    shadows: Vec<(u32, Shadow, bool, RenderPipeline)>,
    /// Pipelines for figures without materials, by fill, with flags for their paint and for
    /// vertices bound to tissue.
    bare: Vec<(Fill, bool, bool, RenderPipeline)>,
    /// Pipeline of overlays over figures, created on demand.
    pub(crate) overlay: Option<RenderPipeline>,
    /// Pipelines of lines over figures, created on demand: behind and in front.
    pub(crate) lines: Option<[RenderPipeline; 2]>,
}

/// Returns true if a figure is rendered without its own materials.
pub(crate) fn is_bare(shown: &Visibility) -> bool {
    shown.fill != Fill::Solid || !shown.materials
}

/// Returns the vertex buffer layouts of a figure; the last one applies only to vertices that follow
/// tissue.
fn vertex_buffers() -> [Option<VertexBufferLayout<'static>>; 3] {
    [
        Some(SHAPE_LAYOUT),
        Some(FixedVertex::LAYOUT),
        Some(TissueVertex::LAYOUT),
    ]
}

/// Returns a boolean as a shader constant, 1 or 0.
fn flag(on: bool) -> f64 {
    f64::from(u8::from(on))
}

/// Returns the number of vertex streams.
fn stream_count(bound: bool) -> usize {
    2 + usize::from(bound)
}

impl Pipelines {
    /// Creates the tier without compiled pipelines.
    pub(crate) fn new(target: TargetKind, quality: Quality) -> Self {
        Self {
            theatres: Vec::new(),
            theatre: 0,
            with_layout: None,
            tone_map: None,
            target,
            simple: target.is_direct,
            constants: vec![
                ("EARLY_ENCODE", flag(!target.is_float())),
                ("FINE_DETAIL", flag(quality.fine_detail())),
                ("SHADOW_REACH", f64::from(quality.shadow_reach())),
                ("SHADOWS", f64::from(quality.shadows())),
                ("COVERAGE", flag(target.samples > 1)),
                ("SIMPLE", flag(target.is_direct)),
            ],
            materials: Vec::new(),
            shadows: Vec::new(),
            bare: Vec::new(),
            overlay: None,
            lines: None,
        }
    }

    /// Compiles the first missing pipeline for a set and the `keys` of a figure, with shadows from
    /// `lights` lamps; returns true if there was one. Each takes tens of milliseconds with software
    /// rendering.
    pub(crate) fn make_next(
        &mut self,
        device: &Device,
        shared: &SharedResources,
        set: StageSet,
        keys: impl Iterator<Item = PipelineKey>,
        lights: u32,
    ) -> bool {
        if self.tone_map.is_none() {
            self.tone_map = Some(self.make_tone_map(device, shared));
            return true;
        }
        if self.target.is_direct && self.with_layout.is_none() {
            self.with_layout = Some(self.create_with_layout(device, shared));
            return true;
        }
        if self.make_theatre(device, shared, set) {
            return true;
        }
        for key in keys {
            if self.material(key).is_none() {
                let pipeline = self.make_material(device, shared, key);
                self.materials.push((key, pipeline));
                return true;
            }
            let shadow = key.shadow();
            let lights = if shadow == Shadow::Nothing { 0 } else { lights };
            let mut lit = 0..lights;
            if let Some(light) = lit.find(|light| self.shadow(*light, shadow, key.bound).is_none())
            {
                let pipeline = make_shadow(device, shared, light, shadow, key.bound);
                self.shadows.push((light, shadow, key.bound, pipeline));
                return true;
            }
        }
        false
    }

    fn make_tone_map(&self, device: &Device, shared: &SharedResources) -> RenderPipeline {
        let constants = [
            ("EARLY_ENCODE", flag(!self.target.is_float())),
            ("SMOOTH_EDGES", flag(self.target.samples == 1)),
            ("TARGET_ENCODES", flag(shared.output.is_srgb())),
        ];
        let layout = pipeline_layout(device, "tone map", &[&shared.layouts.tone_map]);
        PipelineDescription {
            label: "tone map",
            constants: &constants,
            vertex: "vs_tone_map",
            fragment: Some("fs_tone_map"),
            ..full_screen(&shared.tone_map, &layout, shared.output)
        }
        .build(device)
    }

    fn create_with_layout(&self, device: &Device, shared: &SharedResources) -> RenderPipeline {
        let layout = pipeline_layout(device, "tone map", &[&shared.layouts.tone_map]);
        PipelineDescription {
            label: "backdrop",
            vertex: "vs_still",
            fragment: Some("fs_still"),
            samples: self.target.samples,
            depth: BEHIND,
            ..full_screen(&shared.tone_map, &layout, self.target.format)
        }
        .build(device)
    }

    fn make_material(
        &self,
        device: &Device,
        shared: &SharedResources,
        key: PipelineKey,
    ) -> RenderPipeline {
        let Layouts {
            lit, figure, maps, ..
        } = &shared.layouts;
        let clear = key.alpha_mode == AlphaMode::Blend;
        PipelineDescription {
            label: "material",
            module: &shared.stage,
            layout: &pipeline_layout(device, "figure", &[lit, figure, maps]),
            constants: &self.constants,
            vertex: material_entry(key),
            buffers: &vertex_buffers()[..stream_count(key.bound)],
            fragment: Some(fragment_entry(key, self.simple)),
            target: Some(self.target.format),
            blend: clear.then_some(BlendState::PREMULTIPLIED_ALPHA_BLENDING),
            // The alpha of alpha-to-coverage must not make the canvas transparent.
            writes: if self.simple {
                wgpu::ColorWrites::COLOR
            } else {
                wgpu::ColorWrites::ALL
            },
            samples: self.target.samples,
            coverage: key.alpha_mode == AlphaMode::Mask && self.target.samples > 1,
            cull: (!key.double_sided).then_some(Face::Back),
            topology: PrimitiveTopology::TriangleList,
            depth: Some((CompareFunction::Less, !clear)),
            bias: wgpu::DepthBiasState::default(),
        }
        .build(device)
    }

    /// Compiles the pipelines that `shown` needs in addition to materials, if missing, for a figure
    /// that `has_tissue` or not.
    pub(crate) fn prepare_shown(
        &mut self,
        device: &Device,
        shared: &SharedResources,
        shown: &Visibility,
        has_tissue: bool,
    ) {
        for bound in [false, true] {
            let wanted = shown.body && is_bare(shown) && (has_tissue || !bound);
            if wanted && self.bare(shown, bound).is_none() {
                let pipeline = self.create_bare(device, shared, shown, bound);
                self.bare
                    .push((shown.fill, shown.materials, bound, pipeline));
            }
        }
        if shown.has_overlay() && self.overlay.is_none() {
            self.overlay = Some(self.make_overlay(device, shared));
        }
    }

    /// Compiles the pipelines of lines over figures, if missing.
    pub(crate) fn prepare_lines(&mut self, device: &Device, shared: &SharedResources) {
        if self.lines.is_none() {
            self.lines = Some([true, false].map(|behind| self.make_lines(device, shared, behind)));
        }
    }

    /// Returns the pipeline for meshes as edges, as vertices or in clay, `bound` to tissue or not;
    /// `None` before [`Self::prepare_shown`].
    pub(crate) fn bare(&self, shown: &Visibility, bound: bool) -> Option<&RenderPipeline> {
        let mut made = self.bare.iter();
        let found = made.find(|(f, m, b, _)| (*f, *m, *b) == (shown.fill, shown.materials, bound));
        found.map(|(.., pipeline)| pipeline)
    }

    fn create_bare(
        &self,
        device: &Device,
        shared: &SharedResources,
        shown: &Visibility,
        bound: bool,
    ) -> RenderPipeline {
        let Layouts {
            lit, figure, maps, ..
        } = &shared.layouts;
        let mut constants = self.constants.clone();
        constants.push(("CLAY", flag(!shown.materials)));
        constants.push(("THIN", flag(shown.fill != Fill::Solid)));
        PipelineDescription {
            constants: &constants,
            vertex: figure_entry(bound),
            buffers: &vertex_buffers()[..stream_count(bound)],
            blend: (shown.fill != Fill::Solid).then_some(BlendState::ALPHA_BLENDING),
            writes: wgpu::ColorWrites::ALL,
            topology: match shown.fill {
                Fill::Solid => PrimitiveTopology::TriangleList,
                Fill::Wireframe => PrimitiveTopology::LineList,
                Fill::Points => PrimitiveTopology::PointList,
            },
            ..self.plainly(
                "bare",
                &shared.stage,
                &pipeline_layout(device, "figure", &[lit, figure, maps]),
                "fs_bare",
            )
        }
        .build(device)
    }

    fn make_overlay(&self, device: &Device, shared: &SharedResources) -> RenderPipeline {
        PipelineDescription {
            vertex: "vs_over",
            buffers: &[Some(OverlayVertex::LAYOUT)],
            ..self.plainly(
                "overlay",
                &shared.stage,
                &pipeline_layout(device, "overlay", &[&shared.layouts.lit]),
                "fs_over",
            )
        }
        .build(device)
    }

    fn make_lines(
        &self,
        device: &Device,
        shared: &SharedResources,
        behind: bool,
    ) -> RenderPipeline {
        let mut constants = self.constants.clone();
        constants.push(("BEHIND", f64::from(u8::from(behind))));
        let compare = if behind {
            CompareFunction::Greater
        } else {
            CompareFunction::LessEqual
        };
        PipelineDescription {
            constants: &constants,
            vertex: "vs_line",
            buffers: &[Some(LineInstance::LAYOUT)],
            blend: Some(BlendState::PREMULTIPLIED_ALPHA_BLENDING),
            writes: wgpu::ColorWrites::ALL,
            topology: PrimitiveTopology::TriangleStrip,
            depth: Some((compare, false)),
            ..self.plainly(
                "lines",
                &shared.stage,
                &pipeline_layout(device, "lines", &[&shared.layouts.lit]),
                "fs_line",
            )
        }
        .build(device)
    }

    /// Returns a description of an opaque, double-sided pipeline.
    fn plainly<'a>(
        &'a self,
        label: &'a str,
        module: &'a ShaderModule,
        layout: &'a wgpu::PipelineLayout,
        fragment: &'a str,
    ) -> PipelineDescription<'a> {
        PipelineDescription {
            label,
            module,
            layout,
            constants: &self.constants,
            vertex: "",
            buffers: &[],
            fragment: Some(fragment),
            target: Some(self.target.format),
            blend: None,
            writes: wgpu::ColorWrites::ALL,
            samples: self.target.samples,
            coverage: false,
            cull: None,
            topology: PrimitiveTopology::TriangleList,
            depth: Some((CompareFunction::Less, true)),
            bias: wgpu::DepthBiasState::default(),
        }
    }

    /// Returns the pipeline of a material's key; `None` until [`Self::make_next`] has compiled it.
    pub(crate) fn material(&self, key: PipelineKey) -> Option<&RenderPipeline> {
        let found = self.materials.iter().find(|(l, _)| *l == key);
        found.map(|(_, pipeline)| pipeline)
    }

    /// Returns the pipeline of a shadow; `None` until [`Self::make_next`] has compiled it.
    pub(crate) fn shadow(
        &self,
        light: u32,
        shadow: Shadow,
        bound: bool,
    ) -> Option<&RenderPipeline> {
        let found = self
            .shadows
            .iter()
            .find(|(l, s, b, _)| (*l, *s, *b) == (light, shadow, bound));
        found.map(|(.., pipeline)| pipeline)
    }
}

fn make_shadow(
    device: &Device,
    shared: &SharedResources,
    light: u32,
    shadow: Shadow,
    bound: bool,
) -> RenderPipeline {
    let Layouts {
        frame,
        figure,
        maps,
        ..
    } = &shared.layouts;
    let (groups, fragment): (&[_], _) = match shadow {
        Shadow::Strands => (&[frame, figure, maps], Some("fs_hair_shadow")),
        Shadow::Picture => (&[frame, figure, maps], Some("fs_cut_shadow")),
        Shadow::Solid | Shadow::Nothing => (&[frame, figure], None),
    };
    PipelineDescription {
        label: "shadow",
        module: &shared.stage,
        layout: &pipeline_layout(device, "shadow", groups),
        constants: &[("LIGHT", f64::from(light))],
        vertex: if bound {
            "vs_bound_shadow"
        } else {
            "vs_shadow"
        },
        buffers: &vertex_buffers()[..stream_count(bound)],
        fragment,
        target: None,
        blend: None,
        writes: wgpu::ColorWrites::ALL,
        samples: 1,
        coverage: false,
        cull: None,
        topology: PrimitiveTopology::TriangleList,
        depth: Some((CompareFunction::Less, true)),
        // Steep surfaces are pushed back by their slope within a texel.
        bias: wgpu::DepthBiasState {
            constant: 0,
            slope_scale: 1.5,
            clamp: 0.0,
        },
    }
    .build(device)
}
