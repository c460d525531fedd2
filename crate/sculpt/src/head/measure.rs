//! Measures of head and face: what each is, how it is taken, and the form that changes it.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use raconteur_base::DVec3;

use super::cage::Key;
use super::form::{Form, handle};
use crate::statistics::{Row, Source};

/// A measure of the head or the face.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Measure {
    /// Glabella to opisthocranion.
    HeadLength,
    /// Greatest breadth of the skull.
    HeadBreadth,
    /// Tragion to vertex, vertical.
    HeadHeight,
    /// Least breadth of the forehead.
    ForeheadBreadth,
    /// Breadth of the cheekbones' arches.
    FaceBreadth,
    /// Breadth at the angles of the jaw.
    JawBreadth,
    /// Nasion to menton.
    FaceHeight,
    /// Nasion to subnasale.
    NoseHeight,
    /// Breadth of the alae.
    NoseBreadth,
    /// Subnasale to pronasale.
    NoseProtrusion,
    /// Between the inner corners of the eyes.
    InnerCanthalBreadth,
    /// Between the outer corners of the eyes.
    OuterCanthalBreadth,
    /// Between the pupils.
    PupilDistance,
    /// Opening of the lids.
    FissureHeight,
    /// Between the corners of the mouth.
    MouthBreadth,
    /// Subnasale to the border of the upper lip.
    PhiltrumLength,
    /// Between the peaks of the upper lip.
    PhiltrumBreadth,
    /// Red of the upper lip.
    UpperRed,
    /// Red of the lower lip.
    LowerRed,
    /// Skin below the lower lip to the fold above the chin.
    LowerLipSkin,
    /// Length of the ear.
    EarLength,
    /// Breadth of the ear.
    EarBreadth,
    /// Depth of the nose's bridge at the eyes, mm forward.
    Bridge,
    /// Dorsum, mm: hump above, hollow below zero.
    Dorsum,
    /// Tip of the nose, mm upward.
    TipLift,
    /// Lips, mm forward.
    LipProtrusion,
    /// Chin, mm forward.
    ChinProtrusion,
    /// Breadth of the chin, mm.
    ChinBreadth,
    /// Ridge over the eyes, mm forward.
    BrowRidge,
    /// Brow, mm upward.
    BrowHeight,
    /// Top of the forehead, mm forward.
    ForeheadSlope,
    /// Cheekbones, mm outward and forward.
    Cheekbone,
    /// Fullness of the cheeks, mm.
    CheekFullness,
    /// Skin over the upper lid, mm downward.
    LidHood,
    /// Outer corner of the eye, mm upward.
    CanthalTilt,
    /// Corner of the mouth, mm upward.
    MouthCorner,
    /// Bags and the furrow below the eye, mm.
    EyeBag,
    /// Nasolabial fold, mm.
    NasolabialFold,
    /// Jowls, mm.
    Jowl,
    /// Cords of the neck, mm.
    NeckCord,
    /// Breadth of the neck, mm.
    NeckBreadth,
    /// Angle of the ears, in steps of about 1 mm.
    EarProtrusion,
}

/// Points by key; the left half, mm.
pub(crate) type At<'a> = &'a dyn Fn(Key) -> DVec3;

/// How a measure is taken on the left half.
pub(crate) type Take = fn(At<'_>) -> f64;

/// A measure's definition.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Definition {
    pub(crate) measure: Measure,
    pub(crate) name: &'static str,
    /// Ends of the distance in standard landmark names; empty for a designed measure.
    pub(crate) landmarks: &'static str,
    /// Its statistics; `None` for a designed measure, given in mm against the mean.
    pub(crate) norm: Option<(Row, Take)>,
    pub(crate) form: Form,
}

fn breadth(p: DVec3) -> f64 {
    2.0 * p.x
}

const G: fn(u8, u8) -> Key = Key::Grid;

/// Greatest of some keys by a coordinate.
fn most(at: At<'_>, keys: &[Key], coordinate: fn(DVec3) -> f64) -> f64 {
    keys.iter()
        .map(|&k| coordinate(at(k)))
        .fold(f64::MIN, f64::max)
}

const SKULL_SIDE: [Key; 4] = [
    Key::Grid(12, 4),
    Key::Grid(14, 4),
    Key::Grid(12, 6),
    Key::Grid(15, 6),
];
const SKULL_BACK: [Key; 3] = [Key::Grid(20, 0), Key::Grid(20, 4), Key::Grid(20, 8)];
const SKULL_TOP: [Key; 3] = [Key::Crown(3, 0), Key::Crown(4, 0), Key::Crown(5, 0)];
const EAR_RIM: [u8; 8] = [3, 4, 5, 6, 8, 9, 13, 14];

fn ear(at: At<'_>, coordinate: fn(DVec3) -> f64) -> f64 {
    EAR_RIM
        .iter()
        .map(|&k| coordinate(at(Key::Ear(4, k))))
        .fold(f64::MIN, f64::max)
}

const NO_CHANGE: [f64; 2] = [0.0, 0.0];

macro_rules! row {
    ($mean:expr, $sd:expr, $nine:expr, $year:expr, $source:ident) => {
        Row::new($mean, $sd, $nine, $year, Source::$source)
    };
}

/// All measures: first those with statistics, then the designed ones.
#[rustfmt::skip]
pub(crate) const DEFINITIONS: [Definition; 42] = {
    use Measure as M;
    const fn known(measure: M, name: &'static str, landmarks: &'static str, row: Row, take: Take, form: Form) -> Definition {
        Definition { measure, name, landmarks, norm: Some((row, take)), form }
    }
    const fn designed(measure: M, name: &'static str, form: Form) -> Definition {
        Definition { measure, name, landmarks: "", norm: None, form }
    }
    [
        known(M::HeadLength, "head_length", "g-op", row!([199.5, 189.8], [7.0, 7.4], [0.945, 0.95], NO_CHANGE, Ansur),
            |at| SKULL_BACK.iter().map(|&k| (at(k) - at(G(0, 4))).length()).fold(0.0, f64::max), handle::HEAD_LENGTH),
        known(M::HeadBreadth, "head_breadth", "eu_l-eu_r", row!([154.3, 147.8], [5.5, 5.2], [0.955, 0.96], NO_CHANGE, Ansur),
            |at| most(at, &SKULL_SIDE, breadth), handle::HEAD_BREADTH),
        known(M::HeadHeight, "head_height", "t_l-v", row!([131.2, 126.5], [6.2, 6.6], [0.955, 0.96], NO_CHANGE, Ansur),
            |at| most(at, &SKULL_TOP, |p| p.y), handle::HEAD_HEIGHT),
        known(M::ForeheadBreadth, "forehead_breadth", "ft_l-ft_r", row!([105.5, 102.9], [5.7, 5.4], [0.937, 0.952], NO_CHANGE, Respirator),
            |at| breadth(at(G(8, 3))), handle::FOREHEAD_BREADTH),
        known(M::FaceBreadth, "face_breadth", "zy_l-zy_r", row!([142.6, 133.8], [6.2, 5.6], [0.931, 0.947], [-0.008, -0.039], Ansur),
            |at| breadth(at(G(10, 8))), handle::FACE_BREADTH),
        known(M::JawBreadth, "jaw_breadth", "go_l-go_r", row!([112.0, 103.5], [9.0, 7.8], [0.909, 0.929], NO_CHANGE, JawMean),
            |at| breadth(at(G(11, 24))), handle::JAW_BREADTH),
        known(M::FaceHeight, "face_height", "se-gn", row!([122.6, 113.1], [6.7, 6.1], [0.891, 0.916], [0.0225, 0.0373], Ansur),
            |at| (at(G(0, 6)) - at(G(0, 24))).length(), handle::FACE_HEIGHT),
        known(M::NoseHeight, "nose_height", "se-sn", row!([52.0, 48.2], [4.1, 3.8], [0.89, 0.904], [0.03, 0.03], Respirator),
            |at| (at(G(0, 6)) - at(G(0, 14))).length(), handle::NOSE_HEIGHT),
        known(M::NoseBreadth, "nose_breadth", "al_l-al_r", row!([36.8, 33.2], [2.7, 2.4], [0.848, 0.898], [0.04, 0.03], FacialNorms),
            |at| breadth(at(G(4, 12))), handle::NOSE_BREADTH),
        known(M::NoseProtrusion, "nose_protrusion", "sn-prn", row!([20.9, 20.0], [2.0, 1.8], [0.823, 0.84], [0.02, 0.02], FacialNorms),
            |at| (at(G(0, 11)) - at(G(0, 14))).length(), handle::NOSE_PROTRUSION),
        known(M::InnerCanthalBreadth, "inner_canthal_breadth", "en_l-en_r", row!([32.7, 31.5], [2.9, 2.7], [0.939, 0.965], NO_CHANGE, FacialNorms),
            |at| breadth(at(Key::Eye(5, 0))), handle::INNER_CANTHAL),
        known(M::OuterCanthalBreadth, "outer_canthal_breadth", "ex_l-ex_r", row!([88.9, 85.6], [4.0, 3.8], [0.925, 0.942], [-0.02, -0.02], FacialNorms),
            |at| breadth(at(Key::Eye(5, 8))), handle::OUTER_CANTHAL),
        known(M::PupilDistance, "pupil_distance", "p_l-p_r", row!([64.0, 61.7], [3.4, 3.6], [0.90, 0.91], [0.045, 0.026], Ansur),
            |at| breadth((at(Key::Eye(6, 4)) + at(Key::Eye(6, 12))) / 2.0), handle::PUPIL_DISTANCE),
        known(M::FissureHeight, "fissure_height", "ps-pi", row!([10.8, 10.9], [0.9, 1.2], [0.95, 0.95], [-0.025, -0.02], Farkas),
            |at| (at(Key::Eye(5, 4)) - at(Key::Eye(5, 12))).length(), handle::FISSURE_HEIGHT),
        known(M::MouthBreadth, "mouth_breadth", "ch_l-ch_r", row!([51.1, 48.5], [4.0, 3.7], [0.828, 0.85], [0.04, 0.03], FacialNorms),
            |at| breadth(at(Key::Mouth(1, 6))), handle::MOUTH_BREADTH),
        known(M::PhiltrumLength, "philtrum_length", "sn-ls", row!([16.3, 14.0], [2.5, 2.35], [0.859, 0.93], [0.04, 0.04], FacialNorms),
            |at| at(G(0, 14)).y - at(Key::Mouth(1, 0)).y, handle::PHILTRUM_LENGTH),
        known(M::PhiltrumBreadth, "philtrum_breadth", "cph_l-cph_r", row!([13.1, 11.75], [1.74, 1.71], [0.832, 0.876], NO_CHANGE, FacialNorms),
            |at| breadth(at(Key::Mouth(1, 2))), handle::PHILTRUM_BREADTH),
        known(M::UpperRed, "upper_red", "ls-sts", row!([7.6, 7.4], [1.6, 1.4], [0.945, 0.96], [-0.045, -0.04], FacialNorms),
            |at| at(Key::Mouth(1, 0)).y - at(Key::Mouth(4, 0)).y, handle::UPPER_RED),
        known(M::LowerRed, "lower_red", "sti-li", row!([8.7, 8.6], [2.1, 1.7], [0.92, 0.872], [-0.05, -0.045], FacialNorms),
            |at| at(Key::Mouth(4, 12)).y - at(Key::Mouth(1, 12)).y, handle::LOWER_RED),
        known(M::LowerLipSkin, "lower_lip_skin", "li-sl", row!([12.3, 10.6], [2.4, 2.2], [0.805, 0.896], NO_CHANGE, FacialNorms),
            |at| at(Key::Mouth(1, 12)).y - at(G(0, 21)).y, handle::LOWER_LIP_SKIN),
        known(M::EarLength, "ear_length", "sa-sba", row!([64.2, 59.4], [4.5, 3.9], [0.93, 0.935], [0.139, 0.094], Ansur),
            |at| ear(at, |p| p.y) + ear(at, |p| -p.y), handle::EAR_LENGTH),
        known(M::EarBreadth, "ear_breadth", "t_l-pa_l", row!([36.1, 33.2], [3.0, 2.8], [0.96, 0.97], [0.055, 0.053], Ansur),
            |at| at(G(12, 9)).z + ear(at, |p| -p.z), handle::EAR_BREADTH),
        designed(M::Bridge, "bridge", handle::BRIDGE),
        designed(M::Dorsum, "dorsum", handle::DORSUM),
        designed(M::TipLift, "tip_lift", handle::TIP_LIFT),
        designed(M::LipProtrusion, "lip_protrusion", handle::LIP_PROTRUSION),
        designed(M::ChinProtrusion, "chin_protrusion", handle::CHIN_PROTRUSION),
        designed(M::ChinBreadth, "chin_breadth", handle::CHIN_BREADTH),
        designed(M::BrowRidge, "brow_ridge", handle::BROW_RIDGE),
        designed(M::BrowHeight, "brow_height", handle::BROW_HEIGHT),
        designed(M::ForeheadSlope, "forehead_slope", handle::FOREHEAD_SLOPE),
        designed(M::Cheekbone, "cheekbone", handle::CHEEKBONE),
        designed(M::CheekFullness, "cheek_fullness", handle::CHEEK_FULLNESS),
        designed(M::LidHood, "lid_hood", handle::LID_HOOD),
        designed(M::CanthalTilt, "canthal_tilt", handle::CANTHAL_TILT),
        designed(M::MouthCorner, "mouth_corner", handle::MOUTH_CORNER),
        designed(M::EyeBag, "eye_bag", handle::EYE_BAG),
        designed(M::NasolabialFold, "nasolabial_fold", handle::NASOLABIAL_FOLD),
        designed(M::Jowl, "jowl", handle::JOWL),
        designed(M::NeckCord, "neck_cord", handle::NECK_CORD),
        designed(M::NeckBreadth, "neck_breadth", handle::NECK_BREADTH),
        designed(M::EarProtrusion, "ear_protrusion", handle::EAR_PROTRUSION),
    ]
};

impl Measure {
    /// How many there are.
    pub const COUNT: usize = DEFINITIONS.len();

    /// All, in the order of the table.
    pub fn all() -> impl Iterator<Item = Self> {
        DEFINITIONS.iter().map(|d| d.measure)
    }

    pub(crate) fn definition(self) -> &'static Definition {
        &DEFINITIONS[self as usize]
    }

    /// Its name in parameter files, for example `nose_breadth`.
    #[must_use]
    pub fn name(self) -> &'static str {
        self.definition().name
    }

    /// The measure of a name.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        Self::all().find(|m| m.name() == name)
    }

    /// Whether it is given in standard deviations from the mean for the person's sex and
    /// age; otherwise in millimetres against it.
    #[must_use]
    pub fn is_in_deviations(self) -> bool {
        self.definition().norm.is_some()
    }
}

/// A measure with statistics, as it is taken on a finished figure.
#[derive(Clone, Copy, Debug)]
pub struct KnownMeasure {
    /// Its name.
    pub name: &'static str,
    /// Its ends in landmark names.
    pub landmarks: &'static str,
    /// Its statistics.
    pub row: &'static Row,
    /// Axis of a distance that is not taken straight, world frame.
    pub along: Option<DVec3>,
}

/// The measures with statistics.
pub fn known_measures() -> impl Iterator<Item = KnownMeasure> {
    DEFINITIONS.iter().filter_map(|d| {
        let (row, _) = d.norm.as_ref()?;
        let along = match d.measure {
            Measure::HeadHeight
            | Measure::PhiltrumLength
            | Measure::UpperRed
            | Measure::LowerRed
            | Measure::LowerLipSkin
            | Measure::EarLength => Some(DVec3::Y),
            Measure::EarBreadth => Some(DVec3::Z),
            _ => None,
        };
        Some(KnownMeasure {
            name: d.name,
            landmarks: d.landmarks,
            row,
            along,
        })
    })
}

/// A person's measures: standard deviations or millimetres from the mean for sex and age,
/// all 0 unless set.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(into = "BTreeMap<String, f64>", try_from = "BTreeMap<String, f64>")]
pub struct Measures([f64; Measure::COUNT]);

impl From<Measures> for BTreeMap<String, f64> {
    fn from(measures: Measures) -> Self {
        Measure::all()
            .map(|m| (m.name().to_owned(), measures.get(m)))
            .collect()
    }
}

impl TryFrom<BTreeMap<String, f64>> for Measures {
    type Error = String;

    fn try_from(map: BTreeMap<String, f64>) -> Result<Self, String> {
        let mut all = Self::default();
        for (name, value) in map {
            let measure = Measure::from_name(&name)
                .ok_or_else(|| format!("there is no measure named {name}"))?;
            all = all.with(measure, value);
        }
        Ok(all)
    }
}

impl Default for Measures {
    fn default() -> Self {
        Self([0.0; Measure::COUNT])
    }
}

impl Measures {
    /// Some measures set, the others at the mean.
    #[must_use]
    pub fn of(set: &[(Measure, f64)]) -> Self {
        let mut all = Self::default();
        for &(m, value) in set {
            all.0[m as usize] = value;
        }
        all
    }

    /// One measure.
    #[must_use]
    pub fn get(&self, measure: Measure) -> f64 {
        self.0[measure as usize]
    }

    /// With one measure set.
    #[must_use]
    pub fn with(mut self, measure: Measure, value: f64) -> Self {
        self.0[measure as usize] = value;
        self
    }
}
