//! Impressions of faces (F&H 3.2.2): ratings of the examples, agreement of the raters, and the
//! labels for learning attributes.

mod table;

use std::collections::BTreeMap;

pub use table::{RatingError, Ratings};

/// A mean square of differences that is less is rounding: values differ by hundredths and more.
const MIN_SQUARE: f64 = 1e-12;
/// Number of standard deviations from the mean for a label of 1, as for labels from measures.
const DEVIATIONS: f64 = 2.0;

/// One rating and the line of its table.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Rating {
    value: f64,
    line: usize,
}

/// Ratings of faces for one attribute, by rater and face.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct AttributeRatings {
    /// Ratings, by rater and by index of the face.
    raters: BTreeMap<String, BTreeMap<usize, Rating>>,
}

/// Inter-rater agreement: the intraclass correlation of Shrout and Fleiss 1979
/// (doi:10.1037/0033-2909.86.2.420), two-way random effects, absolute agreement. It is 1 if all
/// raters agree on each face, 0 or less if ratings are unrelated to the face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Agreement {
    /// Number of raters with at least one rating.
    pub raters: usize,
    /// Number of faces rated by all of them; only these count here.
    pub faces: usize,
    /// ICC(2,1): reliability of a single rater. `None` if fewer than two raters rated the same two
    /// faces, or if the values do not determine it.
    pub single: Option<f64>,
    /// ICC(2,k): reliability of the mean of these raters. `None` under the same conditions as
    /// `single`.
    pub average: Option<f64>,
}

impl AttributeRatings {
    /// Computes the agreement of the raters on the faces that all of them rated.
    #[must_use]
    pub fn agreement(&self) -> Agreement {
        let first = self.raters.values().next();
        let is_common = |face: &usize| self.raters.values().all(|rated| rated.contains_key(face));
        let common: Vec<usize> = first
            .into_iter()
            .flat_map(BTreeMap::keys)
            .copied()
            .filter(is_common)
            .collect();
        let row = |rated: &BTreeMap<usize, Rating>| -> Vec<f64> {
            let ratings = common.iter().filter_map(|face| rated.get(face));
            ratings.map(|rating| rating.value).collect()
        };
        let table: Vec<Vec<f64>> = self.raters.values().map(row).collect();
        let [single, average] = correlations(&table);
        Agreement {
            raters: self.raters.len(),
            faces: common.len(),
            single,
            average,
        }
    }

    /// Returns the labels of `examples` examples; `None` for unrated ones. Ratings of further
    /// examples are ignored.
    ///
    /// Each rater's values are expressed in standard deviations from the rater's own mean, so it
    /// does not matter how much of the scale a rater uses. Raters with zero variance are excluded.
    /// The label of a face is the mean over its raters. Labels are shifted to zero mean over the
    /// labelled faces and scaled to ±1 at two standard deviations.
    #[must_use]
    pub fn labels(&self, examples: usize) -> Vec<Option<f64>> {
        let mut sums = vec![(0.0_f64, 0_u32); examples];
        for rated in self.raters.values() {
            let values: Vec<f64> = rated.range(..examples).map(|(_, r)| r.value).collect();
            let Some((mean, deviation)) = spread(&values) else {
                continue;
            };
            for (&face, rating) in rated.range(..examples) {
                if let Some((sum, count)) = sums.get_mut(face) {
                    *sum += (rating.value - mean) / deviation;
                    *count += 1;
                }
            }
        }
        let means: Vec<Option<f64>> = sums
            .into_iter()
            .map(|(sum, count)| (count > 0).then(|| sum / f64::from(count)))
            .collect();
        let known: Vec<f64> = means.iter().flatten().copied().collect();
        let all = spread(&known);
        // Raters that contradict each other in everything leave no label that differs from 0.
        let label = |x: f64| all.map_or(0.0, |(mean, d)| (x - mean) / (DEVIATIONS * d));
        means.into_iter().map(|x| x.map(label)).collect()
    }
}

/// Returns mean and standard deviation; `None` if all values are equal.
fn spread(values: &[f64]) -> Option<(f64, f64)> {
    let count = values.len() as f64;
    let mean = values.iter().sum::<f64>() / count;
    let square = values.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / count;
    (square > MIN_SQUARE).then(|| (mean, square.sqrt()))
}

/// Returns ICC(2,1) and ICC(2,k) of a table with a row per rater and a column per face; `None`
/// where they are undefined.
fn correlations(table: &[Vec<f64>]) -> [Option<f64>; 2] {
    let length = table.first().map_or(0, Vec::len);
    if table.len() < 2 || length < 2 {
        return [None; 2];
    }
    let (raters, faces) = (table.len() as f64, length as f64);
    let all = table.iter().flatten().sum::<f64>() / (raters * faces);
    let of_raters: Vec<f64> = table
        .iter()
        .map(|row| row.iter().sum::<f64>() / faces)
        .collect();
    let of_faces: Vec<f64> = (0..length)
        .map(|face| table.iter().map(|row| row[face]).sum::<f64>() / raters)
        .collect();
    let squares = |means: &[f64]| means.iter().map(|m| (m - all) * (m - all)).sum::<f64>();
    // Mean squares: BMS, JMS and EMS of the paper.
    let between_faces = raters * squares(&of_faces) / (faces - 1.0);
    let between_raters = faces * squares(&of_raters) / (raters - 1.0);
    let rest = table.iter().zip(&of_raters).flat_map(|(row, rater)| {
        let pairs = row.iter().zip(&of_faces);
        pairs.map(move |(value, face)| value - rater - face + all)
    });
    let error = rest.map(|x| x * x).sum::<f64>() / ((faces - 1.0) * (raters - 1.0));
    let bias = (between_raters - error) / faces;
    // Estimated variances may have a negative sum where raters contradict each other.
    let ratio = |whole: f64| (whole > MIN_SQUARE).then_some((between_faces - error) / whole);
    [
        ratio(between_faces + (raters - 1.0) * error + raters * bias),
        ratio(between_faces + bias),
    ]
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// Parses a test table of ratings for one attribute.
    fn rated(lines: &[(&str, usize, f64)]) -> AttributeRatings {
        let mut text = "rater\tface\tattribute\tvalue\n".to_owned();
        for (rater, face, value) in lines {
            text += &format!("{rater}\t{face}\tfriendly\t{value}\n");
        }
        let ratings = Ratings::parse(&text).expect("a table");
        ratings.get("friendly").cloned().unwrap_or_default()
    }

    fn is_near(a: Option<f64>, b: Option<f64>) -> bool {
        match (a, b) {
            (Some(a), Some(b)) => (a - b).abs() < 1e-9,
            (a, b) => a == b,
        }
    }

    /// Four judges of six targets, Table 2 of Shrout and Fleiss 1979, converted to the scale used
    /// here.
    const JUDGES: [[f64; 4]; 6] = [
        [9.0, 2.0, 5.0, 8.0],
        [6.0, 1.0, 3.0, 2.0],
        [8.0, 4.0, 6.0, 8.0],
        [7.0, 1.0, 2.0, 6.0],
        [10.0, 5.0, 6.0, 9.0],
        [6.0, 2.0, 4.0, 7.0],
    ];

    fn judged() -> Vec<(&'static str, usize, f64)> {
        let line = |(face, row): (usize, &[f64; 4])| {
            let judges = ["one", "two", "three", "four"].into_iter().zip(*row);
            judges.map(move |(rater, value)| (rater, face, (value - 5.5) / 2.0))
        };
        JUDGES.iter().enumerate().flat_map(line).collect()
    }

    #[test]
    fn agreement_is_that_of_shrout_and_fleiss() {
        let mut lines = judged();
        let all = rated(&lines).agreement();
        assert_eq!((all.raters, all.faces), (4, 6));
        // The paper has 0.29 and 0.62; these are from its sums of squares.
        assert!(
            (all.single.expect("known") - 0.28976).abs() < 1e-5,
            "{all:?}"
        );
        assert!(
            (all.average.expect("known") - 0.62005).abs() < 1e-5,
            "{all:?}"
        );
        // Faces without a rating by every rater are excluded.
        lines.push(("one", 9, 3.0));
        lines.push(("two", 9, -3.0));
        assert_eq!(rated(&lines).agreement(), all);
    }

    #[test]
    fn agreement_that_cannot_be_told_is_none() {
        let told = |lines: &[(&str, usize, f64)]| {
            let found = rated(lines).agreement();
            (found.raters, found.faces, found.single, found.average)
        };
        assert_eq!(told(&[]), (0, 0, None, None));
        assert_eq!(told(&[("a", 0, 1.0), ("a", 1, 2.0)]), (1, 2, None, None));
        assert_eq!(told(&[("a", 0, 1.0), ("b", 1, 2.0)]), (2, 0, None, None));
        assert_eq!(told(&[("a", 0, 1.0), ("b", 0, 1.0)]), (2, 1, None, None));
        let same = [("a", 0, 1.1), ("a", 1, 1.1), ("b", 0, 1.1), ("b", 1, 1.1)];
        assert_eq!(told(&same), (2, 2, None, None));
        // The formula would give 2.
        let against = [("a", 0, 1.0), ("a", 1, -1.0), ("b", 0, -1.0), ("b", 1, 1.0)];
        assert_eq!(told(&against).3, None);
    }

    #[test]
    fn labels_do_not_hang_on_how_a_rater_uses_the_scale() {
        let lines = judged();
        let labels = rated(&lines).labels(8);
        assert_eq!(labels.len(), 8);
        assert_eq!(labels[6..], [None, None]);
        let known: Vec<f64> = labels.iter().flatten().copied().collect();
        let (mean, deviation) = spread(&known).expect("they differ");
        assert!(
            mean.abs() < 1e-12 && (deviation - 0.5).abs() < 1e-12,
            "the ratings are standardised"
        );
        let mut other = lines.clone();
        for (rater, _, value) in &mut other {
            if *rater == "two" {
                *value = 0.25 * *value + 1.5;
            }
        }
        // A rater who gives equal ratings and one who has rated a single face contribute nothing.
        other.extend((0..6).map(|face| ("same", face, 2.2)));
        other.push(("seldom", 3, -3.0));
        let again = rated(&other).labels(8);
        let pairs = labels.iter().zip(&again);
        assert!(pairs.clone().all(|(a, b)| is_near(*a, *b)), "{again:?}");
    }

    #[test]
    fn a_face_has_the_mean_of_those_who_rated_it() {
        let lines = [
            ("a", 0, -1.0),
            ("a", 1, 1.0),
            ("b", 1, 0.0),
            ("b", 2, 2.0),
            ("c", 5, 2.0),
        ];
        // Scores are −1; the mean of 1 and −1; and 1.
        let unit = DEVIATIONS * (2.0_f64 / 3.0).sqrt();
        let expected = [Some(-1.0 / unit), Some(0.0), Some(1.0 / unit), None];
        let labels = rated(&lines).labels(4);
        let mut pairs = labels.iter().zip(&expected);
        assert!(pairs.all(|(a, b)| is_near(*a, *b)), "{labels:?}");
        assert!(
            rated(&lines).labels(0).is_empty(),
            "too few faces give no labels"
        );
        let against = [("a", 0, 1.0), ("a", 1, -1.0), ("b", 0, -1.0), ("b", 1, 1.0)];
        assert_eq!(rated(&against).labels(2), [Some(0.0), Some(0.0)]);
    }

    proptest! {
        #[test]
        fn labels_and_agreement_stay_in_their_ranges(
            table in prop::collection::btree_map((0..4_usize, 0..6_usize), -6..=6_i32, 0..24),
            examples in 0..7_usize,
        ) {
            let names = ["a", "b", "c", "d"];
            let lines: Vec<(&str, usize, f64)> = table
                .iter()
                .map(|(&(rater, face), &half)| (names[rater], face, f64::from(half) / 2.0))
                .collect();
            let ratings = rated(&lines);
            let agreement = ratings.agreement();
            for part in [agreement.single, agreement.average].into_iter().flatten() {
                prop_assert!(part.is_finite() && part <= 1.0 + 1e-9, "{}", part);
            }
            let labels = ratings.labels(examples);
            prop_assert_eq!(labels.len(), examples);
            let known: Vec<f64> = labels.into_iter().flatten().collect();
            if let Some((mean, deviation)) = spread(&known) {
                prop_assert!(mean.abs() < 1e-9 && (deviation - 0.5).abs() < 1e-9);
            } else {
                prop_assert!(known.iter().all(|label| *label == 0.0));
            }
        }
    }
}
