//! Overlay of a figure: its bones, their frames and joints, and the targets of the manipulators.
//! Everything consists of one shape, a spindle of eight faces.

use bytemuck::{Pod, Zeroable};
use glam::Vec3;
use raconteur_base::DAffine3;
use raconteur_body::Bone;
use raconteur_stage::Frame;
use wgpu::{
    Buffer, BufferUsages, Device, Queue, VertexBufferLayout, VertexStepMode, vertex_attr_array,
};

use crate::gpu::empty_buffer;

/// Vertex of an overlay spindle: position (world, metres) and linear colour.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
pub(crate) struct OverlayVertex {
    at: [f32; 3],
    color: [u8; 4],
}

impl OverlayVertex {
    /// Vertex buffer layout of the overlay shader.
    pub(crate) const LAYOUT: VertexBufferLayout<'static> = VertexBufferLayout {
        array_stride: size_of::<Self>() as u64,
        step_mode: VertexStepMode::Vertex,
        attributes: &vertex_attr_array![0 => Float32x3, 1 => Unorm8x4],
    };
}

/// Corners of the triangles of one spindle.
const CORNERS: usize = 24;
/// Maximum number of spindles: a bone and one for its free end, three axes and a joint for each of
/// the bones; more are left out.
const MAX_SPINDLES: usize = 7 * Bone::COUNT;

/// Colours are linear and before the tone curve, 0..255.
const BONE: [f32; 3] = [168.0, 140.0, 98.0];
const JOINT: [f32; 3] = [220.0, 120.0, 10.0];
const HANDLE: [f32; 3] = [10.0, 150.0, 220.0];
const AXES: [[f32; 3]; 3] = [
    [210.0, 16.0, 12.0],
    [24.0, 150.0, 20.0],
    [20.0, 60.0, 230.0],
];

/// Overlay of a figure's bones, joints and manipulator targets, drawn as spindles.
pub(crate) struct Overlay {
    corners: Vec<OverlayVertex>,
    pub(crate) buffer: Buffer,
}

impl Overlay {
    pub(crate) fn new(device: &Device) -> Self {
        let most = MAX_SPINDLES * CORNERS;
        Self {
            corners: Vec::with_capacity(most),
            buffer: empty_buffer(
                device,
                "overlay",
                (most * size_of::<OverlayVertex>()) as u64,
                BufferUsages::VERTEX,
            ),
        }
    }

    /// Returns the number of corners to draw.
    pub(crate) fn len(&self) -> u32 {
        self.corners.len() as u32
    }

    /// Builds and uploads a frame's overlay for a figure of this stature; allocates nothing.
    pub(crate) fn send(&mut self, queue: &Queue, frame: &Frame, stature_m: f32) {
        self.corners.clear();
        let joints = &frame.world_from_joint;
        for bone in Bone::ALL {
            if let Some(here) = joints.get(bone.index()) {
                let parent = bone.parent().and_then(|p| joints.get(p.index()));
                self.joint(frame, bone, here, parent, stature_m);
            }
        }
        if frame.visibility.manipulators {
            for handle in &frame.handles {
                self.dot(place(handle), 0.016 * stature_m, HANDLE);
                self.axes(handle, 0.07 * stature_m);
            }
        }
        self.corners.truncate(MAX_SPINDLES * CORNERS);
        queue.write_buffer(&self.buffer, 0, bytemuck::cast_slice(&self.corners));
    }

    fn joint(
        &mut self,
        frame: &Frame,
        bone: Bone,
        here: &DAffine3,
        parent: Option<&DAffine3>,
        stature_m: f32,
    ) {
        let (at, axis) = (place(here), here.matrix3.as_mat3());
        let (start, hint) =
            parent.map_or((at, Vec3::X), |p| (place(p), p.matrix3.y_axis.as_vec3()));
        let length = (at - start).length();
        // The chin turns about a point inside the head.
        if frame.visibility.bones && bone != Bone::Chin {
            self.bone(start, at, hint);
            if is_free(bone) {
                self.bone(at, at + axis.x_axis * (0.9 * length), axis.y_axis);
            }
        }
        // Fingers are near each other, and so are smaller.
        let size = (0.45 * length).clamp(0.009 * stature_m, 0.045 * stature_m);
        if frame.visibility.frames {
            self.axes(here, size);
        }
        if frame.visibility.centers {
            self.dot(at, 0.2 * size, JOINT);
        }
    }

    fn bone(&mut self, from: Vec3, to: Vec3, hint: Vec3) {
        let radius = (0.1 * (to - from).length()).min(0.025);
        self.spindle(from, to, hint, (0.16, radius), BONE);
    }

    fn axes(&mut self, frame: &DAffine3, length: f32) {
        let (at, axes) = (place(frame), frame.matrix3.as_mat3());
        for (i, color) in AXES.into_iter().enumerate() {
            let tip = at + axes.col(i).normalize_or_zero() * length;
            self.spindle(at, tip, axes.col((i + 1) % 3), (0.1, 0.06 * length), color);
        }
    }

    fn dot(&mut self, at: Vec3, radius: f32, color: [f32; 3]) {
        let up = Vec3::Y * radius;
        self.spindle(at - up, at + up, Vec3::Z, (0.5, radius), color);
    }

    /// Adds a spindle between two points, thickest at the share `waist` of its length, with
    /// `radius` there; one of its edges points towards `hint`.
    fn spindle(
        &mut self,
        from: Vec3,
        to: Vec3,
        hint: Vec3,
        (waist, radius): (f32, f32),
        color: [f32; 3],
    ) {
        let along = to - from;
        let Some(side) = along.cross(hint).try_normalize() else {
            return;
        };
        let front = side.cross(along).normalize_or_zero();
        let middle = from + along * waist;
        let ring = [side, front, -side, -front];
        for i in 0..4 {
            let (a, b) = (ring[i], ring[(i + 1) % 4]);
            // A lamp above the viewer's left shoulder shapes the four sides.
            let lit = 0.68 + 0.24 * (a + b).dot(Vec3::new(-0.4, 0.7, 0.6));
            let [r, g, b_] = color.map(|c| (c * lit) as u8);
            let (a, b) = (middle + a * radius, middle + b * radius);
            for at in [from, a, b, to, b, a] {
                self.corners.push(OverlayVertex {
                    at: at.into(),
                    color: [r, g, b_, 255],
                });
            }
        }
    }
}

fn place(world: &DAffine3) -> Vec3 {
    world.translation.as_vec3()
}

/// Returns true if a bone has no child other than the chin.
fn is_free(bone: Bone) -> bool {
    bone == Bone::Skull || !Bone::ALL.iter().any(|b| b.parent() == Some(bone))
}
