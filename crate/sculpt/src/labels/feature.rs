//! Features: labels read from points on the skin, and the position of each.

use raconteur_base::{DVec3, Side};

use super::{Affects, Label};
use crate::examples::{Example, measured_mm};

/// Segments that contain a feature (F&H Table 5.1).
const SEGMENTS: [(&str, &[&str]); 27] = [
    ("angles of the face", &["jaw", "cheeks"]),
    ("taper of the face", &["forehead", "jaw"]),
    ("cheeks", &["cheeks"]),
    ("cheekbones", &["cheeks"]),
    ("breadth of the chin", &["chin"]),
    ("protrusion of the chin", &["chin"]),
    (
        "distance between lips and chin",
        &["chin", "peripheral oral region"],
    ),
    ("double chin", &["chin", "rest"]),
    ("nasolabial fold", &["cheeks", "peripheral oral region"]),
    ("opening of the eyes", &["eyes"]),
    ("inclination of the eyes", &["eyes"]),
    ("distance of the eyes", &["eyes"]),
    (
        "curve of the left brow",
        &["eyebrows", "orbits and brow ridge"],
    ),
    (
        "curve of the right brow",
        &["eyebrows", "orbits and brow ridge"],
    ),
    (
        "distance of the brows",
        &["eyebrows", "orbits and brow ridge", "forehead", "nose root"],
    ),
    (
        "distance between brows and eyes",
        &["eyebrows", "orbits and brow ridge"],
    ),
    ("length of the nose", &["nose"]),
    ("breadth of the nose bridge", &["nose"]),
    ("breadth of the alar wings", &["nose"]),
    ("roundness of the alar wings", &["nose"]),
    ("profile of the nose", &["nose"]),
    ("distance between nose and mouth", &["mouth"]),
    ("width of the mouth", &["mouth"]),
    ("lips", &["mouth"]),
    ("line of the lips", &["mouth"]),
    ("size of the ears", &["ears"]),
    ("ears", &["ears"]),
];

/// Displacement for the numerical gradient of a measure, metres.
const STEP_M: f64 = 1e-5;

impl Label {
    /// Returns the segments that contain the feature; `None` for a trait of the whole face.
    #[must_use]
    pub fn segments(&self) -> Option<&'static [&'static str]> {
        let is_own = |(name, _): &&(&str, _)| self.affects == Affects::Shape && *name == self.name;
        SEGMENTS.iter().find(is_own).map(|(_, segments)| *segments)
    }

    /// Returns the half that contains the feature; `None` for both.
    #[must_use]
    pub fn side(&self) -> Option<Side> {
        let sides = [("left", Side::Left), ("right", Side::Right)];
        let named = |(word, _): &(&str, Side)| self.name.split(' ').any(|own| own == *word);
        sides.into_iter().find(named).map(|(_, side)| side)
    }

    /// Returns the change of the label per metre of each coordinate of the skin, by its index, at
    /// an example; `unit` is that of [`Self::unit`]. Empty if the label is not measured on the
    /// skin.
    #[must_use]
    pub fn gradient(&self, at: &Example, unit: f64) -> Vec<(u32, f64)> {
        let mut named: Vec<u32> = at.landmarks.iter().map(|(_, v)| *v).collect();
        named.sort_unstable();
        named.dedup();
        let slope = |change: &dyn Fn(&mut Example, f64)| {
            let read = |by: f64| {
                let mut moved = at.clone();
                change(&mut moved, by);
                moved.measure_again();
                (self.of)(&moved)
            };
            let [before, after] = [-STEP_M, STEP_M].map(read);
            (after.unwrap_or(0.0) - before.unwrap_or(0.0)) / (2.0 * STEP_M * unit)
        };
        let mut all: Vec<(u32, f64)> = Vec::new();
        for index in named.iter().flat_map(|v| 3 * v..3 * v + 3) {
            let by = slope(&|e, way| e.skin[index as usize] += way);
            all.push((index, by));
        }
        for side in 0..2 {
            for (k, place) in at.brows[side].iter().enumerate() {
                let vertex = at.nearest(*place);
                for axis in 0..3 {
                    let by = slope(&|e, way| e.brows[side][k][axis] += 1e3 * way);
                    all.push((3 * vertex + axis as u32, by));
                }
            }
        }
        let most = all.iter().fold(0.0_f64, |most, (_, g)| most.max(g.abs()));
        all.retain(|(_, g)| g.abs() > 1e-6 * most);
        all
    }
}

impl Example {
    /// Updates the measures from the current skin.
    fn measure_again(&mut self) {
        let places = self.skin.as_chunks::<3>().0;
        let place = |name: &str| match name {
            "p_l" => Some(self.organs.eye_centres[0]),
            "p_r" => Some(self.organs.eye_centres[1]),
            _ => {
                let found = self.landmarks.iter().find(|(known, _)| known == name)?;
                places.get(found.1 as usize).map(|p| DVec3::from_array(*p))
            }
        };
        self.measures = measured_mm(&place);
    }

    /// Returns the skin vertex nearest to a position, millimetres in the frame of the head.
    fn nearest(&self, place: DVec3) -> u32 {
        let places = (0u32..).zip(self.skin.as_chunks::<3>().0);
        let far = |p: &[f64; 3]| (DVec3::from_array(*p) * 1e3 - place).length_squared();
        let best = places.min_by(|(_, a), (_, b)| far(a).total_cmp(&far(b)));
        best.map_or(0, |(v, _)| v)
    }

    /// Returns the average of examples: positions, inner parts of the head and brows. Everything
    /// else comes from the first.
    #[must_use]
    pub fn average(examples: &[Self]) -> Option<Self> {
        let mut average = examples.first()?.clone();
        let count = examples.len() as f64;
        let mean = |of: &dyn Fn(&Self) -> f64| examples.iter().map(of).sum::<f64>() / count;
        for i in 0..average.skin.len() {
            average.skin[i] = mean(&|e| e.skin[i]);
        }
        for side in 0..2 {
            for k in 0..average.brows[side].len() {
                for axis in 0..3 {
                    average.brows[side][k][axis] = mean(&|e| e.brows[side][k][axis]);
                }
            }
            for axis in 0..3 {
                average.organs.eye_centres[side][axis] =
                    mean(&|e| e.organs.eye_centres[side][axis]);
            }
        }
        for i in 0..average.draft.fields.len() {
            average.draft.fields[i] = mean(&|e| e.draft.fields[i]);
        }
        average.measure_again();
        Some(average)
    }
}
