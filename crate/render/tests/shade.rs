//! Shadows on test bodies: no grain, and no light behind an obstacle. `close` tests the rendering
//! of a face.

#![allow(clippy::expect_used, reason = "tests fail by panicking")]

#[allow(dead_code, reason = "other tests use the rest")]
mod common;
mod device;

use device::headless;
use glam::Vec3;
use raconteur_base::DVec3;
use raconteur_body::{Bone, Figure, MaterialKind, Pose};
use raconteur_render::{Headless, Quality};
use raconteur_stage::{Camera, DirectedLight, Frame, Lighting, Shot};

const SIDE: u32 = 160;

/// A figure of ellipsoids: material, middle and radii, metres.
fn balls(parts: &[(MaterialKind, Vec3, Vec3)]) -> Figure {
    let mut figure = common::figure();
    let joint = Bone::Skull.index() as u16;
    figure.meshes = parts
        .iter()
        .map(|&(kind, centre, radii)| {
            common::ball(kind, [200, 150, 120, 255], joint, centre, radii)
        })
        .collect();
    figure
}

/// Returns lighting with only the key light, from a direction.
fn key_only(towards: DVec3) -> Lighting {
    let dark = DirectedLight {
        towards_light_in_world: DVec3::Y,
        irradiance: [0.0; 3],
    };
    Lighting {
        key: DirectedLight {
            towards_light_in_world: towards.normalize(),
            irradiance: [1.0; 3],
        },
        fill: dark,
        rim: dark,
        sky: [0.0; 3],
        ground: [0.0; 3],
        exposure: 1.0,
        softness: 1.0,
    }
}

fn looking_at(figure: &Figure, lighting: Lighting, target: DVec3, from: DVec3) -> Frame {
    let mut frame = common::frame(figure, &Pose::zero(), Shot::Close, 1.0);
    frame.lighting = lighting;
    frame.camera = Camera {
        eye_in_world: target + from,
        target_in_world: target,
        fov_y_rad: 0.2,
        near_m: 0.1,
        ..Camera::default()
    };
    frame
}

fn red(device: &mut Headless, frame: &Frame) -> Vec<u8> {
    let rgba = device.render_rgba(frame, SIDE, SIDE).expect("drawn");
    rgba.chunks_exact(4).map(|p| p[0]).collect()
}

/// Returns the brightness difference of each inner pixel from all its neighbours: 0 except for
/// grain.
fn grain(picture: &[u8]) -> Vec<u8> {
    let side = SIDE as usize;
    let mut out = Vec::new();
    for y in 1..side - 1 {
        for x in 1..side - 1 {
            let at = |dx: usize, dy: usize| picture[(y + dy - 1) * side + x + dx - 1];
            let around = [
                (0, 0),
                (1, 0),
                (2, 0),
                (0, 1),
                (2, 1),
                (0, 2),
                (1, 2),
                (2, 2),
            ];
            let (low, high) = around.iter().fold((255, 0), |(low, high), &(dx, dy)| {
                (at(dx, dy).min(low), at(dx, dy).max(high))
            });
            let own = at(1, 1);
            out.push(low.saturating_sub(own).max(own.saturating_sub(high)));
        }
    }
    out
}

#[test]
fn a_soft_shadow_has_no_grain() {
    // A wall, and a ball and a thin rod in front of it, outside the frame.
    let wall = (
        MaterialKind::Plain,
        Vec3::new(0.0, 1.6, -2.0),
        Vec3::new(2.0, 2.0, 2.0),
    );
    for (far, radii) in [
        (0.10, Vec3::splat(0.035)),
        (0.16, Vec3::new(0.2, 0.006, 0.006)),
    ] {
        let towards = DVec3::new(-0.62, 0.78, 0.86).normalize();
        let caster = (towards * far).as_vec3() + Vec3::new(0.0, 1.6, 0.0);
        let figure = balls(&[wall, (MaterialKind::Plain, caster, radii)]);
        let frame = looking_at(
            &figure,
            key_only(towards),
            DVec3::new(0.0, 1.6, 0.0),
            DVec3::new(0.9, -0.5, 0.45),
        );
        for quality in [Quality::Medium, Quality::High] {
            let mut device = headless(quality);
            device.set_figure(&figure).expect("a sound figure");
            let picture = red(&mut device, &frame);
            let (low, high) = (picture.iter().min(), picture.iter().max());
            assert!(low < Some(&60) && high > Some(&120), "{low:?} {high:?}");
            // Dithering changes a value by one of 255 steps.
            let strong = grain(&picture).into_iter().filter(|g| *g > 5).count();
            let share = strong as f64 / picture.len() as f64;
            assert!(share < 0.002, "{quality:?}, {far} m: {share}");
        }
    }
}

#[test]
fn light_does_not_reach_round_what_stands_before_the_lamp() {
    // A throat under a jaw: skin that turns from a lamp which the jaw hides from all of it.
    let throat = (
        MaterialKind::Skin,
        Vec3::new(0.0, 1.60, 0.0),
        Vec3::new(0.055, 0.09, 0.055),
    );
    for (x, y, z) in [(-0.62, 0.78, 0.86), (0.0, 1.0, 0.25), (0.9, 0.5, 0.4)] {
        let towards = DVec3::new(x, y, z).normalize();
        let jaw_at = (towards * 0.24).as_vec3() + Vec3::new(0.0, 1.60, 0.0);
        let jaw = (MaterialKind::Plain, jaw_at, Vec3::splat(0.13));
        let figure = balls(&[throat, jaw]);
        for quality in [Quality::Medium, Quality::High] {
            let mut device = headless(quality);
            let frame = |figure: &Figure| {
                let away = DVec3::new(-towards.x, -0.3 - towards.y, 0.4 - towards.z);
                let from = away.normalize() * 0.8;
                looking_at(figure, key_only(towards), DVec3::new(0.0, 1.60, 0.0), from)
            };
            let mut plain = throat;
            plain.0 = MaterialKind::Plain;
            let hidden = balls(&[plain, jaw]);
            device.set_figure(&hidden).expect("a sound figure");
            let as_plain = red(&mut device, &frame(&hidden));
            device.set_figure(&figure).expect("a sound figure");
            let as_skin = red(&mut device, &frame(&figure));
            let brighter = as_skin
                .iter()
                .zip(&as_plain)
                .map(|(s, p)| s.saturating_sub(*p))
                .max();
            // The value is 1; it was 5 when skin let the lamp's light wrap around.
            assert!(brighter < Some(3), "{quality:?} {towards}: {brighter:?}");
        }
    }
}
