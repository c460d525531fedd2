//! Uniform block shared by all passes: `Frame` of `shader/frame.wgsl`.

use bytemuck::{Pod, Zeroable};
use glam::Vec3;
use raconteur_base::DVec3;
use raconteur_body::Bone;
use raconteur_stage::{Frame, StageSet};

use crate::environment;
use crate::shadow::ShadowView;
use crate::view::View;

/// Radius of an eyeball, mm: the globes of figures, and of the proportions in `shader/eye.wgsl`.
const GLOBE_RADIUS_MM: f64 = 12.0;

/// Uniform block of a frame, field by field as `Frame` in the shaders.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
pub(crate) struct FrameUniform {
    clip_from_world: [f32; 16],
    shadow_from_world: [[f32; 16]; 2],
    ray_forward: [f32; 4],
    ray_right: [f32; 4],
    ray_up: [f32; 4],
    eye_in_world: [f32; 4],
    key_dir: [f32; 4],
    key: [f32; 4],
    fill_dir: [f32; 4],
    fill: [f32; 4],
    rim_dir: [f32; 4],
    rim: [f32; 4],
    sky: [f32; 4],
    ground: [f32; 4],
    floor: [f32; 4],
    backdrop_low: [f32; 4],
    backdrop_high: [f32; 4],
    glow: [f32; 4],
    fog: [f32; 4],
    stand: [f32; 4],
    feet: [[f32; 4]; 2],
    shadow: [f32; 4],
    viewport: [f32; 4],
    ambient: [[f32; 4]; 9],
    head_up: [f32; 4],
    /// Radius of the pupil over that of the globe, then the distance of the lips, mm.
    pub(crate) eyes: [f32; 4],
    /// Edges of the lids, see `LidEdge::plane`.
    pub(crate) lids: [[f32; 4]; 4],
    /// Mapping of a ray to the still of the backdrop: horizontal, vertical, and their common
    /// divisor.
    pub(crate) still: [[f32; 4]; 3],
}

/// Returns the standing position of the figure, from its joints; the stage's middle without joints.
pub(crate) fn stand_in_world(frame: &Frame) -> DVec3 {
    frame.world_from_joint.first().map_or(DVec3::ZERO, |root| {
        DVec3::new(root.translation.x, 0.0, root.translation.z)
    })
}

/// Returns a set's number in the shaders.
fn number_of(kind: StageSet) -> f32 {
    match kind {
        StageSet::Studio => 0.0,
        StageSet::Curtain => 1.0,
        StageSet::Fireside => 2.0,
        StageSet::Garden => 3.0,
        StageSet::Night => 4.0,
        StageSet::School => 5.0,
    }
}

impl FrameUniform {
    /// Returns the parts on which a set depends without shadows, without the camera direction: the
    /// soles and the place under the figure are rounded to a centimetre, because it sways.
    pub(crate) fn of_backdrop(&self) -> Self {
        let to_cm = |p: [f32; 4]| p.map(|x| (x * 100.0).round() / 100.0);
        let [x, y, z, _] = self.eye_in_world;
        let [.., number] = self.backdrop_low;
        // Only the night set has ground lit by the rim light.
        let rim = if number == number_of(StageSet::Night) {
            self.rim
        } else {
            [0.0; 4]
        };
        Self {
            rim,
            shadow_from_world: [[0.0; 16]; 2],
            eye_in_world: [x, y, z, 0.0],
            stand: to_cm(self.stand),
            feet: self.feet.map(to_cm),
            shadow: [0.0; 4],
            ambient: [[0.0; 4]; 9],
            head_up: [0.0; 4],
            eyes: [0.0; 4],
            lids: [[0.0; 4]; 4],
            still: [[0.0; 4]; 3],
            clip_from_world: [0.0; 16],
            ray_forward: [0.0; 4],
            ray_right: [0.0; 4],
            ray_up: [0.0; 4],
            ..*self
        }
    }

    /// Creates the uniform; `size` is that of the image, pixels.
    pub(crate) fn new(
        frame: &Frame,
        view: &View,
        shadows: &[ShadowView; 2],
        stature_m: f64,
        size: (u32, u32),
    ) -> Self {
        let light = &frame.lighting;
        let sole = |bone: Bone| {
            frame
                .world_from_joint
                .get(bone.index())
                .map_or([0.0, -9.0, 0.0, 0.0], |j| {
                    // The contact shadow is below the instep, on the floor.
                    point(
                        DVec3::new(
                            j.translation.x,
                            0.0_f64.max(j.translation.y - 0.09),
                            j.translation.z,
                        ),
                        0.0,
                    )
                })
        };
        let (w, h) = (size.0 as f32, size.1 as f32);
        Self {
            clip_from_world: view.clip_from_world.as_mat4().to_cols_array(),
            shadow_from_world: shadows
                .each_ref()
                .map(|s| s.clip_from_world.as_mat4().to_cols_array()),
            ray_forward: point(view.forward, 0.0),
            ray_right: point(view.right, 0.0),
            ray_up: point(view.up, 0.0),
            eye_in_world: point(frame.camera.eye_in_world, frame.set.time_secs as f32),
            key_dir: direction(light.key.towards_light_in_world),
            key: color(light.key.irradiance, 0.0),
            fill_dir: direction(light.fill.towards_light_in_world),
            fill: color(light.fill.irradiance, 0.0),
            rim_dir: direction(light.rim.towards_light_in_world),
            rim: color(light.rim.irradiance, 0.0),
            sky: color(light.sky, 0.0),
            ground: color(light.ground, light.exposure),
            floor: color(frame.set.floor, 0.0),
            backdrop_low: color(frame.set.backdrop_low, number_of(frame.set.kind)),
            backdrop_high: color(frame.set.backdrop_high, 0.0),
            glow: color(frame.set.glow, 0.0),
            fog: color(frame.set.fog, frame.set.fog_density),
            stand: point(stand_in_world(frame), stature_m as f32),
            feet: [sole(Bone::LMidtarsal), sole(Bone::RMidtarsal)],
            shadow: [
                shadows[0].tap_uv,
                shadows[0].normal_offset_m,
                shadows[0].depth_bias,
                shadows[0].depth_of_metre,
            ],
            viewport: [w, h, 1.0 / w, 1.0 / h],
            ambient: environment::harmonics(light, &frame.set).map(|c| color(c, 0.0)),
            head_up: point(
                frame
                    .world_from_joint
                    .get(Bone::Skull.index())
                    .map_or(DVec3::Y, |head| head.matrix3.y_axis.normalize_or(DVec3::Y)),
                frame
                    .camera
                    .eye_in_world
                    .distance(frame.camera.target_in_world) as f32,
            ),
            eyes: [
                (0.5 * frame.pupil_mm / GLOBE_RADIUS_MM) as f32,
                0.0,
                0.0,
                0.0,
            ],
            lids: [[0.0; 4]; 4],
            still: [[0.0; 4]; 3],
        }
    }

    /// Returns the rays through the centre, and half an image right and up.
    pub(crate) fn rays(&self) -> [Vec3; 3] {
        [self.ray_forward, self.ray_right, self.ray_up].map(|r| Vec3::new(r[0], r[1], r[2]))
    }
}

fn point(p: DVec3, w: f32) -> [f32; 4] {
    [p.x as f32, p.y as f32, p.z as f32, w]
}

fn direction(d: DVec3) -> [f32; 4] {
    point(d.try_normalize().unwrap_or(DVec3::Y), 0.0)
}

fn color(c: [f32; 3], w: f32) -> [f32; 4] {
    [c[0], c[1], c[2], w]
}
