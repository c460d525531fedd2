//! Transfer of the layout from the reference head to another: a radial basis warp through their
//! landmarks (F&H section 3.1.2, "Creating New Animatable Head Models").

use faer::Mat;
use faer::linalg::solvers::Solve as _;
use raconteur_base::DVec3;

/// Map of space that takes landmarks to landmarks: an affine part and a sum of biharmonic kernels,
/// which in 3D are plain distances. It transfers layouts between heads.
pub(crate) struct Warp {
    at: Vec<DVec3>,
    weights: Vec<DVec3>,
    affine: [DVec3; 4],
}

/// Distance below which two landmarks count as one, mm.
const SAME_MM: f64 = 0.5;

impl Warp {
    /// Builds the map from pairs of positions on the left halves of the reference and of the other
    /// head.
    pub(super) fn mirrored(pairs: &[(DVec3, DVec3)]) -> Self {
        let flip = DVec3::new(-1.0, 1.0, 1.0);
        let both = pairs
            .iter()
            .flat_map(|&(at, to)| [(at, to), (at * flip, to * flip)]);
        Self::new(&both.collect::<Vec<_>>())
    }

    /// Builds the map from pairs of positions on the reference and on the other head.
    pub(crate) fn new(pairs: &[(DVec3, DVec3)]) -> Self {
        let mut kept: Vec<(DVec3, DVec3)> = Vec::new();
        for &(at, to) in pairs {
            if kept.iter().all(|(k, _)| k.distance(at) > SAME_MM) {
                kept.push((at, to));
            }
        }
        let n = kept.len();
        let polynomial = |p: DVec3| [1.0, p.x, p.y, p.z];
        let matrix = Mat::from_fn(n + 4, n + 4, |i, j| match (i < n, j < n) {
            (true, true) => kept[i].0.distance(kept[j].0),
            (true, false) => polynomial(kept[i].0)[j - n],
            (false, true) => polynomial(kept[j].0)[i - n],
            (false, false) => 0.0,
        });
        let wanted = Mat::from_fn(n + 4, 3, |i, k| if i < n { kept[i].1[k] } else { 0.0 });
        let solved = matrix.full_piv_lu().solve(&wanted);
        let row = |i: usize| DVec3::new(solved[(i, 0)], solved[(i, 1)], solved[(i, 2)]);
        Self {
            weights: (0..n).map(row).collect(),
            affine: core::array::from_fn(|k| row(n + k)),
            at: kept.into_iter().map(|(at, _)| at).collect(),
        }
    }

    /// Maps a position of the reference head to the other.
    pub(crate) fn place(&self, p: DVec3) -> DVec3 {
        let [base, x, y, z] = self.affine;
        let kernels = self.at.iter().zip(&self.weights);
        let bent: DVec3 = kernels.map(|(at, &weight)| weight * p.distance(*at)).sum();
        base + x * p.x + y * p.y + z * p.z + bent
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn landmarks_go_to_landmarks_and_what_lies_between_lies_between() {
        let bend = |p: DVec3| DVec3::new(1.1 * p.x, p.y + 0.002 * p.x * p.x, 0.9 * p.z + 3.0);
        let at = |i: i32| {
            DVec3::new(
                f64::from(i % 5) * 9.0,
                f64::from(i / 5) * 9.0,
                f64::from((i * 7) % 11),
            )
        };
        let pairs: Vec<(DVec3, DVec3)> = (0..25).map(|i| (at(i), bend(at(i)))).collect();
        let warp = Warp::mirrored(&pairs);
        for (from, to) in &pairs {
            assert!(
                warp.place(*from).distance(*to) < 1e-6,
                "the landmark is mapped to its target"
            );
        }
        let p = DVec3::new(13.0, 22.0, 5.0);
        assert!(
            warp.place(p).distance(bend(p)) < 0.6,
            "a point between landmarks is near the bend"
        );
    }
}
