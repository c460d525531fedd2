//! Sparse linear least squares by the normal equations.

use faer::linalg::solvers::Solve as _;
use faer::sparse::{SparseColMat, Triplet};
use faer::{Mat, Side as Triangle};
use raconteur_base::DVec3;

/// Row of a sparse least-squares matrix: pairs of unknown and coefficient.
pub(crate) type Terms = Vec<(u32, f64)>;

/// Minimises Σ |row · x − value|² for three right-hand sides simultaneously; `None` if the problem
/// has no unique solution.
pub(crate) fn least_squares(
    unknowns: usize,
    rows: &[(Terms, DVec3)],
    free_rows: &[Terms],
) -> Option<Vec<DVec3>> {
    let mut triplets: Vec<Triplet<usize, usize, f64>> = Vec::new();
    // A small multiple of the identity keeps unconstrained vertices solvable.
    triplets.extend((0..unknowns).map(|i| Triplet::new(i, i, 1e-9)));
    for row in rows.iter().map(|(r, _)| r).chain(free_rows) {
        for &(i, a) in row {
            for &(j, b) in row {
                if i >= j {
                    triplets.push(Triplet::new(i as usize, j as usize, a * b));
                }
            }
        }
    }
    let normal =
        SparseColMat::<usize, f64>::try_new_from_triplets(unknowns, unknowns, &triplets).ok()?;
    let mut right = Mat::<f64>::zeros(unknowns, 3);
    for (row, value) in rows {
        for &(i, a) in row {
            for (axis, x) in value.to_array().into_iter().enumerate() {
                right[(i as usize, axis)] += a * x;
            }
        }
    }
    let factor = normal.sp_cholesky(Triangle::Lower).ok()?;
    let x = factor.solve(&right);
    Some(
        (0..unknowns)
            .map(|i| DVec3::new(x[(i, 0)], x[(i, 1)], x[(i, 2)]))
            .collect(),
    )
}
