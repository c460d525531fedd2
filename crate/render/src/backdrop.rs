//! Still image of the stage without a figure. While the camera is fixed, the lowest quality renders
//! the set once and uses it as the background of every frame, rotated and scaled as the camera
//! turns and zooms.

use glam::{Vec3, Vec4};
use wgpu::{Device, TextureFormat, TextureUsages, TextureView};

use crate::gpu::{bind_group, binding};
use crate::layouts::Layouts;
use crate::uniform::FrameUniform;

/// Width of a still relative to the image that it is rendered for, so it can be reused while the
/// camera moves.
const STILL_MARGIN: f32 = 1.15;
/// Maximum enlargement of a still; the background behind the speaker is out of focus. Chosen by
/// eye.
const MAX_ENLARGED: f32 = 1.7;

/// Backdrop textures of one image size: the stage without the figure, reused while the camera
/// stands still.
pub(crate) struct Backdrop {
    pub(crate) view: TextureView,
    /// Bindings of the pass that composites it.
    pub(crate) group: wgpu::BindGroup,
    /// State of the previous image, without its camera direction.
    last: Option<FrameUniform>,
    /// Camera rays of the previous image.
    last_rays: Option<[Vec3; 3]>,
    still: Option<StillKey>,
    /// Size of the images.
    size: (u32, u32),
}

/// Rendering mode of an image's backdrop: drawn directly, or as a reusable still.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum BackdropMode {
    /// Rendered with the image, since it differs from the previous one and may change again.
    Directly,
    /// Rendered as a still that later images reuse.
    Now,
    /// Reused from a still rendered earlier.
    Before,
}

impl Backdrop {
    pub(crate) fn new(
        device: &Device,
        layouts: &Layouts,
        frame: &wgpu::Buffer,
        sampler: &wgpu::Sampler,
        format: TextureFormat,
        size: (u32, u32),
    ) -> Self {
        let view = device
            .create_texture(&wgpu::TextureDescriptor {
                label: Some("backdrop"),
                size: wgpu::Extent3d {
                    width: wider(size.0),
                    height: wider(size.1),
                    depth_or_array_layers: 1,
                },
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage: TextureUsages::RENDER_ATTACHMENT | TextureUsages::TEXTURE_BINDING,
                view_formats: &[],
            })
            .create_view(&wgpu::TextureViewDescriptor::default());
        let group = bind_group(
            device,
            "backdrop",
            &layouts.tone_map,
            &[
                binding(0, frame.as_entire_binding()),
                binding(1, wgpu::BindingResource::TextureView(&view)),
                binding(2, wgpu::BindingResource::Sampler(sampler)),
            ],
        );
        Self {
            view,
            group,
            last: None,
            last_rays: None,
            still: None,
            size,
        }
    }

    /// Returns the mode of the next image's backdrop, and sets the mapping of the image's rays to
    /// the still.
    pub(crate) fn next(&mut self, uniform: &mut FrameUniform) -> BackdropMode {
        let shown = uniform.of_backdrop();
        let is_same = self
            .last
            .is_some_and(|last| bytemuck::bytes_of(&last) == bytemuck::bytes_of(&shown));
        self.last = Some(shown);
        if !is_same {
            self.still = None;
            self.last_rays = Some(uniform.rays());
            return BackdropMode::Directly;
        }
        let rays = uniform.rays();
        let stands = self.last_rays.replace(rays) == Some(rays);
        let serving = self.still.filter(|still| match stands {
            // The image of a fixed camera is the same at any time.
            true => still.is_own && still.rays == rays,
            false => serves(still.rays, rays),
        });
        let still = serving.unwrap_or_else(|| StillKey::from_camera(rays, stands));
        uniform.still = places(still.rays);
        uniform.still[2][3] = f32::from(u8::from(stands));
        if serving.is_some() {
            return BackdropMode::Before;
        }
        uniform.still[0][3] = if stands { 0.0 } else { STILL_MARGIN - 1.0 };
        self.still = Some(still);
        BackdropMode::Now
    }

    /// Returns the rendered part of the still's texture, pixels.
    pub(crate) fn drawn_size(&self) -> (f32, f32) {
        let (width, height) = self.size;
        match self.still {
            Some(StillKey { is_own: true, .. }) | None => (width as f32, height as f32),
            Some(_) => (wider(width) as f32, wider(height) as f32),
        }
    }
}

/// Content of a still.
#[derive(Clone, Copy)]
struct StillKey {
    /// Rays, as in an image.
    rays: [Vec3; 3],
    /// True if it matches the image pixel by pixel, without margin.
    is_own: bool,
}

impl StillKey {
    fn from_camera([forward, right, up]: [Vec3; 3], is_own: bool) -> Self {
        let margin = if is_own { 1.0 } else { STILL_MARGIN };
        Self {
            rays: [forward, right * margin, up * margin],
            is_own,
        }
    }
}

fn wider(n: u32) -> u32 {
    (n as f32 * STILL_MARGIN).ceil() as u32
}

/// Returns the matrix that maps a ray to its position in a still.
fn places([forward, right, up]: [Vec3; 3]) -> [[f32; 4]; 3] {
    let over = |v: Vec3| (v / v.length_squared()).extend(0.0).to_array();
    [over(right), over(up), over(forward)]
}

/// Returns true if a still covers an image, with sufficient resolution.
fn serves(still: [Vec3; 3], [forward, right, up]: [Vec3; 3]) -> bool {
    let [across, upwards, over] = places(still).map(Vec4::from_array).map(Vec4::truncate);
    let is_in = |(x, y): (f32, f32)| {
        let ray = forward + right * x + up * y;
        let depth = ray.dot(over);
        depth > 0.0 && ray.dot(across).abs() <= depth && ray.dot(upwards).abs() <= depth
    };
    let corners = [(-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0), (1.0, 1.0)];
    corners.into_iter().all(is_in) && up.length() * MAX_ENLARGED >= still[2].length()
}

#[cfg(test)]
mod tests {
    use raconteur_base::{DVec3, ops};

    use super::*;

    fn rays(turn: f64, tilt: f64, half: f32) -> [Vec3; 3] {
        let ((sine, cosine), (rise, level)) = (ops::sincos(turn), ops::sincos(tilt));
        let forward = DVec3::new(sine * level, rise, -cosine * level).as_vec3();
        let right = forward.cross(Vec3::Y).normalize();
        [forward, right * (half * 1.78), right.cross(forward) * half]
    }

    #[test]
    fn a_still_serves_while_all_of_a_picture_lies_in_it() {
        let still = rays(0.0, -0.05, 0.2 * STILL_MARGIN);
        for (turn, tilt, half, expected) in [
            (0.0, -0.05, 0.2, true),
            (0.02, -0.05, 0.2, true),
            (0.0, -0.04, 0.17, true),
            (0.2, -0.05, 0.2, false),
            (0.0, 0.1, 0.2, false),
            (0.0, -0.05, 0.24, false),
            (0.0, -0.05, 0.1, false),
            (3.0, -0.05, 0.2, false),
        ] {
            assert_eq!(
                serves(still, rays(turn, tilt, half)),
                expected,
                "{turn} {tilt} {half}"
            );
        }
    }

    #[test]
    fn a_ray_lies_where_the_still_has_it() {
        let still = rays(0.1, -0.05, 0.25);
        let [across, upwards, over] = places(still).map(|r| Vec4::from_array(r).truncate());
        for (x, y) in [(0.0, 0.0), (0.7, -0.3), (-1.0, 1.0)] {
            let ray = (still[0] + still[1] * x + still[2] * y) * 2.5;
            assert!(
                (ray.dot(across) / ray.dot(over) - x).abs() < 1e-5,
                "the horizontal position of the ray in the still"
            );
            assert!(
                (ray.dot(upwards) / ray.dot(over) - y).abs() < 1e-5,
                "the vertical position of the ray in the still"
            );
        }
    }
}
