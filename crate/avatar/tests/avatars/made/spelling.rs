//! Names of body parts in each dialect.

use super::Dialect;

/// A part's name in a dialect.
pub(super) fn spelled(dialect: Dialect, part: &str, index: usize) -> String {
    let bare = part.strip_prefix("left").or(part.strip_prefix("right"));
    let left = part.starts_with("left");
    let Some(bare) = bare else {
        let word = match (dialect, part) {
            (Dialect::Vrm0 | Dialect::Vrm1, _) => return format!("node{index}"),
            (Dialect::Blender, p) => return p.to_owned(),
            (_, "hips") => "Hips",
            (_, "spine") => "Spine",
            (_, "chest") => "Spine1",
            (_, "neck") => "Neck",
            _ => "Head",
        };
        return if dialect == Dialect::Mixamo {
            format!("mixamorig:{word}")
        } else {
            word.to_owned()
        };
    };
    let finger = ["Thumb", "Index", "Middle", "Ring", "Little"]
        .iter()
        .find(|f| bare.starts_with(**f));
    let phalanx = ["Proximal", "Intermediate", "Distal"]
        .iter()
        .position(|p| bare.ends_with(p))
        .map_or(0, |i| i + 1);
    match dialect {
        Dialect::Vrm0 | Dialect::Vrm1 => format!("node{index}"),
        Dialect::Blender => {
            let word = match (bare, finger) {
                (_, Some(f)) => format!(
                    "f_{}.0{phalanx}",
                    f.replace("Little", "pinky").to_lowercase()
                ),
                ("UpperArm", _) => "upper_arm".to_owned(),
                ("LowerArm", _) => "forearm".to_owned(),
                ("UpperLeg", _) => "thigh".to_owned(),
                ("LowerLeg", _) => "shin".to_owned(),
                ("Toes", _) => "toe".to_owned(),
                (other, _) => other.to_lowercase(),
            };
            format!("{word}.{}", if left { 'L' } else { 'R' })
        }
        Dialect::Mixamo | Dialect::ReadyPlayerMe => {
            let word = match (bare, finger) {
                (_, Some(f)) => format!("Hand{}{phalanx}", f.replace("Little", "Pinky")),
                ("UpperArm", _) => "Arm".to_owned(),
                ("LowerArm", _) => "ForeArm".to_owned(),
                ("UpperLeg", _) => "UpLeg".to_owned(),
                ("LowerLeg", _) => "Leg".to_owned(),
                ("Toes", _) => "ToeBase".to_owned(),
                (other, _) => other.to_owned(),
            };
            let prefix = if dialect == Dialect::Mixamo {
                "mixamorig:"
            } else {
                ""
            };
            format!("{prefix}{}{word}", if left { "Left" } else { "Right" })
        }
    }
}
