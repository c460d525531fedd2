//! Surface of the body model at the head's binding: its faces subdivided twice, and the mapping
//! between positions and faces.

use std::collections::{BTreeMap, BTreeSet};

use raconteur_base::DVec3;

use crate::subdivide::{Stencil, Subdivided, subdivide};

/// Position in a face, 0..1: from its first corner along its first edge and along its last edge.
pub(super) type InFace = [f64; 2];

/// Returns the child of a quad that contains a position, and the position in the child.
fn child([u, v]: InFace) -> (usize, InFace) {
    match (u > 0.5, v > 0.5) {
        (false, false) => (0, [2.0 * u, 2.0 * v]),
        (true, false) => (1, [2.0 * v, 2.0 * (1.0 - u)]),
        (true, true) => (2, [2.0 * (1.0 - u), 2.0 * (1.0 - v)]),
        (false, true) => (3, [2.0 * (1.0 - v), 2.0 * u]),
    }
}

/// Returns the position in a quad of a position in its child.
fn parent(child: usize, [a, b]: InFace) -> InFace {
    let (a, b) = (a / 2.0, b / 2.0);
    match child {
        0 => [a, b],
        1 => [1.0 - b, a],
        2 => [1.0 - a, 1.0 - b],
        _ => [b, 1.0 - a],
    }
}

/// Patch of the body model around some faces, subdivided twice, for binding points to a smooth
/// surface.
pub(super) struct Refined {
    /// Model vertex of each local vertex.
    vertices: Vec<u32>,
    /// Model face of each local face.
    faces: Vec<u32>,
    /// Local index of each model face.
    at: BTreeMap<u32, usize>,
    fine: Subdivided,
}

impl Refined {
    /// Refines the model's faces around the given ones.
    pub(super) fn new(faces: &[[u32; 4]], wanted: BTreeSet<u32>) -> Self {
        let mut near = wanted;
        // Within two steps, a face depends on its neighbours' neighbours.
        for _ in 0..2 {
            let touched: BTreeSet<u32> = near.iter().flat_map(|&f| faces[f as usize]).collect();
            near = (0u32..)
                .zip(faces)
                .filter(|(_, f)| f.iter().any(|v| touched.contains(v)))
                .map(|(i, _)| i)
                .collect();
        }
        let vertices: BTreeSet<u32> = near.iter().flat_map(|&f| faces[f as usize]).collect();
        let index: BTreeMap<u32, u32> = vertices.iter().copied().zip(0u32..).collect();
        let local: Vec<Vec<u32>> = near
            .iter()
            .map(|&f| faces[f as usize].iter().map(|v| index[v]).collect())
            .collect();
        Self {
            fine: subdivide(&local, vertices.len(), 2),
            at: near.iter().copied().zip(0..).collect(),
            faces: near.into_iter().collect(),
            vertices: vertices.into_iter().collect(),
        }
    }

    /// Returns a position in one of the given faces as a weighted sum over the model's vertices.
    pub(super) fn stencil(&self, face: u32, at: InFace) -> Stencil {
        let (first, at) = child(at);
        let (second, [u, v]) = child(at);
        let quad = &self.fine.faces[4 * (4 * self.at[&face] + first) + second];
        let corners = [(1.0 - u) * (1.0 - v), u * (1.0 - v), u * v, (1.0 - u) * v];
        let mut sum: BTreeMap<u32, f64> = BTreeMap::new();
        for (&corner, weight) in quad.iter().zip(corners) {
            for &(i, w) in &self.fine.stencils[corner as usize] {
                *sum.entry(self.vertices[i as usize]).or_default() += w * weight;
            }
        }
        sum.into_iter().collect()
    }

    /// Returns the subdivided vertices for the shape of a person.
    pub(super) fn points(&self, shape: &[DVec3]) -> Vec<DVec3> {
        let own: Vec<DVec3> = self.vertices.iter().map(|&v| shape[v as usize]).collect();
        self.fine.apply(&own)
    }

    /// Returns two triangles for each subdivided face: corners 1, 2, 3 and 1, 3, 4.
    pub(super) fn triangles(&self) -> Vec<[u32; 3]> {
        let quads = self.fine.faces.iter();
        quads
            .flat_map(|q| [[q[0], q[1], q[2]], [q[0], q[2], q[3]]])
            .collect()
    }

    /// Returns the model's face and the position in it for a position in a triangle, given by its
    /// barycentric coordinates.
    pub(super) fn place(&self, triangle: u32, shares: [f64; 3]) -> (u32, InFace) {
        let (quad, is_second) = (triangle as usize / 2, triangle % 2 == 1);
        let [_, b, c] = shares;
        let at = if is_second { [b, b + c] } else { [b + c, c] };
        let at = parent(quad / 4 % 4, parent(quad % 4, at));
        (self.faces[quad / 16], at)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_in_a_child_is_found_in_its_quad_again() {
        for i in 0..16u8 {
            let at = [f64::from(i % 4) / 4.0 + 0.1, f64::from(i / 4) / 4.0 + 0.07];
            let (first, inner) = child(at);
            let (second, innermost) = child(inner);
            let back = parent(first, parent(second, innermost));
            assert!((0..2).all(|k| (back[k] - at[k]).abs() < 1e-12), "{at:?}");
        }
    }

    #[test]
    fn the_place_of_a_triangle_has_its_stencil() {
        let faces = [[0, 1, 4, 3], [1, 2, 5, 4], [3, 4, 7, 6], [4, 5, 8, 7]];
        let shape: Vec<DVec3> = (0..9)
            .map(|i| {
                DVec3::new(
                    f64::from(i % 3),
                    f64::from(i / 3),
                    f64::from(i * i % 5) * 0.1,
                )
            })
            .collect();
        let refined = Refined::new(&faces, (0..4).collect());
        let points = refined.points(&shape);
        for (t, corners) in (0u32..).zip(refined.triangles()) {
            for (k, corner) in corners.into_iter().enumerate() {
                let mut shares = [0.0; 3];
                shares[k] = 1.0;
                let (face, at) = refined.place(t, shares);
                let p: DVec3 = refined
                    .stencil(face, at)
                    .iter()
                    .map(|&(i, w)| shape[i as usize] * w)
                    .sum();
                assert!(p.distance(points[corner as usize]) < 1e-12, "{t} {k}");
            }
        }
    }
}
