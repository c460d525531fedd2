//! Imported avatars: any dialect, unit, facing and rest pose performs as generated figures do.

use crate::made::{Avatar, Dialect, FOREARM_M, File, UPPER_ARM_M, delta, make};
use raconteur_avatar::{ImportError, Imported, convert, import_figure, open_figure};
use raconteur_base::{DAffine3, DQuat, DVec3};
use raconteur_body::read::{ReadError, read_figure};
use raconteur_body::skeleton::zero_frames;
use raconteur_body::{Bone, Figure, Pose};

const DIALECTS: [Dialect; 5] = [
    Dialect::Vrm0,
    Dialect::Vrm1,
    Dialect::Mixamo,
    Dialect::ReadyPlayerMe,
    Dialect::Blender,
];

pub(crate) fn import(file: &File) -> Imported {
    import_figure("x", &file.glb()).unwrap_or_else(|e| panic!("{e}"))
}

/// Vertices of a mesh in a pose, as the renderer skins them.
pub(crate) fn posed(figure: &Figure, mesh: usize, pose: &Pose) -> Vec<DVec3> {
    let mut world = Vec::new();
    figure.skeleton.solve(pose, &mut world);
    let moved: Vec<DAffine3> = world
        .iter()
        .zip(&figure.inverse_bind)
        .map(|(w, b)| *w * *b)
        .collect();
    let mesh = &figure.meshes[mesh];
    mesh.positions
        .iter()
        .zip(mesh.joints.iter().zip(&mesh.weights))
        .map(|(p, (joints, weights))| {
            let at = DVec3::from_array(p.map(f64::from));
            joints.iter().zip(weights).fold(DVec3::ZERO, |sum, (j, w)| {
                sum + moved[usize::from(*j)].transform_point3(at) * f64::from(*w)
            })
        })
        .collect()
}

/// Returns the rendered position of a part's joint.
fn seen(file: &File, points: &[DVec3], part: &str) -> DVec3 {
    points[file.range(part)].iter().copied().sum::<DVec3>() / 6.0
}

/// Arm raised, elbow bent, wrist turned, on both sides.
pub(crate) fn pose() -> Pose {
    let mut pose = Pose::zero();
    for (part, q) in [
        (
            "shoulder",
            DQuat::from_rotation_y(0.5) * DQuat::from_rotation_z(0.4),
        ),
        ("elbow", DQuat::from_rotation_z(1.3)),
        ("wrist", DQuat::from_rotation_x(0.6)),
        ("index0", DQuat::from_rotation_z(-0.7)),
        ("hip", DQuat::from_rotation_z(0.3)),
        ("knee", DQuat::from_rotation_z(-0.5)),
    ] {
        for side in raconteur_base::Side::BOTH {
            pose.set(Bone::on(side, part), q);
        }
    }
    pose
}

/// Returns every supported stance of an avatar in its file.
fn variants() -> Vec<Avatar> {
    let mut list = Vec::new();
    for (i, dialect) in DIALECTS.into_iter().enumerate() {
        for (k, (arms_down_rad, elbow_rad)) in [(0.0, 0.0), (0.7, 0.0), (1.45, 0.5), (0.3, 0.9)]
            .into_iter()
            .enumerate()
        {
            let cm = (i + k) % 3;
            list.push(Avatar {
                units_per_metre: if cm == 0 { 1.0 } else { 100.0 },
                armature_scaled: cm == 1,
                // VRM 0.x faces -z.
                yaw_rad: match (dialect, k % 2) {
                    (Dialect::Vrm0, _) => core::f64::consts::PI,
                    (_, 0) => 0.0,
                    _ => 2.1,
                },
                arms_down_rad,
                elbow_rad,
                // VRM's nodes must be in the pose of the skin.
                posed_rad: match dialect {
                    Dialect::Vrm0 | Dialect::Vrm1 => 0.0,
                    _ => 0.3 * (k % 2) as f64,
                },
                ..Avatar::new(dialect)
            });
        }
    }
    list
}

#[test]
fn our_pose_moves_their_hands_where_kinematics_says() {
    let zero = zero_frames();
    for avatar in variants() {
        let file = make(&avatar);
        let imported = import(&file);
        let figure = &imported.figure;
        let stature = figure.skeleton.stature_m();
        assert!((stature - 1.7).abs() < 1e-3, "{avatar:?}: {stature}");
        let rest = posed(figure, 0, &Pose::zero());
        let pose = pose();
        let points = posed(figure, 0, &pose);
        for (side, letter) in [("left", 'l'), ("right", 'r')] {
            let bone = |part: &str| Bone::from_name(&format!("{letter}_{part}")).expect("a bone");
            let shoulder = seen(&file, &rest, &format!("{side}UpperArm"));
            let (s, e) = (bone("shoulder").index(), bone("elbow").index());
            let upper = zero[s] * pose.rotation(bone("shoulder"));
            let lower = upper * (zero[s].inverse() * zero[e]) * pose.rotation(bone("elbow"));
            let elbow = shoulder + upper * DVec3::X * UPPER_ARM_M;
            let wrist = elbow + lower * DVec3::X * FOREARM_M;
            for (part, wanted) in [("UpperArm", shoulder), ("LowerArm", elbow), ("Hand", wrist)] {
                let got = seen(&file, &points, &format!("{side}{part}"));
                let off = got.distance(wanted);
                assert!(off < 1e-3, "{avatar:?} {side}{part}: {off} m");
            }
        }
    }
}

#[test]
fn every_rest_pose_gives_the_same_performance() {
    let wanted: Vec<DVec3> = {
        let file = make(&Avatar::new(Dialect::Mixamo));
        posed(&import(&file).figure, 0, &pose())
    };
    let reference = make(&Avatar::new(Dialect::Mixamo));
    for avatar in variants() {
        let file = make(&avatar);
        let points = posed(&import(&file).figure, 0, &pose());
        for part in reference.parts.iter().filter(|p| !p.contains("Thumb")) {
            let off = seen(&file, &points, part).distance(seen(&reference, &wanted, part));
            assert!(off < 2e-3, "{avatar:?} {part}: {off} m");
        }
    }
}

#[test]
fn the_rest_pose_is_kept_in_the_bind() {
    for avatar in variants() {
        let figure = import(&make(&avatar)).figure;
        for mesh in &figure.meshes {
            for (weights, joints) in mesh.weights.iter().zip(&mesh.joints) {
                assert!(
                    (weights.iter().sum::<f32>() - 1.0).abs() < 1e-5,
                    "the weights of a vertex add up to 1"
                );
                assert!(
                    joints
                        .iter()
                        .all(|j| usize::from(*j) < figure.inverse_bind.len()),
                    "every vertex joint exists"
                );
            }
            for n in &mesh.normals {
                let length = DVec3::from_array(n.map(f64::from)).length();
                assert!(
                    (length - 1.0).abs() < 1e-4,
                    "the bone direction has unit length"
                );
            }
        }
        let lowest = figure.meshes[0]
            .positions
            .iter()
            .map(|p| p[1])
            .fold(f32::MAX, f32::min);
        assert!(lowest.abs() < 1e-4, "{lowest}");
        // The nose points to +z, the left hand to +x.
        let toe = figure.meshes[0]
            .positions
            .iter()
            .map(|p| p[2])
            .fold(f32::MIN, f32::max);
        assert!(toe > 0.1, "the nose points to +z");
    }
}

#[test]
fn a_text_file_gives_the_same_figure() {
    let file = make(&Avatar::new(Dialect::ReadyPlayerMe));
    let binary = import(&file).figure;
    let text = import_figure("x", &file.gltf()).expect("a figure").figure;
    assert_eq!(binary.meshes, text.meshes);
}

#[test]
fn what_is_converted_is_read_by_the_player() {
    for dialect in DIALECTS {
        let file = make(&Avatar::new(dialect));
        let direct = import(&file).figure;
        let (glb, _) = convert("x", &file.glb()).expect("a file");
        let again = read_figure("x", &glb).expect("a figure");
        let (a, b) = (posed(&direct, 0, &pose()), posed(&again, 0, &pose()));
        for (a, b) in a.iter().zip(&b) {
            // The file's grid is 0.03 mm.
            assert!(a.distance(*b) < 2e-4, "{dialect:?} {a} {b}");
        }
        assert!(
            open_figure("x", &glb).expect("ours").diagnostics.is_empty(),
            "the converted figure opens without diagnostics"
        );
    }
}

/// Returns the displacement of the face's first vertex by a channel, avatar's frame.
fn moved(figure: &Figure, name: &str) -> Option<DVec3> {
    let target = figure.morph_index(name)?;
    let morph = figure.meshes[1]
        .morphs
        .iter()
        .find(|m| m.target == target)?;
    Some(DVec3::from_array(morph.position_deltas[0].map(f64::from)))
}

fn near(a: Option<DVec3>, b: DVec3) {
    let a = a.expect("a channel");
    assert!(a.distance(b) < 2e-6, "{a} {b}");
}

#[test]
fn arkit_targets_are_taken_as_they_are() {
    let avatar = Avatar {
        morphs: vec![
            "jawOpen",
            "mouthClose",
            "eyeBlink_L",
            "EyeBlinkRight",
            "mouthPucker",
        ],
        ..Avatar::new(Dialect::ReadyPlayerMe)
    };
    let imported = import(&make(&avatar));
    let f = &imported.figure;
    near(moved(f, "jawOpen"), delta(0));
    near(moved(f, "mouthClose"), delta(1) * (0.2 / 0.35));
    near(moved(f, "eyeBlinkLeft"), delta(2));
    near(moved(f, "eyeBlinkRight"), delta(3));
    near(moved(f, "mouthPucker"), delta(4));
    let codes: Vec<_> = imported.diagnostics.iter().map(|d| d.code).collect();
    assert!(codes.is_empty(), "{codes:?}");
}

#[test]
fn visemes_are_composed() {
    let avatar = Avatar {
        morphs: vec![
            "viseme_sil",
            "viseme_aa",
            "viseme_U",
            "viseme_PP",
            "mouthSmile",
        ],
        units_per_metre: 100.0,
        armature_scaled: true,
        ..Avatar::new(Dialect::Mixamo)
    };
    let imported = import(&make(&avatar));
    let f = &imported.figure;
    // The widest vowel is a jaw of 0.245 rad, at which `jawOpen` is 0.7.
    near(moved(f, "jawOpen").map(|d| d * 0.7), delta(1));
    near(moved(f, "mouthPucker"), delta(2) * 0.9 - delta(1) * 0.2);
    near(moved(f, "mouthPressLeft"), delta(3) * 1.2);
    near(moved(f, "mouthSmileRight"), delta(4) * 0.5);
    // Lips closed over the jaw of that vowel end at their initial position: 0.7 of one target, and
    // the weight that 0.245 rad requires of the other.
    let closed = moved(f, "jawOpen").zip(moved(f, "mouthClose"));
    near(
        closed.map(|(jaw, close)| jaw * 0.7 + close * (0.245 / 0.2) + delta(1)),
        delta(1),
    );
    assert!(
        imported
            .diagnostics
            .iter()
            .any(|d| d.code == "mouth-by-visemes"),
        "the diagnostics report the mouth by visemes"
    );
    assert!(
        imported.diagnostics.iter().any(|d| d.code == "lids-still"),
        "the diagnostics report lids that do not move"
    );
}

#[test]
fn vrm_expressions_speak_and_blink() {
    for (dialect, names) in [
        (Dialect::Vrm0, ["a", "u", "blink"]),
        (Dialect::Vrm1, ["aa", "ou", "blink"]),
    ] {
        let avatar = Avatar {
            morphs: vec!["shape.one", "shape.two", "shape.three"],
            expressions: vec![(names[0], 2), (names[1], 1), (names[2], 0)],
            yaw_rad: core::f64::consts::PI,
            ..Avatar::new(dialect)
        };
        let imported = import(&make(&avatar));
        let f = &imported.figure;
        near(moved(f, "jawOpen").map(|d| d * 0.7), delta(2));
        near(moved(f, "eyeBlinkLeft"), delta(0) * 0.5);
        near(moved(f, "mouthPucker"), delta(1) * 0.9 - delta(2) * 0.2);
    }
}

#[test]
fn a_sad_expression_lends_its_mouth_to_frowns() {
    let avatar = Avatar {
        morphs: vec!["shape.one", "shape.two"],
        expressions: vec![("aa", 0), ("sad", 1)],
        ..Avatar::new(Dialect::Vrm1)
    };
    let figure = import(&make(&avatar)).figure;
    for name in ["mouthFrownLeft", "mouthFrownRight"] {
        near(moved(&figure, name), delta(1) * 0.35);
    }
    assert_eq!(figure.morph_index("mouthSmileLeft"), None);
}

#[test]
fn a_face_without_targets_is_told() {
    let imported = import(&make(&Avatar::new(Dialect::Vrm1)));
    let d = imported
        .diagnostics
        .iter()
        .find(|d| d.code == "mouth-still");
    assert!(
        d.is_some_and(|d| d.message.contains("does not move")),
        "the diagnostic names the face that does not move"
    );
}

#[test]
fn compression_and_other_files_are_refused_by_name() {
    let whole = make(&Avatar::new(Dialect::Mixamo));
    for name in ["KHR_draco_mesh_compression", "KHR_texture_basisu"] {
        let mut file = make(&Avatar::new(Dialect::Mixamo));
        file.json["extensionsRequired"] = serde_json::json!([name]);
        let fault = open_figure("x", &file.glb())
            .expect_err("a refusal")
            .to_string();
        assert!(fault.contains(name) && fault.contains("export"), "{fault}");
    }
    let mut file = make(&Avatar::new(Dialect::Mixamo));
    file.json["images"] = serde_json::json!([{ "uri": "skin.png" }]);
    let fault = open_figure("x", &file.glb())
        .expect_err("a refusal")
        .to_string();
    assert!(fault.contains("skin.png"), "{fault}");
    let mut json = whole.json.clone();
    json["buffers"] = serde_json::json!([{ "byteLength": 4_294_967_295u32 }]);
    let huge = crate::made::pack(json.to_string().as_bytes(), &whole.bin);
    assert!(
        matches!(
            open_figure("x", &huge),
            Err(ImportError::Read(ReadError::Truncated { .. }))
        ),
        "a length beyond the file is rejected"
    );
}

#[test]
fn what_is_no_human_is_said_so() {
    let mut file = make(&Avatar::new(Dialect::Mixamo));
    file.json["nodes"][2]["name"] = serde_json::json!("Root");
    for node in file.json["nodes"].as_array_mut().expect("nodes") {
        if node["name"].as_str().is_some_and(|n| n.ends_with("Head")) {
            node["name"] = serde_json::json!("Snout");
        }
        if node["name"].as_str().is_some_and(|n| n.ends_with("Neck")) {
            node["name"] = serde_json::json!("Mane");
        }
    }
    let fault = open_figure("x", &file.glb())
        .expect_err("no human")
        .to_string();
    assert!(fault.contains("head"), "{fault}");
}
