//! Faces for tests: pseudo-random numbers whose spread decreases as that of faces does.

use raconteur_base::noise;

use crate::space::FaceSpace;

/// Returns random test faces, each with `length` numbers.
pub(crate) fn examples(count: u64, length: i64, seed: u64) -> Vec<Vec<f64>> {
    let pattern = |mode: u64, i: i64| noise::signed(!seed, mode, i);
    (0..count)
        .map(|face| {
            let own: Vec<f64> = (0..length as u64)
                .map(|mode| noise::signed(seed, face, mode as i64) / (1.0 + mode as f64))
                .collect();
            let value = |i: i64| (0..).zip(&own).map(|(mode, c)| c * pattern(mode, i)).sum();
            (0..length).map(value).collect()
        })
        .collect()
}

/// Returns the coefficients of test faces, and a label for each.
pub(crate) fn labelled(
    space: &FaceSpace,
    faces: &[Vec<f64>],
    seed: u64,
) -> (Vec<Vec<f64>>, Vec<f64>) {
    let own = faces
        .iter()
        .map(|face| space.coefficients(face).expect("corresponding"));
    let labels = (0..faces.len() as i64).map(|i| noise::signed(seed, 77, i));
    (own.collect(), labels.collect())
}
