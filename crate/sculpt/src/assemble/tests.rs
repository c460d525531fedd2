use super::*;
use crate::part::{JointRef, PartMorph};
use raconteur_body::read::read_figure;
use raconteur_body::skeleton::{Drive, zero_frames};
use raconteur_body::write::to_glb;

/// A unit-less box on the example skeleton, with a morph and two joints.
fn small() -> Figure {
    let corner = |i: u32| {
        let s = |b: u32| if i & b == 0 { -0.1 } else { 0.1 };
        PartVertex {
            position: DVec3::new(s(1), 1.2 + s(2), s(4)),
            uv: [f64::from(i & 1), f64::from(i >> 1 & 1)],
            color: [0.5, 0.25, 0.1, 1.0],
            weights: vec![
                (JointRef(Drive::Bone(Bone::Thoracic)), 0.7),
                (JointRef(Drive::Share(Bone::LElbow, 0.5)), 0.2),
                (JointRef(Drive::Bone(Bone::Skull)), 0.1),
            ],
        }
    };
    let faces = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    let part = MeshPart {
        name: "box".to_owned(),
        material: Material {
            kind: MaterialKind::Cloth,
            base_color: [1.0; 4],
            roughness: 0.5,
            double_sided: false,
            maps: TextureMaps::default(),
        },
        vertices: (0..8).map(corner).collect(),
        faces: faces.iter().map(|f| f.to_vec()).collect(),
        morphs: vec![PartMorph {
            name: "jawOpen".to_owned(),
            deltas: vec![
                (7, DVec3::new(0.0, 0.0, 0.02)),
                (2, DVec3::new(0.01, 0.0, 0.0)),
            ],
        }],
        bound: Vec::new(),
    };
    assemble(&Blueprint {
        name: "box".to_owned(),
        positions_in_world: Bone::ALL.map(Bone::example_position_m),
        bind_rotations: zero_frames(),
        face: FaceJoints {
            eye_centres: [DVec3::new(0.03, 1.8, 0.08), DVec3::new(-0.03, 1.8, 0.08)],
        },
        stature_m: 1.956,
        lid_closure_rad: [0.6, 0.6],
        chains: Vec::new(),
        pieces: vec![part.into()],
        images: vec![Image {
            mime_type: "image/png".to_owned(),
            bytes: vec![1, 2, 3, 4, 5],
        }],
    })
}

#[test]
fn a_written_figure_reads_back() {
    let figure = small();
    let bytes = to_glb(&figure);
    let back = read_figure("box", &bytes).unwrap();
    assert_eq!(back.morph_names, figure.morph_names);
    assert_eq!(back.lid_closure_rad, figure.lid_closure_rad);
    assert_eq!(back.sex, None);
    let woman = Figure {
        sex: Some(1.0),
        ..figure.clone()
    };
    let back_again = read_figure("box", &to_glb(&woman)).unwrap();
    assert_eq!(back_again.sex, Some(1.0));
    assert_eq!(back.dominant_hand, Side::Right);
    let left = Figure {
        dominant_hand: Side::Left,
        ..figure.clone()
    };
    let back_left = read_figure("box", &to_glb(&left)).unwrap();
    assert_eq!(back_left.dominant_hand, Side::Left);
    assert!(
        (back.skeleton.stature_m() - 1.956).abs() < 1e-6,
        "the stature of the written figure"
    );
    for (a, b) in back.skeleton.joints().iter().zip(figure.skeleton.joints()) {
        assert_eq!((&a.name, a.drive, a.parent), (&b.name, b.drive, b.parent));
        assert!(
            a.translation_in_parent.distance(b.translation_in_parent) < 1e-5,
            "{}",
            a.name
        );
    }
    for (a, b) in back.inverse_bind.iter().zip(&figure.inverse_bind) {
        assert!(a.abs_diff_eq(*b, 1e-5), "the matrix round trips");
    }
    let (a, b) = (&back.meshes[0], &figure.meshes[0]);
    assert_eq!(
        (&a.material, &a.indices, &a.joints),
        (&b.material, &b.indices, &b.joints)
    );
    assert_eq!((&a.colors, &a.morphs.len()), (&b.colors, &b.morphs.len()));
    assert_eq!(a.morphs[0].vertices, b.morphs[0].vertices);
    let near = |p: &[[f32; 3]], q: &[[f32; 3]], tolerance: f32| {
        p.iter()
            .flatten()
            .zip(q.iter().flatten())
            .all(|(x, y)| (x - y).abs() < tolerance)
    };
    // Half a step of 1/32768 m; a step of 8-bit normals.
    assert!(
        near(&a.positions, &b.positions, 1.6e-5),
        "the positions round trip within the quantisation"
    );
    assert!(
        near(
            &a.morphs[0].position_deltas,
            &b.morphs[0].position_deltas,
            1.6e-5
        ),
        "the morph positions round trip within the quantisation"
    );
    assert!(
        near(&a.normals, &b.normals, 0.005),
        "the normals round trip within the quantisation"
    );
    assert!(
        near(
            &a.morphs[0].normal_deltas,
            &b.morphs[0].normal_deltas,
            0.005
        ),
        "the morph normals round trip within the quantisation"
    );
    for (x, y) in a.weights.iter().flatten().zip(b.weights.iter().flatten()) {
        assert!((x - y).abs() < 1e-6, "the number round trips");
    }
    assert_eq!(to_glb(&back).len(), bytes.len());
}

#[test]
fn damaged_files_are_refused_without_a_panic() {
    let bytes = to_glb(&small());
    assert!(read_figure("x", b"").is_err(), "an empty file is rejected");
    assert!(
        read_figure("x", &bytes[..100]).is_err(),
        "a truncated header is rejected"
    );
    let mut huge = bytes.clone();
    huge[8..12].copy_from_slice(&u32::MAX.to_le_bytes());
    assert!(
        read_figure("x", &huge).is_err(),
        "an excessive length is rejected"
    );
    let mut short = bytes.clone();
    short[8..12].copy_from_slice(&3u32.to_le_bytes());
    assert!(
        read_figure("x", &short).is_err(),
        "a length that is too short is rejected"
    );
    // One byte in seven of the JSON, and some of the numbers, damaged: never a panic.
    for i in (12..bytes.len()).step_by(7) {
        for value in [0u8, 0xFF, b'9', b'-'] {
            let mut damaged = bytes.clone();
            damaged[i] = value;
            drop(read_figure("x", &damaged));
        }
    }
}

#[test]
fn faults_are_named() {
    use raconteur_body::read::ReadError;
    let bytes = to_glb(&small());
    let swap = |from: &str, to: &str| {
        assert_eq!(from.len(), to.len());
        let mut b = bytes.clone();
        let at = b
            .windows(from.len())
            .position(|w| w == from.as_bytes())
            .unwrap();
        b[at..at + to.len()].copy_from_slice(to.as_bytes());
        read_figure("x", &b).unwrap_err()
    };
    assert!(
        matches!(
            swap("bone_chin", "bone_nose"),
            ReadError::NoSkeleton {
                missing: "bone_chin"
            }
        ),
        "the missing chin joint is named"
    );
    assert!(
        matches!(
            swap("KHR_mesh_quantization", "KHR_mesh_compression_"),
            ReadError::Extension(_)
        ),
        "an unknown extension is rejected"
    );
}
