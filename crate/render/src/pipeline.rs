//! Shader modules, layouts and pipelines.

use raconteur_body::MaterialKind;
use raconteur_stage::{Fill, Shown};
use wgpu::{
    BindGroupLayout, BlendState, CompareFunction, Device, Face, PrimitiveTopology, RenderPipeline,
    ShaderModule, ShaderStages, TextureFormat, VertexAttribute, VertexBufferLayout, VertexFormat,
};

use crate::figure::{FixedVertex, Layer, Look, MaterialUniform, Shadow};
use crate::lines::SentLine;
use crate::morph::ShapeVertex;
use crate::overlay::OverVertex;
use crate::target::{DEPTH_FORMAT, TargetKind};
use crate::tissue::TissueVertex;
use crate::{Quality, uniform::FrameUniform};

const FRAME: &str = include_str!(concat!(env!("OUT_DIR"), "/frame.wgsl"));

/// The shaders of everything on the stage, one module.
const STAGE: [&str; 11] = [
    FRAME,
    include_str!(concat!(env!("OUT_DIR"), "/light.wgsl")),
    include_str!(concat!(env!("OUT_DIR"), "/figure.wgsl")),
    include_str!(concat!(env!("OUT_DIR"), "/surface.wgsl")),
    include_str!(concat!(env!("OUT_DIR"), "/skin.wgsl")),
    include_str!(concat!(env!("OUT_DIR"), "/eye.wgsl")),
    include_str!(concat!(env!("OUT_DIR"), "/mouth.wgsl")),
    include_str!(concat!(env!("OUT_DIR"), "/hair.wgsl")),
    include_str!(concat!(env!("OUT_DIR"), "/cloth.wgsl")),
    include_str!(concat!(env!("OUT_DIR"), "/theatre.wgsl")),
    include_str!(concat!(env!("OUT_DIR"), "/bare.wgsl")),
];

const LAST: [&str; 2] = [FRAME, include_str!(concat!(env!("OUT_DIR"), "/last.wgsl"))];

/// Bind group layouts, named by what they hold.
pub(crate) struct Layouts {
    /// The frame alone.
    pub(crate) frame: BindGroupLayout,
    /// The frame, the shadow map and its sampler.
    pub(crate) lit: BindGroupLayout,
    /// Joints and one material.
    pub(crate) figure: BindGroupLayout,
    /// A material's pictures of colour, normals and wrinkles, and their sampler.
    pub(crate) maps: BindGroupLayout,
    /// The frame, the finished picture and its sampler.
    pub(crate) last: BindGroupLayout,
}

impl Layouts {
    fn new(device: &Device) -> Self {
        let layout = |label, entries: &[wgpu::BindGroupLayoutEntry]| {
            device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
                label: Some(label),
                entries,
            })
        };
        let both = ShaderStages::VERTEX_FRAGMENT;
        let frame = uniform(0, both, false, size_of::<FrameUniform>() as u64);
        let texture = |binding, sample_type| {
            entry(
                binding,
                ShaderStages::FRAGMENT,
                wgpu::BindingType::Texture {
                    sample_type,
                    view_dimension: wgpu::TextureViewDimension::D2,
                    multisampled: false,
                },
            )
        };
        let picture =
            |binding| texture(binding, wgpu::TextureSampleType::Float { filterable: true });
        let sampler = |binding, kind| {
            entry(
                binding,
                ShaderStages::FRAGMENT,
                wgpu::BindingType::Sampler(kind),
            )
        };
        let filtering = wgpu::SamplerBindingType::Filtering;
        Self {
            frame: layout("frame", &[frame]),
            lit: layout(
                "lit",
                &[
                    frame,
                    texture(1, wgpu::TextureSampleType::Depth),
                    sampler(2, wgpu::SamplerBindingType::Comparison),
                ],
            ),
            figure: layout(
                "figure",
                &[
                    uniform(0, ShaderStages::VERTEX, false, 384 * 16),
                    uniform(1, both, true, size_of::<MaterialUniform>() as u64),
                ],
            ),
            maps: layout(
                "maps",
                &[picture(0), picture(1), sampler(2, filtering), picture(3)],
            ),
            last: layout("last", &[frame, picture(1), sampler(2, filtering)]),
        }
    }
}

fn entry(
    binding: u32,
    visibility: ShaderStages,
    ty: wgpu::BindingType,
) -> wgpu::BindGroupLayoutEntry {
    wgpu::BindGroupLayoutEntry {
        binding,
        visibility,
        ty,
        count: None,
    }
}

fn uniform(
    binding: u32,
    stages: ShaderStages,
    dynamic: bool,
    size: u64,
) -> wgpu::BindGroupLayoutEntry {
    entry(
        binding,
        stages,
        wgpu::BindingType::Buffer {
            ty: wgpu::BufferBindingType::Uniform,
            has_dynamic_offset: dynamic,
            min_binding_size: std::num::NonZeroU64::new(size),
        },
    )
}

/// What every tier of quality shares: it is made once for a device.
pub(crate) struct Kit {
    pub(crate) layouts: Layouts,
    stage: ShaderModule,
    last: ShaderModule,
    output: TextureFormat,
}

impl Kit {
    /// For targets of `output`.
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
            last: module("last", &LAST),
            output,
        }
    }
}

/// Everything compiled for one tier of quality.
pub(crate) struct Pipelines {
    pub(crate) theatre: RenderPipeline,
    pub(crate) last: RenderPipeline,
    target: TargetKind,
    constants: Vec<(&'static str, f64)>,
    /// Those that figures have used.
    looks: Vec<(Look, RenderPipeline)>,
    /// Those of the shadow map, by the light's number and whether vertices follow tissue.
    shadows: Vec<(u32, Shadow, bool, RenderPipeline)>,
    /// What draws figures without materials, by fill, whether their paint is used, and
    /// whether vertices follow tissue.
    bare: Vec<(Fill, bool, bool, RenderPipeline)>,
    /// What draws over figures, once it was wanted.
    pub(crate) overlay: Option<RenderPipeline>,
    /// What draws lines over figures, once they were wanted: those behind, those before.
    pub(crate) lines: Option<[RenderPipeline; 2]>,
}

const SHAPE_ATTRIBUTES: [VertexAttribute; 2] =
    wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3];
const FIXED_ATTRIBUTES: [VertexAttribute; 5] = [
    attribute(VertexFormat::Float32x2, 0, 2),
    attribute(VertexFormat::Unorm8x4, 8, 3),
    attribute(VertexFormat::Uint8x4, 12, 4),
    attribute(VertexFormat::Unorm16x4, 16, 5),
    attribute(VertexFormat::Snorm8x4, 24, 6),
];
const TISSUE_ATTRIBUTES: [VertexAttribute; 3] = [
    attribute(VertexFormat::Snorm16x4, 0, 7),
    attribute(VertexFormat::Snorm16x2, 8, 8),
    attribute(VertexFormat::Unorm8x4, 12, 9),
];

const OVER_ATTRIBUTES: [VertexAttribute; 2] =
    wgpu::vertex_attr_array![0 => Float32x3, 1 => Unorm8x4];
const LINE_ATTRIBUTES: [VertexAttribute; 4] =
    wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3, 2 => Unorm8x4, 3 => Float32];

/// Whether a figure's own materials are not what draws it.
pub(crate) fn is_bare(shown: &Shown) -> bool {
    shown.fill != Fill::Solid || !shown.materials
}

const fn attribute(format: VertexFormat, offset: u64, shader_location: u32) -> VertexAttribute {
    VertexAttribute {
        format,
        offset,
        shader_location,
    }
}

/// The streams of a figure; the last one only where vertices follow tissue.
fn vertex_buffers() -> [Option<VertexBufferLayout<'static>>; 3] {
    let buffer = |stride: usize, attributes| {
        Some(VertexBufferLayout {
            array_stride: stride as u64,
            step_mode: wgpu::VertexStepMode::Vertex,
            attributes,
        })
    };
    [
        buffer(size_of::<ShapeVertex>(), &SHAPE_ATTRIBUTES),
        buffer(size_of::<FixedVertex>(), &FIXED_ATTRIBUTES),
        buffer(size_of::<TissueVertex>(), &TISSUE_ATTRIBUTES),
    ]
}

/// How many of the streams there are.
fn stream_count(bound: bool) -> usize {
    2 + usize::from(bound)
}

/// What differs between pipelines.
struct Recipe<'a> {
    label: &'a str,
    module: &'a ShaderModule,
    layout: &'a wgpu::PipelineLayout,
    constants: &'a [(&'a str, f64)],
    vertex: &'a str,
    buffers: &'a [Option<VertexBufferLayout<'static>>],
    fragment: Option<&'a str>,
    target: Option<TextureFormat>,
    blend: Option<BlendState>,
    samples: u32,
    coverage: bool,
    cull: Option<Face>,
    topology: PrimitiveTopology,
    /// Compare and write, when there is a depth buffer.
    depth: Option<(CompareFunction, bool)>,
    bias: wgpu::DepthBiasState,
}

impl Recipe<'_> {
    fn build(&self, device: &Device) -> RenderPipeline {
        let options = wgpu::PipelineCompilationOptions {
            constants: self.constants,
            ..Default::default()
        };
        let targets = [self.target.map(|format| wgpu::ColorTargetState {
            format,
            blend: self.blend,
            write_mask: wgpu::ColorWrites::ALL,
        })];
        device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(self.label),
            layout: Some(self.layout),
            vertex: wgpu::VertexState {
                module: self.module,
                entry_point: Some(self.vertex),
                compilation_options: options.clone(),
                buffers: self.buffers,
            },
            primitive: wgpu::PrimitiveState {
                cull_mode: self.cull,
                topology: self.topology,
                ..Default::default()
            },
            depth_stencil: self.depth.map(|(compare, write)| wgpu::DepthStencilState {
                format: DEPTH_FORMAT,
                depth_write_enabled: Some(write),
                depth_compare: Some(compare),
                stencil: wgpu::StencilState::default(),
                bias: self.bias,
            }),
            multisample: wgpu::MultisampleState {
                count: self.samples,
                mask: !0,
                alpha_to_coverage_enabled: self.coverage,
            },
            fragment: self.fragment.map(|entry_point| wgpu::FragmentState {
                module: self.module,
                entry_point: Some(entry_point),
                compilation_options: options,
                targets: if self.target.is_some() { &targets } else { &[] },
            }),
            multiview_mask: None,
            cache: None,
        })
    }
}

fn pipeline_layout(
    device: &Device,
    label: &str,
    groups: &[&BindGroupLayout],
) -> wgpu::PipelineLayout {
    let groups: Vec<Option<&BindGroupLayout>> = groups.iter().map(|g| Some(*g)).collect();
    device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some(label),
        bind_group_layouts: &groups,
        immediate_size: 0,
    })
}

impl Pipelines {
    pub(crate) fn new(device: &Device, kit: &Kit, target: TargetKind, quality: Quality) -> Self {
        let flag = |b: bool| f64::from(u8::from(b));
        let early = ("EARLY_ENCODE", flag(!target.is_float()));
        let constants = vec![
            early,
            ("FINE_DETAIL", flag(quality.fine_detail())),
            ("SHADOW_REACH", f64::from(quality.shadow_reach())),
            ("SHADOWS", f64::from(quality.shadows())),
            ("COVERAGE", flag(target.samples > 1)),
        ];
        let full_screen =
            |label, module, layout, constants: &[_], vertex, fragment, format, samples, depth| {
                Recipe {
                    label,
                    module,
                    layout,
                    constants,
                    vertex,
                    buffers: &[],
                    fragment: Some(fragment),
                    target: Some(format),
                    blend: None,
                    samples,
                    coverage: false,
                    cull: None,
                    topology: PrimitiveTopology::TriangleList,
                    depth,
                    bias: wgpu::DepthBiasState::default(),
                }
                .build(device)
            };
        let theatre_layout = pipeline_layout(device, "theatre", &[&kit.layouts.lit]);
        let last_layout = pipeline_layout(device, "last", &[&kit.layouts.last]);
        let theatre = full_screen(
            "theatre",
            &kit.stage,
            &theatre_layout,
            &constants,
            "vs_theatre",
            "fs_theatre",
            target.format,
            target.samples,
            Some((CompareFunction::LessEqual, false)),
        );
        let last_constants = [
            early,
            ("SMOOTH_EDGES", flag(target.samples == 1)),
            ("TARGET_ENCODES", flag(kit.output.is_srgb())),
        ];
        let last = full_screen(
            "last",
            &kit.last,
            &last_layout,
            &last_constants,
            "vs_last",
            "fs_last",
            kit.output,
            1,
            None,
        );
        Self {
            theatre,
            last,
            target,
            constants,
            looks: Vec::new(),
            shadows: Vec::new(),
            bare: Vec::new(),
            overlay: None,
            lines: None,
        }
    }

    /// Compiles what a look needs, with its shadow from `lights` lamps, if no figure has
    /// used it yet.
    pub(crate) fn prepare(&mut self, device: &Device, kit: &Kit, look: Look, lights: u32) {
        if self.look(look).is_none() {
            let pipeline = self.make_look(device, kit, look);
            self.looks.push((look, pipeline));
        }
        let shadow = look.shadow();
        if shadow == Shadow::Nothing {
            return;
        }
        for light in 0..lights {
            if self.shadow(light, shadow, look.bound).is_none() {
                let pipeline = make_shadow(device, kit, light, shadow, look.bound);
                self.shadows.push((light, shadow, look.bound, pipeline));
            }
        }
    }

    fn make_look(&self, device: &Device, kit: &Kit, look: Look) -> RenderPipeline {
        let Layouts {
            lit, figure, maps, ..
        } = &kit.layouts;
        let clear = look.layer == Layer::Clear;
        Recipe {
            label: "material",
            module: &kit.stage,
            layout: &pipeline_layout(device, "figure", &[lit, figure, maps]),
            constants: &self.constants,
            vertex: figure_entry(look.bound),
            buffers: &vertex_buffers()[..stream_count(look.bound)],
            fragment: Some(fragment_entry(look.kind)),
            target: Some(self.target.format),
            blend: clear.then_some(BlendState::PREMULTIPLIED_ALPHA_BLENDING),
            samples: self.target.samples,
            coverage: look.layer == Layer::Cut && self.target.samples > 1,
            cull: (!look.double_sided).then_some(Face::Back),
            topology: PrimitiveTopology::TriangleList,
            depth: Some((CompareFunction::Less, !clear)),
            bias: wgpu::DepthBiasState::default(),
        }
        .build(device)
    }

    /// Compiles what `shown` needs beyond materials, if nothing has needed it yet, for a
    /// figure that `has_tissue` or not.
    pub(crate) fn prepare_shown(
        &mut self,
        device: &Device,
        kit: &Kit,
        shown: &Shown,
        has_tissue: bool,
    ) {
        for bound in [false, true] {
            let wanted = shown.body && is_bare(shown) && (has_tissue || !bound);
            if wanted && self.bare(shown, bound).is_none() {
                let pipeline = self.make_bare(device, kit, shown, bound);
                self.bare
                    .push((shown.fill, shown.materials, bound, pipeline));
            }
        }
        if shown.has_overlay() && self.overlay.is_none() {
            self.overlay = Some(self.make_overlay(device, kit));
        }
    }

    /// Compiles what lines over figures need, if nothing has needed it yet.
    pub(crate) fn prepare_lines(&mut self, device: &Device, kit: &Kit) {
        if self.lines.is_none() {
            self.lines = Some([true, false].map(|behind| self.make_lines(device, kit, behind)));
        }
    }

    /// What draws meshes by edges, by corners or in clay, those that are `bound` to tissue or
    /// those that are not; `None` before [`Self::prepare_shown`].
    pub(crate) fn bare(&self, shown: &Shown, bound: bool) -> Option<&RenderPipeline> {
        let mut made = self.bare.iter();
        let found = made.find(|(f, m, b, _)| (*f, *m, *b) == (shown.fill, shown.materials, bound));
        found.map(|(.., pipeline)| pipeline)
    }

    fn make_bare(&self, device: &Device, kit: &Kit, shown: &Shown, bound: bool) -> RenderPipeline {
        let Layouts {
            lit, figure, maps, ..
        } = &kit.layouts;
        let mut constants = self.constants.clone();
        let flag = |b: bool| f64::from(u8::from(b));
        constants.push(("CLAY", flag(!shown.materials)));
        constants.push(("THIN", flag(shown.fill != Fill::Solid)));
        Recipe {
            constants: &constants,
            vertex: figure_entry(bound),
            buffers: &vertex_buffers()[..stream_count(bound)],
            blend: (shown.fill != Fill::Solid).then_some(BlendState::ALPHA_BLENDING),
            topology: match shown.fill {
                Fill::Solid => PrimitiveTopology::TriangleList,
                Fill::Wireframe => PrimitiveTopology::LineList,
                Fill::Points => PrimitiveTopology::PointList,
            },
            ..self.plainly(
                "bare",
                &kit.stage,
                &pipeline_layout(device, "figure", &[lit, figure, maps]),
                "fs_bare",
            )
        }
        .build(device)
    }

    fn make_overlay(&self, device: &Device, kit: &Kit) -> RenderPipeline {
        let vertices = VertexBufferLayout {
            array_stride: size_of::<OverVertex>() as u64,
            step_mode: wgpu::VertexStepMode::Vertex,
            attributes: &OVER_ATTRIBUTES,
        };
        Recipe {
            vertex: "vs_over",
            buffers: &[Some(vertices)],
            ..self.plainly(
                "overlay",
                &kit.stage,
                &pipeline_layout(device, "overlay", &[&kit.layouts.lit]),
                "fs_over",
            )
        }
        .build(device)
    }

    fn make_lines(&self, device: &Device, kit: &Kit, behind: bool) -> RenderPipeline {
        let lines = VertexBufferLayout {
            array_stride: size_of::<SentLine>() as u64,
            step_mode: wgpu::VertexStepMode::Instance,
            attributes: &LINE_ATTRIBUTES,
        };
        let mut constants = self.constants.clone();
        constants.push(("BEHIND", f64::from(u8::from(behind))));
        let compare = if behind {
            CompareFunction::Greater
        } else {
            CompareFunction::LessEqual
        };
        Recipe {
            constants: &constants,
            vertex: "vs_line",
            buffers: &[Some(lines)],
            blend: Some(BlendState::PREMULTIPLIED_ALPHA_BLENDING),
            topology: PrimitiveTopology::TriangleStrip,
            depth: Some((compare, false)),
            ..self.plainly(
                "lines",
                &kit.stage,
                &pipeline_layout(device, "lines", &[&kit.layouts.lit]),
                "fs_line",
            )
        }
        .build(device)
    }

    /// A recipe for what covers what it lies before and is seen from both sides.
    fn plainly<'a>(
        &'a self,
        label: &'a str,
        module: &'a ShaderModule,
        layout: &'a wgpu::PipelineLayout,
        fragment: &'a str,
    ) -> Recipe<'a> {
        Recipe {
            label,
            module,
            layout,
            constants: &self.constants,
            vertex: "",
            buffers: &[],
            fragment: Some(fragment),
            target: Some(self.target.format),
            blend: None,
            samples: self.target.samples,
            coverage: false,
            cull: None,
            topology: PrimitiveTopology::TriangleList,
            depth: Some((CompareFunction::Less, true)),
            bias: wgpu::DepthBiasState::default(),
        }
    }

    /// The pipeline of a look; `None` before [`Self::prepare`].
    pub(crate) fn look(&self, look: Look) -> Option<&RenderPipeline> {
        let found = self.looks.iter().find(|(l, _)| *l == look);
        found.map(|(_, pipeline)| pipeline)
    }

    /// The pipeline of a shadow; `None` before [`Self::prepare`].
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
    kit: &Kit,
    light: u32,
    shadow: Shadow,
    bound: bool,
) -> RenderPipeline {
    let Layouts {
        frame,
        figure,
        maps,
        ..
    } = &kit.layouts;
    let (groups, fragment): (&[_], _) = match shadow {
        Shadow::Strands => (&[frame, figure], Some("fs_hair_shadow")),
        Shadow::Picture => (&[frame, figure, maps], Some("fs_cut_shadow")),
        Shadow::Solid | Shadow::Nothing => (&[frame, figure], None),
    };
    Recipe {
        label: "shadow",
        module: &kit.stage,
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

fn figure_entry(bound: bool) -> &'static str {
    if bound { "vs_bound" } else { "vs_figure" }
}

fn fragment_entry(kind: MaterialKind) -> &'static str {
    match kind {
        MaterialKind::Skin => "fs_skin",
        MaterialKind::Eye => "fs_eye",
        MaterialKind::Cornea => "fs_cornea",
        MaterialKind::Teeth => "fs_teeth",
        MaterialKind::Mouth => "fs_mouth",
        MaterialKind::Hair => "fs_hair",
        MaterialKind::Lash => "fs_lash",
        MaterialKind::Cloth => "fs_cloth",
        MaterialKind::Leather => "fs_leather",
        MaterialKind::Nail => "fs_nail",
        MaterialKind::Plain => "fs_plain",
        MaterialKind::Rib
        | MaterialKind::Woven
        | MaterialKind::Denim
        | MaterialKind::Corduroy
        | MaterialKind::Fleece => "fs_cloth",
    }
}
