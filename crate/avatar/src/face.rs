//! The face's channels from whatever morph targets a figure has.
//!
//! The actor moves targets of ARKit's names. A figure that has those is driven by them; for
//! one that has visemes (Oculus' fifteen) or VRM's vowels, the same channels are made as
//! sums of its targets, so that no later stage needs to know.

use std::collections::BTreeMap;

use serde_json::Value;

use super::error::Notes;
use raconteur_body::figure::{JAW_OPEN_RAD, MOUTH_CLOSE_RAD};
use raconteur_body::read::document::Document;

/// One target of one mesh and how much of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct WeightedTarget {
    pub(super) mesh: usize,
    pub(super) target: usize,
    pub(super) factor: f64,
}

/// Which vertices a channel may move.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Region {
    Everywhere,
    /// Where the mouth's own targets move something: an expression's smile without its eyes.
    Mouth,
    /// Where neither mouth nor lids move: an expression's brows.
    Brows,
}

/// A morph target that the figure will have.
pub(super) struct Channel {
    pub(super) name: &'static str,
    pub(super) parts: Vec<WeightedTarget>,
    pub(super) region: Region,
}

/// The face of a file.
pub(super) struct Face {
    pub(super) channels: Vec<Channel>,
    /// Targets that speech moves, and those that close the lids.
    pub(super) mouth: Vec<WeightedTarget>,
    pub(super) lids: Vec<WeightedTarget>,
    /// Whether targets open the mouth; if not, a jaw bone may.
    pub(super) opens_by_morph: bool,
}

type Sources = BTreeMap<&'static str, Vec<WeightedTarget>>;

/// Sources beside ARKit's: Oculus' visemes, and expressions. Names that files use for each,
/// letters only, lower case.
const OTHERS: [(&str, &[&str]); 15] = [
    (
        "aa",
        &["visemeaa", "vrcvaa", "vaa", "aa", "a", "あ", "fclmtha"],
    ),
    ("E", &["visemee", "vrcve", "ee", "e", "え", "fclmthe"]),
    (
        "I",
        &["visemei", "visemeih", "vrcvih", "ih", "i", "い", "fclmthi"],
    ),
    (
        "O",
        &["visemeo", "visemeoh", "vrcvoh", "oh", "o", "お", "fclmtho"],
    ),
    (
        "U",
        &["visemeu", "visemeou", "vrcvou", "ou", "u", "う", "fclmthu"],
    ),
    ("PP", &["visemepp", "vrcvpp"]),
    ("FF", &["visemeff", "vrcvff"]),
    ("TH", &["visemeth", "vrcvth"]),
    ("mouthOpen", &["mouthopen"]),
    ("mouthSmile", &["mouthsmile", "smile"]),
    (
        "blink",
        &[
            "blink",
            "eyesclosed",
            "eyesclose",
            "eyeblink",
            "まばたき",
            "fcleyeclose",
        ],
    ),
    ("happy", &["happy", "joy", "fun"]),
    ("surprised", &["surprised"]),
    ("angry", &["angry"]),
    ("sad", &["sad", "sorrow"]),
];

/// A sum of sources.
type Sum = &'static [(&'static str, f64)];

/// An opening of the mouth reaches the actor's widest vowel (0.245 rad of jaw) with the whole
/// of a viseme.
const WIDEST: f64 = JAW_OPEN_RAD / 0.245;
/// What closes the lips again over that viseme.
const UNWIDEN: f64 = -MOUTH_CLOSE_RAD / 0.245;
/// What closes the lips over ARKit's jaw, whose `mouthClose` goes with `jawOpen`.
const OVER_JAW: f64 = MOUTH_CLOSE_RAD / JAW_OPEN_RAD;

/// A channel, the ways to make it (the first that the file can is taken; a channel that the
/// file has is taken as it is) and the region of the last of them. Factors are designed: a
/// viseme holds the opening of its vowel, which the jaw channel adds already and which is
/// taken off again.
const RECIPES: [(&str, &[Sum], Region); 52] = [
    (
        "jawOpen",
        &[&[("aa", WIDEST)], &[("mouthOpen", WIDEST)]],
        Region::Everywhere,
    ),
    ("jawForward", &[], Region::Everywhere),
    ("jawLeft", &[], Region::Everywhere),
    ("jawRight", &[], Region::Everywhere),
    (
        "mouthClose",
        &[
            &[("jawOpen", -OVER_JAW)],
            &[("aa", UNWIDEN)],
            &[("mouthOpen", UNWIDEN)],
        ],
        Region::Everywhere,
    ),
    (
        "mouthPucker",
        &[&[("U", 0.9), ("aa", -0.2)]],
        Region::Everywhere,
    ),
    (
        "mouthFunnel",
        &[&[("O", 0.9), ("aa", -0.35)]],
        Region::Everywhere,
    ),
    (
        "mouthStretchLeft",
        &[&[("I", 0.8), ("aa", -0.15)], &[("E", 0.8), ("aa", -0.15)]],
        Region::Everywhere,
    ),
    (
        "mouthStretchRight",
        &[&[("I", 0.8), ("aa", -0.15)], &[("E", 0.8), ("aa", -0.15)]],
        Region::Everywhere,
    ),
    ("mouthPressLeft", &[&[("PP", 1.2)]], Region::Everywhere),
    ("mouthPressRight", &[&[("PP", 1.2)]], Region::Everywhere),
    ("mouthRollLower", &[&[("FF", 1.2)]], Region::Everywhere),
    ("mouthRollUpper", &[], Region::Everywhere),
    ("mouthShrugLower", &[], Region::Everywhere),
    ("mouthShrugUpper", &[], Region::Everywhere),
    ("mouthLeft", &[], Region::Everywhere),
    ("mouthRight", &[], Region::Everywhere),
    ("mouthDimpleLeft", &[], Region::Everywhere),
    ("mouthDimpleRight", &[], Region::Everywhere),
    ("mouthLowerDownLeft", &[], Region::Everywhere),
    ("mouthLowerDownRight", &[], Region::Everywhere),
    ("mouthUpperUpLeft", &[], Region::Everywhere),
    ("mouthUpperUpRight", &[], Region::Everywhere),
    (
        "mouthSmileLeft",
        &[&[("mouthSmile", 0.5)], &[("happy", 0.35)]],
        Region::Mouth,
    ),
    (
        "mouthSmileRight",
        &[&[("mouthSmile", 0.5)], &[("happy", 0.35)]],
        Region::Mouth,
    ),
    ("mouthFrownLeft", &[&[("sad", 0.35)]], Region::Mouth),
    ("mouthFrownRight", &[&[("sad", 0.35)]], Region::Mouth),
    ("tongueOut", &[&[("TH", 0.6)]], Region::Everywhere),
    ("browInnerUp", &[&[("surprised", 0.6)]], Region::Brows),
    ("browOuterUpLeft", &[], Region::Everywhere),
    ("browOuterUpRight", &[], Region::Everywhere),
    ("browDownLeft", &[&[("angry", 0.5)]], Region::Brows),
    ("browDownRight", &[&[("angry", 0.5)]], Region::Brows),
    ("noseSneerLeft", &[], Region::Everywhere),
    ("noseSneerRight", &[], Region::Everywhere),
    ("cheekPuff", &[], Region::Everywhere),
    ("cheekSquintLeft", &[], Region::Everywhere),
    ("cheekSquintRight", &[], Region::Everywhere),
    ("eyeSquintLeft", &[], Region::Everywhere),
    ("eyeSquintRight", &[], Region::Everywhere),
    ("eyeWideLeft", &[], Region::Everywhere),
    ("eyeWideRight", &[], Region::Everywhere),
    ("eyeBlinkLeft", &[&[("blink", 0.5)]], Region::Everywhere),
    ("eyeBlinkRight", &[&[("blink", 0.5)]], Region::Everywhere),
    ("eyeLookUpLeft", &[], Region::Everywhere),
    ("eyeLookUpRight", &[], Region::Everywhere),
    ("eyeLookDownLeft", &[], Region::Everywhere),
    ("eyeLookDownRight", &[], Region::Everywhere),
    ("eyeLookInLeft", &[], Region::Everywhere),
    ("eyeLookInRight", &[], Region::Everywhere),
    ("eyeLookOutLeft", &[], Region::Everywhere),
    ("eyeLookOutRight", &[], Region::Everywhere),
];

/// Letters of a name, lower case.
fn letters(name: &str) -> String {
    name.chars()
        .filter(|c| c.is_alphabetic())
        .flat_map(char::to_lowercase)
        .collect()
}

/// The source that a target's or an expression's name means.
fn recognise(name: &str) -> Option<&'static str> {
    let name: String = name.chars().take(120).collect();
    let spelled = match name.char_indices().next_back() {
        Some((i, side @ ('L' | 'R' | 'l' | 'r'))) if name[..i].ends_with(['_', '.', '-', ' ']) => {
            let side = if side.eq_ignore_ascii_case(&'l') {
                "left"
            } else {
                "right"
            };
            format!("{}{side}", &name[..i])
        }
        _ => name,
    };
    let whole = letters(&spelled);
    let last = letters(spelled.rsplit(['.', ':', '/']).next().unwrap_or_default());
    // VRM 0.x, and exporters that number or prefix.
    let alias = match last.as_str() {
        "blinkleft" => "eyeblinkleft",
        "blinkright" => "eyeblinkright",
        other => other,
    };
    RECIPES
        .into_iter()
        .map(|r| r.0)
        .find(|canonical| {
            let canonical = canonical.to_lowercase();
            alias == canonical || whole.ends_with(&canonical)
        })
        .or_else(|| {
            OTHERS
                .iter()
                .find(|(_, names)| {
                    names.contains(&last.as_str()) || names.contains(&whole.as_str())
                })
                .map(|(key, _)| *key)
        })
}

impl Face {
    /// Finds the face; `has_jaw` and `has_eyes` tell of bones.
    pub(super) fn find(
        json: &Value,
        root: &Document<'_>,
        has_jaw: bool,
        has_eyes: bool,
        notes: &mut Notes,
    ) -> Self {
        let mut sources = expressions(json, root);
        let mut by_name = Sources::new();
        for (mesh, m) in root.meshes.iter().enumerate() {
            // Some exporters name the targets at the first primitive.
            let other = &json["meshes"][mesh]["primitives"][0]["extras"]["targetNames"];
            let other = other.as_array().map_or(&[][..], Vec::as_slice);
            let names = m.target_names.iter().map(String::as_str);
            let others = other.iter().map(|n| n.as_str().unwrap_or_default());
            for (target, name) in names.chain(others.skip(m.target_names.len())).enumerate() {
                if let Some(key) = recognise(name) {
                    by_name.entry(key).or_default().push(WeightedTarget {
                        mesh,
                        target,
                        factor: 1.0,
                    });
                }
            }
        }
        for (key, parts) in by_name {
            sources.entry(key).or_insert(parts);
        }
        let mut channels = Vec::new();
        for (name, sums, region) in RECIPES.into_iter() {
            // Bones turn the eyes better than targets do.
            if has_eyes && name.starts_with("eyeLook") {
                continue;
            }
            channels.extend(channel(&sources, name, sums, region));
        }
        let parts_of = |keys: &[&str]| -> Vec<WeightedTarget> {
            keys.iter()
                .filter_map(|k| sources.get(k))
                .flatten()
                .copied()
                .collect()
        };
        let has = |name: &str| channels.iter().any(|c| c.name == name);
        let face = Self {
            opens_by_morph: has("jawOpen"),
            mouth: parts_of(&[
                "jawOpen",
                "aa",
                "E",
                "I",
                "O",
                "U",
                "mouthOpen",
                "mouthSmile",
            ]),
            lids: parts_of(&["eyeBlinkLeft", "eyeBlinkRight", "blink"]),
            channels,
        };
        face.report(&sources, has_jaw, has_eyes, notes);
        face
    }

    fn report(&self, sources: &Sources, has_jaw: bool, has_eyes: bool, notes: &mut Notes) {
        let has = |name: &str| self.channels.iter().any(|c| c.name == name);
        if !self.opens_by_morph {
            let hint = "add ARKit's or Oculus' morph targets, or VRM expressions";
            if has_jaw {
                notes.add(
                    "mouth-by-jaw",
                    "speech opens the jaw only; the lips do not move",
                    hint,
                );
            } else {
                notes.add("mouth-still", "the face does not move when it speaks", hint);
            }
        } else if !sources.contains_key("jawOpen") {
            notes.add(
                "mouth-by-visemes",
                "speech is made from visemes; lips move more coarsely than with ARKit's targets",
                "",
            );
        }
        if !has("eyeBlinkLeft") {
            notes.add(
                "lids-still",
                "the eyes do not blink",
                "add eyeBlinkLeft and eyeBlinkRight",
            );
        }
        if !has_eyes && !has("eyeLookUpLeft") && !has("eyeLookOutLeft") {
            notes.add(
                "eyes-still",
                "the eyes do not turn",
                "give the eyes bones of their own",
            );
        }
    }
}

fn channel(sources: &Sources, name: &'static str, sums: &[Sum], region: Region) -> Option<Channel> {
    let scaled = |key: &str, factor: f64| -> Option<Vec<WeightedTarget>> {
        let parts = sources.get(key)?.iter();
        Some(
            parts
                .map(|p| WeightedTarget {
                    factor: p.factor * factor,
                    ..*p
                })
                .collect(),
        )
    };
    if sources.contains_key(name) {
        // ARKit's lips close over its jaw at equal weights; ours at a jaw angle.
        let factor = if name == "mouthClose" { OVER_JAW } else { 1.0 };
        return Some(Channel {
            name,
            parts: scaled(name, factor)?,
            region: Region::Everywhere,
        });
    }
    // The first term must be there; subtracted ones may be missing.
    let sum = sums
        .iter()
        .find(|sum| sum.first().is_some_and(|(k, _)| sources.contains_key(k)))?;
    let parts = sum
        .iter()
        .filter_map(|(k, f)| scaled(k, *f))
        .flatten()
        .collect();
    let whole_face = !matches!(sum[0].0, "happy" | "surprised" | "angry" | "sad");
    Some(Channel {
        name,
        parts,
        region: if whole_face {
            Region::Everywhere
        } else {
            region
        },
    })
}

/// VRM's expressions (1.0) or blend shape groups (0.x) as sources.
fn expressions(json: &Value, root: &Document<'_>) -> Sources {
    let mut sources = Sources::new();
    let number = |v: &Value| v.as_u64().and_then(|n| usize::try_from(n).ok());
    let list = |v: &Value| v.as_array().cloned().unwrap_or_default();
    let mut add = |name: &str, parts: Vec<WeightedTarget>| {
        if let Some(key) = recognise_expression(name).filter(|_| !parts.is_empty()) {
            sources.entry(key).or_insert(parts);
        }
    };
    let one = &json["extensions"]["VRMC_vrm"]["expressions"];
    for table in ["preset", "custom"] {
        for (name, expression) in one[table].as_object().into_iter().flatten() {
            let bind = |b: &Value| {
                let node = root.nodes.get(number(&b["node"])?)?;
                Some(WeightedTarget {
                    mesh: node.mesh?,
                    target: number(&b["index"])?,
                    factor: b["weight"].as_f64().unwrap_or(1.0),
                })
            };
            let binds = list(&expression["morphTargetBinds"]);
            add(name, binds.iter().filter_map(bind).collect());
        }
    }
    for group in list(&json["extensions"]["VRM"]["blendShapeMaster"]["blendShapeGroups"]) {
        let bind = |b: &Value| {
            Some(WeightedTarget {
                mesh: number(&b["mesh"])?,
                target: number(&b["index"])?,
                // Percent.
                factor: b["weight"].as_f64().unwrap_or(100.0) / 100.0,
            })
        };
        let preset = group["presetName"].as_str().unwrap_or("unknown");
        let name = if preset.is_empty() || preset.eq_ignore_ascii_case("unknown") {
            group["name"].as_str().unwrap_or_default()
        } else {
            preset
        };
        add(
            name,
            list(&group["binds"]).iter().filter_map(bind).collect(),
        );
    }
    sources
}

/// The source that an expression's name means. Both eyes look with one expression, so the
/// whole of it goes to one eye's channel.
fn recognise_expression(name: &str) -> Option<&'static str> {
    match letters(name).as_str() {
        "lookup" => Some("eyeLookUpLeft"),
        "lookdown" => Some("eyeLookDownLeft"),
        "lookleft" => Some("eyeLookOutLeft"),
        "lookright" => Some("eyeLookOutRight"),
        "blinkl" => Some("eyeBlinkLeft"),
        "blinkr" => Some("eyeBlinkRight"),
        _ => recognise(name),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slips_and_prefixes_are_understood() {
        for (name, key) in [
            ("jawOpen", "jawOpen"),
            ("JawOpen", "jawOpen"),
            ("head_jawOpen", "jawOpen"),
            ("blendShape1.jawOpen", "jawOpen"),
            ("eyeBlink_L", "eyeBlinkLeft"),
            ("EyeBlinkRight", "eyeBlinkRight"),
            ("mouthSmile_R", "mouthSmileRight"),
            ("mouth_close", "mouthClose"),
            ("viseme_aa", "aa"),
            ("viseme_PP", "PP"),
            ("vrc.v_ou", "U"),
            ("あ", "aa"),
            ("mouthOpen", "mouthOpen"),
            ("Blink", "blink"),
        ] {
            assert_eq!(recognise(name), Some(key), "{name}");
        }
        for name in ["", "target_0", "hairLong", "viseme_sil", "x"] {
            assert_eq!(recognise(name), None, "{name}");
        }
        assert_eq!(recognise_expression("Blink_L"), Some("eyeBlinkLeft"));
    }

    #[test]
    fn every_target_of_arkit_is_known_by_its_name() {
        let arkit = "eyeBlinkLeft eyeLookDownLeft eyeLookInLeft eyeLookOutLeft eyeLookUpLeft \
            eyeSquintLeft eyeWideLeft eyeBlinkRight eyeLookDownRight eyeLookInRight \
            eyeLookOutRight eyeLookUpRight eyeSquintRight eyeWideRight jawForward jawLeft \
            jawRight jawOpen mouthClose mouthFunnel mouthPucker mouthLeft mouthRight \
            mouthSmileLeft mouthSmileRight mouthFrownLeft mouthFrownRight mouthDimpleLeft \
            mouthDimpleRight mouthStretchLeft mouthStretchRight mouthRollLower mouthRollUpper \
            mouthShrugLower mouthShrugUpper mouthPressLeft mouthPressRight mouthLowerDownLeft \
            mouthLowerDownRight mouthUpperUpLeft mouthUpperUpRight browDownLeft browDownRight \
            browInnerUp browOuterUpLeft browOuterUpRight cheekPuff cheekSquintLeft \
            cheekSquintRight noseSneerLeft noseSneerRight tongueOut";
        assert_eq!(arkit.split_whitespace().count(), RECIPES.len());
        for name in arkit.split_whitespace() {
            assert_eq!(recognise(name), Some(name));
            assert_eq!(recognise(&format!("Head.{name}")), Some(name));
        }
    }

    #[test]
    fn no_channel_is_listed_twice() {
        let mut names: Vec<_> = RECIPES.into_iter().map(|r| r.0).collect();
        names.sort_unstable();
        let count = names.len();
        names.dedup();
        assert_eq!(names.len(), count);
    }
}
