//! Mapping from imported names to bones.
//!
//! One grammar covers VRM's humanoid names, Mixamo, Ready Player Me, Blender's rigs, Biped, Unreal,
//! Daz and similar conventions: it splits a name into words, removes meaningless words and the word
//! of the side, and looks up the rest.

use raconteur_base::Side;

use raconteur_body::skeleton::Bone;

/// Role in a humanoid skeleton that a node name indicates.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum NodeRole {
    /// A bone that has one joint.
    Bone(Bone),
    /// Joint of the spine between hips and neck.
    Torso,
    /// Finger joint: the name of the finger's first bone, and the index in the chain.
    Finger(Bone, u32),
    /// An eyeball.
    Eye(Side),
    /// Joint of an arm, from the upper arm on.
    Arm(Side),
    /// Joint of a leg, from the hip on.
    Leg(Side),
}

/// Words that carry no information about the part.
const NOISE: [&str; 27] = [
    "mixamorig",
    "armature",
    "skeleton",
    "character",
    "j",
    "c",
    "b",
    "bip",
    "biped",
    "valve",
    "def",
    "org",
    "cc",
    "base",
    "rig",
    "bone",
    "jnt",
    "bind",
    "skin",
    "human",
    "humanoid",
    "avatar",
    "sk",
    "genesis",
    "root",
    "jt",
    "fk",
];

/// Parts with a side: words without the side, and the bone on the left.
const SIDED: [(&[&str], Bone); 8] = [
    (
        &["shoulder", "clavicle", "collar", "collarbone", "scapula"],
        Bone::LScapula,
    ),
    (
        &["upperarm", "arm", "uparm", "shldr", "armupper", "shldrbend"],
        Bone::LShoulder,
    ),
    (
        &[
            "forearm",
            "lowerarm",
            "elbow",
            "lowarm",
            "armlower",
            "forearmbend",
        ],
        Bone::LElbow,
    ),
    (&["hand", "wrist"], Bone::LWrist),
    (
        &["upleg", "upperleg", "thigh", "hip", "legupper", "thighbend"],
        Bone::LHip,
    ),
    (
        &[
            "leg", "lowerleg", "calf", "shin", "knee", "lowleg", "leglower",
        ],
        Bone::LKnee,
    ),
    (&["foot", "ankle"], Bone::LSubtalar),
    (&["toe", "toes", "ball"], Bone::LMetatarsal),
];

/// Fingers by their words, with their first bone on the left.
const FINGERS: [(&[&str], Bone); 5] = [
    (&["thumb"], Bone::LThumb0),
    (&["index", "pointer"], Bone::LIndex0),
    (&["middle", "mid"], Bone::LMiddle0),
    (&["ring"], Bone::LRing0),
    (&["pinky", "pinkie", "little"], Bone::LPinky0),
];

fn on(side: Side, left: Bone) -> Bone {
    if side == Side::Left {
        left
    } else {
        left.mirrored()
    }
}

/// Splits a name into lower-case words: at signs, between letters and digits, and before capitals.
fn words(name: &str) -> Vec<String> {
    let own = name.rsplit([':', '|']).next().unwrap_or(name);
    let chars: Vec<char> = own.chars().take(120).collect();
    let mut words: Vec<String> = vec![String::new()];
    for (i, &c) in chars.iter().enumerate() {
        if !c.is_alphanumeric() {
            words.push(String::new());
            continue;
        }
        let before = i.checked_sub(1).map(|k| chars[k]);
        let next_is_lower = chars.get(i + 1).is_some_and(|n| n.is_lowercase());
        let cut = before.is_some_and(|b| {
            b.is_ascii_digit() != c.is_ascii_digit()
                || (c.is_uppercase() && (b.is_lowercase() || (b.is_uppercase() && next_is_lower)))
        });
        if cut {
            words.push(String::new());
        }
        if let Some(word) = words.last_mut() {
            word.extend(c.to_lowercase());
        }
    }
    words.retain(|w| !w.is_empty());
    words
}

fn side_of(word: &str) -> Option<Side> {
    match word {
        "l" | "left" | "lft" | "lf" => Some(Side::Left),
        "r" | "right" | "rgt" | "rt" => Some(Side::Right),
        _ => None,
    }
}

/// A name without noise and side.
struct ParsedName {
    side: Option<Side>,
    /// Joined words without the last number.
    stem: String,
    /// Digits of the number in the name, as written.
    digits: Option<String>,
}

fn is_number(word: &str) -> bool {
    word.bytes().all(|b| b.is_ascii_digit())
}

/// Removes side and noise from a name's words.
fn bare(mut words: Vec<String>) -> (Option<Side>, Vec<String>) {
    // A rig's number belongs to its own name: "Bip001 Head", "mixamorig9_Hips".
    let rig = words.iter().take_while(|w| NOISE.contains(&w.as_str()));
    let number_at = rig.count();
    if number_at > 0 && words.len() > number_at + 1 && is_number(&words[number_at]) {
        words.remove(number_at);
    }
    // "Leftarm" in one word.
    for (prefix, letter) in [("left", "l"), ("right", "r")] {
        if let Some(w) = words
            .iter_mut()
            .find(|w| w.len() > prefix.len() && w.starts_with(prefix))
        {
            *w = w[prefix.len()..].to_owned();
            words.insert(0, letter.to_owned());
        }
    }
    let side_at = words.iter().position(|w| side_of(w).is_some());
    let side = side_at.and_then(|i| side_of(&words.remove(i)));
    words.retain(|w| !NOISE.contains(&w.as_str()));
    (side, words)
}

fn parsed(side: Option<Side>, words: &[String]) -> ParsedName {
    let (digits, stem) = match words.split_last() {
        Some((last, stem)) if is_number(last) => (Some(last.clone()), stem),
        _ => (None, words),
    };
    ParsedName {
        side,
        stem: stem.concat(),
        digits,
    }
}

fn finger(side: Side, stem: &str, digits: Option<&str>) -> Option<NodeRole> {
    let number = digits.and_then(|d| d.parse::<u32>().ok());
    // MakeHuman counts both from one, the thumb first: finger1-1 to finger5-3.
    if let Some([which @ b'1'..=b'5']) = stem.strip_prefix("finger").map(str::as_bytes) {
        let (_, first) = FINGERS.get(usize::from(which - b'1'))?;
        let joint = number.filter(|n| (1..=4).contains(n))?;
        return Some(NodeRole::Finger(on(side, *first), joint));
    }
    // Biped counts fingers from the thumb and joints after it: Finger0, Finger01, Finger02.
    if stem == "finger" {
        let d = digits?.as_bytes();
        let (which, joint) = match d {
            [f] => (f - b'0', 0),
            [f, j] => (f - b'0', u32::from(j - b'0')),
            _ => return None,
        };
        let (_, first) = FINGERS.get(usize::from(which))?;
        return Some(NodeRole::Finger(on(side, *first), joint));
    }
    let (rest, first) = FINGERS.iter().find_map(|(names, first)| {
        let name = names.iter().find(|n| stem.contains(**n))?;
        Some((stem.replacen(name, "", 1), *first))
    })?;
    let rest = rest.replace("hand", "").replace("finger", "");
    let order = match (rest.as_str(), number) {
        ("" | "f", n) => n.unwrap_or(0),
        // The palm's own bones carry no finger, but the thumb's is its first joint.
        ("metacarpal", _) if first == Bone::LThumb0 => 0,
        ("proximal", _) => 1,
        ("intermediate" | "middle" | "medial", _) => 2,
        ("distal", _) => 3,
        _ => return None,
    };
    // Larger numbers are a list's, not a finger's.
    (order <= 4).then_some(NodeRole::Finger(on(side, first), order))
}

/// Recognises limbs with numbered joints, as in Khronos' sample figures, whose numbers ascend or
/// descend: the tree determines their order.
fn numbered(p: &ParsedName) -> Option<NodeRole> {
    match (p.side, p.stem.as_str(), p.digits.as_deref()) {
        (Some(side), "armjoint", _) => Some(NodeRole::Arm(side)),
        (Some(side), "legjoint", _) => Some(NodeRole::Leg(side)),
        (None, "torsojoint", Some("1")) => Some(NodeRole::Bone(Bone::Sacroiliac)),
        (None, "neckjoint", Some("1")) => Some(NodeRole::Bone(Bone::Cervical)),
        (None, "neckjoint", Some("2")) => Some(NodeRole::Bone(Bone::Skull)),
        _ => None,
    }
}

fn part(p: &ParsedName) -> Option<NodeRole> {
    let stem = p.stem.as_str();
    let digits = p.digits.as_deref();
    if let Some(side) = p.side {
        if let Some(slot) = finger(side, stem, digits) {
            return Some(slot);
        }
        if digits.is_some() {
            return None;
        }
        if matches!(stem, "eye" | "eyeball") {
            return Some(NodeRole::Eye(side));
        }
        return SIDED
            .iter()
            .find(|(names, _)| names.contains(&stem))
            .map(|(_, bone)| NodeRole::Bone(on(side, *bone)));
    }
    match (stem, digits) {
        ("hips" | "hip" | "pelvis", None) => Some(NodeRole::Bone(Bone::Sacroiliac)),
        ("spine" | "chest", _) | ("upperchest" | "abdomen" | "torso", None) => {
            Some(NodeRole::Torso)
        }
        ("neck", None) => Some(NodeRole::Bone(Bone::Cervical)),
        ("head", None) => Some(NodeRole::Bone(Bone::Skull)),
        ("jaw" | "lowerjaw" | "chin", None) => Some(NodeRole::Bone(Bone::Chin)),
        _ => None,
    }
}

/// Returns the role of a name, and a penalty for the quality of the match: lower is better.
pub(super) fn slot_of(name: &str) -> Option<(NodeRole, u8)> {
    let (side, mut words) = bare(words(name));
    let whole = parsed(side, &words);
    if let Some(slot) = part(&whole) {
        return Some((slot, 0));
    }
    if let Some(slot) = numbered(&whole) {
        return Some((slot, 1));
    }
    // Some sites number every node: "LeftHand_011".
    if whole.digits.is_some() {
        words.pop();
    }
    words.retain(|w| w != "joint");
    part(&parsed(side, &words)).map(|slot| (slot, 2))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_usual_rigs_are_understood() {
        for (name, bone) in [
            ("mixamorig:Hips", Bone::Sacroiliac),
            ("mixamorigLeftForeArm", Bone::LElbow),
            ("mixamorig:RightUpLeg", Bone::RHip),
            ("LeftArm", Bone::LShoulder),
            ("LeftShoulder", Bone::LScapula),
            ("RightLeg", Bone::RKnee),
            ("LeftToeBase", Bone::LMetatarsal),
            ("leftUpperArm", Bone::LShoulder),
            ("rightLowerLeg", Bone::RKnee),
            ("J_Bip_L_UpperArm", Bone::LShoulder),
            ("J_Bip_C_Head", Bone::Skull),
            ("Bip01 L UpperArm", Bone::LShoulder),
            ("Bip001 R Calf", Bone::RKnee),
            ("Bip01 Pelvis", Bone::Sacroiliac),
            ("upper_arm.L", Bone::LShoulder),
            ("DEF-shin.R", Bone::RKnee),
            ("clavicle_l", Bone::LScapula),
            ("lShldr", Bone::LShoulder),
            ("CC_Base_L_Upperarm", Bone::LShoulder),
            ("ValveBiped.Bip01_R_Hand", Bone::RWrist),
            ("b_LeftHand_011", Bone::LWrist),
            ("upperarm01.L", Bone::LShoulder),
            ("neck_01", Bone::Cervical),
            ("Skeleton_torso_joint_1", Bone::Sacroiliac),
            ("Skeleton_neck_joint_2", Bone::Skull),
        ] {
            let slot = slot_of(name).map(|s| s.0);
            assert_eq!(slot, Some(NodeRole::Bone(bone)), "{name}");
        }
        for (name, bone, order) in [
            ("mixamorig:LeftHandIndex1", Bone::LIndex0, 1),
            ("RightHandThumb3", Bone::RThumb0, 3),
            ("leftThumbMetacarpal", Bone::LThumb0, 0),
            ("rightLittleIntermediate", Bone::RPinky0, 2),
            ("J_Bip_R_Little3", Bone::RPinky0, 3),
            ("Bip01 L Finger0", Bone::LThumb0, 0),
            ("Bip01 L Finger12", Bone::LIndex0, 2),
            ("f_ring.02.R", Bone::RRing0, 2),
            ("thumb_01_l", Bone::LThumb0, 1),
            ("lMid2", Bone::LMiddle0, 2),
            ("Index.L", Bone::LIndex0, 0),
            ("finger1-1.L", Bone::LThumb0, 1),
            ("finger3-2.R", Bone::RMiddle0, 2),
            ("finger5-3.L", Bone::LPinky0, 3),
            ("mixamorig1LeftHandIndex1", Bone::LIndex0, 1),
            ("mixamorig9_RightHandThumb3", Bone::RThumb0, 3),
        ] {
            let slot = slot_of(name).map(|s| s.0);
            assert_eq!(slot, Some(NodeRole::Finger(bone, order)), "{name}");
        }
        assert_eq!(
            slot_of("LeftEye").map(|s| s.0),
            Some(NodeRole::Eye(Side::Left))
        );
        for (name, slot) in [
            ("Skeleton_arm_joint_L__4_", NodeRole::Arm(Side::Left)),
            ("Skeleton_arm_joint_R", NodeRole::Arm(Side::Right)),
            ("leg_joint_R_3", NodeRole::Leg(Side::Right)),
        ] {
            assert_eq!(slot_of(name).map(|s| s.0), Some(slot), "{name}");
        }
        assert_eq!(slot_of("Spine02").map(|s| s.0), Some(NodeRole::Torso));
    }

    #[test]
    fn what_is_no_part_stays_unknown() {
        for name in [
            "",
            "LeftForeArmTwist",
            "earring.L",
            "HeadTop_End",
            "hair_01",
            "skirt_L_2",
            "index_metacarpal_l",
            "Camera",
            "Ÿ•",
            "L",
            "tail3",
            "thigh_twist_01_l",
            "finger6-1.L",
            "mixamorig1",
        ] {
            assert_eq!(slot_of(name), None, "{name}");
        }
    }
}
