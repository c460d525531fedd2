//! View of a light's shadow map.

use glam::dcamera::rh::{proj::directx::orthographic, view::look_to_mat4};
use raconteur_base::{DMat4, DVec3};
use raconteur_stage::{Camera, DirectedLight};

use crate::view::View;

/// View of a light for its shadow map, with the parameters of the shadow filter.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ShadowView {
    pub(crate) clip_from_world: DMat4,
    /// Distance between taps, in map widths.
    pub(crate) tap_uv: f32,
    /// Offset of a surface point along its normal before the look-up, metres.
    pub(crate) normal_offset_m: f32,
    /// Subtracted from the depth before comparing.
    pub(crate) depth_bias: f32,
    /// Depth-map units per metre.
    pub(crate) depth_of_metre: f32,
}

/// Subject of a shadow map: the figure and the part of it that the camera sees.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ShadowSubject<'a> {
    pub(crate) camera: &'a Camera,
    pub(crate) view: &'a View,
    /// Standing position of the figure.
    pub(crate) feet_in_world: DVec3,
    pub(crate) stature_m: f64,
}

/// Distance between filter taps on the figure, metres: the edge of a large soft lamp.
const SOFT_TAP_M: f64 = 0.0028;

impl ShadowView {
    /// Fits the map to the visible part of the figure, so a close shot has finer shadows. Casters
    /// outside still cast: depth covers the whole figure. Edges are `softness` times as soft as
    /// from a large lamp.
    pub(crate) fn new(
        light: &DirectedLight,
        softness: f64,
        subject: &ShadowSubject<'_>,
        texels: u32,
    ) -> Self {
        let ShadowSubject {
            camera,
            view,
            feet_in_world: stand_in_world,
            stature_m,
        } = *subject;
        let towards = light
            .towards_light_in_world
            .try_normalize()
            .unwrap_or(DVec3::Y);
        // Outstretched arms reach half the stature from the middle.
        let whole = 0.72 * stature_m;
        let middle = stand_in_world + DVec3::Y * (0.5 * stature_m);
        let distance = (camera.target_in_world - camera.eye_in_world).length();
        let seen_half_height = distance * view.half_height;
        let half_diagonal = seen_half_height
            * (1.0 + view.right.length_squared() / view.up.length_squared()).sqrt();
        // A third more than the visible area, for objects behind the target's plane.
        let close = half_diagonal * 1.35;
        let (centre, radius) = if close.is_finite() && close < whole {
            // Only as fine as the filter can use.
            (camera.target_in_world, close.max(0.40))
        } else {
            (middle, whole)
        };
        let texel_m = 2.0 * radius / f64::from(texels);
        let up = if towards.y.abs() > 0.99 {
            DVec3::Z
        } else {
            DVec3::Y
        };
        // Shadow casters may be a whole stature nearer to the lamp than anything visible.
        let back = 2.0 * stature_m;
        let far = back + 2.0 * stature_m;
        let light_from_world = look_to_mat4(centre + towards * back, -towards, up);
        let clip_from_light = orthographic(-radius, radius, -radius, radius, 0.0, far);
        let tap_m = (SOFT_TAP_M * softness).max(1.1 * texel_m);
        Self {
            clip_from_world: clip_from_light * light_from_world,
            tap_uv: (tap_m / (2.0 * radius)) as f32,
            normal_offset_m: (1.6 * tap_m + 0.0012) as f32,
            depth_bias: ((0.35 * tap_m + 0.0004) / far) as f32,
            depth_of_metre: (1.0 / far) as f32,
        }
    }
}
