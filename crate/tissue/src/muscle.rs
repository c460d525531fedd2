//! The mimic muscles (F&H section 3.1.1, table 3.1 and figure 3.3).

use raconteur_base::Side;

use Muscle as M;

/// How many muscles a face has, left and right counted apart.
pub const MUSCLES: usize = 38;

/// A mimic muscle, by its anatomical name. The reference head of F&H has 24 major ones; here
/// paired muscles are two, and the frontal belly and the ring of the mouth are told apart as
/// their fibres are controlled apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[repr(usize)]
#[allow(missing_docs, reason = "the names are the anatomical ones")]
pub enum Muscle {
    FrontalisMedialLeft,
    FrontalisMedialRight,
    FrontalisLateralLeft,
    FrontalisLateralRight,
    CorrugatorLeft,
    CorrugatorRight,
    DepressorSuperciliiLeft,
    DepressorSuperciliiRight,
    Procerus,
    OrbicularisOculiLeft,
    OrbicularisOculiRight,
    NasalisLeft,
    NasalisRight,
    DepressorSepti,
    LevatorLabiiAlaequeLeft,
    LevatorLabiiAlaequeRight,
    LevatorLabiiLeft,
    LevatorLabiiRight,
    ZygomaticusMinorLeft,
    ZygomaticusMinorRight,
    ZygomaticusMajorLeft,
    ZygomaticusMajorRight,
    LevatorAnguliLeft,
    LevatorAnguliRight,
    RisoriusLeft,
    RisoriusRight,
    BuccinatorLeft,
    BuccinatorRight,
    DepressorAnguliLeft,
    DepressorAnguliRight,
    DepressorLabiiLeft,
    DepressorLabiiRight,
    MentalisLeft,
    MentalisRight,
    OrbicularisOrisUpper,
    OrbicularisOrisLower,
    PlatysmaLeft,
    PlatysmaRight,
}

/// Each muscle with its name in stories: anatomical, without the words "superioris",
/// "supercilii" and the like where nothing else could be meant.
const NAMES: [(Muscle, &str); MUSCLES] = [
    (M::FrontalisMedialLeft, "FrontalisMedialLeft"),
    (M::FrontalisMedialRight, "FrontalisMedialRight"),
    (M::FrontalisLateralLeft, "FrontalisLateralLeft"),
    (M::FrontalisLateralRight, "FrontalisLateralRight"),
    (M::CorrugatorLeft, "CorrugatorSuperciliiLeft"),
    (M::CorrugatorRight, "CorrugatorSuperciliiRight"),
    (M::DepressorSuperciliiLeft, "DepressorSuperciliiLeft"),
    (M::DepressorSuperciliiRight, "DepressorSuperciliiRight"),
    (M::Procerus, "Procerus"),
    (M::OrbicularisOculiLeft, "OrbicularisOculiLeft"),
    (M::OrbicularisOculiRight, "OrbicularisOculiRight"),
    (M::NasalisLeft, "NasalisLeft"),
    (M::NasalisRight, "NasalisRight"),
    (M::DepressorSepti, "DepressorSeptiNasi"),
    (
        M::LevatorLabiiAlaequeLeft,
        "LevatorLabiiSuperiorisAlaequeNasiLeft",
    ),
    (
        M::LevatorLabiiAlaequeRight,
        "LevatorLabiiSuperiorisAlaequeNasiRight",
    ),
    (M::LevatorLabiiLeft, "LevatorLabiiSuperiorisLeft"),
    (M::LevatorLabiiRight, "LevatorLabiiSuperiorisRight"),
    (M::ZygomaticusMinorLeft, "ZygomaticusMinorLeft"),
    (M::ZygomaticusMinorRight, "ZygomaticusMinorRight"),
    (M::ZygomaticusMajorLeft, "ZygomaticusMajorLeft"),
    (M::ZygomaticusMajorRight, "ZygomaticusMajorRight"),
    (M::LevatorAnguliLeft, "LevatorAnguliOrisLeft"),
    (M::LevatorAnguliRight, "LevatorAnguliOrisRight"),
    (M::RisoriusLeft, "RisoriusLeft"),
    (M::RisoriusRight, "RisoriusRight"),
    (M::BuccinatorLeft, "BuccinatorLeft"),
    (M::BuccinatorRight, "BuccinatorRight"),
    (M::DepressorAnguliLeft, "DepressorAnguliOrisLeft"),
    (M::DepressorAnguliRight, "DepressorAnguliOrisRight"),
    (M::DepressorLabiiLeft, "DepressorLabiiInferiorisLeft"),
    (M::DepressorLabiiRight, "DepressorLabiiInferiorisRight"),
    (M::MentalisLeft, "MentalisLeft"),
    (M::MentalisRight, "MentalisRight"),
    (M::OrbicularisOrisUpper, "OrbicularisOrisUpper"),
    (M::OrbicularisOrisLower, "OrbicularisOrisLower"),
    (M::PlatysmaLeft, "PlatysmaLeft"),
    (M::PlatysmaRight, "PlatysmaRight"),
];

impl Muscle {
    /// All muscles in the order of [`FaceControls::contraction`](super::FaceControls).
    pub fn all() -> impl Iterator<Item = Self> {
        NAMES.iter().map(|(muscle, _)| *muscle)
    }

    /// Its place in [`FaceControls::contraction`](super::FaceControls).
    #[must_use]
    pub fn index(self) -> usize {
        self as usize
    }

    /// Its name in stories.
    #[must_use]
    pub fn name(self) -> &'static str {
        NAMES[self.index()].1
    }

    /// The muscle of a name; letters may be great or small.
    #[must_use]
    pub fn by_name(name: &str) -> Option<Self> {
        let named = NAMES.iter().find(|(_, n)| n.eq_ignore_ascii_case(name));
        named.map(|(muscle, _)| *muscle)
    }

    /// On which side of the face it is; `None` in the middle.
    #[must_use]
    pub fn side(self) -> Option<Side> {
        if self.name().ends_with("Left") {
            Some(Side::Left)
        } else if self.name().ends_with("Right") {
            Some(Side::Right)
        } else {
            None
        }
    }

    /// The same muscle of the other side; itself in the middle.
    #[must_use]
    pub fn mirrored(self) -> Self {
        match self.side() {
            Some(Side::Left) => NAMES[self.index() + 1].0,
            Some(Side::Right) => NAMES[self.index() - 1].0,
            None => self,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn muscles_stand_at_their_index_and_sides_are_mirrored() {
        for (i, muscle) in Muscle::all().enumerate() {
            assert_eq!(muscle.index(), i);
            assert_eq!(Muscle::by_name(&muscle.name().to_lowercase()), Some(muscle));
            assert_eq!(muscle.mirrored().mirrored(), muscle);
            assert_eq!(
                muscle.mirrored().side(),
                muscle.side().map(Side::opposite),
                "{muscle:?}"
            );
        }
    }
}
