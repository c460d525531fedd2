//! Points on the skin of a head: the hit of a ray, and its texture coordinates.

use raconteur_base::{DAffine3, DVec3};

use super::{Reshaper, wide};
use raconteur_body::figure::{Figure, Mesh};
use raconteur_body::skeleton::Bone;

/// Point on the skin as the corners of a triangle and their barycentric weights; it denotes the
/// same point on every head.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePoint {
    /// Vertices of the skin.
    pub corners: [u32; 3],
    /// Shares that sum to 1.
    pub shares: [f64; 3],
}

impl SurfacePoint {
    /// Parses three vertices and three weights, one after another; `None` if they are invalid.
    #[must_use]
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "whole numbers from 0 to u32::MAX"
    )]
    pub fn from_numbers(numbers: &[f64]) -> Option<Self> {
        let [a, b, c, shares @ ..] = <[f64; 6]>::try_from(numbers).ok()?;
        let is_index = |x: &f64| *x >= 0.0 && *x <= f64::from(u32::MAX) && x.fract() == 0.0;
        let is_spot = [a, b, c].iter().all(is_index) && shares.iter().all(|x| x.is_finite());
        is_spot.then(|| Self {
            corners: [a, b, c].map(|x| x as u32),
            shares,
        })
    }
}

/// Local mapping from the skin to its texture around a point, used to paint marks without
/// distortion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Chart {
    /// Texture coordinates of the spot.
    pub uv: [f64; 2],
    /// Change of the texture coordinates over a metre of skin to the viewer's right, facing the
    /// face.
    pub right: [f64; 2],
    /// Change of the texture coordinates over a metre of skin upwards.
    pub up: [f64; 2],
}

fn corners(mesh: &Mesh, t: [u32; 3]) -> Option<[DVec3; 3]> {
    let at = |v: u32| mesh.positions.get(v as usize).map(|&p| wide(p));
    let [a, b, c] = t.map(at);
    Some([a?, b?, c?])
}

/// Returns the distance along a ray to a triangle that it hits from outside, and the barycentric
/// weights of the hit (Möller and Trumbore 1997, doi:10.1080/10867651.1997.10487468).
fn intersect(from: DVec3, to: DVec3, [a, b, c]: [DVec3; 3]) -> Option<(f64, [f64; 3])> {
    let (ab, ac) = (b - a, c - a);
    let p = to.cross(ac);
    let volume = ab.dot(p);
    if volume <= 1e-14 {
        return None;
    }
    let off = from - a;
    let u = off.dot(p) / volume;
    let q = off.cross(ab);
    let v = to.dot(q) / volume;
    let far = ac.dot(q) / volume;
    let is_met = u >= 0.0 && v >= 0.0 && u + v <= 1.0 && far > 0.0;
    is_met.then_some((far, [1.0 - u - v, u, v]))
}

impl Reshaper {
    /// Returns the first skin point hit by a ray on a figure produced by this reshaper, in its
    /// current pose: `from` and `to`, its direction, in the world; `skull` is the world from the
    /// skull's joint.
    #[must_use]
    pub fn pick(
        &self,
        figure: &Figure,
        skull: &DAffine3,
        from: DVec3,
        to: DVec3,
    ) -> Option<SurfacePoint> {
        let mesh = figure.meshes.get(self.head)?;
        let bind = figure.inverse_bind.get(Bone::Skull.index())?;
        let bind_from_world = (*skull * *bind).inverse();
        let from = bind_from_world.transform_point3(from);
        let to = bind_from_world.transform_vector3(to);
        let met = self.triangles.iter().filter_map(|t| {
            let (far, shares) = intersect(from, to, corners(mesh, *t)?)?;
            let spot = SurfacePoint {
                corners: *t,
                shares,
            };
            Some((far, spot))
        });
        met.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, spot)| spot)
    }

    /// Returns the chart of a point on the textures of a figure's skin; `None` if the vertices do
    /// not exist, or if the texture coordinates do not change there.
    #[must_use]
    pub fn chart(&self, figure: &Figure, spot: &SurfacePoint) -> Option<Chart> {
        if spot.corners.iter().any(|&v| v as usize >= self.vertices) {
            return None;
        }
        let mesh = figure.meshes.get(self.head)?;
        let [a, b, c] = corners(mesh, spot.corners)?;
        let (ab, ac) = (b - a, c - a);
        let normal = ab.cross(ac).try_normalize()?;
        // On upward-facing skin, forwards is up.
        let upright = if normal.y.abs() > 0.9 {
            DVec3::Z
        } else {
            DVec3::Y
        };
        let up = (upright - normal * upright.dot(normal)).try_normalize()?;
        let right = up.cross(normal);
        let uvs = spot.corners.map(|v| mesh.uvs[v as usize].map(f64::from));
        let edge = |i: usize| [uvs[i][0] - uvs[0][0], uvs[i][1] - uvs[0][1]];
        let (e1, e2) = (edge(1), edge(2));
        let (d11, d12, d22) = (ab.dot(ab), ab.dot(ac), ac.dot(ac));
        let det = d11 * d22 - d12 * d12;
        let along = |way: DVec3| {
            let (w1, w2) = (way.dot(ab), way.dot(ac));
            let s = (w1 * d22 - w2 * d12) / det;
            let t = (w2 * d11 - w1 * d12) / det;
            [s * e1[0] + t * e2[0], s * e1[1] + t * e2[1]]
        };
        let mean = |i: usize| (0..3).map(|k| spot.shares[k] * uvs[k][i]).sum();
        let chart = Chart {
            uv: [mean(0), mean(1)],
            right: along(right),
            up: along(up),
        };
        let [r, u] = [chart.right, chart.up];
        let area = r[0] * u[1] - r[1] * u[0];
        (area.is_finite() && area.abs() > 1e-6).then_some(chart)
    }

    /// Returns the colour texture of the skin, as an index into the figure's images.
    #[must_use]
    pub fn skin_picture(&self) -> Option<usize> {
        self.figure.meshes[self.head].material.maps.base_color
    }
}
