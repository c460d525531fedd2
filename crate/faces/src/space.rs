//! Face space (F&H 3.2.1, after Blanz and Vetter 1999, doi:10.1145/311535.311556): the mean of
//! corresponding faces and the principal components of their differences from it.
//!
//! A face is a vector of numbers: the coordinates of its vertices in order, or the values of its
//! texture. Shape and texture have separate spaces.

#[cfg(any(test, feature = "learn"))]
mod local;

use crate::error::FaceError;

/// Linear space of faces (F&H 3.2.1): mean, principal components and their standard deviations, for
/// shapes or textures.
#[derive(Clone, Debug, PartialEq)]
pub struct FaceSpace {
    /// The average face.
    mean: Vec<f64>,
    /// Principal components one after another, each as long as the mean; orthonormal, by
    /// decreasing standard deviation.
    modes: Vec<f64>,
    /// Standard deviation of the examples along each mode: σ of equation 3.2.
    deviations: Vec<f64>,
}

/// Numbers of a face that are summed at a time.
const PIECE: usize = 1024;
/// Minimum deviation, as a share of the examples' greatest, that is not treated as rounding error.
#[cfg(any(test, feature = "learn"))]
const MIN_SHARE: f64 = 1e-9;

impl FaceSpace {
    /// Builds a space from its parts; `None` if they are inconsistent.
    #[must_use]
    pub fn from_parts(mean: Vec<f64>, modes: Vec<f64>, deviations: Vec<f64>) -> Option<Self> {
        let fits = modes.len() == mean.len() * deviations.len();
        let is_ordered = deviations.windows(2).all(|pair| pair[0] >= pair[1]);
        let is_positive = deviations.iter().all(|d| d.is_finite() && *d > 0.0);
        (fits && is_ordered && is_positive).then_some(Self {
            mean,
            modes,
            deviations,
        })
    }

    /// Computes the space spanned by the examples, with all of its modes, by the singular value
    /// decomposition of equation 3.3. Runs on one thread, so the same examples give the same bits.
    ///
    /// # Errors
    /// Returns an error if there are fewer than two examples, or they do not correspond.
    #[cfg(any(test, feature = "learn"))]
    pub fn learn(examples: &[Vec<f64>]) -> Result<Self, FaceError> {
        let [first, _, ..] = examples else {
            let found = examples.len();
            return Err(FaceError::TooFew { found });
        };
        let (length, count) = (first.len(), examples.len());
        correspond(examples, length)?;
        let mean: Vec<f64> = (0..length)
            .map(|i| examples.iter().map(|e| e[i]).sum::<f64>() / count as f64)
            .collect();
        let differences = faer::Mat::<f64>::from_fn(length, count, |row, column| {
            examples[column][row] - mean[row]
        });
        // Deviations from a mean sum to zero: one direction fewer than examples.
        let (modes, singular) = decompose(&differences, count - 1)?;
        let root = (count as f64).sqrt();
        Ok(Self {
            mean,
            modes,
            deviations: singular.into_iter().map(|s| s / root).collect(),
        })
    }

    /// Creates the space of the mean plus multiples of a basis, which are independent with standard
    /// deviation 1. The basis need not be orthogonal or linearly independent; the space has one
    /// mode per independent direction.
    ///
    /// # Errors
    /// Returns an error if the basis does not correspond to the mean, or a number is not finite. In
    /// the error, index 0 is the mean; basis vectors count from 1.
    #[cfg(any(test, feature = "learn"))]
    pub fn of_basis(mean: Vec<f64>, basis: &[Vec<f64>]) -> Result<Self, FaceError> {
        correspond(std::iter::once(&mean).chain(basis), mean.len())?;
        let columns =
            faer::Mat::<f64>::from_fn(mean.len(), basis.len(), |row, column| basis[column][row]);
        let (modes, deviations) = decompose(&columns, basis.len())?;
        Ok(Self {
            mean,
            modes,
            deviations,
        })
    }

    /// Returns the space with only its first modes.
    #[must_use]
    pub fn truncated(&self, modes: usize) -> Self {
        let kept = modes.min(self.dimensions());
        Self {
            mean: self.mean.clone(),
            modes: self.modes[..kept * self.mean.len()].to_vec(),
            deviations: self.deviations[..kept].to_vec(),
        }
    }

    /// Returns the number of modes in the space.
    #[must_use]
    pub fn dimensions(&self) -> usize {
        self.deviations.len()
    }

    /// Returns the number of values in a face vector.
    #[must_use]
    pub fn length(&self) -> usize {
        self.mean.len()
    }

    /// Returns the average face.
    #[must_use]
    pub fn mean(&self) -> &[f64] {
        &self.mean
    }

    /// Returns the standard deviations along the modes, decreasing.
    #[must_use]
    pub fn deviations(&self) -> &[f64] {
        &self.deviations
    }

    /// Returns a mode (principal component) by its index.
    ///
    /// # Panics
    /// Panics if there is no mode with this index.
    #[must_use]
    pub fn mode(&self, index: usize) -> &[f64] {
        &self.modes[index * self.length()..(index + 1) * self.length()]
    }

    /// Returns the face with these coefficients, in the units of the examples; missing ones are
    /// zero, further ones are ignored.
    #[must_use]
    pub fn face(&self, coefficients: &[f64]) -> Vec<f64> {
        let mut face = self.mean.clone();
        self.add_to(&mut face, coefficients);
        face
    }

    /// Returns the change of a face caused by coefficients.
    #[must_use]
    pub fn difference(&self, coefficients: &[f64]) -> Vec<f64> {
        let mut difference = vec![0.0; self.length()];
        self.add_to(&mut difference, coefficients);
        difference
    }

    /// Adds modes block by block, so that the sums stay in cache, and four at a time, to reduce
    /// memory traffic.
    fn add_to(&self, sums: &mut [f64], coefficients: &[f64]) {
        let used = &coefficients[..coefficients.len().min(self.dimensions())];
        let (fours, rest) = used.as_chunks::<4>();
        for (piece, sums) in sums.chunks_mut(PIECE).enumerate() {
            let first = piece * PIECE;
            let part = |index: usize| &self.mode(index)[first..first + sums.len()];
            let parts: Vec<&[f64]> = (0..used.len()).map(part).collect();
            for (four, c) in fours.iter().enumerate() {
                let [p, q, r, s] = [0, 1, 2, 3].map(|k| parts[4 * four + k]);
                let modes = p.iter().zip(q).zip(r.iter().zip(s));
                for (sum, ((p, q), (r, s))) in sums.iter_mut().zip(modes) {
                    *sum += (p * c[0] + q * c[1]) + (r * c[2] + s * c[3]);
                }
            }
            for (mode, c) in parts[4 * fours.len()..].iter().zip(rest) {
                for (sum, x) in sums.iter_mut().zip(*mode) {
                    *sum += x * c;
                }
            }
        }
    }

    /// Returns the coefficients of the face in the space that is nearest to a face.
    ///
    /// # Errors
    /// Returns an error if the face does not correspond to the space.
    pub fn coefficients(&self, face: &[f64]) -> Result<Vec<f64>, FaceError> {
        if face.len() != self.length() {
            return Err(FaceError::Correspondence {
                example: 0,
                found: face.len(),
                expected: self.length(),
            });
        }
        let difference: Vec<f64> = face.iter().zip(&self.mean).map(|(x, m)| x - m).collect();
        Ok(self.along(&difference))
    }

    /// Projects a difference between two faces on each mode. Missing numbers count as 0.
    #[must_use]
    pub fn along(&self, difference: &[f64]) -> Vec<f64> {
        let along = |index: usize| dot(difference, self.mode(index));
        (0..self.dimensions()).map(along).collect()
    }

    /// Returns the scalar product of two differences in coefficients, in standard deviations of the
    /// examples (F&H 3.2.2): the cheap form of equation 3.7.
    #[must_use]
    pub fn product(&self, a: &[f64], b: &[f64]) -> f64 {
        let parts = a.iter().zip(b).zip(&self.deviations);
        parts.map(|((a, b), d)| (a / d) * (b / d)).sum()
    }

    /// Returns the root-mean-square error per number of the faces reconstructed with the first
    /// modes only, for each number of modes from none to all.
    ///
    /// # Errors
    /// Returns an error if a face does not correspond to the space.
    pub fn errors_by_modes(&self, faces: &[Vec<f64>]) -> Result<Vec<f64>, FaceError> {
        let mut squares = vec![0.0; self.dimensions() + 1];
        for face in faces {
            let coefficients = self.coefficients(face)?;
            let mut left: f64 = face
                .iter()
                .zip(&self.mean)
                .map(|(value, mean)| (value - mean) * (value - mean))
                .sum();
            squares[0] += left;
            for (sum, c) in squares[1..].iter_mut().zip(&coefficients) {
                left -= c * c;
                *sum += left.max(0.0);
            }
        }
        let numbers = (faces.len() * self.length()).max(1) as f64;
        Ok(squares.into_iter().map(|s| (s / numbers).sqrt()).collect())
    }
}

/// Returns the dot product, in four partial sums for vectorised code; missing elements count as 0.
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let length = a.len().min(b.len());
    let ((a, a_rest), (b, b_rest)) = (a[..length].as_chunks::<4>(), b[..length].as_chunks::<4>());
    let mut sums = [0.0; 4];
    for (a, b) in a.iter().zip(b) {
        for ((sum, a), b) in sums.iter_mut().zip(a).zip(b) {
            *sum += a * b;
        }
    }
    let rest = a_rest.iter().zip(b_rest).map(|(a, b)| a * b).sum::<f64>();
    (sums[0] + sums[1]) + (sums[2] + sums[3]) + rest
}

/// Returns true if each face has the required count of numbers, all finite.
#[cfg(any(test, feature = "learn"))]
fn correspond<'a>(
    faces: impl IntoIterator<Item = &'a Vec<f64>>,
    expected: usize,
) -> Result<(), FaceError> {
    for (example, face) in faces.into_iter().enumerate() {
        let found = face.len();
        if found != expected {
            return Err(FaceError::Correspondence {
                example,
                found,
                expected,
            });
        }
        if !face.iter().all(|x| x.is_finite()) {
            return Err(FaceError::NotFinite { example });
        }
    }
    Ok(())
}

/// Returns the left singular vectors of columns, one after another, and the singular values,
/// decreasing: at most `most`, without those caused by rounding. Runs on one thread, so the same
/// columns give the same bits.
#[cfg(any(test, feature = "learn"))]
fn decompose(columns: &faer::Mat<f64>, most: usize) -> Result<(Vec<f64>, Vec<f64>), FaceError> {
    let is_zero = |column: usize| (0..columns.nrows()).all(|row| columns[(row, column)] == 0.0);
    if (0..columns.ncols()).all(is_zero) {
        return Ok((Vec::new(), Vec::new()));
    }
    faer::set_global_parallelism(faer::Par::Seq);
    let Ok(svd) = columns.thin_svd() else {
        let found = columns.ncols();
        return Err(FaceError::TooFew { found });
    };
    let singular = svd.S().column_vector();
    let greatest = (0..singular.nrows())
        .map(|i| singular[i])
        .fold(0.0, f64::max);
    let kept = (0..singular.nrows().min(most))
        .take_while(|&i| singular[i] > MIN_SHARE * greatest)
        .count();
    let mut vectors = Vec::with_capacity(kept * columns.nrows());
    for column in 0..kept {
        let vector = svd.U().col(column);
        // Both signs are principal components; this choice does not depend on the decomposition.
        let sense = vector.iter().fold(
            0.0_f64,
            |most, x| {
                if x.abs() > most.abs() { *x } else { most }
            },
        );
        vectors.extend(vector.iter().map(|x| x * sense.signum()));
    }
    Ok((vectors, (0..kept).map(|i| singular[i]).collect()))
}

#[cfg(test)]
mod of_basis;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample::examples;

    pub(super) fn distance(a: &[f64], b: &[f64]) -> f64 {
        let square: f64 = a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum();
        square.sqrt()
    }

    #[test]
    fn every_example_lies_in_its_space() {
        let faces = examples(12, 90, 1);
        let space = FaceSpace::learn(&faces).expect("corresponding");
        assert_eq!((space.dimensions(), space.length()), (11, 90));
        for face in &faces {
            let again = space.face(&space.coefficients(face).expect("corresponding"));
            assert!(
                distance(&again, face) < 1e-12,
                "the example is restored by its coefficients"
            );
        }
        let errors = space.errors_by_modes(&faces).expect("corresponding");
        assert!(
            errors.windows(2).all(|pair| pair[1] <= pair[0] + 1e-12),
            "more modes do not increase the error"
        );
        assert!(errors[0] > 0.01 && errors[11] < 1e-7, "{errors:?}");
    }

    #[test]
    fn modes_are_orthonormal_and_deviations_those_of_the_examples() {
        let faces = examples(40, 60, 2);
        let space = FaceSpace::learn(&faces).expect("corresponding");
        for i in 0..space.dimensions() {
            for j in 0..=i {
                let product: f64 = space
                    .mode(i)
                    .iter()
                    .zip(space.mode(j))
                    .map(|(a, b)| a * b)
                    .sum();
                assert!(
                    (product - f64::from(u8::from(i == j))).abs() < 1e-12,
                    "{i} {j}"
                );
            }
        }
        let along: Vec<Vec<f64>> = faces
            .iter()
            .map(|face| space.coefficients(face).expect("corresponding"))
            .collect();
        for (i, deviation) in space.deviations().iter().enumerate() {
            let square: f64 = along.iter().map(|c| c[i] * c[i]).sum();
            assert!(
                ((square / 40.0).sqrt() - deviation).abs() < 1e-12,
                "the deviation of the mode is that of the examples"
            );
        }
    }

    #[test]
    fn the_same_examples_give_the_same_bits() {
        let faces = examples(20, 45, 3);
        assert_eq!(FaceSpace::learn(&faces), FaceSpace::learn(&faces));
    }

    #[test]
    fn strangers_are_refused() {
        assert_eq!(FaceSpace::learn(&[]), Err(FaceError::TooFew { found: 0 }));
        let mut faces = examples(3, 9, 4);
        faces[2].pop();
        let wrong = FaceError::Correspondence {
            example: 2,
            found: 8,
            expected: 9,
        };
        assert_eq!(FaceSpace::learn(&faces), Err(wrong));
        faces[2].push(f64::NAN);
        assert_eq!(
            FaceSpace::learn(&faces),
            Err(FaceError::NotFinite { example: 2 })
        );
        assert_eq!(
            FaceSpace::from_parts(vec![0.0; 3], vec![0.0; 5], vec![1.0]),
            None
        );
        assert_eq!(
            FaceSpace::from_parts(vec![0.0; 2], vec![0.0; 4], vec![1.0, 2.0]),
            None
        );
    }
}
