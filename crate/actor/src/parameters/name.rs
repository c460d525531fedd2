//! Control parameters and their names (GEVH 3.2.4).

use raconteur_body::face::MUSCLES;
use raconteur_speech::emotion::WORDS;
use raconteur_speech::phones::{self, PhoneTargets};

use super::control::{FACE_CONTROLS, FaceControl};

/// The visemes of OpenXR's `XR_META_face_tracking_visemes`, each with a phone that has it, by
/// the name of its row in [`phones`].
pub const VISEMES: [(&str, &str); 15] = [
    ("sil", "pau"),
    ("PP", "p"),
    ("FF", "f"),
    ("TH", "th"),
    ("DD", "d"),
    ("kk", "k"),
    ("CH", "ch"),
    ("SS", "s"),
    ("nn", "n"),
    ("RR", "r"),
    ("aa", "aa"),
    ("E", "eh"),
    ("ih", "iy"),
    ("oh", "ao"),
    ("ou", "uw"),
];

/// Ekman's name of one of the six, which the table of F&H calls otherwise (section 4.4.3). The
/// other five are words of the table.
const EKMAN: [(&str, &str); 1] = [("Sadness", "sorry-for")];

/// Suffixes of names that stand for several parameters together.
const PARTS: [&str; 9] = [
    "Left",
    "Right",
    "Upper",
    "Lower",
    "Medial",
    "Lateral",
    "Anterior",
    "Superior",
    "Posterior",
];

/// Control parameter of a story (GEVH 3.2.4): a face control, a viseme, or an emotion.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Parameter(u8);

/// Quantity that a control parameter sets: a face control, the phone of a viseme, or an emotion
/// word.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ParameterTarget {
    /// A muscle, or a direct parameter of the face.
    Control(FaceControl),
    /// The mouth of a phone.
    Viseme(&'static PhoneTargets),
    /// An emotion, by its word in [`WORDS`].
    Emotion(&'static str),
}

impl Parameter {
    /// Number of parameters.
    pub(super) const COUNT: usize = FACE_CONTROLS + VISEMES.len() + WORDS.len();

    /// Returns every parameter that a name stands for, case-insensitively; none for an unknown
    /// name. `ZygomaticusMajorLeft` is one muscle, `ZygomaticusMajor` both, `Frontalis` all four;
    /// visemes are named `PP` or `VisemePP`.
    pub fn named(name: &str) -> impl Iterator<Item = Self> {
        let name = EKMAN
            .iter()
            .find(|(ekman, _)| ekman.eq_ignore_ascii_case(name))
            .map_or(name, |(_, word)| word);
        Self::all().filter(move |parameter| parameter.is_called(name))
    }

    fn is_called(self, name: &str) -> bool {
        let own = self.name();
        if own.eq_ignore_ascii_case(name) {
            return true;
        }
        match self.target() {
            ParameterTarget::Control(_) => {
                let begins = own
                    .get(..name.len())
                    .is_some_and(|begin| begin.eq_ignore_ascii_case(name));
                begins && is_of_parts(&own[name.len()..])
            }
            ParameterTarget::Viseme(_) => {
                let rest = name.get(6..).filter(|rest| rest.eq_ignore_ascii_case(own));
                rest.is_some() && name[..6].eq_ignore_ascii_case("viseme")
            }
            ParameterTarget::Emotion(_) => false,
        }
    }

    /// Returns all control parameters: face controls, then visemes, then emotions.
    pub fn all() -> impl Iterator<Item = Self> {
        (0..Self::COUNT as u8).map(Self)
    }

    /// Returns its index among all parameters.
    pub(super) fn index(self) -> usize {
        usize::from(self.0)
    }

    /// Returns the name of the parameter in stories.
    #[must_use]
    pub fn name(self) -> &'static str {
        let index = self.index();
        if let Some(dial) = FaceControl::from_index(index) {
            return dial.name();
        }
        let index = index - FACE_CONTROLS;
        match index.checked_sub(VISEMES.len()) {
            None => VISEMES[index].0,
            Some(word) => WORDS[word].0,
        }
    }

    /// Returns the face control, viseme or emotion that the parameter sets.
    #[must_use]
    pub fn target(self) -> ParameterTarget {
        let index = self.index();
        if let Some(dial) = FaceControl::from_index(index) {
            return ParameterTarget::Control(dial);
        }
        let index = index - FACE_CONTROLS;
        match index.checked_sub(VISEMES.len()) {
            None => {
                let phone = phones::by_name(VISEMES[index].1);
                ParameterTarget::Viseme(phone.unwrap_or(phones::PhoneRow::SILENCE.targets()))
            }
            Some(word) => ParameterTarget::Emotion(WORDS[word].0),
        }
    }

    /// Returns the minimum value, −1 or 0; the maximum is 1.
    #[must_use]
    pub fn min_value(self) -> f64 {
        let dial = FaceControl::from_index(self.index());
        if dial.is_some_and(FaceControl::is_signed) {
            -1.0
        } else {
            0.0
        }
    }

    /// Returns all names, except those that stand for several parameters: muscles first.
    pub fn names() -> impl Iterator<Item = &'static str> {
        let ekman = EKMAN.iter().map(|(name, _)| *name);
        Self::all().map(Self::name).chain(ekman)
    }
}

/// Returns true if the rest of a name consists only of sides and parts.
fn is_of_parts(mut rest: &str) -> bool {
    while !rest.is_empty() {
        match PARTS.iter().find_map(|part| rest.strip_prefix(part)) {
            Some(after) => rest = after,
            None => return false,
        }
    }
    true
}

// Parameters are counted in a byte.
const _: () = assert!(
    Parameter::COUNT <= 256 && MUSCLES <= FACE_CONTROLS,
    "parameters fit a byte and muscles are dials"
);

#[cfg(test)]
mod tests {
    use super::*;

    fn names(name: &str) -> Vec<&'static str> {
        Parameter::named(name).map(Parameter::name).collect()
    }

    #[test]
    fn every_name_finds_its_own_and_a_bare_one_both_sides() {
        for name in Parameter::names() {
            let found = names(&name.to_uppercase());
            assert_eq!(found.len(), 1, "{name} stands for {found:?}");
        }
        assert_eq!(
            names("zygomaticusMajor"),
            ["ZygomaticusMajorLeft", "ZygomaticusMajorRight"]
        );
        assert_eq!(names("Frontalis").len(), 4);
        assert_eq!(names("Auricularis").len(), 6);
        assert_eq!(names("LevatorLabii"), [""; 0]);
        assert_eq!(names("Masseter"), ["MasseterLeft", "MasseterRight"]);
        assert_eq!(names("UpperLid"), ["UpperLidLeft", "UpperLidRight"]);
        assert_eq!(
            names("LipProtrusion"),
            ["LipProtrusionUpper", "LipProtrusionLower"]
        );
        assert_eq!(names("Jaw"), ["Jaw"]);
        assert_eq!(names("VisemePP"), ["PP"]);
        assert_eq!(names("visemesil"), ["sil"]);
        assert_eq!(names("Disgust"), ["disgust"]);
        assert_eq!(names("Sadness"), ["sorry-for"]);
        assert_eq!(names("Happy-For"), ["happy-for"]);
        for unknown in [
            "", "Zyg", "Left", "Viseme", "Smile", "VisemeX", "é", "LipX", "Lip",
        ] {
            assert_eq!(names(unknown), [""; 0], "{unknown}");
        }
    }

    #[test]
    fn visemes_are_those_of_their_phones_and_emotions_those_of_the_table() {
        for (name, _) in VISEMES {
            let parameter = Parameter::named(name).next().expect("a viseme");
            let ParameterTarget::Viseme(targets) = parameter.target() else {
                panic!("{name}")
            };
            assert_eq!(targets.viseme, name);
        }
        let fear = Parameter::named("FEAR").next().expect("a word").target();
        assert_eq!(fear, ParameterTarget::Emotion("fear"));
        assert_eq!(
            Parameter::named("Blush").next().expect("one").min_value(),
            -1.0
        );
        assert_eq!(
            Parameter::named("Jaw").next().expect("one").min_value(),
            0.0
        );
    }
}
