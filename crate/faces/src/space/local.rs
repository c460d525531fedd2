//! Local modes: small shapes that principal components, which are selected by variance, omit.

use super::FaceSpace;
use crate::error::FaceError;

/// Threshold below which a direction counts as zero, as a share of the longest.
const NONE: f64 = 1e-3;

impl FaceSpace {
    /// Returns the space with additional modes: the directions in which the residual of the faces
    /// correlates with signals, each with one number per face. The new modes are orthonormal, and
    /// uncorrelated over the faces.
    ///
    /// # Errors
    /// Returns an error if faces or signals do not correspond.
    pub fn with_local(&self, faces: &[Vec<f64>], signals: &[Vec<f64>]) -> Result<Self, FaceError> {
        for signal in signals {
            if signal.len() != faces.len() {
                return Err(FaceError::Labels {
                    name: "a signal".to_owned(),
                    found: signal.len(),
                    expected: faces.len(),
                });
            }
        }
        let mut basis: Vec<Vec<f64>> = Vec::new();
        for signal in signals {
            basis.push(self.covariance_with(faces, signal)?);
        }
        let basis = self.orthonormal(basis);
        if basis.is_empty() {
            return Ok(self.clone());
        }
        let along = |face: &Vec<f64>| -> Vec<f64> {
            let part = |direction: &Vec<f64>| {
                let numbers = face.iter().zip(&self.mean).zip(direction);
                numbers.map(|((x, m), d)| (x - m) * d).sum()
            };
            basis.iter().map(part).collect()
        };
        let turned = Self::learn(&faces.iter().map(along).collect::<Vec<_>>())?;
        let local = (0..turned.dimensions()).map(|i| {
            let mut mode = vec![0.0; self.length()];
            for (direction, share) in basis.iter().zip(turned.mode(i)) {
                for (x, d) in mode.iter_mut().zip(direction) {
                    *x += share * d;
                }
            }
            (turned.deviations[i], mode)
        });
        let own = (0..self.dimensions()).map(|i| (self.deviations[i], self.mode(i).to_vec()));
        let mut all: Vec<(f64, Vec<f64>)> = own.chain(local).collect();
        all.sort_by(|a, b| b.0.total_cmp(&a.0));
        Ok(Self {
            mean: self.mean.clone(),
            deviations: all.iter().map(|(deviation, _)| *deviation).collect(),
            modes: all.into_iter().flat_map(|(_, mode)| mode).collect(),
        })
    }

    /// Returns the covariance of the numbers of faces with a signal.
    fn covariance_with(&self, faces: &[Vec<f64>], signal: &[f64]) -> Result<Vec<f64>, FaceError> {
        let count = signal.len().max(1) as f64;
        let mean = signal.iter().sum::<f64>() / count;
        let square = signal.iter().map(|s| (s - mean) * (s - mean)).sum::<f64>() / count;
        // Signals have equal weight, regardless of their units.
        let unit = square.sqrt().max(f64::MIN_POSITIVE);
        let mut sum = vec![0.0; self.length()];
        for (example, (face, s)) in faces.iter().zip(signal).enumerate() {
            if face.len() != self.length() {
                return Err(FaceError::Correspondence {
                    example,
                    found: face.len(),
                    expected: self.length(),
                });
            }
            let weight = (s - mean) / unit / count;
            for ((sum, x), m) in sum.iter_mut().zip(face).zip(&self.mean) {
                *sum += weight * (x - m);
            }
        }
        Ok(sum)
    }

    /// Orthonormalises directions against the modes and each other, with length 1.
    fn orthonormal(&self, directions: Vec<Vec<f64>>) -> Vec<Vec<f64>> {
        let product = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let remove = |from: &mut [f64], along: &[f64]| {
            let share = product(from, along);
            for (x, a) in from.iter_mut().zip(along) {
                *x -= share * a;
            }
        };
        let longest = directions
            .iter()
            .map(|d| product(d, d).sqrt())
            .fold(0.0, f64::max);
        let mut kept: Vec<Vec<f64>> = Vec::new();
        for mut direction in directions {
            // Twice, against rounding.
            for _ in 0..2 {
                for i in 0..self.dimensions() {
                    remove(&mut direction, self.mode(i));
                }
                for other in &kept {
                    remove(&mut direction, other);
                }
            }
            let length = product(&direction, &direction).sqrt();
            if length > NONE * longest {
                direction.iter_mut().for_each(|x| *x /= length);
                kept.push(direction);
            }
        }
        kept
    }
}

#[cfg(test)]
mod tests {
    use raconteur_base::noise;

    use super::*;
    use crate::attribute::Attribute;

    /// Returns test faces with large variation everywhere and a small one at two numbers.
    fn faces() -> (Vec<Vec<f64>>, Vec<f64>) {
        let small: Vec<f64> = (0..200).map(|i| noise::signed(9, i, 0)).collect();
        let face = |i: usize| {
            let large: Vec<f64> = (0..4).map(|k| noise::signed(3, i as u64, k)).collect();
            (0..60_i64)
                .map(|n| {
                    let wide: f64 = (0..4_i64)
                        .map(|k| large[k as usize] * noise::signed(4, k as u64, n))
                        .sum();
                    let fold = if n == 7 || n == 8 {
                        0.05 * small[i]
                    } else {
                        0.0
                    };
                    wide + fold
                })
                .collect()
        };
        ((0..200).map(face).collect(), small)
    }

    #[test]
    fn a_small_form_is_told_by_a_mode_of_its_own() {
        let (faces, small) = faces();
        let space = FaceSpace::learn(&faces)
            .expect("corresponding")
            .truncated(4);
        let told = |space: &FaceSpace| {
            let own: Vec<Vec<f64>> = faces
                .iter()
                .map(|f| space.coefficients(f).expect("corresponding"))
                .collect();
            let attribute = Attribute::learn("fold", space, &own, &small).expect("a direction");
            let mean = small.iter().sum::<f64>() / 200.0;
            let off: f64 = own
                .iter()
                .zip(&small)
                .map(|(face, s)| (attribute.value(space, face) - (s - mean)).powi(2))
                .sum();
            1.0 - off / small.iter().map(|s| (s - mean).powi(2)).sum::<f64>()
        };
        let more = space
            .with_local(&faces, std::slice::from_ref(&small))
            .expect("corresponding");
        assert_eq!(more.dimensions(), 5);
        assert!(
            told(&space) < 0.5 && told(&more) > 0.99,
            "{} {}",
            told(&space),
            told(&more)
        );
        for i in 0..5 {
            for j in 0..=i {
                let product: f64 = more
                    .mode(i)
                    .iter()
                    .zip(more.mode(j))
                    .map(|(a, b)| a * b)
                    .sum();
                assert!(
                    (product - f64::from(u8::from(i == j))).abs() < 1e-9,
                    "the local modes are orthonormal"
                );
            }
        }
        // A redundant signal adds nothing.
        let again = more.with_local(&faces, &[small]).expect("corresponding");
        assert_eq!(again.dimensions(), 5);
        assert!(
            space.with_local(&faces, &[vec![1.0; 3]]).is_err(),
            "a signal of the wrong length is rejected"
        );
    }
}
