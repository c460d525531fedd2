//! Similarity that aligns two point sets: Umeyama 1991, doi:10.1109/34.88573; rotation by unit
//! quaternion, Horn 1987, doi:10.1364/JOSAA.4.000629.

use raconteur_base::{DMat3, DQuat, DVec3};

/// Similarity transform: rotation, uniform scale and translation.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Similarity {
    turn: DQuat,
    pub(crate) scale: f64,
    shift: DVec3,
}

impl Similarity {
    pub(crate) fn apply(&self, p: DVec3) -> DVec3 {
        self.turn * p * self.scale + self.shift
    }

    /// Applies the inverse of [`Similarity::apply`].
    pub(crate) fn undo(&self, p: DVec3) -> DVec3 {
        self.turn.inverse() * ((p - self.shift) / self.scale)
    }

    /// Returns the similarity that maps the first point of each pair closest to the second, in the
    /// least-squares sense.
    pub(crate) fn best(pairs: &[(DVec3, DVec3)]) -> Self {
        let n = pairs.len().max(1) as f64;
        let from = pairs.iter().map(|p| p.0).sum::<DVec3>() / n;
        let to = pairs.iter().map(|p| p.1).sum::<DVec3>() / n;
        let mut m = [[0.0; 3]; 3];
        let mut spread = 0.0;
        for &(a, b) in pairs {
            let (a, b) = ((a - from).to_array(), (b - to).to_array());
            for i in 0..3 {
                for j in 0..3 {
                    m[i][j] += a[i] * b[j];
                }
                spread += a[i] * a[i];
            }
        }
        let [[xx, xy, xz], [yx, yy, yz], [zx, zy, zz]] = m;
        let horn = [
            [xx + yy + zz, yz - zy, zx - xz, xy - yx],
            [yz - zy, xx - yy - zz, xy + yx, zx + xz],
            [zx - xz, xy + yx, yy - xx - zz, yz + zy],
            [xy - yx, zx + xz, yz + zy, zz - xx - yy],
        ];
        // Largest eigenvalue by power iteration; the shift makes it the largest in size.
        let bound: f64 = horn.iter().flatten().map(|x| x.abs()).sum();
        let mut q = [1.0, 0.1, 0.1, 0.1];
        for _ in 0..400 {
            let mut next = [0.0; 4];
            for (i, row) in horn.iter().enumerate() {
                next[i] = bound * q[i] + row.iter().zip(&q).map(|(a, b)| a * b).sum::<f64>();
            }
            let length = next.iter().map(|x| x * x).sum::<f64>().sqrt().max(1e-300);
            q = next.map(|x| x / length);
        }
        let turn = DQuat::from_xyzw(q[1], q[2], q[3], q[0]).normalize();
        let turned = DMat3::from_quat(turn);
        let along: f64 = pairs
            .iter()
            .map(|&(a, b)| (turned * (a - from)).dot(b - to))
            .sum();
        let scale = if spread > 0.0 { along / spread } else { 1.0 };
        Self {
            turn,
            scale,
            shift: to - turn * from * scale,
        }
    }
}
