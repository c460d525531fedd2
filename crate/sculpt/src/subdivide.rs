//! Catmull–Clark subdivision as stencils, so that positions, weights, colours and morph targets
//! follow the same rule.
//!
//! Source: Catmull and Clark 1978, doi:10.1016/0010-4485(78)90110-0; boundary curves are cubic
//! B-splines. Limit mask of interior vertices as in Halstead, Kass and DeRose 1993,
//! doi:10.1145/166117.166121.

use std::collections::BTreeMap;

use raconteur_base::DVec3;

/// Weighted sum over the vertices of a cage, which gives a vertex of the subdivided mesh; weights
/// sum to 1.
pub type Stencil = Vec<(u32, f64)>;

/// Polygons after subdivision, and the stencil by which each of their vertices follows from the
/// cage.
#[derive(Clone, Debug)]
pub struct Subdivided {
    /// Quads, or the cage's own polygons at level 0.
    pub faces: Vec<Vec<u32>>,
    /// Stencil over the cage's vertices for each vertex.
    pub stencils: Vec<Stencil>,
}

impl Subdivided {
    /// Applies the stencils to any quantity of the cage's vertices.
    #[must_use]
    pub fn apply<T>(&self, cage: &[T]) -> Vec<T>
    where
        T: Copy + core::ops::Mul<f64, Output = T> + core::iter::Sum,
    {
        self.stencils
            .iter()
            .map(|s| s.iter().map(|&(i, w)| cage[i as usize] * w).sum())
            .collect()
    }
}

fn edge_key(a: u32, b: u32) -> (u32, u32) {
    (a.min(b), a.max(b))
}

/// Returns the faces next to each edge.
#[must_use]
pub fn edge_faces(faces: &[Vec<u32>]) -> BTreeMap<(u32, u32), Vec<u32>> {
    let mut edges: BTreeMap<(u32, u32), Vec<u32>> = BTreeMap::new();
    for (f, face) in faces.iter().enumerate() {
        for i in 0..face.len() {
            let key = edge_key(face[i], face[(i + 1) % face.len()]);
            edges.entry(key).or_default().push(f as u32);
        }
    }
    edges
}

fn combine(terms: &[(u32, f64)], parents: &[Stencil]) -> Stencil {
    let mut sum: BTreeMap<u32, f64> = BTreeMap::new();
    for &(i, w) in terms {
        for &(j, v) in &parents[i as usize] {
            *sum.entry(j).or_insert(0.0) += w * v;
        }
    }
    sum.into_iter().collect()
}

/// Returns the stencil of the middle of a face, scaled by `weight`.
fn face_stencil(face: &[u32], weight: f64) -> Stencil {
    face.iter()
        .map(|&v| (v, weight / face.len() as f64))
        .collect()
}

/// Returns the new position of a vertex, from the edges and faces around it.
fn vertex_terms<'a>(
    v: u32,
    around: &[(u32, u32)],
    is_rim: impl Fn(&(u32, u32)) -> bool,
    faces: impl Iterator<Item = &'a Vec<u32>>,
) -> Stencil {
    let rim: Vec<_> = around.iter().filter(|e| is_rim(e)).collect();
    let mut terms = Vec::new();
    if around.is_empty() {
        terms.push((v, 1.0));
    } else if rim.len() == 2 {
        terms.push((v, 0.75));
        for e in rim {
            terms.push((if e.0 == v { e.1 } else { e.0 }, 0.125));
        }
    } else if !rim.is_empty() {
        // A corner where several boundaries meet stays in place.
        terms.push((v, 1.0));
    } else {
        let n = around.len() as f64;
        // (mean of face points + 2 mean of edge mid-points + (n − 3) v) / n
        terms.push((v, (n - 3.0) / n));
        for face in faces {
            terms.extend(face_stencil(face, 1.0 / (n * n)));
        }
        for e in around {
            terms.push((e.0, 1.0 / (n * n)));
            terms.push((e.1, 1.0 / (n * n)));
        }
    }
    terms
}

/// Performs one subdivision step; stencils are over the given faces' own vertices.
fn step(faces: &[Vec<u32>], vertex_count: usize) -> Subdivided {
    let edges = edge_faces(faces);
    let mut edge_index: BTreeMap<(u32, u32), u32> = BTreeMap::new();
    let mut vertex_edges: Vec<Vec<(u32, u32)>> = vec![Vec::new(); vertex_count];
    let mut vertex_faces: Vec<Vec<u32>> = vec![Vec::new(); vertex_count];
    for &key in edges.keys() {
        let n = edge_index.len() as u32;
        edge_index.insert(key, n);
        vertex_edges[key.0 as usize].push(key);
        vertex_edges[key.1 as usize].push(key);
    }
    for (f, face) in faces.iter().enumerate() {
        for &v in face {
            vertex_faces[v as usize].push(f as u32);
        }
    }
    let identity: Vec<Stencil> = (0..vertex_count as u32).map(|v| vec![(v, 1.0)]).collect();
    let face_stencil = |f: u32, weight: f64| face_stencil(&faces[f as usize], weight);

    let mut stencils: Vec<Stencil> = Vec::with_capacity(vertex_count + edges.len() + faces.len());
    for v in 0..vertex_count as u32 {
        let around = &vertex_edges[v as usize];
        let is_rim = |e: &(u32, u32)| edges[e].len() == 1;
        let around_faces = vertex_faces[v as usize].iter().map(|&f| &faces[f as usize]);
        let terms = vertex_terms(v, around, is_rim, around_faces);
        stencils.push(combine(&terms, &identity));
    }
    for (key, sides) in &edges {
        let mut terms = Vec::new();
        if sides.len() == 2 {
            terms.push((key.0, 0.25));
            terms.push((key.1, 0.25));
            for &f in sides {
                terms.extend(face_stencil(f, 0.25));
            }
        } else {
            terms.push((key.0, 0.5));
            terms.push((key.1, 0.5));
        }
        stencils.push(combine(&terms, &identity));
    }
    let face_base = (vertex_count + edges.len()) as u32;
    let mut quads = Vec::new();
    for (f, face) in faces.iter().enumerate() {
        stencils.push(combine(&face_stencil(f as u32, 1.0), &identity));
        let n = face.len();
        for i in 0..n {
            let next = edge_index[&edge_key(face[i], face[(i + 1) % n])];
            let before = edge_index[&edge_key(face[(i + n - 1) % n], face[i])];
            quads.push(vec![
                face[i],
                vertex_count as u32 + next,
                face_base + f as u32,
                vertex_count as u32 + before,
            ]);
        }
    }
    Subdivided {
        faces: quads,
        stencils,
    }
}

/// Subdivides polygons `levels` times by the Catmull–Clark scheme. Cage vertices keep their
/// indices.
#[must_use]
pub fn subdivide(faces: &[Vec<u32>], vertex_count: usize, levels: usize) -> Subdivided {
    let mut current = Subdivided {
        faces: faces.to_vec(),
        stencils: (0..vertex_count as u32).map(|v| vec![(v, 1.0)]).collect(),
    };
    for _ in 0..levels {
        let next = step(&current.faces, current.stencils.len());
        let stencils = next
            .stencils
            .iter()
            .map(|s| combine(s, &current.stencils))
            .collect();
        current = Subdivided {
            faces: next.faces,
            stencils,
        };
    }
    current
}

/// Returns the position of each vertex on the limit surface, as a stencil over the same mesh.
/// Interior: (n² v + 4 Σ edge + Σ opposite) / (n (n + 5)) on quads; boundary: (1, 4, 1) / 6.
#[must_use]
pub fn limit_stencils(faces: &[Vec<u32>], vertex_count: usize) -> Vec<Stencil> {
    let edges = edge_faces(faces);
    let mut neighbours: Vec<Vec<u32>> = vec![Vec::new(); vertex_count];
    let mut rim: Vec<Vec<u32>> = vec![Vec::new(); vertex_count];
    for (&(a, b), sides) in &edges {
        neighbours[a as usize].push(b);
        neighbours[b as usize].push(a);
        if sides.len() == 1 {
            rim[a as usize].push(b);
            rim[b as usize].push(a);
        }
    }
    let mut opposite: Vec<Vec<u32>> = vec![Vec::new(); vertex_count];
    for face in faces {
        if face.len() == 4 {
            for i in 0..4 {
                opposite[face[i] as usize].push(face[(i + 2) % 4]);
            }
        }
    }
    (0..vertex_count)
        .map(|v| {
            let own = v as u32;
            if rim[v].len() == 2 {
                return vec![
                    (own, 4.0 / 6.0),
                    (rim[v][0], 1.0 / 6.0),
                    (rim[v][1], 1.0 / 6.0),
                ];
            }
            let n = neighbours[v].len() as f64;
            if !rim[v].is_empty() || opposite[v].len() != neighbours[v].len() || n == 0.0 {
                return vec![(own, 1.0)];
            }
            let d = n * (n + 5.0);
            let mut s = vec![(own, n * n / d)];
            s.extend(neighbours[v].iter().map(|&i| (i, 4.0 / d)));
            s.extend(opposite[v].iter().map(|&i| (i, 1.0 / d)));
            s
        })
        .collect()
}

/// Returns the first vertex at the position of each vertex, to a hundredth of a millimetre; metres.
pub(crate) fn firsts(positions: &[DVec3]) -> Vec<u32> {
    let mut first: BTreeMap<[i64; 3], u32> = BTreeMap::new();
    (0u32..)
        .zip(positions)
        .map(|(i, p)| {
            let key = p.to_array().map(|x| (x * 1e5).round() as i64);
            *first.entry(key).or_insert(i)
        })
        .collect()
}

/// Returns the faces with coincident vertices merged to the first, for surfaces with doubled
/// vertices along texture seams.
pub(crate) fn welded(positions: &[DVec3], faces: &[Vec<u32>]) -> Vec<Vec<u32>> {
    let one = firsts(positions);
    let turned = |f: &Vec<u32>| f.iter().map(|&v| one[v as usize]).collect();
    faces.iter().map(turned).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use raconteur_base::surface::vertex_normals;

    fn cube() -> (Vec<Vec<u32>>, Vec<DVec3>) {
        let p = (0..8)
            .map(|i| {
                let s = |b: i32| if i & b == 0 { -1.0 } else { 1.0 };
                DVec3::new(s(1), s(2), s(4))
            })
            .collect();
        let f = [
            [0, 2, 3, 1],
            [4, 5, 7, 6],
            [0, 1, 5, 4],
            [2, 6, 7, 3],
            [0, 4, 6, 2],
            [1, 3, 7, 5],
        ];
        (f.iter().map(|q| q.to_vec()).collect(), p)
    }

    #[test]
    fn a_cube_approaches_its_limit_and_stays_closed() {
        let (faces, p) = cube();
        let limit: Vec<DVec3> = limit_stencils(&faces, 8)
            .iter()
            .map(|s| s.iter().map(|&(i, w)| p[i as usize] * w).sum())
            .collect();
        let fine = subdivide(&faces, 8, 4);
        let q = fine.apply(&p);
        assert_eq!(fine.faces.len(), 6 * 4usize.pow(4));
        assert!(
            edge_faces(&fine.faces).values().all(|f| f.len() == 2),
            "every edge has two faces"
        );
        for v in 0..8 {
            // Each step brings a regular vertex at least four times closer to its limit.
            assert!((q[v] - limit[v]).length() < 0.01, "{} {}", q[v], limit[v]);
        }
        for s in &fine.stencils {
            assert!(
                (s.iter().map(|t| t.1).sum::<f64>() - 1.0).abs() < 1e-12,
                "the weights of the limit point add up to 1"
            );
        }
    }

    #[test]
    fn normals_of_a_cube_point_outwards() {
        let (faces, p) = cube();
        for (n, p) in vertex_normals(&p, &faces).iter().zip(&p) {
            assert!(n.dot(*p) > 1.0, "the normal points outwards");
        }
    }
}
