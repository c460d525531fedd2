//! Descriptions of pipelines by their differences.

use wgpu::{
    BindGroupLayout, BlendState, CompareFunction, Device, Face, PrimitiveTopology, RenderPipeline,
    ShaderModule, TextureFormat, VertexBufferLayout,
};

use crate::target::DEPTH_FORMAT;

/// Variable parts of a render pipeline descriptor; the rest is the same for all pipelines.
pub(super) struct PipelineDescription<'a> {
    pub(super) label: &'a str,
    pub(super) module: &'a ShaderModule,
    pub(super) layout: &'a wgpu::PipelineLayout,
    pub(super) constants: &'a [(&'a str, f64)],
    pub(super) vertex: &'a str,
    pub(super) buffers: &'a [Option<VertexBufferLayout<'static>>],
    pub(super) fragment: Option<&'a str>,
    pub(super) target: Option<TextureFormat>,
    pub(super) blend: Option<BlendState>,
    pub(super) writes: wgpu::ColorWrites,
    pub(super) samples: u32,
    pub(super) coverage: bool,
    pub(super) cull: Option<Face>,
    pub(super) topology: PrimitiveTopology,
    /// Compare and write, when there is a depth buffer.
    pub(super) depth: Option<(CompareFunction, bool)>,
    pub(super) bias: wgpu::DepthBiasState,
}

impl PipelineDescription<'_> {
    pub(super) fn build(&self, device: &Device) -> RenderPipeline {
        let options = wgpu::PipelineCompilationOptions {
            constants: self.constants,
            ..Default::default()
        };
        let targets = [self.target.map(|format| wgpu::ColorTargetState {
            format,
            blend: self.blend,
            write_mask: self.writes,
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

/// Depth state of backgrounds: tested but not written.
pub(super) const BEHIND: Option<(CompareFunction, bool)> =
    Some((CompareFunction::LessEqual, false));

/// Returns a description with one triangle over the whole image.
pub(super) fn full_screen<'a>(
    module: &'a ShaderModule,
    layout: &'a wgpu::PipelineLayout,
    format: TextureFormat,
) -> PipelineDescription<'a> {
    PipelineDescription {
        label: "full screen",
        module,
        layout,
        constants: &[],
        vertex: "",
        buffers: &[],
        fragment: None,
        target: Some(format),
        blend: None,
        writes: wgpu::ColorWrites::ALL,
        samples: 1,
        coverage: false,
        cull: None,
        topology: PrimitiveTopology::TriangleList,
        depth: None,
        bias: wgpu::DepthBiasState::default(),
    }
}

pub(super) fn pipeline_layout(
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
