//! Closed low-poly solids: tubes, blobs and plates.

use raconteur_base::{DMat3, DVec3, ops};

/// Closed surface of polygons, counter-clockwise from outside; used for bones and other inner
/// parts.
#[derive(Clone, Debug, Default)]
pub struct Solid {
    /// Corner positions, metres.
    pub points: Vec<DVec3>,
    /// Polygons of three or four corners.
    pub faces: Vec<Vec<u32>>,
}

/// Elliptic cross-section: centre and two half axes.
pub type Section = (DVec3, DVec3, DVec3);

impl Solid {
    /// Rings of equally many points joined by quads; a fan closes each end.
    #[must_use]
    pub fn from_rings(rings: &[Vec<DVec3>]) -> Self {
        let mut out = Self::default();
        let n = rings.first().map_or(0, Vec::len);
        for ring in rings {
            out.points.extend(ring);
        }
        let at = |ring: usize, k: usize| (ring * n + k % n) as u32;
        for ring in 1..rings.len() {
            for k in 0..n {
                out.faces.push(vec![
                    at(ring - 1, k),
                    at(ring - 1, k + 1),
                    at(ring, k + 1),
                    at(ring, k),
                ]);
            }
        }
        for (ring, flip) in [(0, true), (rings.len().saturating_sub(1), false)] {
            let Some(points) = rings.get(ring) else {
                continue;
            };
            let middle = out.points.len() as u32;
            out.points.push(points.iter().sum::<DVec3>() / n as f64);
            for k in 0..n {
                let (a, b) = (at(ring, k), at(ring, k + 1));
                out.faces.push(if flip {
                    vec![middle, b, a]
                } else {
                    vec![middle, a, b]
                });
            }
        }
        out.turned_outwards()
    }

    /// Builds a tube of elliptic cross-sections with rounded ends.
    #[must_use]
    pub fn tube(sections: &[Section], n: usize) -> Self {
        let mut all: Vec<Section> = Vec::with_capacity(sections.len() + 2);
        let rounded = |end: Section, inner: Section| {
            let out = (end.0 - inner.0).try_normalize().unwrap_or(DVec3::Y);
            let radius = end.1.length().min(end.2.length());
            (end.0 + out * radius * 0.45, end.1 * 0.62, end.2 * 0.62)
        };
        if let [first, second, ..] = sections {
            all.push(rounded(*first, *second));
        }
        all.extend(sections);
        if let [.., before, last] = sections {
            all.push(rounded(*last, *before));
        }
        let rings: Vec<Vec<DVec3>> = all
            .iter()
            .map(|(centre, a, b)| {
                (0..n)
                    .map(|k| {
                        let (s, c) = ops::sincos(core::f64::consts::TAU * k as f64 / n as f64);
                        *centre + *a * c + *b * s
                    })
                    .collect()
            })
            .collect();
        Self::from_rings(&rings)
    }

    /// Builds a tube along points with two radii: `wide` along `side` (made perpendicular to the
    /// path), `thick` perpendicular to both.
    #[must_use]
    pub fn rod(path: &[(DVec3, f64, f64)], side: DVec3, n: usize) -> Self {
        let sections: Vec<Section> = (0..path.len())
            .map(|i| {
                let before = path[i.saturating_sub(1)].0;
                let after = path[(i + 1).min(path.len() - 1)].0;
                let along = (after - before).try_normalize().unwrap_or(DVec3::Y);
                let across = (side - along * side.dot(along))
                    .try_normalize()
                    .unwrap_or_else(|| along.any_orthonormal_vector());
                let (p, wide, thick) = path[i];
                (p, across * wide, along.cross(across) * thick)
            })
            .collect();
        Self::tube(&sections, n)
    }

    /// Builds an ellipsoid of five rings; the columns of `axes` are its half axes, the first runs
    /// from pole to pole.
    #[must_use]
    pub fn blob(centre: DVec3, axes: DMat3, n: usize) -> Self {
        let rings: Vec<Vec<DVec3>> = (1..6)
            .map(|i| {
                let (s, c) = ops::sincos(core::f64::consts::PI * f64::from(i) / 6.0);
                (0..n)
                    .map(|k| {
                        let (sk, ck) = ops::sincos(core::f64::consts::TAU * k as f64 / n as f64);
                        centre - axes.x_axis * c + (axes.y_axis * ck + axes.z_axis * sk) * s
                    })
                    .collect()
            })
            .collect();
        Self::from_rings(&rings)
    }

    /// Builds a slightly bulging plate between an outline and its copy displaced by `thickness`.
    #[must_use]
    pub fn plate(outline: &[DVec3], thickness: DVec3) -> Self {
        let centre = outline.iter().sum::<DVec3>() / outline.len().max(1) as f64;
        let layer = |shift: f64, shrink: f64| -> Vec<DVec3> {
            outline
                .iter()
                .map(|p| centre + (*p - centre) * shrink + thickness * shift)
                .collect()
        };
        Self::from_rings(&[
            layer(-0.5, 0.86),
            layer(-0.3, 1.0),
            layer(0.3, 1.0),
            layer(0.5, 0.86),
        ])
    }

    /// Returns the enclosed volume: one sixth of the sum of the faces' triple products.
    #[must_use]
    pub fn volume(&self) -> f64 {
        self.faces
            .iter()
            .flat_map(|f| (1..f.len() - 1).map(|i| [f[0], f[i], f[i + 1]]))
            .map(|t| {
                let [a, b, c] = t.map(|i| self.points[i as usize]);
                a.dot(b.cross(c)) / 6.0
            })
            .sum()
    }

    /// Returns the solid with all faces oriented outwards.
    #[must_use]
    pub fn turned_outwards(mut self) -> Self {
        if self.volume() < 0.0 {
            for face in &mut self.faces {
                face.reverse();
            }
        }
        self
    }

    /// Returns the solid with every point transformed by `map`; a mirroring map reverses the faces.
    #[must_use]
    pub fn mapped(mut self, map: impl Fn(DVec3) -> DVec3) -> Self {
        for p in &mut self.points {
            *p = map(*p);
        }
        self.turned_outwards()
    }

    /// Appends the surface of another solid.
    pub fn append(&mut self, other: Self) {
        let base = self.points.len() as u32;
        self.points.extend(other.points);
        self.faces.extend(
            other
                .faces
                .into_iter()
                .map(|f| f.into_iter().map(|v| v + base).collect()),
        );
    }
}
