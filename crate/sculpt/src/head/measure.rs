//! Measures of head and face: definition, measurement and statistics.

use raconteur_base::DVec3;

use super::cage::Key;
use crate::statistics::{Row, Source};

/// Measure of the head or the face, for which population statistics are known.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Measure {
    /// Glabella to opisthocranion.
    HeadLength,
    /// Greatest breadth of the skull.
    HeadBreadth,
    /// Tragion to vertex, vertical.
    HeadHeight,
    /// Minimum breadth of the forehead.
    ForeheadBreadth,
    /// Breadth of the cheekbones' arches.
    FaceBreadth,
    /// Breadth at the angles of the jaw.
    JawBreadth,
    /// The deepest point of the root of the nose to menton.
    FaceHeight,
    /// The deepest point of the root of the nose to subnasale.
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
}

/// Function that returns the position of a cage vertex by key; left half, mm.
pub(crate) type At<'a> = &'a dyn Fn(Key) -> DVec3;

/// Function that takes a measure on the left half of a head, mm.
pub(crate) type Measurer = fn(At<'_>) -> f64;

/// Definition of a measure: name, landmarks, statistics and the function that takes it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Definition {
    pub(crate) measure: Measure,
    pub(crate) name: &'static str,
    /// Ends of the distance in standard landmark names.
    pub(crate) landmarks: &'static str,
    /// Population statistics of the measure.
    pub(crate) row: Row,
    pub(crate) measurer: Measurer,
}

fn breadth(p: DVec3) -> f64 {
    2.0 * p.x
}

const G: fn(u8, u8) -> Key = Key::Grid;

/// Returns the maximum of a coordinate over some cage vertices.
fn max_by(at: At<'_>, keys: &[Key], coordinate: fn(DVec3) -> f64) -> f64 {
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

/// Definitions of all measures, in the order of [`Measure`].
#[rustfmt::skip]
pub(crate) const DEFINITIONS: [Definition; 22] = {
    use Measure as M;
    const fn known(measure: M, name: &'static str, landmarks: &'static str, row: Row, take: Measurer) -> Definition {
        Definition { measure, name, landmarks, row, measurer: take }
    }
    [
        known(M::HeadLength, "head_length", "g-op", row!([199.5, 189.8], [7.0, 7.4], [0.945, 0.95], NO_CHANGE, Ansur),
            |at| SKULL_BACK.iter().map(|&k| (at(k) - at(G(0, 4))).length()).fold(0.0, f64::max)),
        known(M::HeadBreadth, "head_breadth", "eu_l-eu_r", row!([154.3, 147.8], [5.5, 5.2], [0.955, 0.96], NO_CHANGE, Ansur),
            |at| max_by(at, &SKULL_SIDE, breadth)),
        known(M::HeadHeight, "head_height", "t_l-v", row!([131.2, 126.5], [6.2, 6.6], [0.955, 0.96], NO_CHANGE, Ansur),
            |at| max_by(at, &SKULL_TOP, |p| p.y)),
        known(M::ForeheadBreadth, "forehead_breadth", "ft_l-ft_r", row!([105.5, 102.9], [5.7, 5.4], [0.937, 0.952], NO_CHANGE, Respirator),
            |at| breadth(at(G(8, 3)))),
        known(M::FaceBreadth, "face_breadth", "zy_l-zy_r", row!([142.6, 133.8], [6.2, 5.6], [0.931, 0.947], [-0.008, -0.039], Ansur),
            |at| breadth(at(G(10, 8)))),
        known(M::JawBreadth, "jaw_breadth", "go_l-go_r", row!([112.0, 103.5], [9.0, 7.8], [0.909, 0.929], NO_CHANGE, JawMean),
            |at| breadth(at(G(11, 24)))),
        known(M::FaceHeight, "face_height", "n-gn", row!([122.6, 113.1], [6.7, 6.1], [0.891, 0.916], [0.0225, 0.0373], Ansur),
            |at| (at(G(0, 6)) - at(G(0, 24))).length()),
        known(M::NoseHeight, "nose_height", "n-sn", row!([52.0, 48.2], [4.1, 3.8], [0.89, 0.904], [0.03, 0.03], Respirator),
            |at| (at(G(0, 6)) - at(G(0, 14))).length()),
        known(M::NoseBreadth, "nose_breadth", "al_l-al_r", row!([36.8, 33.2], [2.7, 2.4], [0.848, 0.898], [0.04, 0.03], FacialNorms),
            |at| breadth(at(G(4, 12)))),
        known(M::NoseProtrusion, "nose_protrusion", "sn-prn", row!([20.9, 20.0], [2.0, 1.8], [0.823, 0.84], [0.02, 0.02], FacialNorms),
            |at| (at(G(0, 11)) - at(G(0, 14))).length()),
        known(M::InnerCanthalBreadth, "inner_canthal_breadth", "en_l-en_r", row!([32.7, 31.5], [2.9, 2.7], [0.939, 0.965], NO_CHANGE, FacialNorms),
            |at| breadth(at(Key::Eye(5, 0)))),
        known(M::OuterCanthalBreadth, "outer_canthal_breadth", "ex_l-ex_r", row!([88.9, 85.6], [4.0, 3.8], [0.925, 0.942], [-0.02, -0.02], FacialNorms),
            |at| breadth(at(Key::Eye(5, 8)))),
        known(M::PupilDistance, "pupil_distance", "p_l-p_r", row!([64.0, 61.7], [3.4, 3.6], [0.90, 0.91], [0.045, 0.026], Ansur),
            |at| breadth((at(Key::Eye(6, 4)) + at(Key::Eye(6, 12))) / 2.0)),
        known(M::FissureHeight, "fissure_height", "ps-pi", row!([10.8, 10.9], [0.9, 1.2], [0.95, 0.95], [-0.025, -0.02], Farkas),
            |at| (at(Key::Eye(5, 4)) - at(Key::Eye(5, 12))).length()),
        known(M::MouthBreadth, "mouth_breadth", "ch_l-ch_r", row!([51.1, 48.5], [4.0, 3.7], [0.828, 0.85], [0.04, 0.03], FacialNorms),
            |at| breadth(at(Key::Mouth(1, 6)))),
        known(M::PhiltrumLength, "philtrum_length", "sn-ls", row!([16.3, 14.0], [2.5, 2.35], [0.859, 0.93], [0.04, 0.04], FacialNorms),
            |at| at(G(0, 14)).y - at(Key::Mouth(1, 0)).y),
        known(M::PhiltrumBreadth, "philtrum_breadth", "cph_l-cph_r", row!([13.1, 11.75], [1.74, 1.71], [0.832, 0.876], NO_CHANGE, FacialNorms),
            |at| breadth(at(Key::Mouth(1, 2)))),
        known(M::UpperRed, "upper_red", "ls-sts", row!([7.6, 7.4], [1.6, 1.4], [0.945, 0.96], [-0.045, -0.04], FacialNorms),
            |at| at(Key::Mouth(1, 0)).y - at(Key::Mouth(4, 0)).y),
        known(M::LowerRed, "lower_red", "sti-li", row!([8.7, 8.6], [2.1, 1.7], [0.92, 0.872], [-0.05, -0.045], FacialNorms),
            |at| at(Key::Mouth(4, 12)).y - at(Key::Mouth(1, 12)).y),
        known(M::LowerLipSkin, "lower_lip_skin", "li-sl", row!([12.3, 10.6], [2.4, 2.2], [0.805, 0.896], NO_CHANGE, FacialNorms),
            |at| at(Key::Mouth(1, 12)).y - at(G(0, 21)).y),
        known(M::EarLength, "ear_length", "sa-sba", row!([64.2, 59.4], [4.5, 3.9], [0.93, 0.935], [0.139, 0.094], Ansur),
            |at| ear(at, |p| p.y) + ear(at, |p| -p.y)),
        known(M::EarBreadth, "ear_breadth", "t_l-pa_l", row!([36.1, 33.2], [3.0, 2.8], [0.96, 0.97], [0.055, 0.053], Ansur),
            |at| at(G(12, 9)).z + ear(at, |p| -p.z)),
    ]
};

impl Measure {
    /// Number of measures.
    pub const COUNT: usize = DEFINITIONS.len();

    /// Iterates over all measures in the order of the table.
    pub fn all() -> impl Iterator<Item = Self> {
        DEFINITIONS.iter().map(|d| d.measure)
    }

    pub(crate) fn definition(self) -> &'static Definition {
        &DEFINITIONS[self as usize]
    }

    /// Returns the name of the measure in parameter files, for example `nose_breadth`.
    #[must_use]
    pub fn name(self) -> &'static str {
        self.definition().name
    }

    /// Returns the measure with a name; `None` for an unknown name.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        Self::all().find(|m| m.name() == name)
    }
}

/// Measure that can be taken on a finished figure, with its landmarks and statistics.
#[derive(Clone, Copy, Debug)]
pub struct KnownMeasure {
    /// Name of the measure.
    pub name: &'static str,
    /// Landmarks at the ends of the distance, separated by `-`.
    pub landmarks: &'static str,
    /// Population statistics of the measure.
    pub row: &'static Row,
    /// Axis of a projected distance, world frame; `None` for a straight one.
    pub along: Option<DVec3>,
}

/// Iterates over the measures that can be taken on a finished figure.
pub fn known_measures() -> impl Iterator<Item = KnownMeasure> {
    DEFINITIONS.iter().map(|d| {
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
        KnownMeasure {
            name: d.name,
            landmarks: d.landmarks,
            row: &d.row,
            along,
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::head::ModelHeadShape;

    #[test]
    fn names_name_measures() {
        assert_eq!(
            Measure::from_name("nose_breadth"),
            Some(Measure::NoseBreadth)
        );
        assert!(
            Measure::all().all(|m| Measure::from_name(m.name()) == Some(m)),
            "the measure names round trip"
        );
    }

    #[test]
    fn every_measure_of_the_mean_adult_is_near_the_mean() {
        let all = ModelHeadShape::default().symmetric();
        for d in &DEFINITIONS {
            let norm = d.row.norm_at(0.5, 28.0);
            let off = ((d.measurer)(&|key| all[&key]) - norm.mean) / norm.sd;
            assert!(off.abs() < 2.0, "{}: {off:.2} deviations", d.name);
        }
    }
}
