//! Helpers for basic device objects.

use wgpu::{Buffer, BufferUsages, Device, VertexAttribute, VertexFormat};

/// Creates an empty GPU buffer that is written later.
pub(crate) fn empty_buffer(device: &Device, label: &str, size: u64, usage: BufferUsages) -> Buffer {
    device.create_buffer(&wgpu::BufferDescriptor {
        label: Some(label),
        size,
        usage: usage | BufferUsages::COPY_DST,
        mapped_at_creation: false,
    })
}

/// Returns a bind group entry for a resource and its binding number.
pub(crate) fn binding(
    binding: u32,
    resource: wgpu::BindingResource<'_>,
) -> wgpu::BindGroupEntry<'_> {
    wgpu::BindGroupEntry { binding, resource }
}

/// Creates a bind group.
pub(crate) fn bind_group(
    device: &Device,
    label: &str,
    layout: &wgpu::BindGroupLayout,
    entries: &[wgpu::BindGroupEntry<'_>],
) -> wgpu::BindGroup {
    device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some(label),
        layout,
        entries,
    })
}

/// Returns a vertex attribute at an offset in bytes.
pub(crate) const fn attribute(
    format: VertexFormat,
    offset: u64,
    shader_location: u32,
) -> VertexAttribute {
    VertexAttribute {
        format,
        offset,
        shader_location,
    }
}
