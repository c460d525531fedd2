//! Rendered images on any Vulkan device (Mesa's software Vulkan suffices).

#![allow(clippy::expect_used, reason = "tests fail by panicking")]

mod common;
mod device;

use device::headless;
use raconteur_base::{DQuat, DVec3, ops};
use raconteur_body::{Bone, Figure, Pose};
use raconteur_render::{Headless, Quality, RenderError, RenderOptions};
use raconteur_stage::{Camera, Frame, Shot};

const SIZE: (u32, u32) = (160, 120);
const ASPECT: f64 = 160.0 / 120.0;

fn draw(device: &mut Headless, frame: &Frame) -> Vec<u8> {
    device.render_rgba(frame, SIZE.0, SIZE.1).expect("drawn")
}

fn medium(figure: &Figure, pose: &Pose) -> Frame {
    common::frame(figure, pose, Shot::Medium, ASPECT)
}

/// Pixels that differ by more than `limit` in a channel.
fn differing(a: &[u8], b: &[u8], limit: u8) -> Vec<usize> {
    let far = |p: &[u8], q: &[u8]| p.iter().zip(q).any(|(x, y)| x.abs_diff(*y) > limit);
    let pixels = a.chunks_exact(4).zip(b.chunks_exact(4));
    pixels
        .enumerate()
        .filter(|(_, (p, q))| far(p, q))
        .map(|(i, _)| i)
        .collect()
}

#[test]
fn every_quality_draws_the_figure_on_a_stage() {
    let figure = common::figure();
    let frame = medium(&figure, &Pose::zero());
    for (quality, _) in Quality::NAMES {
        let mut device = headless(quality);
        let empty = draw(&mut device, &frame);
        device.set_figure(&figure).expect("a sound figure");
        let full = draw(&mut device, &frame);
        let info = device.info().clone();
        assert!(
            full.chunks_exact(4).all(|p| p[3] == 255),
            "the full image is opaque"
        );
        let covered = differing(&empty, &full, 12).len();
        let all = (SIZE.0 * SIZE.1) as usize;
        assert!(
            covered > all / 10 && covered < all * 2 / 3,
            "{quality:?}: {covered} of {all}"
        );
        let stage_mean = empty.iter().map(|&b| f64::from(b)).sum::<f64>() / empty.len() as f64;
        assert!(
            stage_mean > 64.0 && stage_mean < 200.0,
            "{quality:?}: {stage_mean}"
        );
        assert_eq!(quality == Quality::Low, info.smooths_edges, "{info:?}");
        assert_eq!(quality == Quality::Low, info.samples == 1, "{info:?}");
        assert!(info.draw_calls >= 10 && info.triangles > 10_000, "{info:?}");
    }
}

/// Checks changes of quality on one device, forwards and back, like those of a player's frame
/// pacing.
#[test]
fn qualities_change_on_one_device() {
    let figure = common::figure();
    let frame = medium(&figure, &Pose::zero());
    let mut changing = headless(Quality::High);
    changing.set_figure(&figure).expect("a sound figure");
    for quality in [
        Quality::Lowest,
        Quality::Medium,
        Quality::Lowest,
        Quality::Low,
    ] {
        changing.set_options(RenderOptions { quality });
        let mut alone = headless(quality);
        alone.set_figure(&figure).expect("a sound figure");
        assert!(
            draw(&mut changing, &frame) == draw(&mut alone, &frame),
            "{quality:?}"
        );
    }
}

/// Checks that images are unchanged during a change of quality, which completes within some images.
#[test]
fn another_quality_comes_when_it_is_whole() {
    let figure = common::figure();
    let frame = medium(&figure, &Pose::zero());
    let mut changing = headless(Quality::High);
    changing.set_figure(&figure).expect("a sound figure");
    let mut before = draw(&mut changing, &frame);
    for quality in [Quality::Lowest, Quality::Medium] {
        changing.set_options_soon(RenderOptions { quality });
        let mut alone = headless(quality);
        alone.set_figure(&figure).expect("a sound figure");
        let after = draw(&mut alone, &frame);
        let mut pictures = 0;
        while changing.info().options.quality != quality {
            let drawn = draw(&mut changing, &frame);
            pictures += 1;
            let is_there = changing.info().options.quality == quality;
            assert!(
                drawn
                    == if is_there {
                        after.clone()
                    } else {
                        before.clone()
                    },
                "the image changes only with the complete quality"
            );
            assert!(pictures < 60, "{quality:?}");
        }
        assert!(pictures > 4, "{quality:?}: one program for each");
        before = after;
    }
}

#[test]
fn two_devices_draw_the_same_bytes() {
    let figure = common::figure();
    let frame = medium(&figure, &Pose::zero());
    let once = || {
        let mut device = headless(Quality::High);
        device.set_figure(&figure).expect("a sound figure");
        draw(&mut device, &frame)
    };
    assert!(once() == once(), "two devices render identical bytes");
}

/// A pose that bends the left arm forward and turns the whole figure a little.
fn bent() -> Pose {
    let mut pose = Pose::zero();
    pose.set(Bone::LElbow, DQuat::from_rotation_z(0.9));
    pose.set(Bone::LShoulder, DQuat::from_rotation_y(-0.3));
    pose.root_rotation = DQuat::from_rotation_y(0.2);
    pose.root_offset_in_world = DVec3::new(0.05, 0.02, -0.1);
    pose
}

/// Returns image coordinates of a world point, pixels from the upper left.
fn project(camera: &Camera, p: DVec3) -> (f64, f64) {
    let forward = (camera.target_in_world - camera.eye_in_world).normalize();
    let right = forward.cross(DVec3::Y).normalize();
    let d = p - camera.eye_in_world;
    let scale = 0.5 * f64::from(SIZE.1) / (ops::tan(0.5 * camera.fov_y_rad) * d.dot(forward));
    (
        0.5 * f64::from(SIZE.0) + scale * d.dot(right),
        0.5 * f64::from(SIZE.1) - scale * d.dot(right.cross(forward)),
    )
}

#[test]
fn blending_on_the_device_agrees_with_blending_here() {
    let mut figure = common::figure();
    // A ball near the elbow, weighted 0.3 : 0.7 between upper arm and forearm.
    let (upper, fore) = (Bone::LShoulder.index(), Bone::LElbow.index());
    let at = DVec3::new(0.60, 1.70, 0.05);
    let mut ball = figure.meshes[0].clone();
    ball.morphs.clear();
    let middle = DVec3::new(0.0, 1.81, 0.01).as_vec3();
    let radii = DVec3::new(0.08, 0.12, 0.10).as_vec3();
    for p in &mut ball.positions {
        let unit = (glam::Vec3::from(*p) - middle) / radii;
        *p = (at.as_vec3() + unit * 0.03).into();
    }
    ball.joints.fill([upper as u16, fore as u16, 0, 0]);
    ball.weights.fill([0.3, 0.7, 0.0, 0.0]);
    let frame = medium(&figure, &bent());
    ball.colors.fill([0, 255, 0, 255]);
    figure.meshes = vec![ball];
    let mut alone = headless(Quality::Medium);
    let empty = draw(&mut alone, &frame);
    alone.set_figure(&figure).expect("a sound figure");
    let with = draw(&mut alone, &frame);
    let place =
        |i: usize| (frame.world_from_joint[i] * figure.inverse_bind[i]).transform_point3(at);
    let expected = project(&frame.camera, place(upper) * 0.3 + place(fore) * 0.7);
    // Each joint alone would move it to a clearly different position.
    let alone_at = [upper, fore].map(|j| project(&frame.camera, place(j)));
    assert!(
        ops::hypot(alone_at[0].0 - alone_at[1].0, alone_at[0].1 - alone_at[1].1) > 5.0,
        "both joints alone project to different points"
    );
    let green = |i: &usize| with[4 * i + 1] > with[4 * i].saturating_add(30);
    let seen: Vec<usize> = differing(&empty, &with, 12)
        .into_iter()
        .filter(green)
        .collect();
    assert!(seen.len() > 10, "{} pixels", seen.len());
    let n = seen.len() as f64;
    let width = SIZE.0 as usize;
    let x = seen.iter().map(|i| (i % width) as f64 + 0.5).sum::<f64>() / n;
    let y = seen.iter().map(|i| (i / width) as f64 + 0.5).sum::<f64>() / n;
    // Half-covered pixels at the rim count fully or not at all: under one pixel.
    let error = ops::hypot(x - expected.0, y - expected.1);
    assert!(
        error < 1.0,
        "seen ({x:.2}, {y:.2}), expected {expected:.2?}"
    );
}

#[test]
fn a_morph_moves_the_chin_and_comes_back() {
    let figure = common::figure();
    let mut device = headless(Quality::Low);
    device.set_figure(&figure).expect("a sound figure");
    let mut frame = common::frame(&figure, &Pose::zero(), Shot::Close, ASPECT);
    let rest = draw(&mut device, &frame);
    frame.morph_weights[0] = 1.0;
    let open = draw(&mut device, &frame);
    frame.morph_weights[0] = 0.0;
    let back = draw(&mut device, &frame);
    assert!(
        differing(&rest, &open, 12).len() > 50,
        "the open jaw changes more than 50 pixels"
    );
    assert!(rest == back, "the closed jaw restores the image");
    frame.morph_weights[0] = f32::NAN;
    assert!(
        rest == draw(&mut device, &frame),
        "a weight that is no number counts as none"
    );
}

#[test]
fn more_exposure_never_darkens_a_pixel() {
    let figure = common::figure();
    let mut device = headless(Quality::Medium);
    device.set_figure(&figure).expect("a sound figure");
    let mut frame = medium(&figure, &Pose::zero());
    let mut last = vec![0; (SIZE.0 * SIZE.1 * 4) as usize];
    for step in 0..36 {
        frame.lighting.exposure = 0.002 * ops::pow(1.45, f64::from(step)) as f32;
        let picture = draw(&mut device, &frame);
        assert!(
            picture.iter().zip(&last).all(|(new, old)| new >= old),
            "step {step}"
        );
        last = picture;
    }
    let bright = last.iter().filter(|&&b| b > 250).count();
    assert!(bright > last.len() / 2, "the curve reaches white");
}

#[test]
fn what_cannot_be_drawn_is_an_error() {
    let figure = common::figure();
    let mut device = headless(Quality::Low);
    let mut crowded = figure.clone();
    crowded.inverse_bind.resize(257, crowded.inverse_bind[0]);
    assert!(
        matches!(
            device.set_figure(&crowded),
            Err(RenderError::TooManyJoints {
                found: 257,
                limit: 256
            })
        ),
        "a mesh with 257 joints is rejected"
    );
    let breaks: [fn(&mut Figure); 4] = [
        |f| f.meshes[0].indices[0] = 1_000_000,
        |f| f.meshes[0].uvs.truncate(3),
        |f| f.meshes[0].joints[5] = [500, 0, 0, 0],
        |f| f.meshes[0].morphs[0].vertices[0] = u32::MAX,
    ];
    for spoil in breaks {
        let mut bad = figure.clone();
        spoil(&mut bad);
        assert!(
            matches!(device.set_figure(&bad), Err(RenderError::BadMesh { .. })),
            "an invalid mesh is rejected"
        );
    }
    let frame = medium(&figure, &Pose::zero());
    assert!(
        matches!(
            device.render_rgba(&frame, 0, 10),
            Err(RenderError::BadSize { .. })
        ),
        "a width of 0 is rejected"
    );
    assert!(
        matches!(
            device.render_rgba(&frame, 1_000_000, 10),
            Err(RenderError::BadSize { .. })
        ),
        "an excessive width is rejected"
    );
}

#[test]
fn a_frame_without_sense_draws_something() {
    let figure = common::figure();
    let mut device = headless(Quality::Low);
    device.set_figure(&figure).expect("a sound figure");
    let mut frame = medium(&figure, &Pose::zero());
    frame.world_from_joint.truncate(3);
    frame.morph_weights.clear();
    frame.camera.target_in_world = frame.camera.eye_in_world;
    frame.lighting.key.towards_light_in_world = DVec3::ZERO;
    assert_eq!(
        draw(&mut device, &frame).len(),
        (SIZE.0 * SIZE.1 * 4) as usize
    );
}

#[test]
fn every_named_light_shows_the_figure_without_losing_it() {
    let figure = common::figure();
    let mut device = headless(Quality::High);
    let mut frame = common::frame(&figure, &Pose::zero(), Shot::Close, ASPECT);
    for (name, light) in raconteur_stage::Lighting::PRESETS {
        frame.lighting = light();
        device.set_figure(&figure).expect("a sound figure");
        let picture = draw(&mut device, &frame);
        // A pixel that is NaN renders black.
        let black = picture
            .chunks_exact(4)
            .filter(|p| p[..3].iter().all(|&c| c == 0))
            .count();
        let burnt = picture
            .chunks_exact(4)
            .filter(|p| p[..3].iter().all(|&c| c == 255))
            .count();
        let all = picture.len() / 4;
        assert!(black < all / 50, "{name}: {black} of {all} black");
        assert!(burnt < all / 50, "{name}: {burnt} of {all} burnt");
    }
}
