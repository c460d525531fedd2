//! Names of the same bones in different programs.

use serde_json::json;

use crate::made::{Avatar, Dialect, File, make};
use crate::performs::{import, pose, posed};

fn renamed(rename: impl Fn(&str) -> String) -> File {
    let mut file = make(&Avatar::new(Dialect::Mixamo));
    for node in file.json["nodes"].as_array_mut().expect("nodes") {
        node["name"] = json!(rename(node["name"].as_str().expect("a name")));
    }
    file
}

/// The name of MakeHuman's default rig for one of Mixamo's.
fn makehuman(name: &str) -> String {
    let Some(name) = name.strip_prefix("mixamorig:") else {
        return name.to_owned();
    };
    let (side, part) = match (name.strip_prefix("Left"), name.strip_prefix("Right")) {
        (Some(part), _) => (".L", part),
        (_, Some(part)) => (".R", part),
        _ => ("", name),
    };
    let fingers = ["Thumb", "Index", "Middle", "Ring", "Pinky"];
    let finger = fingers.iter().position(|f| part.contains(f));
    let bone = match (finger, part) {
        (Some(i), _) => format!("finger{}-{}", i + 1, &part[part.len() - 1..]),
        (_, "Hips") => "root".to_owned(),
        (_, "Spine") => "spine05".to_owned(),
        (_, "Spine1") => "spine02".to_owned(),
        (_, "Neck") => "neck01".to_owned(),
        (_, "Shoulder") => "clavicle".to_owned(),
        (_, "Arm") => "upperarm01".to_owned(),
        (_, "ForeArm") => "lowerarm01".to_owned(),
        (_, "Hand") => "wrist".to_owned(),
        (_, "UpLeg") => "upperleg01".to_owned(),
        (_, "Leg") => "lowerleg01".to_owned(),
        (_, "ToeBase") => "toe1-1".to_owned(),
        (_, other) => other.to_lowercase(),
    };
    bone + side
}

#[test]
fn a_rig_performs_alike_by_any_of_its_names() {
    let reference = renamed(str::to_owned);
    let reference = import(&reference);
    let wanted = posed(&reference.figure, 0, &pose());
    let renames: [fn(&str) -> String; 5] = [
        |name| name.replace("mixamorig:", "mixamorig1:"),
        |name| name.replace("mixamorig:", "mixamorig1"),
        |name| name.replace("mixamorig:", "mixamorig9_"),
        |name| name.replace("mixamorig:", "Armature_mixamorig12_"),
        makehuman,
    ];
    for (i, rename) in renames.into_iter().enumerate() {
        let imported = import(&renamed(rename));
        assert_eq!(imported.diagnostics, reference.diagnostics, "{i}");
        let points = posed(&imported.figure, 0, &pose());
        let off = points.iter().zip(&wanted).map(|(a, b)| a.distance(*b));
        let off = off.fold(0.0, f64::max);
        assert!(off < 1e-9, "{i}: {off} m");
    }
}
