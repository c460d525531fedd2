//! What pages draw over the picture and beside it, as numbers.
//!
//! Nothing of it is needed before a face moves, so that its code is in the file of the face:
//! `web/tools/split.mjs` cuts here. Its functions are never inlined, or the code would come along.

use raconteur_player::Player;
use raconteur_player::body::face::MUSCLES;

/// Samples that are taken at once at most.
const MOST: usize = 4096;

#[inline(never)]
pub(crate) fn controls(performer: &Player, from: f64, to: f64, count: usize) -> Vec<f32> {
    let mut numbers = Vec::new();
    let count = count.min(MOST);
    for i in 0..count {
        let share = i as f64 / (count - 1).max(1) as f64;
        let mut c = performer.face_controls(from + (to - from) * share);
        c.limit();
        let mut put = |values: &[f64]| numbers.extend(values.iter().map(|&v| v as f32));
        let all: &[f64; MUSCLES] = &c.contraction;
        put(all);
        put(&[
            c.jaw.pitch_rad,
            c.jaw.yaw_rad,
            c.jaw.forward_m,
            c.jaw.down_m,
        ]);
        put(&c.upper_lid);
        put(&c.lower_lid);
        put(&c.protrusion);
        put(&[
            c.seal,
            c.bite,
            c.tongue_tip,
            c.tongue_back,
            c.tongue_out,
            c.blush,
        ]);
    }
    numbers
}

#[inline(never)]
pub(crate) fn segments(performer: &Player) -> Vec<f32> {
    let mut numbers = Vec::new();
    for (start, track) in performer.lips() {
        for (_, segment) in track.segments() {
            let own = segment.iter().enumerate();
            numbers.extend(own.map(|(k, v)| (v + if k < 4 { *start } else { 0.0 }) as f32));
        }
    }
    numbers
}

#[inline(never)]
pub(crate) fn names(performer: &Player) -> Vec<String> {
    let tracks = performer.lips().iter();
    let segments = tracks.flat_map(|(_, track)| track.segments());
    segments.map(|(name, _)| name.to_owned()).collect()
}

/// As `Player.pose`.
#[inline(never)]
pub(crate) fn pose(performer: &mut Player, aspect: f64) -> Vec<f32> {
    let mut numbers = Vec::new();
    let manipulators = performer.manipulators(performer.last_frame().time_secs);
    let mut put = |values: &[f64]| numbers.extend(values.iter().map(|&v| v as f32));
    let frame = performer.last_frame();
    let camera = &frame.camera;
    put(&camera.eye_in_world.to_array());
    put(&camera.target_in_world.to_array());
    put(&[camera.fov_y_rad, aspect, camera.near_m, camera.far_m]);
    let units = performer.units();
    put(&units.speaker_point([0.0; 3]).to_array());
    let joints = performer.figure().skeleton.joints();
    put(&[units.world_point([1.0, 0.0, 0.0]).x, joints.len() as f64]);
    for (joint, world) in joints.iter().zip(&frame.world_from_joint) {
        put(&[joint.parent.map_or(-1.0, |p| p as f64)]);
        put(&world.to_cols_array());
    }
    for manipulator in &manipulators {
        put(&manipulator.target_in_world.to_array());
        put(&[manipulator.error_m]);
    }
    numbers
}

/// As `Player.poseNames`.
#[inline(never)]
pub(crate) fn pose_names(performer: &mut Player) -> Vec<String> {
    let manipulators = performer.manipulators(performer.last_frame().time_secs);
    let joints = performer.figure().skeleton.joints().iter();
    joints
        .map(|j| j.name.clone())
        .chain(manipulators.iter().map(|m| m.name.to_owned()))
        .collect()
}

/// As `poseDigests`.
#[inline(never)]
pub(crate) fn digests(performer: &mut Player, times_secs: &[f64]) -> Vec<String> {
    let digests = times_secs.iter().map(|&t| performer.digest(t));
    digests.map(|digest| format!("{digest:016x}")).collect()
}
