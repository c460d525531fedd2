//! A small figure for tests: balls and tubes on GEVH's example skeleton, with one part
//! of every material.

use glam::{Vec2, Vec3};
use raconteur_base::{DAffine3, DVec3};
use raconteur_body::figure::Maps;
use raconteur_body::skeleton::Drive;
use raconteur_body::{Bone, Figure, Material, MaterialKind, Mesh, Morph, Pose, Skeleton};
use raconteur_stage::{Frame, Room, Shot};

/// Where the balls of the eyes stand, in front of the skeleton's own.
const EYES: [DVec3; 2] = [
    DVec3::new(0.032, 1.80, 0.085),
    DVec3::new(-0.032, 1.80, 0.085),
];

/// An ellipsoid whose pole points to +z; uv as on an eye.
pub(crate) fn ball(
    kind: MaterialKind,
    color: [u8; 4],
    joint: u16,
    centre: Vec3,
    radii: Vec3,
) -> Mesh {
    let (rings, sectors) = (16_u32, 24_u32);
    let mut mesh = empty(kind);
    for i in 0..=rings {
        let polar = std::f64::consts::PI * f64::from(i) / f64::from(rings);
        for j in 0..=sectors {
            let turn = std::f64::consts::TAU * f64::from(j) / f64::from(sectors);
            let (s, c) = raconteur_base::ops::sincos(polar);
            let (st, ct) = raconteur_base::ops::sincos(turn);
            let d = Vec3::new((s * ct) as f32, (s * st) as f32, c as f32);
            mesh.positions.push((centre + d * radii).into());
            mesh.normals.push((d / radii).normalize().into());
            mesh.uvs
                .push((Vec2::splat(0.5) + 0.5 * Vec2::new(d.x, d.y)).into());
            mesh.colors.push(color);
            mesh.joints.push([joint, 0, 0, 0]);
            mesh.weights.push([1.0, 0.0, 0.0, 0.0]);
        }
    }
    for i in 0..rings {
        for j in 0..sectors {
            let a = i * (sectors + 1) + j;
            let b = a + sectors + 1;
            mesh.indices.extend([a, b, a + 1, a + 1, b, b + 1]);
        }
    }
    mesh
}

pub(crate) fn empty(kind: MaterialKind) -> Mesh {
    let name = MaterialKind::NAMES[kind as usize].1;
    Mesh {
        name: name.to_owned(),
        material: Material {
            kind,
            base_color: [1.0; 4],
            roughness: 0.5,
            double_sided: matches!(kind, MaterialKind::Hair | MaterialKind::Lash),
            maps: Maps::default(),
        },
        positions: Vec::new(),
        normals: Vec::new(),
        uvs: Vec::new(),
        colors: Vec::new(),
        joints: Vec::new(),
        weights: Vec::new(),
        indices: Vec::new(),
        morphs: Vec::new(),
        binding: None,
    }
}

/// Cards hanging over the head like a cap.
fn hair(joint: u16) -> Mesh {
    let mut mesh = empty(MaterialKind::Hair);
    for card in 0..60 {
        let turn = std::f64::consts::TAU * f64::from(card) / 60.0;
        let (s, c) = raconteur_base::ops::sincos(turn);
        let out = Vec3::new(s as f32, 0.0, c as f32);
        if out.z > 0.6 {
            continue;
        }
        let side = Vec3::Y.cross(out) * 0.012;
        let base = mesh.positions.len() as u32;
        for k in 0..5_u32 {
            let v = k as f32 / 4.0;
            let p = Vec3::new(0.0, 1.93, 0.0) + out * (0.05 + 0.075 * v.sqrt())
                - Vec3::Y * (0.25 * v * v);
            for (u, at) in [(0.0, p - side), (1.0, p + side)] {
                mesh.positions.push(at.into());
                mesh.normals
                    .push((out + Vec3::Y * (1.0 - v)).normalize().into());
                mesh.uvs.push([u, v]);
                mesh.colors.push([60, 32, 18, 230]);
                mesh.joints.push([joint, 0, 0, 0]);
                mesh.weights.push([1.0, 0.0, 0.0, 0.0]);
            }
            if k > 0 {
                let a = base + 2 * (k - 1);
                mesh.indices.extend([a, a + 2, a + 1, a + 1, a + 2, a + 3]);
            }
        }
    }
    mesh
}

/// The test figure.
pub(crate) fn figure() -> Figure {
    let skeleton = Skeleton::example();
    let mut bind = Vec::new();
    skeleton.solve(&Pose::zero(), &mut bind);
    let at = |bone: Bone| bind[bone.index()].translation.as_vec3();
    let eye = |side: raconteur_base::Side| {
        skeleton
            .joints()
            .iter()
            .position(|j| j.drive == Drive::Eye(side))
            .unwrap_or(0) as u16
    };
    let skull = Bone::Skull.index() as u16;
    let skin = [205, 140, 105, 255];
    let mut meshes = vec![
        ball(
            MaterialKind::Skin,
            skin,
            skull,
            Vec3::new(0.0, 1.81, 0.01),
            Vec3::new(0.08, 0.12, 0.10),
        ),
        hair(skull),
        ball(
            MaterialKind::Cloth,
            [60, 80, 120, 255],
            Bone::Thoracic.index() as u16,
            Vec3::new(0.0, 1.35, 0.0),
            Vec3::new(0.19, 0.30, 0.12),
        ),
        ball(
            MaterialKind::Plain,
            [90, 60, 60, 255],
            Bone::Sacroiliac.index() as u16,
            Vec3::new(0.0, 1.02, 0.0),
            Vec3::new(0.17, 0.14, 0.11),
        ),
        ball(
            MaterialKind::Teeth,
            [235, 225, 205, 200],
            skull,
            Vec3::new(0.0, 1.745, 0.095),
            Vec3::new(0.022, 0.008, 0.012),
        ),
        ball(
            MaterialKind::Mouth,
            [150, 50, 50, 160],
            skull,
            Vec3::new(0.0, 1.73, 0.093),
            Vec3::new(0.026, 0.010, 0.012),
        ),
        ball(
            MaterialKind::Lash,
            [20, 14, 10, 255],
            skull,
            Vec3::new(0.032, 1.822, 0.10),
            Vec3::new(0.016, 0.003, 0.006),
        ),
    ];
    for (side, centre) in raconteur_base::Side::BOTH.into_iter().zip(EYES) {
        let c = centre.as_vec3();
        let mut globe = ball(
            MaterialKind::Eye,
            [255; 4],
            eye(side),
            c,
            Vec3::splat(0.018),
        );
        globe.material.base_color = [0.16, 0.09, 0.04, 1.0];
        meshes.push(globe);
    }
    for (bone, end, kind, color, width) in [
        (
            Bone::LShoulder,
            Bone::LElbow,
            MaterialKind::Cloth,
            [60, 80, 120, 255],
            0.05,
        ),
        (
            Bone::RShoulder,
            Bone::RElbow,
            MaterialKind::Cloth,
            [60, 80, 120, 255],
            0.05,
        ),
        (Bone::LElbow, Bone::LWrist, MaterialKind::Skin, skin, 0.04),
        (Bone::RElbow, Bone::RWrist, MaterialKind::Skin, skin, 0.04),
        (
            Bone::LHip,
            Bone::LKnee,
            MaterialKind::Plain,
            [40, 40, 60, 255],
            0.07,
        ),
        (
            Bone::RHip,
            Bone::RKnee,
            MaterialKind::Plain,
            [40, 40, 60, 255],
            0.07,
        ),
        (
            Bone::LKnee,
            Bone::LSubtalar,
            MaterialKind::Leather,
            [50, 30, 20, 255],
            0.05,
        ),
        (
            Bone::RKnee,
            Bone::RSubtalar,
            MaterialKind::Leather,
            [50, 30, 20, 255],
            0.05,
        ),
    ] {
        let (a, b) = (at(bone), at(end));
        let half = (b - a).abs() * 0.5 + Vec3::splat(width);
        meshes.push(ball(kind, color, bone.index() as u16, (a + b) * 0.5, half));
    }
    // The head's lower half drops with one morph target.
    let head = &mut meshes[0];
    let low: Vec<u32> = (0..head.positions.len() as u32)
        .filter(|&i| head.positions[i as usize][1] < 1.76)
        .collect();
    head.morphs.push(Morph {
        target: 0,
        position_deltas: vec![[0.0, -0.05, 0.0]; low.len()],
        normal_deltas: vec![[0.0; 3]; low.len()],
        vertices: low,
    });
    let inverse_bind = bind.iter().map(DAffine3::inverse).collect();
    Figure {
        name: "test".to_owned(),
        skeleton,
        inverse_bind,
        meshes,
        morph_names: vec!["jawOpen".to_owned()],
        lid_closure_rad: [0.6; 2],
        sex: None,
        dominant_hand: raconteur_base::Side::Right,
        images: Vec::new(),
        tissue: None,
    }
}

/// A frame of the figure in this pose.
pub(crate) fn frame(figure: &Figure, pose: &Pose, shot: Shot, aspect: f64) -> Frame {
    let mut frame = Frame::with_capacity(figure.skeleton.joints().len(), figure.morph_names.len());
    figure.skeleton.solve(pose, &mut frame.world_from_joint);
    frame.camera = shot.frame(
        DVec3::ZERO,
        figure.skeleton.stature_m(),
        aspect,
        Room::default(),
    );
    frame
}
