//! Mean and orthonormal modes of a set of corresponding shapes.

use raconteur_base::DVec3;
use raconteur_body::Mesh;

/// Why a face space could not be made or used.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FaceSpaceError {
    /// There was no example.
    #[error("a face space needs at least one example")]
    Empty,
    /// An example has another number of vertices than the first.
    #[error("example {example} has {found} vertices, the first has {expected}")]
    Correspondence {
        /// Index of the example.
        example: usize,
        /// Vertices it has.
        found: usize,
        /// Vertices it should have.
        expected: usize,
    },
}

/// A linear space of face shapes. Positions in metres, in the examples' common frame.
#[derive(Clone, Debug)]
pub struct FaceSpace {
    mean: Vec<DVec3>,
    /// Orthonormal under the sum of dot products over vertices.
    modes: Vec<Vec<DVec3>>,
}

fn dot(a: &[DVec3], b: &[DVec3]) -> f64 {
    a.iter().zip(b).map(|(p, q)| p.dot(*q)).sum()
}

/// The positions of a mesh as a shape vector.
#[must_use]
fn shape_of(mesh: &Mesh) -> Vec<DVec3> {
    mesh.positions
        .iter()
        .map(|p| DVec3::new(f64::from(p[0]), f64::from(p[1]), f64::from(p[2])))
        .collect()
}

impl FaceSpace {
    /// The space spanned by some figures' face meshes; see [`FaceSpace::from_shapes`].
    ///
    /// # Errors
    /// When there is no mesh or the meshes do not correspond.
    pub fn from_meshes(meshes: &[&Mesh]) -> Result<Self, FaceSpaceError> {
        Self::from_shapes(&meshes.iter().map(|m| shape_of(m)).collect::<Vec<_>>())
    }

    /// The space spanned by examples around their mean, by modified Gram–Schmidt, which
    /// loses no example and needs no order of importance. Examples that add nothing new
    /// (less than a micrometre a vertex, root mean square) add no mode.
    ///
    /// # Errors
    /// When there is no example or the examples do not correspond.
    pub fn from_shapes(examples: &[Vec<DVec3>]) -> Result<Self, FaceSpaceError> {
        let expected = examples.first().ok_or(FaceSpaceError::Empty)?.len();
        if let Some((example, shape)) = examples
            .iter()
            .enumerate()
            .find(|(_, e)| e.len() != expected)
        {
            return Err(FaceSpaceError::Correspondence {
                example,
                found: shape.len(),
                expected,
            });
        }
        let count = examples.len() as f64;
        let mean: Vec<DVec3> = (0..expected)
            .map(|v| examples.iter().map(|e| e[v]).sum::<DVec3>() / count)
            .collect();
        let smallest = 1e-6 * (expected.max(1) as f64).sqrt();
        let mut modes: Vec<Vec<DVec3>> = Vec::new();
        for example in examples {
            let mut rest: Vec<DVec3> = example.iter().zip(&mean).map(|(e, m)| *e - *m).collect();
            for mode in &modes {
                let share = dot(&rest, mode);
                rest.iter_mut()
                    .zip(mode)
                    .for_each(|(r, m)| *r -= *m * share);
            }
            let length = dot(&rest, &rest).sqrt();
            if length > smallest {
                rest.iter_mut().for_each(|r| *r /= length);
                modes.push(rest);
            }
        }
        Ok(Self { mean, modes })
    }

    /// How many independent directions there are.
    #[must_use]
    pub fn dimensions(&self) -> usize {
        self.modes.len()
    }

    /// The mean shape.
    #[must_use]
    pub fn mean(&self) -> &[DVec3] {
        &self.mean
    }

    /// The shape with these coefficients (metres times the square root of the vertex
    /// count); missing ones are zero, further ones are ignored.
    #[must_use]
    pub fn shape(&self, coefficients: &[f64]) -> Vec<DVec3> {
        let mut shape = self.mean.clone();
        for (mode, c) in self.modes.iter().zip(coefficients) {
            shape.iter_mut().zip(mode).for_each(|(s, m)| *s += *m * *c);
        }
        shape
    }

    /// The coefficients of the nearest shape in the space.
    ///
    /// # Errors
    /// When the shape does not correspond.
    pub fn project(&self, shape: &[DVec3]) -> Result<Vec<f64>, FaceSpaceError> {
        if shape.len() != self.mean.len() {
            return Err(FaceSpaceError::Correspondence {
                example: 0,
                found: shape.len(),
                expected: self.mean.len(),
            });
        }
        let rest: Vec<DVec3> = shape.iter().zip(&self.mean).map(|(s, m)| *s - *m).collect();
        Ok(self.modes.iter().map(|mode| dot(&rest, mode)).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use raconteur_base::noise;

    fn examples(n: u64) -> Vec<Vec<DVec3>> {
        (0..n)
            .map(|e| {
                (0..50)
                    .map(|v| {
                        let c = |k| noise::signed(e, k, v) * 0.1;
                        DVec3::new(c(0), c(1), c(2))
                    })
                    .collect()
            })
            .collect()
    }

    #[test]
    fn every_example_lies_in_its_space() {
        let shapes = examples(6);
        let space = FaceSpace::from_shapes(&shapes).expect("corresponding");
        // Deviations from a mean sum to zero: one direction fewer than examples.
        assert_eq!(space.dimensions(), 5);
        for shape in &shapes {
            let again = space.shape(&space.project(shape).expect("corresponding"));
            let worst = again
                .iter()
                .zip(shape)
                .map(|(a, b)| (*a - *b).length())
                .fold(0.0, f64::max);
            assert!(worst < 1e-12, "{worst}");
        }
    }

    #[test]
    fn coefficients_survive_the_way_there_and_back() {
        let space = FaceSpace::from_shapes(&examples(4)).expect("corresponding");
        let c = [0.3, -0.2, 0.05];
        let again = space.project(&space.shape(&c)).expect("corresponding");
        for (a, b) in again.iter().zip(c) {
            assert!((a - b).abs() < 1e-12);
        }
    }

    #[test]
    fn strangers_are_refused() {
        assert_eq!(
            FaceSpace::from_shapes(&[]).err(),
            Some(FaceSpaceError::Empty)
        );
        let mut shapes = examples(2);
        shapes[1].pop();
        assert!(matches!(
            FaceSpace::from_shapes(&shapes),
            Err(FaceSpaceError::Correspondence {
                example: 1,
                found: 49,
                expected: 50
            })
        ));
    }
}
