//! Textures on surfaces.

#![allow(clippy::expect_used, reason = "tests fail by panicking")]

#[allow(dead_code, reason = "other tests use the rest")]
mod common;
mod device;

use device::headless;
use raconteur_base::DVec3;
use raconteur_body::figure::{Image, TextureMaps};
use raconteur_body::{Figure, MaterialKind, Pose};
use raconteur_render::{Headless, Quality, RenderError, RenderOptions};
use raconteur_stage::{Camera, Frame, Shot};

const SIDE: u32 = 96;

/// Returns a square of 40 cm in front of the camera that fills the image centre, uv (0, 0) at the
/// upper left, with image 0 as colour and image 1 as normals.
fn square(kind: MaterialKind) -> Figure {
    let mut figure = common::figure();
    let mut mesh = common::empty(kind);
    for (x, y, u, v) in [
        (-0.2_f32, 0.2_f32, 0.0, 0.0),
        (0.2, 0.2, 1.0, 0.0),
        (-0.2, -0.2, 0.0, 1.0),
        (0.2, -0.2, 1.0, 1.0),
    ] {
        mesh.positions.push([x, 1.2 + y, 0.5]);
        mesh.normals.push([0.0, 0.0, 1.0]);
        mesh.uvs.push([u, v]);
        mesh.colors.push([255; 4]);
        mesh.joints.push([0; 4]);
        mesh.weights.push([1.0, 0.0, 0.0, 0.0]);
    }
    mesh.indices = vec![0, 2, 1, 1, 2, 3];
    mesh.material.roughness = 1.0;
    mesh.material.maps = TextureMaps {
        base_color: Some(0),
        normal: Some(1),
        wrinkles: None,
    };
    figure.meshes = vec![mesh];
    let image = Image {
        mime_type: "image/png".to_owned(),
        bytes: Vec::new(),
    };
    figure.images = vec![image.clone(), image];
    figure
}

/// Returns a frame with the camera straight in front of the square, at a distance.
fn before(figure: &Figure, distance_m: f64) -> Frame {
    let mut frame = common::frame(figure, &Pose::zero(), Shot::Medium, 1.0);
    let middle = DVec3::new(0.0, 1.2, 0.5);
    frame.camera = Camera {
        eye_in_world: middle + DVec3::Z * distance_m,
        target_in_world: middle,
        fov_y_rad: 0.4,
        ..Camera::default()
    };
    frame
}

fn draw(device: &mut Headless, frame: &Frame) -> Vec<u8> {
    device.render_rgba(frame, SIDE, SIDE).expect("drawn")
}

/// Returns the mean of a square of 9 pixels around a position given in shares of the image.
fn mean_at(picture: &[u8], x: f64, y: f64) -> [f64; 3] {
    let side = f64::from(SIDE);
    let (cx, cy) = ((x * side) as usize, (y * side) as usize);
    let mut sum = [0.0; 3];
    for j in cy - 1..=cy + 1 {
        for i in cx - 1..=cx + 1 {
            let at = 4 * (j * SIDE as usize + i);
            for (s, c) in sum.iter_mut().zip(&picture[at..at + 3]) {
                *s += f64::from(*c) / 9.0;
            }
        }
    }
    sum
}

const RED: [u8; 4] = [230, 20, 20, 255];
const GREEN: [u8; 4] = [20, 200, 20, 255];
const BLUE: [u8; 4] = [20, 20, 230, 255];
const WHITE: [u8; 4] = [255; 4];

#[test]
fn a_picture_lies_the_right_way_up_on_skin_and_on_plain_surfaces() {
    for kind in [MaterialKind::Plain, MaterialKind::Skin] {
        let figure = square(kind);
        let frame = before(&figure, 0.9);
        let mut device = headless(Quality::Medium);
        device.set_figure(&figure).expect("a sound figure");
        let fallback = draw(&mut device, &frame);
        let pixels: Vec<u8> = (0..32 * 32)
            .flat_map(|i| match (i % 32 < 16, i / 32 < 16) {
                (true, true) => RED,
                (false, true) => GREEN,
                (true, false) => BLUE,
                (false, false) => WHITE,
            })
            .collect();
        device
            .set_image(0, 32, 32, &pixels)
            .expect("a sound picture");
        let picture = draw(&mut device, &frame);
        let [r, g, b, w] =
            [(0.3, 0.3), (0.7, 0.3), (0.3, 0.7), (0.7, 0.7)].map(|(x, y)| mean_at(&picture, x, y));
        assert!(r[0] > r[1] + 40.0 && r[0] > r[2] + 40.0, "{kind:?} {r:?}");
        assert!(g[1] > g[0] + 40.0 && g[1] > g[2] + 40.0, "{kind:?} {g:?}");
        assert!(b[2] > b[0] + 40.0 && b[2] > b[1] + 40.0, "{kind:?} {b:?}");
        let missing = mean_at(&fallback, 0.7, 0.7);
        assert!(
            w.iter().zip(&missing).all(|(a, b)| (a - b).abs() < 3.0),
            "{kind:?}: a missing picture is white: {w:?} {missing:?}"
        );
    }
}

#[test]
fn from_afar_a_fine_pattern_is_its_mean() {
    let figure = square(MaterialKind::Plain);
    let mut device = headless(Quality::Low);
    device.set_figure(&figure).expect("a sound figure");
    let checks: Vec<u8> = (0..512 * 512)
        .flat_map(|i| {
            if (i % 512 + i / 512) % 2 == 0 {
                [255; 4]
            } else {
                [0, 0, 0, 255]
            }
        })
        .collect();
    let frame = before(&figure, 1.6);
    device
        .set_image(0, 512, 512, &checks)
        .expect("a sound picture");
    let fine = draw(&mut device, &frame);
    device
        .set_image(0, 1, 1, &[188, 188, 188, 255])
        .expect("a sound picture");
    let grey = draw(&mut device, &frame);
    for (x, y) in [(0.4, 0.4), (0.5, 0.6), (0.6, 0.5)] {
        let (a, b) = (mean_at(&fine, x, y), mean_at(&grey, x, y));
        assert!(
            a.iter().zip(&b).all(|(a, b)| (a - b).abs() < 6.0),
            "{a:?} {b:?}"
        );
    }
}

#[test]
fn a_normal_map_tilts_to_the_light_as_gltf_says() {
    let figure = square(MaterialKind::Plain);
    let mut frame = before(&figure, 0.9);
    frame.lighting.fill.irradiance = [0.0; 3];
    frame.lighting.rim.irradiance = [0.0; 3];
    let mut device = headless(Quality::Low);
    device.set_figure(&figure).expect("a sound figure");
    // Tilted by 30 degrees to +x, −x, +y (up in the image) and −y in turn.
    let mut brightness = |normal: [u8; 4], towards: DVec3| {
        device.set_image(1, 1, 1, &normal).expect("a sound picture");
        frame.lighting.key.towards_light_in_world = towards.normalize();
        mean_at(&draw(&mut device, &frame), 0.5, 0.5)[1]
    };
    let flat = [128, 128, 255, 255];
    for (towards, to, away) in [
        (
            DVec3::new(1.0, 0.0, 1.0),
            [191, 128, 238, 255],
            [64, 128, 238, 255],
        ),
        (
            DVec3::new(0.0, 1.0, 1.0),
            [128, 191, 238, 255],
            [128, 64, 238, 255],
        ),
    ] {
        let level = brightness(flat, towards);
        let (lit, dim) = (brightness(to, towards), brightness(away, towards));
        assert!(lit > level + 4.0, "{towards}: {lit} {level}");
        assert!(dim < level - 4.0, "{towards}: {dim} {level}");
    }
}

#[test]
fn alpha_cuts_plain_surfaces_and_their_shadow() {
    let figure = square(MaterialKind::Plain);
    let frame = before(&figure, 0.9);
    for quality in [Quality::Low, Quality::High] {
        let mut device = headless(quality);
        let empty = draw(&mut device, &frame);
        device.set_figure(&figure).expect("a sound figure");
        let half: Vec<u8> = (0..64 * 64)
            .flat_map(|i| [255, 255, 255, if i % 64 < 32 { 255 } else { 0 }])
            .collect();
        device.set_image(0, 64, 64, &half).expect("a sound picture");
        let cut = draw(&mut device, &frame);
        assert_ne!(mean_at(&empty, 0.3, 0.5), mean_at(&cut, 0.3, 0.5));
        assert_eq!(mean_at(&empty, 0.72, 0.4), mean_at(&cut, 0.72, 0.4));
    }
}

#[test]
fn clear_surfaces_let_the_stage_through() {
    let mut figure = square(MaterialKind::Plain);
    let frame = before(&figure, 0.9);
    let mut device = headless(Quality::Medium);
    let empty = mean_at(&draw(&mut device, &frame), 0.5, 0.5);
    device.set_figure(&figure).expect("a sound figure");
    let full = mean_at(&draw(&mut device, &frame), 0.5, 0.5);
    figure.meshes[0].material.base_color[3] = 0.5;
    device.set_figure(&figure).expect("a sound figure");
    let half = mean_at(&draw(&mut device, &frame), 0.5, 0.5);
    for c in 0..3 {
        assert!(
            empty[c] < half[c] && half[c] < full[c],
            "{empty:?} {half:?} {full:?}"
        );
    }
}

#[test]
fn what_is_no_picture_is_an_error_and_changes_nothing() {
    let figure = square(MaterialKind::Plain);
    let frame = before(&figure, 0.9);
    let mut device = headless(Quality::Low);
    device.set_figure(&figure).expect("a sound figure");
    device.set_image(0, 1, 1, &RED).expect("a sound picture");
    let red = draw(&mut device, &frame);
    for (w, h, bytes) in [
        (2, 2, 15),
        (0, 0, 0),
        (9000, 1, 36_000),
        (u32::MAX, u32::MAX, 4),
    ] {
        assert!(
            matches!(
                device.set_image(0, w, h, &vec![0; bytes]),
                Err(RenderError::BadImage { .. })
            ),
            "an invalid image is rejected"
        );
    }
    device
        .set_image(77, 1, 1, &BLUE)
        .expect("one that nothing shows is let go");
    assert!(
        red == draw(&mut device, &frame),
        "an image without a texture leaves the rendering unchanged"
    );
}

#[test]
fn a_tier_can_be_changed_and_keeps_figure_and_pictures() {
    let figure = square(MaterialKind::Plain);
    let frame = before(&figure, 0.9);
    let mut device = headless(Quality::High);
    device.set_figure(&figure).expect("a sound figure");
    device.set_image(0, 1, 1, &RED).expect("a sound picture");
    let high = draw(&mut device, &frame);
    for quality in [Quality::Lowest, Quality::Low, Quality::Medium] {
        let options = RenderOptions { quality };
        device.set_options(options);
        let other = draw(&mut device, &frame);
        assert_eq!(device.info().options, options);
        let (a, b) = (mean_at(&high, 0.5, 0.5), mean_at(&other, 0.5, 0.5));
        assert!(
            a.iter().zip(&b).all(|(a, b)| (a - b).abs() < 6.0),
            "{options:?}: {a:?} {b:?}"
        );
    }
    device.set_options(RenderOptions::default());
    assert!(
        high == draw(&mut device, &frame),
        "the same bytes as before"
    );
}

#[test]
fn meshes_of_one_surface_are_drawn_in_one_call() {
    let mut figure = square(MaterialKind::Plain);
    let mesh = figure.meshes[0].clone();
    figure.meshes = vec![mesh; 7];
    let frame = before(&figure, 0.9);
    let mut device = headless(Quality::High);
    device.set_figure(&figure).expect("a sound figure");
    draw(&mut device, &frame);
    // One visible draw, and one in each of two shadows.
    assert_eq!(device.info().figure_draw_calls, 3);
}
