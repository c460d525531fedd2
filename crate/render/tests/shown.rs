//! The figure as edges, vertices and clay, and its overlay.

#![allow(clippy::expect_used, reason = "tests fail by panicking")]

mod common;
mod device;

use device::headless;
use raconteur_base::DAffine3;
use raconteur_body::figure::{Image, TextureMaps};
use raconteur_body::{Bone, MaterialKind, Pose};
use raconteur_render::{Headless, Quality};
use raconteur_stage::{Fill, Frame, Shot, Visibility};

/// Large enough for a triangle to have an inside.
const SIZE: (u32, u32) = (480, 360);

/// A device with the test figure, and a frame of it.
fn stage(quality: Quality) -> (Headless, Frame) {
    let figure = common::figure();
    let mut device = headless(quality);
    device.set_figure(&figure).expect("a sound figure");
    let frame = common::frame(&figure, &Pose::zero(), Shot::Medium, 4.0 / 3.0);
    (device, frame)
}

fn draw(device: &mut Headless, frame: &Frame, shown: Visibility) -> Vec<u8> {
    let frame = Frame {
        visibility: shown,
        ..frame.clone()
    };
    device
        .render_rgba(&frame, SIZE.0, SIZE.1)
        .expect("a picture")
}

/// Pixels that differ by more than `limit` in a channel.
fn differing(a: &[u8], b: &[u8], limit: u8) -> usize {
    let far = |p: &[u8], q: &[u8]| p.iter().zip(q).any(|(x, y)| x.abs_diff(*y) > limit);
    let pixels = a.chunks_exact(4).zip(b.chunks_exact(4));
    pixels.filter(|(p, q)| far(p, q)).count()
}

const NOTHING: Visibility = Visibility {
    fill: Fill::Solid,
    body: false,
    bones: false,
    frames: false,
    centers: false,
    materials: true,
    textures: true,
    manipulators: false,
    springs: false,
    muscles: false,
    skull: false,
};

#[test]
fn edges_leave_holes_and_corners_leave_more() {
    for quality in [Quality::Low, Quality::High] {
        let (mut device, mut frame) = stage(quality);
        let eye = &mut frame.camera.eye_in_world;
        *eye = eye.lerp(frame.camera.target_in_world, 0.5);
        let empty = draw(&mut device, &frame, NOTHING);
        let body = Visibility::default();
        let mut covered = |fill| {
            let picture = draw(&mut device, &frame, Visibility { fill, ..body });
            differing(&empty, &picture, 24)
        };
        // From so near that most triangles have an inside.
        let [solid, edges, corners] =
            [Fill::Solid, Fill::Wireframe, Fill::Points].map(&mut covered);
        assert!(corners > solid / 60, "{quality:?}: {corners} of {solid}");
        assert!(edges > 2 * corners, "{quality:?}: {edges}, {corners}");
        assert!(edges < solid * 4 / 5, "{quality:?}: {edges} of {solid}");
        // The initial state again.
        assert_eq!(covered(Fill::Solid), solid);
    }
}

#[test]
fn without_the_body_an_empty_stage_is_left_and_bones_stand_on_it() {
    let (mut device, frame) = stage(Quality::High);
    let empty = draw(&mut device, &frame, NOTHING);
    let mut lonely = headless(Quality::High);
    assert!(
        empty == draw(&mut lonely, &frame, Visibility::default()),
        "the stage without the body equals an empty stage"
    );
    let bones = Visibility {
        bones: true,
        ..NOTHING
    };
    let skeleton = draw(&mut device, &frame, bones);
    let seen = differing(&empty, &skeleton, 20);
    assert!(seen > 250, "{seen} pixels");
    // Over the body, the bones look the same as without it.
    let both = Visibility {
        body: true,
        ..bones
    };
    let body = draw(&mut device, &frame, Visibility::default());
    let over = draw(&mut device, &frame, both);
    let seen_over = differing(&body, &over, 20);
    assert!(
        seen_over > seen / 2,
        "{seen_over} of {seen} pixels through the body"
    );
}

#[test]
fn axes_have_their_colours_and_joints_theirs() {
    let (mut device, frame) = stage(Quality::High);
    let empty = draw(&mut device, &frame, NOTHING);
    let mut hues = |shown| {
        let picture = draw(&mut device, &frame, shown);
        let mut hues = [0; 3];
        for (p, q) in picture.chunks_exact(4).zip(empty.chunks_exact(4)) {
            let strongest = (0..3).max_by_key(|&c| p[c]).unwrap_or(0);
            let others = (0..3).filter(|&c| c != strongest).map(|c| p[c]).max();
            let pure = p[strongest] > others.unwrap_or(0).saturating_add(40);
            hues[strongest] +=
                usize::from(pure && p.iter().zip(q).any(|(a, b)| a.abs_diff(*b) > 20));
        }
        hues
    };
    let frames = hues(Visibility {
        frames: true,
        ..NOTHING
    });
    assert!(frames.iter().all(|&n| n > 30), "{frames:?}");
    let joints = hues(Visibility {
        centers: true,
        ..NOTHING
    });
    assert!(joints[0] > 30 && joints[2] == 0, "{joints:?}");
}

#[test]
fn handles_are_drawn_where_they_are() {
    let (mut device, mut frame) = stage(Quality::High);
    // In the centre of the image, inside the figure.
    frame
        .handles
        .push(DAffine3::from_translation(frame.camera.target_in_world));
    let plain = draw(&mut device, &frame, Visibility::default());
    let handles = Visibility {
        manipulators: true,
        ..Visibility::default()
    };
    let with = draw(&mut device, &frame, handles);
    let middle = 4 * (SIZE.1 / 2 * SIZE.0 + SIZE.0 / 2) as usize;
    let (seen, behind) = (&with[middle..middle + 3], &plain[middle..middle + 3]);
    assert!(
        seen[2] > seen[0].saturating_add(60) && behind[0] > seen[0].saturating_add(40),
        "{seen:?}, {behind:?}"
    );
    assert!(
        differing(&plain, &with, 8) < plain.len() / 4 / 20,
        "the handles cover less than 5 % of the image"
    );
}

#[test]
fn clay_has_one_colour_and_no_pictures_leave_the_paint() {
    let (_, frame) = stage(Quality::High);
    let mut figure = common::figure();
    // A red ball in front of the chest, whose texture is blue.
    let mut ball = figure.meshes[0].clone();
    ball.morphs.clear();
    ball.material.kind = MaterialKind::Plain;
    ball.material.base_color = [1.0; 4];
    ball.material.maps = TextureMaps {
        base_color: Some(0),
        normal: None,
        wrinkles: None,
    };
    ball.colors.fill([255; 4]);
    let joint = Bone::Thoracic.index() as u16;
    ball.joints.fill([joint, 0, 0, 0]);
    let middle = frame.camera.target_in_world.as_vec3() + glam::Vec3::Z * 0.3;
    let at = glam::Vec3::new(0.0, 1.81, 0.01);
    for p in &mut ball.positions {
        *p = (middle + glam::Vec3::from(*p) - at).into();
    }
    figure.meshes = vec![ball];
    figure.images = vec![Image {
        mime_type: "image/jpeg".to_owned(),
        bytes: Vec::new(),
    }];
    let mut device = headless(Quality::default());
    device.set_figure(&figure).expect("a sound figure");
    device
        .set_image(0, 1, 1, &[20, 30, 255, 255])
        .expect("a picture");
    let mut center = |shown| {
        let picture = draw(&mut device, &frame, shown);
        let at = 4 * (SIZE.1 / 2 * SIZE.0 + SIZE.0 / 2) as usize;
        [picture[at], picture[at + 1], picture[at + 2]]
    };
    let [red, _, blue] = center(Visibility::default());
    assert!(blue > red.saturating_add(60), "its picture is blue");
    let [red, _, blue] = center(Visibility {
        textures: false,
        ..Visibility::default()
    });
    assert!(
        red.abs_diff(blue) < 50 && red > 120,
        "its paint is white: {red} {blue}"
    );
    let clay = center(Visibility {
        materials: false,
        ..Visibility::default()
    });
    assert!(clay[0].abs_diff(clay[2]) < 50 && clay[0] < red, "{clay:?}");
}
