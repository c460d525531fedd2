//! Lines and dots over a figure: muscles and springs of its face.

use bytemuck::{Pod, Zeroable};
use raconteur_stage::Line;
use wgpu::{
    Buffer, BufferUsages, Device, Queue, VertexBufferLayout, VertexStepMode, vertex_attr_array,
};

use crate::gpu::empty_buffer;

/// Instance data of one overlay line for the shader: ends, colour and width.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
pub(crate) struct LineInstance {
    from: [f32; 3],
    to: [f32; 3],
    color: [u8; 4],
    width: f32,
}

impl LineInstance {
    /// Vertex buffer layout of the line shader.
    pub(crate) const LAYOUT: VertexBufferLayout<'static> = VertexBufferLayout {
        array_stride: size_of::<Self>() as u64,
        step_mode: VertexStepMode::Instance,
        attributes: &vertex_attr_array![0 => Float32x3, 1 => Float32x3, 2 => Unorm8x4, 3 => Float32],
    };
}

/// Maximum number of lines: twice the springs of a face. More are left out.
const MAX_LINES: usize = 1 << 16;

/// Overlay lines on the GPU, which show muscles and springs of the face.
pub(crate) struct Lines {
    sent: Vec<LineInstance>,
    /// Capacity of the buffer, lines.
    room: usize,
    pub(crate) buffer: Buffer,
}

impl Lines {
    pub(crate) fn new(device: &Device) -> Self {
        let room = 1024;
        Self {
            sent: Vec::new(),
            room,
            buffer: buffer_for(device, room),
        }
    }

    /// Returns the number of lines to draw.
    pub(crate) fn count(&self) -> u32 {
        self.sent.len() as u32
    }

    /// Uploads the current lines. Allocates only when there are more than ever before.
    pub(crate) fn send(&mut self, device: &Device, queue: &Queue, lines: &[Line]) {
        self.sent.clear();
        self.sent
            .extend(lines.iter().take(MAX_LINES).map(|l| LineInstance {
                from: l.from_in_world,
                to: l.to_in_world,
                color: l.color,
                width: l.width_px,
            }));
        if self.sent.len() > self.room {
            self.room = self.sent.len().next_power_of_two();
            self.buffer = buffer_for(device, self.room);
        }
        queue.write_buffer(&self.buffer, 0, bytemuck::cast_slice(&self.sent));
    }
}

fn buffer_for(device: &Device, room: usize) -> Buffer {
    let bytes = (room * size_of::<LineInstance>()) as u64;
    empty_buffer(device, "lines", bytes, BufferUsages::VERTEX)
}
