//! Rendered surface: the cage's limit surface, sampled finely in detailed areas and coarsely
//! elsewhere, without cracks.

use raconteur_base::DVec3;

use super::cage::{Cage, Zone};
use crate::subdivide::{Stencil, Subdivided, limit_stencils, subdivide};

/// Rendered surface of the head: vertices on the limit surface of the cage, and the faces between
/// them.
#[derive(Clone, Debug)]
pub(crate) struct Surface {
    /// Triangles and quads, counter-clockwise from outside.
    pub(crate) faces: Vec<Vec<u32>>,
    /// Zone of each face.
    pub(crate) zones: Vec<Zone>,
    /// The cage subdivided twice.
    fine: Subdivided,
    limit: Vec<Stencil>,
    /// Fine vertex of each rendered vertex.
    used: Vec<u32>,
}

/// Returns true if a zone is rendered from two subdivisions; the rest uses one.
fn is_detailed(zone: Zone) -> bool {
    match zone {
        Zone::Grid(i, j) => i < 7 && (4..22).contains(&j),
        Zone::Eye(r) => r < 6,
        Zone::Mouth(r) => r < 5,
        Zone::Nostril(r) => r < 2,
        Zone::Ear(r) => (3..7).contains(&r),
        Zone::Crown => false,
    }
}

impl Surface {
    /// Samples the limit surface of a cage.
    pub(crate) fn new(cage: &Cage) -> Self {
        let coarse_faces = subdivide(&cage.faces, cage.len(), 1).faces;
        let fine = subdivide(&cage.faces, cage.len(), 2);
        let limit = limit_stencils(&fine.faces, fine.stencils.len());
        let zone_of: Vec<Zone> = cage
            .faces
            .iter()
            .zip(&cage.zones)
            .flat_map(|(f, &z)| core::iter::repeat_n(z, f.len()))
            .collect();
        // A quad of the first level precedes its four children, each of which begins at a corner
        // and goes to the middle of the next edge.
        let middle = |q: usize, edge: usize| fine.faces[4 * q + edge][1];
        let mut split = vec![false; fine.stencils.len()];
        for (q, _) in coarse_faces
            .iter()
            .enumerate()
            .filter(|&(q, _)| is_detailed(zone_of[q]))
        {
            for edge in 0..4 {
                split[middle(q, edge) as usize] = true;
            }
        }
        let (mut faces, mut zones) = (Vec::new(), Vec::new());
        for (q, quad) in coarse_faces.iter().enumerate() {
            if is_detailed(zone_of[q]) {
                faces.extend_from_slice(&fine.faces[4 * q..4 * q + 4]);
            } else {
                let mut outline = Vec::with_capacity(8);
                let mut first_middle = None;
                for (edge, &corner) in quad.iter().enumerate() {
                    outline.push(corner);
                    let m = middle(q, edge);
                    if split[m as usize] {
                        first_middle.get_or_insert(outline.len());
                        outline.push(m);
                    }
                }
                match first_middle {
                    None => faces.push(outline),
                    // A fan about the middle of an edge has no triangle without area.
                    Some(at) => {
                        outline.rotate_left(at);
                        faces.extend(
                            outline[1..]
                                .windows(2)
                                .map(|w| vec![outline[0], w[0], w[1]]),
                        );
                    }
                }
            }
            zones.resize(faces.len(), zone_of[q]);
        }
        let mut index = vec![u32::MAX; fine.stencils.len()];
        let mut used = Vec::new();
        for v in faces.iter_mut().flatten() {
            let slot = &mut index[*v as usize];
            if *slot == u32::MAX {
                *slot = used.len() as u32;
                used.push(*v);
            }
            *v = *slot;
        }
        Self {
            faces,
            zones,
            fine,
            limit,
            used,
        }
    }

    /// Returns the vertex of the cage subdivided twice for each rendered vertex.
    pub(crate) fn fine(&self) -> &[u32] {
        &self.used
    }

    /// Returns the number of vertices.
    pub(crate) fn len(&self) -> usize {
        self.used.len()
    }

    /// Returns the rendered vertex at the limit position of a cage vertex; `None` if none is
    /// rendered.
    pub(crate) fn vertex_of(&self, cage_vertex: usize) -> Option<u32> {
        // Subdivision keeps the initial vertices first.
        let fine = cage_vertex as u32;
        self.used.iter().position(|&v| v == fine).map(|i| i as u32)
    }

    /// Carries any quantity of the cage's vertices to the surface.
    pub(crate) fn apply<T>(&self, cage: &[T]) -> Vec<T>
    where
        T: Copy + core::ops::Mul<f64, Output = T> + core::iter::Sum,
    {
        let fine = self.fine.apply(cage);
        self.used
            .iter()
            .map(|&v| {
                self.limit[v as usize]
                    .iter()
                    .map(|&(i, w)| fine[i as usize] * w)
                    .sum()
            })
            .collect()
    }

    /// Carries a number per cage vertex to the surface.
    pub(crate) fn apply_by(&self, cage: &Cage, value: impl Fn(usize) -> f64) -> Vec<f64> {
        self.apply(&(0..cage.len()).map(value).collect::<Vec<f64>>())
    }
}

/// Faces, cut into triangles.
pub(crate) fn triangles(faces: &[Vec<u32>]) -> impl Iterator<Item = [u32; 3]> + '_ {
    faces
        .iter()
        .flat_map(|f| f[1..].windows(2).map(|w| [f[0], w[0], w[1]]))
}

/// Returns the `count` nearest points of a cloud with weights 1 / (d + soft)², for moving objects
/// attached to the surface by the mean displacement.
pub(crate) fn nearest(points: &[DVec3], p: DVec3, count: usize, soft: f64) -> Vec<(u32, f64)> {
    let mut best: Vec<(f64, u32)> = Vec::with_capacity(count + 1);
    for (i, &q) in points.iter().enumerate() {
        let d = (q - p).length_squared();
        if best.len() < count || best.last().is_some_and(|b| d < b.0) {
            let at = best.partition_point(|b| b.0 <= d);
            best.insert(at, (d, i as u32));
            best.truncate(count);
        }
    }
    let weight = |d: f64| 1.0 / ((d.sqrt() + soft) * (d.sqrt() + soft));
    let sum: f64 = best.iter().map(|b| weight(b.0)).sum();
    best.into_iter()
        .map(|(d, i)| (i, weight(d) / sum))
        .collect()
}
