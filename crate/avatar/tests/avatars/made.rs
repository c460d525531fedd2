//! Generated stick figures in the dialects of other avatars.
//!
//! Every joint carries a small octahedron around itself, so that a test finds the joint's position
//! from its vertices. Joints have arbitrary axes, as in rigs.

mod file;
mod spelling;

use raconteur_base::{DAffine3, DMat4, DQuat, DVec3, noise, ops};
use serde_json::{Value, json};

use self::file::push;
pub(crate) use self::file::{File, pack};
use self::spelling::spelled;

/// Naming convention of the joints.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Dialect {
    /// Table in the extension `VRM`; node names carry no information.
    Vrm0,
    /// A table in `VRMC_vrm`.
    Vrm1,
    /// `mixamorig:LeftArm`.
    Mixamo,
    /// `LeftArm`, with bones for the eyes.
    ReadyPlayerMe,
    /// `upper_arm.L`.
    Blender,
}

/// Parameters of the test avatar.
#[derive(Clone, Debug)]
pub(crate) struct Avatar {
    pub(crate) dialect: Dialect,
    /// Numbers in the file for a metre; the armature's scale undoes `armature` of it.
    pub(crate) units_per_metre: f64,
    /// True if the armature is scaled so that the file is nevertheless in metres.
    pub(crate) armature_scaled: bool,
    /// Turn of the whole about the vertical, radians.
    pub(crate) yaw_rad: f64,
    /// Angle of the arms below the horizontal in the rest pose, radians.
    pub(crate) arms_down_rad: f64,
    /// Bend of the elbows in the rest pose, radians.
    pub(crate) elbow_rad: f64,
    /// Random rotation of the nodes relative to the bind pose, radians: a file saved during a
    /// movement.
    pub(crate) posed_rad: f64,
    /// Adds fingers.
    pub(crate) fingers: bool,
    /// Morph targets of the face by name, each moving all its vertices by [`delta`].
    pub(crate) morphs: Vec<&'static str>,
    /// VRM's expressions: name and target.
    pub(crate) expressions: Vec<(&'static str, usize)>,
}

impl Avatar {
    pub(crate) fn new(dialect: Dialect) -> Self {
        Self {
            dialect,
            units_per_metre: 1.0,
            armature_scaled: false,
            yaw_rad: 0.0,
            arms_down_rad: 0.0,
            elbow_rad: 0.0,
            posed_rad: 0.0,
            fingers: true,
            morphs: Vec::new(),
            expressions: Vec::new(),
        }
    }
}

/// Displacement of target `i`, metres in the avatar's own frame.
pub(crate) fn delta(i: usize) -> DVec3 {
    DVec3::new(0.001 * i as f64, 0.002, 0.003 + 0.0005 * i as f64)
}

/// Part of the stick figure: VRM name, parent's name, and position in the T-pose, metres.
struct Joint {
    part: String,
    parent: Option<String>,
    at: DVec3,
}

/// Lengths of the stick figure's upper arm and forearm, metres.
pub(crate) const UPPER_ARM_M: f64 = 0.27;
pub(crate) const FOREARM_M: f64 = 0.25;

fn joints(avatar: &Avatar) -> Vec<Joint> {
    let mut list: Vec<Joint> = Vec::new();
    let mut add = |part: &str, parent: &str, at: DVec3| {
        list.push(Joint {
            part: part.to_owned(),
            parent: (!parent.is_empty()).then(|| parent.to_owned()),
            at,
        });
    };
    let v = DVec3::new;
    add("hips", "", v(0.0, 0.93, 0.0));
    add("spine", "hips", v(0.0, 1.03, 0.0));
    add("chest", "spine", v(0.0, 1.18, -0.01));
    add("neck", "chest", v(0.0, 1.42, -0.01));
    add("head", "neck", v(0.0, 1.52, 0.0));
    for (side, s) in [("left", 1.0), ("right", -1.0)] {
        let name = |part: &str| format!("{side}{part}");
        if avatar.dialect == Dialect::ReadyPlayerMe {
            add(&name("Eye"), "head", v(0.03 * s, 1.58, 0.08));
        }
        add(&name("UpperLeg"), "hips", v(0.09 * s, 0.9, 0.0));
        add(&name("LowerLeg"), &name("UpperLeg"), v(0.09 * s, 0.49, 0.0));
        add(&name("Foot"), &name("LowerLeg"), v(0.09 * s, 0.08, -0.01));
        add(&name("Toes"), &name("Foot"), v(0.09 * s, 0.02, 0.12));
        add(&name("Shoulder"), "chest", v(0.03 * s, 1.38, 0.0));
        let shoulder = v(0.17 * s, 1.38, 0.0);
        add(&name("UpperArm"), &name("Shoulder"), shoulder);
        // Down about the axis to the front, then the elbow about the arm's own hinge.
        let down = DQuat::from_rotation_z(-s * avatar.arms_down_rad);
        let bend = down * DQuat::from_rotation_y(-s * avatar.elbow_rad);
        let elbow = shoulder + down * v(UPPER_ARM_M * s, 0.0, 0.0);
        let wrist = elbow + bend * v(FOREARM_M * s, 0.0, 0.0);
        add(&name("LowerArm"), &name("UpperArm"), elbow);
        add(&name("Hand"), &name("LowerArm"), wrist);
        if !avatar.fingers {
            continue;
        }
        for (finger, z) in [
            ("Index", 0.03),
            ("Middle", 0.01),
            ("Ring", -0.01),
            ("Little", -0.03),
        ] {
            for (i, phalanx) in ["Proximal", "Intermediate", "Distal"].iter().enumerate() {
                let parent = match i {
                    0 => name("Hand"),
                    1 => name(&format!("{finger}Proximal")),
                    _ => name(&format!("{finger}Intermediate")),
                };
                let at = wrist + bend * v((0.09 + 0.03 * i as f64) * s, 0.0, z);
                add(&name(&format!("{finger}{phalanx}")), &parent, at);
            }
        }
        for (i, phalanx) in ["Proximal", "Intermediate", "Distal"].iter().enumerate() {
            let parent = match i {
                0 => name("Hand"),
                1 => name("ThumbProximal"),
                _ => name("ThumbIntermediate"),
            };
            let d = i as f64;
            let at = wrist + bend * v((0.03 + 0.02 * d) * s, -0.01 - 0.01 * d, 0.02 + 0.02 * d);
            add(&name(&format!("Thumb{phalanx}")), &parent, at);
        }
    }
    list
}

const OCTAHEDRON: [DVec3; 6] = [
    DVec3::X,
    DVec3::NEG_X,
    DVec3::Y,
    DVec3::NEG_Y,
    DVec3::Z,
    DVec3::NEG_Z,
];
const FACES: [[u16; 3]; 8] = [
    [0, 2, 4],
    [2, 1, 4],
    [1, 3, 4],
    [3, 0, 4],
    [2, 0, 5],
    [1, 2, 5],
    [3, 1, 5],
    [0, 3, 5],
];

fn index(joints: &[Joint], part: &str) -> usize {
    joints
        .iter()
        .position(|j| j.part == part)
        .expect("a parent")
}

/// Armature, body and joints; `own` is each joint from the armature's space.
fn nodes(avatar: &Avatar, joints: &[Joint], own: &[DAffine3], armature: &DAffine3) -> Vec<Value> {
    // Node 0 is the armature, node 1 the body, then the joints, then the face.
    let mut nodes = vec![json!({}), json!({ "name": "Body", "mesh": 0, "skin": 0 })];
    for (i, joint) in joints.iter().enumerate() {
        let local = match &joint.parent {
            Some(parent) => own[index(joints, parent)].inverse() * own[i],
            None => own[i],
        };
        let (_, rotation, translation) = local.to_scale_rotation_translation();
        let turn = [1, 2, 3].map(|k| avatar.posed_rad * noise::signed(9, k, i as i64));
        let rotation = rotation * DQuat::from_scaled_axis(DVec3::from_array(turn));
        let children: Vec<usize> = (0..joints.len())
            .filter(|&c| joints[c].parent.as_deref() == Some(&joint.part))
            .map(|c| c + 2)
            .collect();
        let mut node = json!({
            "name": spelled(avatar.dialect, &joint.part, i),
            "translation": translation.to_array(),
            "rotation": rotation.to_array(),
        });
        if !children.is_empty() {
            node["children"] = json!(children);
        }
        nodes.push(node);
    }
    let (scales, rotation, _) = armature.to_scale_rotation_translation();
    nodes[0] = json!({
        "name": "Armature", "children": [2],
        "scale": scales.to_array(), "rotation": rotation.to_array(),
    });
    nodes
}

/// The mesh of octahedra and its skin.
fn add_body(file: &mut File, joints: &[Joint], own: &[DAffine3], u: f64) {
    let mut positions = Vec::new();
    let mut indices: Vec<u16> = Vec::new();
    let mut carriers: Vec<u8> = Vec::new();
    for (i, joint) in joints.iter().enumerate() {
        for face in FACES {
            indices.extend(face.map(|v| v + 6 * i as u16));
        }
        // The head reaches to 1.70 m, the toes to the floor.
        let radius = if joint.part == "head" { 0.18 } else { 0.02 };
        for corner in OCTAHEDRON {
            positions.push((joint.at + corner * radius) * u);
            carriers.extend([i as u8, 0, 0, 0]);
        }
    }
    let count = positions.len();
    let position = file.vectors(&positions);
    let joint_view = file.accessor(&carriers, 5121, "VEC4", count);
    let weights: Vec<u8> = (0..count)
        .flat_map(|_| [1f32, 0.0, 0.0, 0.0])
        .flat_map(f32::to_le_bytes)
        .collect();
    let weight_view = file.accessor(&weights, 5126, "VEC4", count);
    let index_bytes: Vec<u8> = indices.iter().flat_map(|i| i.to_le_bytes()).collect();
    let index_view = file.accessor(&index_bytes, 5123, "SCALAR", indices.len());
    let binds: Vec<u8> = own
        .iter()
        .flat_map(|o| DMat4::from(o.inverse()).to_cols_array())
        .flat_map(|x| (x as f32).to_le_bytes())
        .collect();
    let bind_view = file.accessor(&binds, 5126, "MAT4", own.len());
    file.json["meshes"] = json!([{ "name": "Body", "primitives": [{
        "attributes": { "POSITION": position, "JOINTS_0": joint_view, "WEIGHTS_0": weight_view },
        "indices": index_view,
    }] }]);
    file.json["skins"] = json!([{
        "joints": (2..joints.len() + 2).collect::<Vec<_>>(), "inverseBindMatrices": bind_view,
    }]);
}

/// Makes the avatar.
pub(crate) fn make(avatar: &Avatar) -> File {
    let joints = joints(avatar);
    let u = avatar.units_per_metre;
    let scale = if avatar.armature_scaled { 1.0 / u } else { 1.0 };
    let armature = DAffine3::from_scale_rotation_translation(
        DVec3::splat(scale),
        DQuat::from_xyzw(
            0.0,
            ops::sin(0.5 * avatar.yaw_rad),
            0.0,
            ops::cos(0.5 * avatar.yaw_rad),
        ),
        DVec3::ZERO,
    );
    let mut file = File {
        json: json!({ "asset": { "version": "2.0" }, "scene": 0, "scenes": [{ "nodes": [0, 1] }] }),
        bin: Vec::new(),
        parts: joints.iter().map(|j| j.part.clone()).collect(),
    };
    // The joint in the armature's space, with arbitrary axes.
    let own: Vec<DAffine3> = joints
        .iter()
        .enumerate()
        .map(|(i, j)| {
            let q = [1, 2, 3, 4].map(|k| noise::signed(7, k, i as i64));
            DAffine3::from_rotation_translation(DQuat::from_array(q).normalize(), j.at * u)
        })
        .collect();
    let mut nodes = nodes(avatar, &joints, &own, &armature);
    add_body(&mut file, &joints, &own, u);
    if !avatar.morphs.is_empty() {
        add_face(&mut file, avatar, &mut nodes, index(&joints, "head"), &own);
    }
    file.json["nodes"] = json!(nodes);
    add_tables(&mut file, avatar, &joints);
    file
}

/// A face that hangs on the head without a skin.
fn add_face(
    file: &mut File,
    avatar: &Avatar,
    nodes: &mut Vec<Value>,
    head: usize,
    own: &[DAffine3],
) {
    let u = avatar.units_per_metre;
    let to_head = own[head].inverse();
    let corners = [
        DVec3::new(0.03, 1.55, 0.1),
        DVec3::new(-0.03, 1.55, 0.1),
        DVec3::new(0.0, 1.60, 0.1),
    ];
    let points: Vec<DVec3> = corners
        .iter()
        .map(|c| to_head.transform_point3(*c * u))
        .collect();
    let position = file.vectors(&points);
    let targets: Vec<Value> = (0..avatar.morphs.len())
        .map(|i| {
            let d = to_head.transform_vector3(delta(i) * u);
            json!({ "POSITION": file.vectors(&[d; 3]) })
        })
        .collect();
    let mesh = json!({
        "name": "Face",
        "extras": { "targetNames": avatar.morphs },
        "primitives": [{ "attributes": { "POSITION": position }, "targets": targets }],
    });
    push(&mut file.json["meshes"], mesh);
    let face = nodes.len();
    nodes.push(json!({ "name": "Face", "mesh": 1 }));
    push(&mut nodes[head + 2]["children"], json!(face));
}

fn add_tables(file: &mut File, avatar: &Avatar, joints: &[Joint]) {
    let nodes = joints
        .iter()
        .enumerate()
        .map(|(i, j)| (j.part.as_str(), i + 2));
    match avatar.dialect {
        Dialect::Vrm0 => {
            let bones: Vec<Value> = nodes
                .map(|(b, n)| json!({ "bone": b, "node": n }))
                .collect();
            let groups: Vec<Value> = avatar
                .expressions
                .iter()
                .map(|(name, target)| {
                    json!({ "presetName": name, "binds": [{ "mesh": 1, "index": target, "weight": 100 }] })
                })
                .collect();
            file.json["extensions"]["VRM"] = json!({
                "humanoid": { "humanBones": bones },
                "blendShapeMaster": { "blendShapeGroups": groups },
            });
        }
        Dialect::Vrm1 => {
            let mut bones = json!({});
            for (bone, node) in nodes {
                // The thumb's first joint has another name there.
                let name = match bone {
                    "leftThumbProximal" => "leftThumbMetacarpal",
                    "rightThumbProximal" => "rightThumbMetacarpal",
                    "leftThumbIntermediate" => "leftThumbProximal",
                    "rightThumbIntermediate" => "rightThumbProximal",
                    other => other,
                };
                bones[name] = json!({ "node": node });
            }
            let face = joints.len() + 2;
            let mut preset = json!({});
            for (name, target) in &avatar.expressions {
                let bind = json!({ "node": face, "index": target, "weight": 1.0 });
                preset[*name] = json!({ "morphTargetBinds": [bind] });
            }
            file.json["extensions"]["VRMC_vrm"] = json!({
                "humanoid": { "humanBones": bones }, "expressions": { "preset": preset },
            });
        }
        _ => {}
    }
}
