//! A reshaped figure renders like the same figure uploaded again.

#![allow(clippy::expect_used, reason = "tests fail by panicking")]

mod common;
mod device;

use device::headless;
use raconteur_base::DVec3;
use raconteur_body::skeleton::Drive;
use raconteur_body::{Figure, Pose, Skeleton};
use raconteur_render::{Headless, Quality};
use raconteur_stage::Shot;

const SIZE: (u32, u32) = (320, 240);

/// Broader, of other colours in part, with its eyes elsewhere, and of half the triangles where `is_cut`.
fn reshaped(figure: &Figure, is_cut: bool) -> Figure {
    let mut other = figure.clone();
    for (i, mesh) in other.meshes.iter_mut().enumerate() {
        for p in &mut mesh.positions {
            p[0] *= 1.2;
        }
        if i % 2 == 0 {
            for c in &mut mesh.colors {
                *c = [c[0] / 2, c[1], c[2], c[3]];
            }
        }
    }
    for mesh in other.meshes.iter_mut().filter(|_| is_cut) {
        mesh.indices.truncate(mesh.indices.len() / 6 * 3);
    }
    let mut joints = other.skeleton.joints().to_vec();
    for joint in joints
        .iter_mut()
        .filter(|j| matches!(j.drive, Drive::Eye(_)))
    {
        joint.translation_in_parent += DVec3::new(0.0, 0.004, 0.0);
    }
    let stature = other.skeleton.stature_m();
    other.skeleton = Skeleton::from_joints(joints, stature).expect("the same joints");
    let mut world = Vec::new();
    other.skeleton.solve(&Pose::zero(), &mut world);
    for (own, now) in other.inverse_bind.iter_mut().zip(world) {
        *own = now.inverse();
    }
    other
}

#[test]
fn another_shape_looks_like_a_figure_that_is_sent_anew() {
    let first = common::figure();
    let mut device = headless(Quality::Low);
    device.set_figure(&first).expect("a sound figure");
    let mut sent = first.clone();
    for (is_cut, moves) in [
        (false, false),
        (true, false),
        (false, false),
        (false, true),
        (false, false),
    ] {
        let mut other = reshaped(&first, is_cut);
        if moves {
            for p in other.meshes.iter_mut().flat_map(|m| &mut m.positions) {
                p[1] *= 1.02;
            }
        }
        let frame = common::frame(&other, &Pose::zero(), Shot::Medium, 4.0 / 3.0);
        let draw = |device: &mut Headless| {
            let picture = device.render_rgba(&frame, SIZE.0, SIZE.1);
            picture.expect("a picture")
        };
        let stale = draw(&mut device);
        device
            .set_shape(&sent, &other, moves)
            .expect("a sound figure");
        let shaped = draw(&mut device);
        assert!(stale != shaped, "cut: {is_cut}");
        let mut fresh = headless(Quality::Low);
        fresh.set_figure(&other).expect("a sound figure");
        // During a transition, the shape is current but may be less detailed.
        assert!(moves || shaped == draw(&mut fresh), "cut: {is_cut}");
        sent = other;
    }
}
