//! Distances of a finished figure, compared with their statistics.

use raconteur_base::DVec3;

use super::hand::HandParams;
use super::head::{KnownMeasure, known_measures};
use super::person::Person;
use super::statistics::{Norm, Row, Source};
use raconteur_body::annotation::Annotations;
use raconteur_body::figure::Figure;

/// Measurement of a figure: one distance, with the norm for the person's sex and age.
#[derive(Clone, Debug, PartialEq)]
pub struct Reading {
    /// Name, for example `nose_breadth`.
    pub name: &'static str,
    /// Ends, in standard landmark names.
    pub landmarks: &'static str,
    /// The figure's own, millimetres.
    pub mm: f64,
    /// The population's, for the person's sex and age.
    pub norm: Norm,
    /// Source of the norm.
    pub source: &'static str,
}

impl Reading {
    /// Returns the deviation of the distance from the mean, in standard deviations.
    #[must_use]
    pub fn deviations(&self) -> f64 {
        (self.mm - self.norm.mean) / self.norm.sd
    }
}

/// Distances not set by a parameter: name, landmarks and statistics. Subnasale to gnathion and the
/// hairline's distances after Farkas 1994, the others after Weinberg et al. 2016 at 25; shares of
/// children after the same curves, the hairline's designed.
const FURTHER: [(&str, &str, Row); 8] = [
    further(
        "nose_length",
        "n-prn",
        [49.6, 46.9],
        [3.9, 3.4],
        [0.857, 0.879],
        Source::FacialNorms,
    ),
    further(
        "lower_face_height",
        "sn-gn",
        [72.6, 64.3],
        [4.5, 4.0],
        [0.89, 0.915],
        Source::Farkas,
    ),
    further(
        "fissure_length",
        "en-ex",
        [28.7, 27.8],
        [1.95, 1.97],
        [0.932, 0.942],
        Source::FacialNorms,
    ),
    further(
        "ala_length",
        "ac-prn",
        [35.0, 31.4],
        [2.2, 1.85],
        [0.83, 0.868],
        Source::FacialNorms,
    ),
    further(
        "subnasal_breadth",
        "sbal_l-sbal_r",
        [19.2, 17.5],
        [2.6, 2.3],
        [0.909, 0.93],
        Source::FacialNorms,
    ),
    further(
        "upper_lip_height",
        "sn-sts",
        [22.6, 20.25],
        [2.5, 2.4],
        [0.895, 0.935],
        Source::FacialNorms,
    ),
    further(
        "forehead_height",
        "tr-n",
        [67.1, 63.0],
        [7.5, 6.0],
        [0.95, 0.95],
        Source::Farkas,
    ),
    further(
        "face_height_to_hairline",
        "tr-gn",
        [187.5, 172.5],
        [8.1, 7.5],
        [0.9, 0.92],
        Source::Farkas,
    ),
];

const fn further(
    name: &'static str,
    landmarks: &'static str,
    mean: [f64; 2],
    sd: [f64; 2],
    at_nine: [f64; 2],
    source: Source,
) -> (&'static str, &'static str, Row) {
    (
        name,
        landmarks,
        Row::new(mean, sd, at_nine, [0.0, 0.0], source),
    )
}

/// Hand length and breadth of adults (ANSUR II), children by stature (*designed*: 0.74 of
/// the adult hand at nine).
const HAND_LENGTH: Row = Row::new(
    [193.3, 181.1],
    [9.95, 9.7],
    [0.74, 0.77],
    [0.0, 0.0],
    Source::Ansur,
);
const HAND_BREADTH: Row = Row::new(
    [88.3, 78.2],
    [4.4, 3.9],
    [0.74, 0.77],
    [0.0, 0.0],
    Source::Ansur,
);

/// Returns the position of a landmark, millimetres, world frame. The name of a pair without side
/// selects the left one.
#[must_use]
pub fn landmark_mm(figure: &Figure, names: &Annotations, name: &str) -> Option<DVec3> {
    if let Some(side) = name.strip_prefix("p_") {
        let end = |n: &str| landmark_mm(figure, names, &format!("{n}_{side}"));
        return Some((end("ps")? + end("pi")?) / 2.0);
    }
    let at = names
        .landmark(name)
        .or_else(|| names.landmark(&format!("{name}_l")))?;
    let p = figure
        .meshes
        .get(at.mesh)?
        .positions
        .get(at.vertex as usize)?;
    Some(DVec3::from_array(p.map(f64::from)) * 1e3)
}

/// Returns the distance between the two landmarks of a label such as `n-gn`.
fn distance(
    figure: &Figure,
    names: &Annotations,
    label: &str,
    along: Option<DVec3>,
) -> Option<f64> {
    let (a, b) = label.split_once('-')?;
    let d = landmark_mm(figure, names, a)? - landmark_mm(figure, names, b)?;
    Some(along.map_or_else(|| d.length(), |axis| d.dot(axis).abs()))
}

/// Returns every known distance that can be measured on the figure; those of hands only if their
/// parameters exist.
#[must_use]
pub fn readings(
    figure: &Figure,
    names: &Annotations,
    person: Person,
    hand: Option<&HandParams>,
) -> Vec<Reading> {
    let reading = |name, landmarks, row: &Row, mm: f64| Reading {
        name,
        landmarks,
        mm,
        norm: row.norm_at(person.sex, person.age_years),
        source: row.source.citation(),
    };
    let mut all: Vec<Reading> = known_measures()
        .filter_map(
            |KnownMeasure {
                 name,
                 landmarks,
                 row,
                 along,
             }| {
                Some(reading(
                    name,
                    landmarks,
                    row,
                    distance(figure, names, landmarks, along)?,
                ))
            },
        )
        .collect();
    for (name, landmarks, row) in &FURTHER {
        let along = (*name == "upper_lip_height").then_some(DVec3::Y);
        if let Some(mm) = distance(figure, names, landmarks, along) {
            all.push(reading(name, landmarks, row, mm));
        }
    }
    if let Some(hand) = hand {
        all.push(reading(
            "hand_length",
            "stylion-dactylion",
            &HAND_LENGTH,
            hand.length_m * 1e3,
        ));
        all.push(reading(
            "hand_breadth",
            "metacarpal 2-5",
            &HAND_BREADTH,
            hand.breadth_m * 1e3,
        ));
    }
    all
}

#[cfg(test)]
mod tests {
    use std::fs;
    use std::path::PathBuf;

    use super::*;
    use crate::reference_face::{ReferenceFace, deviation};
    use crate::tests::soundness::{people_built, shipped};
    use raconteur_body::annotation::annotations;
    use raconteur_body::write::to_packed_glb;

    fn yardstick() -> Option<ReferenceFace> {
        let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../../shared/models/ict");
        let read = |name: &str| fs::read_to_string(folder.join(name)).ok();
        let files = read("generic_neutral_mesh.obj").zip(read("vertex_indices.json"));
        let Some((mesh, landmarks)) = files else {
            println!("no yardstick in {}: nothing compared", folder.display());
            return None;
        };
        Some(ReferenceFace::read(&mesh, &landmarks).unwrap_or_else(|e| panic!("{e}")))
    }

    #[test]
    fn faces_and_hands_measure_like_their_sex_and_age() {
        for name in people_built() {
            let (params, built) = shipped(name);
            let all = readings(
                &built.figure,
                &built.annotations,
                params.person,
                Some(&params.hands()),
            );
            let within = all.iter().filter(|r| r.deviations().abs() <= 1.0).count();
            assert!(within >= 20, "{name}: {within} of {}: {all:?}", all.len());
            if name == "sofia"
                && let Some(yardstick) = yardstick()
            {
                let far = deviation(&built.figure, &built.annotations, &yardstick);
                let far = far.unwrap_or_else(|e| panic!("{e}"));
                assert!(far.rms_mm <= 3.0, "{far:?}");
            }
            let glb = to_packed_glb(&built.figure, &built.annotations);
            let mut back = annotations(&glb).unwrap_or_else(|e| panic!("{e}"));
            let mut sent = built.annotations.clone();
            // The file stores landmarks by name.
            back.landmarks.sort_by(|a, b| a.name.cmp(&b.name));
            sent.landmarks.sort_by(|a, b| a.name.cmp(&b.name));
            assert_eq!(back, sent);
        }
    }
}
