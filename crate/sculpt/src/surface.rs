//! Nearest points on a triangle mesh.

use raconteur_base::DVec3;

use crate::cells::Cells;

/// Triangle mesh with spatial queries such as nearest point.
pub(crate) struct Surface {
    pub(crate) points: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
    /// Triangles around each point.
    around: Vec<Vec<u32>>,
    cells: Cells,
    reach: f64,
}

/// Point on a mesh, stored as a triangle's corners and their barycentric weights.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    pub(crate) at: DVec3,
    /// The triangle.
    pub(crate) triangle: u32,
    pub(crate) corners: [u32; 3],
    pub(crate) shares: [f64; 3],
    /// Unit normal of the triangle; zero where it has no area.
    pub(crate) normal: DVec3,
}

impl Surface {
    /// Builds the surface; `reach` is approximately the search distance for nearest points, in the
    /// points' unit.
    pub(crate) fn new(points: Vec<DVec3>, triangles: Vec<[u32; 3]>, reach: f64) -> Self {
        let mut around = vec![Vec::new(); points.len()];
        for (t, triangle) in (0u32..).zip(&triangles) {
            for &v in triangle {
                around[v as usize].push(t);
            }
        }
        let cells = Cells::new(&points, reach);
        Self {
            points,
            triangles,
            around,
            cells,
            reach,
        }
    }

    /// Returns the nearest point that `keep` accepts, within the reach.
    pub(crate) fn nearest(&self, p: DVec3, keep: impl Fn(&Place) -> bool) -> Option<Place> {
        let mut near: Vec<(f64, u32)> = self
            .cells
            .neighbours(p)
            .map(|v| (self.points[v as usize].distance_squared(p), v))
            .collect();
        near.sort_by(|a, b| a.0.total_cmp(&b.0));
        // The nearest triangle nearly always has one of the nearest vertices.
        near.truncate(24);
        let mut triangles: Vec<u32> = near
            .iter()
            .flat_map(|&(_, v)| &self.around[v as usize])
            .copied()
            .collect();
        triangles.sort_unstable();
        triangles.dedup();
        triangles
            .into_iter()
            .map(|t| self.place(t, p))
            .filter(|place| place.at.distance(p) < self.reach && keep(place))
            .min_by(|a, b| {
                a.at.distance_squared(p)
                    .total_cmp(&b.at.distance_squared(p))
            })
    }

    /// Returns all intersections with a line.
    pub(crate) fn along(&self, from: DVec3, direction: DVec3) -> Vec<Place> {
        (0u32..)
            .zip(&self.triangles)
            .filter_map(|(t, corners)| {
                let [a, b, c] = corners.map(|v| self.points[v as usize]);
                let normal = (b - a).cross(c - a);
                let slope = direction.dot(normal);
                if slope.abs() < 1e-9 {
                    return None;
                }
                let p = from + direction * ((a - from).dot(normal) / slope);
                let place = self.place(t, p);
                (place.at.distance(p) < 1e-6).then_some(place)
            })
            .collect()
    }

    fn place(&self, triangle: u32, p: DVec3) -> Place {
        let corners = self.triangles[triangle as usize];
        let [a, b, c] = corners.map(|v| self.points[v as usize]);
        let at = on_triangle(p, [a, b, c]);
        let normal = (b - a).cross(c - a);
        let whole = normal.length_squared();
        let share = |from: DVec3, to: DVec3| {
            if whole > 0.0 {
                (from - at).cross(to - at).dot(normal) / whole
            } else {
                1.0 / 3.0
            }
        };
        Place {
            at,
            triangle,
            corners,
            shares: [share(b, c), share(c, a), share(a, b)],
            normal: normal.normalize_or_zero(),
        }
    }
}

/// Returns the nearest point of a triangle (Ericson 2005, ch. 5.1.5).
pub(crate) fn on_triangle(p: DVec3, [a, b, c]: [DVec3; 3]) -> DVec3 {
    let (ab, ac, ap) = (b - a, c - a, p - a);
    let (d1, d2) = (ab.dot(ap), ac.dot(ap));
    if d1 <= 0.0 && d2 <= 0.0 {
        return a;
    }
    let bp = p - b;
    let (d3, d4) = (ab.dot(bp), ac.dot(bp));
    if d3 >= 0.0 && d4 <= d3 {
        return b;
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        return a + ab * (d1 / (d1 - d3));
    }
    let cp = p - c;
    let (d5, d6) = (ab.dot(cp), ac.dot(cp));
    if d6 >= 0.0 && d5 <= d6 {
        return c;
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        return a + ac * (d2 / (d2 - d6));
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 >= d3 && d5 >= d6 {
        return b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
    }
    let sum = va + vb + vc;
    a + ab * (vb / sum) + ac * (vc / sum)
}
