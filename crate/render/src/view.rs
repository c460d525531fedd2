//! Camera of a frame as matrices and rays.

use glam::dcamera::rh::{proj::directx::perspective, view::look_to_mat4};
use raconteur_base::{DMat4, DVec3, ops};
use raconteur_stage::Camera;

/// Camera of a frame as matrix and axes for the shaders.
#[derive(Clone, Copy, Debug)]
pub(crate) struct View {
    pub(crate) clip_from_world: DMat4,
    pub(crate) forward: DVec3,
    /// Vector to the right edge of the image at distance 1.
    pub(crate) right: DVec3,
    /// Vector to the upper edge of the image at distance 1.
    pub(crate) up: DVec3,
    /// Half the height of the image at distance 1, metres.
    pub(crate) half_height: f64,
}

impl View {
    /// Returns the view of a camera in an image of `aspect` (width over height). A camera without
    /// direction looks to the back; one that looks straight up or down keeps the image's top
    /// towards the back of the stage.
    pub(crate) fn new(camera: &Camera, aspect: f64) -> Self {
        let forward = (camera.target_in_world - camera.eye_in_world)
            .try_normalize()
            .unwrap_or(DVec3::NEG_Z);
        let right = forward.cross(DVec3::Y).try_normalize().unwrap_or(DVec3::X);
        let up = right.cross(forward);
        let half_height = ops::tan(0.5 * camera.fov_y_rad);
        let clip_from_view = perspective(camera.fov_y_rad, aspect, camera.near_m, camera.far_m);
        let view_from_world = look_to_mat4(camera.eye_in_world, forward, up);
        Self {
            clip_from_world: clip_from_view * view_from_world,
            forward,
            right: right * (half_height * aspect),
            up: up * half_height,
            half_height,
        }
    }
}
