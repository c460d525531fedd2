//! Small figure for tests: balls and tubes on GEVH's example skeleton, with one part of every
//! material.

use glam::{Vec2, Vec3};
use raconteur_base::{DAffine3, DVec3};
use raconteur_body::figure::TextureMaps;
use raconteur_body::skeleton::Drive;
use raconteur_body::{Bone, Figure, Material, MaterialKind, Mesh, Morph, Pose, Skeleton};
use raconteur_stage::{Frame, FramingMargin, Shot};

/// Positions of the eyeballs, in front of the skeleton's own.
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
            maps: TextureMaps::default(),
        },
        positions: Vec::new(),
        normals: Vec::new(),
        uvs: Vec::new(),
        colors: Vec::new(),
        joints: Vec::new(),
        weights: Vec::new(),
        indices: Vec::new(),
        morphs: Vec::new(),
        coarser: Vec::new(),
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

const SKIN: [u8; 4] = [205, 140, 105, 255];
const SHIRT: [u8; 4] = [60, 80, 120, 255];
const TROUSERS: [u8; 4] = [40, 40, 60, 255];
const SHOE: [u8; 4] = [50, 30, 20, 255];

/// Returns head, trunk and the parts in and on the face; the head first.
fn head_and_trunk() -> Vec<Mesh> {
    use MaterialKind::{Cloth, Lash, Mouth, Plain, Skin, Teeth};
    let (teeth, mouth, lash) = ([235, 225, 205, 200], [150, 50, 50, 160], [20, 14, 10, 255]);
    let rows = [
        (
            Skin,
            SKIN,
            Bone::Skull,
            [0.0, 1.81, 0.01],
            [0.08, 0.12, 0.10],
        ),
        (
            Cloth,
            SHIRT,
            Bone::Thoracic,
            [0.0, 1.35, 0.0],
            [0.19, 0.30, 0.12],
        ),
        (
            Plain,
            [90, 60, 60, 255],
            Bone::Sacroiliac,
            [0.0, 1.02, 0.0],
            [0.17, 0.14, 0.11],
        ),
        (
            Teeth,
            teeth,
            Bone::Skull,
            [0.0, 1.745, 0.095],
            [0.022, 0.008, 0.012],
        ),
        (
            Mouth,
            mouth,
            Bone::Skull,
            [0.0, 1.73, 0.093],
            [0.026, 0.010, 0.012],
        ),
        (
            Lash,
            lash,
            Bone::Skull,
            [0.032, 1.822, 0.10],
            [0.016, 0.003, 0.006],
        ),
    ];
    let mut meshes = rows
        .map(|(kind, color, bone, centre, radii)| {
            ball(
                kind,
                color,
                bone.index() as u16,
                centre.into(),
                radii.into(),
            )
        })
        .to_vec();
    meshes.insert(1, hair(Bone::Skull.index() as u16));
    meshes
}

fn eyes(skeleton: &Skeleton) -> impl Iterator<Item = Mesh> {
    raconteur_base::Side::BOTH
        .into_iter()
        .zip(EYES)
        .map(|(side, centre)| {
            let joints = skeleton.joints();
            let joint = joints.iter().position(|j| j.drive == Drive::Eye(side));
            let joint = joint.unwrap_or(0) as u16;
            let radii = Vec3::splat(0.018);
            let mut globe = ball(MaterialKind::Eye, [255; 4], joint, centre.as_vec3(), radii);
            globe.material.base_color = [0.16, 0.09, 0.04, 1.0];
            globe
        })
}

/// Arms and legs, from joint to joint.
fn limbs(at: impl Fn(Bone) -> Vec3) -> impl Iterator<Item = Mesh> {
    use MaterialKind::{Cloth, Leather, Plain, Skin};
    let rows = [
        (Bone::LShoulder, Bone::LElbow, Cloth, SHIRT, 0.05),
        (Bone::RShoulder, Bone::RElbow, Cloth, SHIRT, 0.05),
        (Bone::LElbow, Bone::LWrist, Skin, SKIN, 0.04),
        (Bone::RElbow, Bone::RWrist, Skin, SKIN, 0.04),
        (Bone::LHip, Bone::LKnee, Plain, TROUSERS, 0.07),
        (Bone::RHip, Bone::RKnee, Plain, TROUSERS, 0.07),
        (Bone::LKnee, Bone::LSubtalar, Leather, SHOE, 0.05),
        (Bone::RKnee, Bone::RSubtalar, Leather, SHOE, 0.05),
    ];
    rows.into_iter()
        .map(move |(bone, end, kind, color, width)| {
            let (a, b) = (at(bone), at(end));
            let half = (b - a).abs() * 0.5 + Vec3::splat(width);
            ball(kind, color, bone.index() as u16, (a + b) * 0.5, half)
        })
}

/// The head's lower half drops.
fn jaw_opens(head: &Mesh) -> Morph {
    let low: Vec<u32> = (0..head.positions.len() as u32)
        .filter(|&i| head.positions[i as usize][1] < 1.76)
        .collect();
    Morph {
        target: 0,
        position_deltas: vec![[0.0, -0.05, 0.0]; low.len()],
        normal_deltas: vec![[0.0; 3]; low.len()],
        vertices: low,
    }
}

/// The test figure.
pub(crate) fn figure() -> Figure {
    let skeleton = Skeleton::example();
    let mut bind = Vec::new();
    skeleton.solve(&Pose::zero(), &mut bind);
    let mut meshes = head_and_trunk();
    let morph = jaw_opens(&meshes[0]);
    meshes[0].morphs.push(morph);
    meshes.extend(eyes(&skeleton));
    meshes.extend(limbs(|bone| bind[bone.index()].translation.as_vec3()));
    Figure {
        name: "test".to_owned(),
        skeleton,
        inverse_bind: bind.iter().map(DAffine3::inverse).collect(),
        meshes,
        morph_names: vec!["jawOpen".to_owned()],
        lid_closure_rad: [0.6; 2],
        sex: None,
        dominant_hand: raconteur_base::Side::Right,
        images: Vec::new(),
        tissue: None,
        springs: raconteur_body::Springs::default(),
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
        FramingMargin::default(),
    );
    frame
}
