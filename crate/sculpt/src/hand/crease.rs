//! Lines of the palm.

use raconteur_base::{DVec3, curve};

/// Crease line in the palm or at the wrist, which is carved into the skin.
pub(super) struct Crease {
    /// Points in the palm's plane (x, y), mm.
    pub(super) points: &'static [(f64, f64)],
    /// Depth, mm.
    pub(super) depth_mm: f64,
}

/// Lines of the palm: thenar, two transverse, wrist.
pub(super) const CREASES: [Crease; 4] = [
    Crease {
        points: &[
            (31.0, 66.0),
            (22.0, 63.0),
            (13.0, 55.0),
            (7.0, 43.0),
            (4.0, 30.0),
            (4.0, 17.0),
            (6.0, 8.0),
        ],
        depth_mm: 1.0,
    },
    Crease {
        points: &[
            (33.0, 68.0),
            (22.0, 67.0),
            (8.0, 62.0),
            (-8.0, 54.0),
            (-22.0, 46.0),
            (-31.0, 40.0),
        ],
        depth_mm: 0.8,
    },
    Crease {
        points: &[
            (12.0, 88.0),
            (8.0, 80.0),
            (-4.0, 73.0),
            (-18.0, 69.0),
            (-30.0, 66.0),
            (-39.0, 66.0),
        ],
        depth_mm: 0.9,
    },
    Crease {
        points: &[(24.0, 4.0), (12.0, 1.0), (-6.0, 2.0), (-24.0, 4.0)],
        depth_mm: 0.4,
    },
];

impl Crease {
    /// Returns the distance in the palm's plane, mm, and the strength of the line there, 0 to 1 (it
    /// fades at both ends).
    pub(super) fn distance_and_depth(&self, p: DVec3) -> (f64, f64) {
        let mut best = (f64::INFINITY, 0.0);
        let mut length = 0.0;
        for pair in self.points.windows(2) {
            let (ax, ay) = pair[0];
            let (dx, dy) = (pair[1].0 - ax, pair[1].1 - ay);
            let squared = dx * dx + dy * dy;
            let t = (((p.x - ax) * dx + (p.y - ay) * dy) / squared).clamp(0.0, 1.0);
            let (ex, ey) = (p.x - ax - t * dx, p.y - ay - t * dy);
            let d = (ex * ex + ey * ey).sqrt();
            if d < best.0 {
                best = (d, length + t * squared.sqrt());
            }
            length += squared.sqrt();
        }
        let along = best.1 / length;
        (
            best.0,
            curve::smooth(along / 0.12) * curve::smooth((1.0 - along) / 0.15),
        )
    }
}
