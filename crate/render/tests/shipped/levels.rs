//! Levels of detail of the shipped figures: they have their promised sizes, no seam opens, closed
//! lids and lips hide the parts behind them at all levels, and each covers the same area as the
//! finest.

use std::collections::{BTreeSet, HashMap};

use crate::device::headless;
use crate::figures::{At, FIGURES, figure, frame, nodes, send};
use raconteur_base::{DQuat, DVec3, noise};
use raconteur_body::face::FaceControls;
use raconteur_body::figure::TextureMaps;
use raconteur_body::{Bone, Figure, MaterialKind, Mesh, Pose};
use raconteur_render::{Headless, Quality};
use raconteur_stage::{Frame, FramingMargin, Lighting, Shot};
use raconteur_tier::{share, sized};

const SIDE: u32 = 256;
/// Qualities by the level that they draw, the finest first.
const LEVELS: [Quality; 3] = [Quality::High, Quality::Low, Quality::Lowest];
/// Triangles of a whole figure at each level: 105,034 to 110,444, 44,300 to 48,500 and 22,000 to
/// 26,500 are shipped.
const MAX_TRIANGLES: [usize; 3] = [108_500, 48_500, 26_500];
/// Inverse of the maximum visible share along the lid line of closed lids, relative to open ones:
/// 0.007 is the most measured, at the finest level.
const LIDS: usize = 100;
/// Inverse of the same for closed lips, which are a pixel of 0.4 mm apart: 0.066 is measured at the
/// finest level, 0.081 at the coarsest.
const LIPS: usize = 10;
/// Poses by chance in which levels are compared in the long tier.
const POSES: u64 = 6;
/// Maximum share of a figure's pixels that may differ between levels: 0.024 is the worst measured.
const MAX_OTHER: f64 = 0.03;

fn draw(device: &mut Headless, frame: &Frame) -> Vec<[u8; 4]> {
    let picture = device.render_rgba(frame, SIDE, SIDE).expect("drawn");
    picture.as_chunks().0.to_vec()
}

/// Returns the edges with a triangle on one side only, by the positions of their ends.
fn borders(mesh: &Mesh, level: usize) -> BTreeSet<[u32; 2]> {
    let mut places = HashMap::new();
    let mut place = |v: u32| {
        let next = places.len() as u32;
        *places
            .entry(mesh.positions[v as usize].map(f32::to_bits))
            .or_insert(next)
    };
    // Numbered alike at every level.
    (0..mesh.positions.len() as u32).for_each(|v| {
        place(v);
    });
    let edges: BTreeSet<[u32; 2]> = mesh
        .triangles_at(level)
        .chunks_exact(3)
        .flat_map(|t| [[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]])
        .map(|edge| edge.map(&mut place))
        .collect();
    let alone = |[a, b]: &&[u32; 2]| !edges.contains(&[*b, *a]);
    edges.iter().filter(alone).copied().collect()
}

#[test]
fn levels_shrink_and_open_no_seam() {
    for name in FIGURES {
        let figure = figure(name);
        for (level, most) in MAX_TRIANGLES.into_iter().enumerate() {
            let of = |m: &Mesh| m.triangles_at(level).len() / 3;
            let triangles: usize = figure.meshes.iter().map(of).sum();
            assert!(triangles <= most, "{name}: {triangles} at level {level}");
        }
        for mesh in &figure.meshes {
            // Cards consist only of borders.
            if matches!(mesh.material.kind, MaterialKind::Hair | MaterialKind::Lash) {
                continue;
            }
            let finest = borders(mesh, 0);
            for level in 1..=mesh.coarser.len() {
                let finer = mesh.triangles_at(level - 1).len();
                assert!(
                    mesh.triangles_at(level).len() < finer,
                    "the coarser level has fewer triangles"
                );
                assert_eq!(borders(mesh, level), finest, "{name}, {}", mesh.name);
            }
        }
    }
}

/// Gives the surfaces behind lids and lips a unique colour.
fn mark_what_is_behind(figure: &mut Figure) {
    for mesh in &mut figure.meshes {
        let (kind, material) = (mesh.material.kind, &mut mesh.material);
        // Caruncles are visible next to closed lids too.
        let is_behind = matches!(kind, MaterialKind::Eye | MaterialKind::Teeth);
        if is_behind && !mesh.name.starts_with("caruncle") {
            material.kind = MaterialKind::Plain;
            material.maps = TextureMaps::default();
            material.base_color = [0.0, 1.0, 0.0, 1.0];
            mesh.colors.iter_mut().for_each(|c| *c = [255; 4]);
        }
    }
    // Nothing may hide a part that shows through, and a hair is not a lid.
    figure
        .meshes
        .retain(|m| matches!(m.material.kind, MaterialKind::Skin | MaterialKind::Plain));
}

fn green(picture: &[[u8; 4]]) -> usize {
    let is_green = |[r, g, b, _]: &&[u8; 4]| *g > r.max(b).saturating_add(30);
    picture.iter().filter(is_green).count()
}

#[test]
fn shut_lids_and_lips_hide_what_is_behind() {
    for (turn, quality) in LEVELS.into_iter().enumerate() {
        let mut device = headless(quality);
        for name in share(&FIGURES, turn, FIGURES.len()) {
            let mut figure = figure(name);
            mark_what_is_behind(&mut figure);
            send(&mut device, &figure);
            let mut seen = |at: At, yaw: f64, closed: f64, pose: &Pose| {
                let mut frame = frame(&figure, Lighting::default(), at, yaw, 0.0);
                figure.skeleton.solve(pose, &mut frame.world_from_joint);
                let controls = FaceControls {
                    seal: closed,
                    upper_lid: [closed; 2],
                    ..FaceControls::default()
                };
                frame.tissue = nodes(&figure, &controls);
                green(&draw(&mut device, &frame))
            };
            let mut shut = Pose::zero();
            shut.upper_lid_rad = figure.lid_closure_rad;
            let mut open = Pose::zero();
            open.set(Bone::Chin, DQuat::from_rotation_z(0.25));
            for yaw in [-0.6, 0.0, 0.6] {
                for (at, part) in [(At::Eyes, LIDS), (At::Nose, LIPS)] {
                    let through = seen(at, yaw, 1.0, &shut);
                    let behind = seen(at, yaw, 0.0, &open);
                    let seen = (at, yaw, through, behind);
                    assert!(
                        behind > 900 && through <= behind / part,
                        "{name}, {quality:?}: {seen:?}"
                    );
                }
            }
        }
    }
}

/// A pose by chance of arms, spine and head.
fn pose(number: u64) -> Pose {
    const MAX_RAD: [(Bone, f64); 7] = [
        (Bone::LShoulder, 0.9),
        (Bone::RShoulder, 0.9),
        (Bone::LWrist, 0.5),
        (Bone::RWrist, 0.5),
        (Bone::Lumbar, 0.2),
        (Bone::Thoracic, 0.2),
        (Bone::Skull, 0.4),
    ];
    let mut pose = Pose::zero();
    for (bone, (name, most)) in (0u64..).zip(MAX_RAD) {
        let turn = |axis| (2.0 * noise::unit(number, bone, axis) - 1.0) * most;
        pose.set(
            name,
            DQuat::from_rotation_x(turn(0)) * DQuat::from_rotation_z(turn(1)),
        );
    }
    for (elbow, axis) in [(Bone::LElbow, 2), (Bone::RElbow, 3)] {
        let bend = 2.2 * noise::unit(number, 0, axis);
        pose.set(elbow, DQuat::from_rotation_z(bend));
    }
    pose
}

#[test]
fn each_level_covers_what_the_finest_covers() {
    let frames = |figure: &Figure| -> Vec<Frame> {
        let solved = |number| {
            let joints = figure.skeleton.joints().len();
            let mut frame = Frame::with_capacity(joints, figure.morph_names.len());
            figure
                .skeleton
                .solve(&pose(number), &mut frame.world_from_joint);
            let stature = figure.skeleton.stature_m();
            let origin = DVec3::ZERO;
            frame.camera = Shot::Full.frame(origin, stature, 1.0, FramingMargin::default());
            frame
        };
        (0..sized(2, POSES)).map(solved).collect()
    };
    // All levels use one quality, so that only the triangles differ.
    let mut device = headless(Quality::High);
    for name in FIGURES {
        let figure = figure(name);
        let covered = |device: &mut Headless, level: usize| -> Vec<Vec<bool>> {
            let mut drawn = figure.clone();
            for mesh in &mut drawn.meshes {
                mesh.indices = mesh.triangles_at(level).to_vec();
                mesh.coarser.clear();
            }
            device.set_figure(&drawn).expect("a sound figure");
            frames(&figure)
                .into_iter()
                .map(|mut frame| {
                    let with = draw(device, &frame);
                    frame.visibility.body = false;
                    let without = draw(device, &frame);
                    let pairs = with.iter().zip(&without);
                    pairs.map(|(a, b)| a != b).collect()
                })
                .collect()
        };
        let finest = covered(&mut device, 0);
        for level in [1, 2] {
            let coarse = covered(&mut device, level);
            for (number, (a, b)) in finest.iter().zip(&coarse).enumerate() {
                let all = a.iter().filter(|p| **p).count() as f64;
                let other = a.iter().zip(b).filter(|(p, q)| p != q).count() as f64;
                assert!(
                    other < MAX_OTHER * all,
                    "{name}, level {level}, pose {number}: {other} of {all}"
                );
            }
        }
    }
}
