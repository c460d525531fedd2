//! Surface under construction: quads with vertex weights.

use std::collections::BTreeMap;

use raconteur_base::DVec3;

use super::weights::Weights;
use crate::subdivide::{Stencil, edge_faces, subdivide};
use raconteur_base::surface::vertex_normals;

/// Surface of polygons with skinning weights; the form in which body and clothes are modelled.
#[derive(Clone, Debug, Default)]
pub struct Shell {
    /// Point positions, world, metres.
    pub points: Vec<DVec3>,
    /// Skinning weights of each point.
    pub weights: Vec<Weights>,
    /// Polygons, counter-clockwise from outside.
    pub faces: Vec<Vec<u32>>,
}

impl Shell {
    /// Returns the unit normals of the points.
    #[must_use]
    pub fn normals(&self) -> Vec<DVec3> {
        vertex_normals(&self.points, &self.faces)
    }

    /// Returns only the faces accepted by `keep`, without unused points.
    #[must_use]
    pub fn select(&self, keep: impl FnMut(usize) -> bool) -> Self {
        self.select_named(keep).0
    }

    /// Returns the result of [`Self::select`], with the new index of each kept point.
    #[must_use]
    pub fn select_named(&self, mut keep: impl FnMut(usize) -> bool) -> (Self, Vec<Option<u32>>) {
        let mut renamed: Vec<Option<u32>> = vec![None; self.points.len()];
        let mut out = Self::default();
        for (i, face) in self.faces.iter().enumerate() {
            if !keep(i) {
                continue;
            }
            let face = face
                .iter()
                .map(|&v| {
                    *renamed[v as usize].get_or_insert_with(|| {
                        out.points.push(self.points[v as usize]);
                        out.weights.push(self.weights[v as usize].clone());
                        out.points.len() as u32 - 1
                    })
                })
                .collect();
            out.faces.push(face);
        }
        (out, renamed)
    }

    /// Subdivides the shell `levels` times by the Catmull–Clark scheme; returns it with the
    /// stencils for other values per vertex.
    #[must_use]
    pub fn subdivided(&self, levels: usize) -> (Self, Vec<Stencil>) {
        let fine = subdivide(&self.faces, self.points.len(), levels);
        let shell = Self {
            points: fine.apply(&self.points),
            weights: fine
                .stencils
                .iter()
                .map(|s| Weights::mix(s.iter().map(|&(i, w)| (&self.weights[i as usize], w))))
                .collect(),
            faces: fine.faces,
        };
        (shell, fine.stencils)
    }

    /// Returns the neighbours of each point along edges, and true for each point on a boundary.
    #[must_use]
    pub fn neighbours(&self) -> (Vec<Vec<u32>>, Vec<bool>) {
        let mut around = vec![Vec::new(); self.points.len()];
        let mut rim = vec![false; self.points.len()];
        for ((a, b), sides) in edge_faces(&self.faces) {
            around[a as usize].push(b);
            around[b as usize].push(a);
            if sides.len() == 1 {
                rim[a as usize] = true;
                rim[b as usize] = true;
            }
        }
        (around, rim)
    }

    /// Moves every inner point half way to the mean of its neighbours, for `rounds` rounds.
    pub fn relax(&mut self, rounds: usize) {
        let (around, rim) = self.neighbours();
        for _ in 0..rounds {
            let before = self.points.clone();
            for (v, p) in self.points.iter_mut().enumerate() {
                if !rim[v] && !around[v].is_empty() {
                    let sum: DVec3 = around[v].iter().map(|&i| before[i as usize]).sum();
                    *p = p.lerp(sum / around[v].len() as f64, 0.5);
                }
            }
        }
    }

    /// Moves every inner point outwards to the mean of its neighbours where that lies farther out,
    /// like taut cloth that spans hollows, for `rounds` rounds, by a share 0..1 of each point;
    /// `outward` is a unit vector.
    pub fn bridge(&mut self, rounds: usize, shares: &[f64], outward: &[DVec3]) {
        let (around, rim) = self.neighbours();
        for _ in 0..rounds {
            let before = self.points.clone();
            for (v, p) in self.points.iter_mut().enumerate() {
                if !rim[v] && shares[v] > 0.0 && !around[v].is_empty() {
                    let sum: DVec3 = around[v].iter().map(|&i| before[i as usize]).sum();
                    let out = (sum / around[v].len() as f64 - *p).dot(outward[v]);
                    *p += outward[v] * (shares[v] * out.max(0.0));
                }
            }
        }
    }

    /// Returns the boundary loops, each in the direction of its faces' edges.
    #[must_use]
    pub fn loops(&self) -> Vec<Vec<u32>> {
        let mut directed: BTreeMap<(u32, u32), ()> = BTreeMap::new();
        for face in &self.faces {
            for i in 0..face.len() {
                directed.insert((face[i], face[(i + 1) % face.len()]), ());
            }
        }
        let mut next: BTreeMap<u32, u32> = directed
            .keys()
            .filter(|(a, b)| !directed.contains_key(&(*b, *a)))
            .copied()
            .collect();
        let mut out = Vec::new();
        while let Some((first, mut at)) = next.pop_first() {
            let mut ring = vec![first];
            while at != first {
                ring.push(at);
                match next.remove(&at) {
                    Some(n) => at = n,
                    None => break,
                }
            }
            out.push(ring);
        }
        out
    }

    /// Appends the points and faces of another shell.
    pub fn append(&mut self, other: Self) {
        let base = self.points.len() as u32;
        self.points.extend(other.points);
        self.weights.extend(other.weights);
        self.faces.extend(
            other
                .faces
                .into_iter()
                .map(|f| f.into_iter().map(|v| v + base).collect()),
        );
    }

    /// Returns the mirror image in the sagittal plane.
    #[must_use]
    pub fn mirrored(&self) -> Self {
        Self {
            points: self
                .points
                .iter()
                .map(|p| raconteur_base::mirror_vector(*p))
                .collect(),
            weights: self.weights.iter().map(Weights::mirrored).collect(),
            faces: self
                .faces
                .iter()
                .map(|f| f.iter().rev().copied().collect())
                .collect(),
        }
    }
}
