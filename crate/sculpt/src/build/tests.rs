use std::sync::OnceLock;

use super::*;
use crate::posed::{self, bind_pose, turn};
use crate::tests::soundness::shipped;
use raconteur_body::pose::Pose;
use raconteur_body::read::read_figure;
use raconteur_body::write::to_packed_glb;

/// Sofia and her file, made once for all tests.
fn sofia() -> (&'static Figure, &'static [u8]) {
    static MADE: OnceLock<Vec<u8>> = OnceLock::new();
    let AnnotatedFigure {
        figure,
        annotations,
    } = &shipped("sofia").1;
    (
        figure,
        MADE.get_or_init(|| to_packed_glb(figure, annotations)),
    )
}

fn skinned(figure: &Figure, pose: &Pose, mesh: &raconteur_body::Mesh) -> Vec<DVec3> {
    let moved = posed::moved(figure, pose);
    let at = |v| mesh.skinned(&moved, v)[0];
    (0..mesh.positions.len()).map(at).collect()
}

#[test]
fn every_vertex_is_sound() {
    let (figure, _) = sofia();
    for mesh in &figure.meshes {
        let n = mesh.positions.len();
        assert!(
            mesh.indices.iter().all(|&i| (i as usize) < n),
            "{}",
            mesh.name
        );
        for v in 0..n {
            let sum: f32 = mesh.weights[v].iter().sum();
            assert!((sum - 1.0).abs() < 1e-5, "{} {v} {sum}", mesh.name);
            assert!(
                mesh.joints[v]
                    .iter()
                    .all(|&j| usize::from(j) < figure.skeleton.joints().len()),
                "every vertex joint exists"
            );
            assert!(
                mesh.positions[v]
                    .iter()
                    .chain(&mesh.uvs[v])
                    .all(|x| x.is_finite()),
                "positions and texture coordinates are finite"
            );
            let length: f32 = mesh.normals[v].iter().map(|x| x * x).sum();
            assert!((length - 1.0).abs() < 1e-3, "{} {v}", mesh.name);
        }
    }
}

#[test]
fn the_budgets_hold() {
    let (figure, bytes) = sofia();
    let triangles: usize = figure.meshes.iter().map(|m| m.indices.len() / 3).sum();
    assert!(triangles <= 110_000, "{triangles} triangles");
    assert!(bytes.len() <= 2_400_000, "{} bytes", bytes.len());
    assert!(figure.meshes.len() <= 20, "{} meshes", figure.meshes.len());
}

#[test]
fn she_is_as_tall_as_asked_and_stands_on_the_floor() {
    let (figure, _) = sofia();
    let heights = || {
        let solid = figure
            .meshes
            .iter()
            .filter(|m| m.material.kind != MaterialKind::Hair);
        solid.flat_map(|m| &m.positions).map(|p| f64::from(p[1]))
    };
    let (low, high) = (
        heights().fold(f64::MAX, f64::min),
        heights().fold(f64::MIN, f64::max),
    );
    assert!((high - 1.66).abs() < 0.005, "{high}");
    // Shoes reach to the floor within their sole's pattern.
    assert!(low.abs() < 0.005, "{low}");
}

/// Triangles, each with its least corner first: a packed file may turn them.
fn turned(indices: &[u32]) -> Vec<[u32; 3]> {
    let triangles = indices.as_chunks::<3>().0.iter().copied();
    triangles
        .map(|mut t| {
            let least = (0..3).min_by_key(|&i| t[i]).unwrap_or(0);
            t.rotate_left(least);
            t
        })
        .collect()
}

#[test]
fn the_file_gives_the_figure_back() {
    let (figure, bytes) = sofia();
    let back = read_figure("sofia", bytes).unwrap();
    assert_eq!(back.morph_names, figure.morph_names);
    assert_eq!(back.meshes.len(), figure.meshes.len());
    for (a, b) in back.meshes.iter().zip(&figure.meshes) {
        assert_eq!((&a.name, &a.colors), (&b.name, &b.colors));
        assert_eq!(a.joints, b.joints);
        assert_eq!(turned(&a.indices), turned(&b.indices), "{}", a.name);
        let levels = |m: &raconteur_body::Mesh| -> Vec<Vec<[u32; 3]>> {
            m.coarser.iter().map(|l| turned(l)).collect()
        };
        assert_eq!(levels(a), levels(b), "{}", a.name);
        for (p, q) in a
            .positions
            .iter()
            .flatten()
            .zip(b.positions.iter().flatten())
        {
            // Half a step of the file's grid.
            assert!((p - q).abs() < 1.7e-5, "{} {p} {q}", a.name);
        }
    }
    assert!(
        read_figure("sofia", &bytes[..bytes.len() / 2]).is_err(),
        "a truncated figure is rejected"
    );
}

#[test]
fn the_bind_pose_leaves_every_vertex_in_place() {
    let (figure, _) = sofia();
    let pose = bind_pose(figure);
    for mesh in &figure.meshes {
        for (p, q) in skinned(figure, &pose, mesh).iter().zip(&mesh.positions) {
            let q = DVec3::from_array(q.map(f64::from));
            assert!(p.distance(q) < 1e-6, "{} {p} {q}", mesh.name);
        }
    }
}

#[test]
fn raised_arms_and_bent_elbows_stretch_the_sweater_little() {
    let (figure, _) = sofia();
    let mesh = figure.meshes.iter().find(|m| m.name == "sweater").unwrap();
    let mut pose = bind_pose(figure);
    for side in Side::BOTH {
        let up = |a: f64| DQuat::from_rotation_z(side.sign() * a);
        // To 70° above the horizontal; the scapula takes 0.42 of it.
        turn(
            &mut pose,
            figure,
            Bone::on(side, "scapula"),
            up(2.06 * 0.42),
        );
        turn(
            &mut pose,
            figure,
            Bone::on(side, "shoulder"),
            up(2.06 * 0.58),
        );
        let axis = Joints::arm_axis().cross(DVec3::Z) * DVec3::new(1.0, side.sign(), 1.0);
        turn(
            &mut pose,
            figure,
            Bone::on(side, "elbow"),
            DQuat::from_axis_angle(axis, side.sign() * 2.44),
        );
    }
    let posed = skinned(figure, &pose, mesh);
    let rest = |i: u32| DVec3::from_array(mesh.positions[i as usize].map(f64::from));
    let mut stretch: Vec<f64> = mesh
        .indices
        .chunks_exact(3)
        .flat_map(|t| [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])])
        .map(|(a, b)| {
            posed[a as usize].distance(posed[b as usize]) / rest(a).distance(rest(b)).max(1e-4)
        })
        .collect();
    stretch.sort_by(f64::total_cmp);
    let at = |share: f64| stretch[(stretch.len() as f64 * share) as usize];
    // The worst is the armpit, whose cloth is gathered in the rest pose.
    assert!(at(0.99) < 3.3, "{}", at(0.99));
    assert!(at(0.01) > 0.15, "{}", at(0.01));
}
