//! Names of targets and expressions, and the composition of channels from them.

use raconteur_body::figure::{JAW_OPEN_RAD, MOUTH_CLOSE_RAD};

/// Region of the face whose vertices a morph target may move.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Region {
    Everywhere,
    /// Vertices moved by the mouth's own targets: an expression's smile without its eyes.
    Mouth,
    /// Vertices moved by neither mouth nor lids: an expression's brows.
    Brows,
}

/// Sources in addition to ARKit's: Oculus visemes, and expressions. Names used by files for each,
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

/// Weighted sum of named morph targets or expressions.
pub(super) type Sum = &'static [(&'static str, f64)];

/// An opening of the mouth reaches the actor's widest vowel (0.245 rad of jaw) with the whole
/// of a viseme.
const MAX_OPENING: f64 = JAW_OPEN_RAD / 0.245;
/// Weight that closes the lips again over that viseme.
const UNWIDEN: f64 = -MOUTH_CLOSE_RAD / 0.245;
/// Weight that closes the lips over ARKit's jaw, whose `mouthClose` combines with `jawOpen`.
pub(super) const OVER_JAW: f64 = MOUTH_CLOSE_RAD / JAW_OPEN_RAD;

/// Recipes: a channel, its alternatives (the first one available in the file is used; a channel
/// present in the file is used directly) and the region of the last alternative. Factors are
/// designed: a viseme includes the opening of its vowel, which the jaw channel already adds and
/// which is therefore subtracted.
pub(super) const RECIPES: [(&str, &[Sum], Region); 52] = [
    (
        "jawOpen",
        &[&[("aa", MAX_OPENING)], &[("mouthOpen", MAX_OPENING)]],
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

/// Returns the canonical name of the morph target or expression that a name in a file means; `None`
/// if unknown.
pub(super) fn recognise(name: &str) -> Option<&'static str> {
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

/// Returns the source for an expression name. Both eyes look with one expression, so all of it goes
/// to one eye's channel.
pub(super) fn recognise_expression(name: &str) -> Option<&'static str> {
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
