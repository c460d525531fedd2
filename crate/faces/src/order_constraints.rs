//! Order constraints that keep skin out of skin. Faces are sums, and a sum of faces with closed
//! lips need not have closed lips: parts that are near each other in a whole head (lip and lip, lid
//! and lid, the sides of a nostril's wing) keep their order, and no part of the skin is turned
//! over. Violating parts yield and take their surroundings along.

use std::collections::BTreeMap;

use raconteur_base::DVec3;
use raconteur_base::self_intersection::{TriangleTree, ViewedSurface};

use crate::blend::VertexNeighbours;
use crate::vertex_lists::VertexLists;

/// Distance below which vertices that face towards or away from each other keep their order,
/// metres.
const NEAR_M: f64 = 2.2e-3;
/// Share of the distance of the reference that is left between them.
const MIN_DISTANCE_SHARE: f64 = 0.8;
/// Distance below which vertices count as coincident, metres.
const SAME_M: f64 = 1e-7;
/// A triangle whose normal has less of the reference's is turned over.
const UPRIGHT: f64 = 0.15;
/// Number of relaxation rounds.
const ROUNDS: usize = 60;
/// Rounds in which skin that passes through skin is smoothed, each about it more widely than the last; and how often in each.
const SMOOTHED: usize = 20;
const SMOOTHINGS: usize = 4;

type Place = [f64; 3];

fn sub(a: Place, b: Place) -> Place {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn dot(a: Place, b: Place) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn normal(places: &[Place], t: &[u32; 3]) -> Place {
    let [a, b, c] = t.map(|v| places[v as usize]);
    let (p, q) = (sub(b, a), sub(c, a));
    [
        p[1] * q[2] - p[2] * q[1],
        p[2] * q[0] - p[0] * q[2],
        p[0] * q[1] - p[1] * q[0],
    ]
}

/// Pair of vertices that keep their order.
#[derive(Clone, Debug)]
struct Pair {
    vertices: [u32; 2],
    /// Unit vector from the second to the first vertex of the pair.
    way: Place,
    /// Minimum separation along the direction, metres.
    least: f64,
}

/// Order constraints of a face model's skin; they correct edited faces whose skin would intersect
/// itself.
#[derive(Clone, Debug)]
pub(crate) struct OrderConstraints {
    reference: Vec<Place>,
    triangles: Vec<[u32; 3]>,
    normals: Vec<Place>,
    pairs: Vec<Pair>,
    /// First vertex at the position of each vertex.
    first: Vec<u32>,
    neighbours: VertexNeighbours,
    /// Pairs and triangles of each vertex, by their numbers.
    pairs_of: VertexLists,
    triangles_of: VertexLists,
    tree: TriangleTree,
    /// Vertices that are close in space, on either side of a fold.
    about: VertexNeighbours,
}

impl OrderConstraints {
    /// Finds the constraints on a reference head without self-intersections; `None` if the
    /// reference has any, or if the triangles do not match its vertices.
    pub(crate) fn find(reference: &[f64], triangles: &[[u32; 3]]) -> Option<Self> {
        let reference = reference.as_chunks::<3>().0.to_vec();
        if reference.is_empty() {
            return None;
        }
        let mut places: BTreeMap<[u64; 3], u32> = BTreeMap::new();
        let first: Vec<u32> = (0u32..)
            .zip(&reference)
            .map(|(v, p)| *places.entry(p.map(f64::to_bits)).or_insert(v))
            .collect();
        let triangles: Vec<[u32; 3]> = triangles
            .iter()
            .map(|t| t.map(|v| first.get(v as usize).copied().unwrap_or(u32::MAX)))
            .filter(|t| t[0] != t[1] && t[1] != t[2] && t[2] != t[0])
            .collect();
        let neighbours = VertexNeighbours::from_triangles(&triangles, reference.len())?;
        let normals: Vec<Place> = triangles.iter().map(|t| normal(&reference, t)).collect();
        let pairs = pairs(&reference, &triangles, &normals, &first, &neighbours);
        let points: Vec<DVec3> = reference.iter().map(|p| DVec3::from_array(*p)).collect();
        Some(Self {
            tree: TriangleTree::from_triangles(&points, &triangles),
            about: about(&reference, &first, &triangles),
            pairs_of: VertexLists::collect(reference.len(), pairs.iter().map(|p| &p.vertices[..])),
            triangles_of: VertexLists::collect(reference.len(), triangles.iter().map(|t| &t[..])),
            reference,
            triangles,
            normals,
            pairs,
            first,
            neighbours,
        })
    }

    /// Moves vertices that violate their order in a shape; the shape has the reference's vertices.
    pub(crate) fn straighten(&self, shape: &mut [f64]) {
        if shape.len() != 3 * self.reference.len() {
            return;
        }
        let mut places: Vec<Place> = shape.as_chunks::<3>().0.to_vec();
        let mut is_any = false;
        // Pairs whose vertices have not moved since the last check are still in order.
        let mut pairs: Vec<u32> = (0..self.pairs.len() as u32).collect();
        let mut triangles: Vec<u32> = (0..self.triangles.len() as u32).collect();
        for _ in 0..ROUNDS {
            let ways = self.apart(&places, &pairs);
            let turned = self.turned(&places, &triangles);
            if ways.is_empty() && turned.is_empty() {
                break;
            }
            is_any = true;
            for (v, by) in &ways {
                let p = &mut places[*v as usize];
                *p = [p[0] + by[0], p[1] + by[1], p[2] + by[2]];
            }
            smooth(&self.neighbours, &self.reference, &mut places, &turned);
            let moved: Vec<u32> = ways.iter().map(|(v, _)| *v).chain(turned).collect();
            pairs = self.pairs_of.about(&moved);
            triangles = self.triangles_of.about(&moved);
        }
        is_any |= self.uncross(&mut places);
        if !is_any {
            return;
        }
        for (v, first) in self.first.iter().enumerate() {
            shape[3 * v..3 * v + 3].copy_from_slice(&places[*first as usize]);
        }
    }

    /// Returns true if a shape has no self-intersections.
    pub(crate) fn is_sound(&self, shape: &[f64]) -> bool {
        let points: Vec<DVec3> = shape
            .as_chunks::<3>()
            .0
            .iter()
            .map(|p| DVec3::from_array(*p))
            .collect();
        self.tree.crossings(&points, &ViewedSurface::All).is_empty()
    }

    /// Smooths the displacements of intersecting skin and its surroundings: the smoother they are,
    /// the more the skin resembles the reference, which has no intersections. Returns true if
    /// anything moved.
    fn uncross(&self, places: &mut [Place]) -> bool {
        let mut points: Vec<DVec3> = places.iter().map(|p| DVec3::from_array(*p)).collect();
        let mut found = self.tree.crossings(&points, &ViewedSurface::Folds);
        let is_any = !found.is_empty();
        for round in 0..SMOOTHED {
            if found.is_empty() {
                break;
            }
            let corners = found.iter().flatten().flat_map(|&t| self.triangles[t]);
            let patch = self.grown(corners.collect(), 1 + round / 2);
            for _ in 0..SMOOTHINGS * (1 + round / 4) {
                smooth(&self.about, &self.reference, places, &patch);
            }
            let mut moved = vec![false; places.len()];
            for &v in &patch {
                moved[v as usize] = true;
                points[v as usize] = DVec3::from_array(places[v as usize]);
            }
            // Triangles whose vertices have not moved are unchanged.
            found = self
                .tree
                .crossings(&points, &ViewedSurface::FoldsAt(&moved));
        }
        is_any
    }

    /// Extends a set of vertices by those within a number of edges.
    fn grown(&self, mut vertices: Vec<u32>, edges: usize) -> Vec<u32> {
        for _ in 0..=edges {
            vertices.sort_unstable();
            vertices.dedup();
            let about: Vec<u32> = vertices
                .iter()
                .flat_map(|&v| self.neighbours.of_vertex(v as usize))
                .copied()
                .collect();
            vertices.extend(about);
        }
        vertices.sort_unstable();
        vertices.dedup();
        vertices
    }

    /// Returns displacements that separate vertices that are too close, for some of the pairs, and
    /// of the vertices around them.
    fn apart(&self, places: &[Place], pairs: &[u32]) -> Vec<(u32, Place)> {
        let mut ways: BTreeMap<u32, (Place, f64)> = BTreeMap::new();
        for pair in pairs.iter().map(|&p| &self.pairs[p as usize]) {
            let [a, b] = pair.vertices;
            let far = dot(sub(places[a as usize], places[b as usize]), pair.way);
            let missing = pair.least - far;
            if missing <= 1e-6 {
                continue;
            }
            for (v, share) in [(a, 0.5), (b, -0.5)] {
                let (way, count) = ways.entry(v).or_default();
                for (x, along) in way.iter_mut().zip(pair.way) {
                    *x += share * missing * along;
                }
                *count += 1.0;
            }
        }
        // Neighbours of a moved vertex move by half unless they move themselves.
        let mut about: BTreeMap<u32, (Place, f64)> = BTreeMap::new();
        for (&v, (way, count)) in &ways {
            for &n in self.neighbours.of_vertex(v as usize) {
                if ways.contains_key(&n) {
                    continue;
                }
                let (sum, all) = about.entry(n).or_default();
                for (x, by) in sum.iter_mut().zip(way) {
                    *x += 0.5 * by / count;
                }
                *all += 1.0;
            }
        }
        let mean = |(v, (way, count)): (u32, (Place, f64))| (v, way.map(|x| x / count));
        ways.into_iter().chain(about).map(mean).collect()
    }

    /// Vertices of those of some triangles that are turned over, and those about them.
    fn turned(&self, places: &[Place], triangles: &[u32]) -> Vec<u32> {
        let mut all = Vec::new();
        for &index in triangles {
            let (t, own) = (
                &self.triangles[index as usize],
                &self.normals[index as usize],
            );
            let now = normal(places, t);
            let sizes = dot(now, now) * dot(*own, *own);
            let along = dot(now, *own);
            if along < UPRIGHT * sizes.sqrt() {
                let about = t
                    .iter()
                    .flat_map(|&v| self.neighbours.of_vertex(v as usize));
                all.extend(about.copied().chain(*t));
            }
        }
        all.sort_unstable();
        all.dedup();
        all
    }
}

/// Smooths the displacements of vertices from the reference towards those of their neighbours.
fn smooth(
    neighbours: &VertexNeighbours,
    reference: &[Place],
    places: &mut [Place],
    vertices: &[u32],
) {
    let way = |places: &[Place], v: u32| sub(places[v as usize], reference[v as usize]);
    let smoothed: Vec<Place> = vertices
        .iter()
        .map(|&v| {
            let near = neighbours.of_vertex(v as usize);
            let own = way(places, v);
            let mut sum = [0.0; 3];
            for by in near.iter().map(|&n| way(places, n)) {
                for (s, x) in sum.iter_mut().zip(by) {
                    *s += x;
                }
            }
            let share = 0.5 / near.len().max(1) as f64;
            core::array::from_fn(|k| reference[v as usize][k] + 0.5 * own[k] + share * sum[k])
        })
        .collect();
    for (&v, p) in vertices.iter().zip(smoothed) {
        places[v as usize] = p;
    }
}

/// Neighbours of each vertex: those along the skin, and those that are near in space.
fn about(places: &[Place], first: &[u32], triangles: &[[u32; 3]]) -> VertexNeighbours {
    let along = triangles
        .iter()
        .flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
    let mut edges: Vec<[u32; 2]> = along.flat_map(|[a, b]| [[a, b], [b, a]]).collect();
    let cells = Cells::from_positions(places, first);
    for (v, other) in cells.pairs() {
        let way = sub(places[v as usize], places[other as usize]);
        if dot(way, way) < NEAR_M * NEAR_M {
            edges.extend([[v, other], [other, v]]);
        }
    }
    VertexNeighbours::of_edges(edges, places.len())
}

/// Vertices by the cells of a spatial grid.
struct Cells<'p> {
    places: &'p [Place],
    cells: BTreeMap<[i64; 3], Vec<u32>>,
}

impl<'p> Cells<'p> {
    /// Builds the cells from one representative vertex per position.
    fn from_positions(places: &'p [Place], first: &[u32]) -> Self {
        let mut cells: BTreeMap<[i64; 3], Vec<u32>> = BTreeMap::new();
        for (v, p) in (0u32..).zip(places) {
            if first[v as usize] == v {
                cells.entry(Self::cell_of(p)).or_default().push(v);
            }
        }
        Self { places, cells }
    }

    fn cell_of(p: &Place) -> [i64; 3] {
        p.map(|x| (x / NEAR_M).floor() as i64)
    }

    /// Pairs that may be nearer than a cell is long, the lower number first.
    fn pairs(&self) -> impl Iterator<Item = (u32, u32)> {
        let all = self.cells.values().flatten().copied();
        all.flat_map(move |v| {
            let [x, y, z] = Self::cell_of(&self.places[v as usize]);
            let about = (-1..=1)
                .flat_map(|i| (-1..=1).flat_map(move |j| (-1..=1).map(move |k| [i, j, k])))
                .filter_map(move |[i, j, k]| self.cells.get(&[x + i, y + j, z + k]));
            about
                .flatten()
                .copied()
                .filter(move |&o| o > v)
                .map(move |o| (v, o))
        })
    }
}

/// Finds vertices that are close in space but not along the skin, and that face towards or away
/// from each other.
fn pairs(
    places: &[Place],
    triangles: &[[u32; 3]],
    normals: &[Place],
    first: &[u32],
    neighbours: &VertexNeighbours,
) -> Vec<Pair> {
    let mut of_vertex = vec![[0.0; 3]; places.len()];
    for (t, n) in triangles.iter().zip(normals) {
        for &v in t {
            for (x, by) in of_vertex[v as usize].iter_mut().zip(n) {
                *x += by;
            }
        }
    }
    let mut all: Vec<(u32, u32)> = Cells::from_positions(places, first).pairs().collect();
    all.sort_unstable();
    let mut found = Vec::new();
    for (v, other) in all {
        let p = &places[v as usize];
        let way = sub(*p, places[other as usize]);
        let length = dot(way, way).sqrt();
        let (n, m) = (of_vertex[v as usize], of_vertex[other as usize]);
        let against = dot(n, m) / (dot(n, n) * dot(m, m)).sqrt().max(f64::MIN_POSITIVE);
        let is_near = length > SAME_M && length < NEAR_M && against < -0.3;
        // The direction crosses a fold rather than following the skin: the normal is along it or
        // against it.
        let along = dot(n, way).abs() / (dot(n, n).sqrt() * length).max(f64::MIN_POSITIVE);
        if is_near && along > 0.5 && !neighbours.of_vertex(v as usize).contains(&other) {
            found.push(Pair {
                vertices: [v, other],
                way: way.map(|x| x / length),
                least: MIN_DISTANCE_SHARE * length,
            });
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use raconteur_base::{noise, ops};

    use super::*;

    const SIDE: u32 = 24;

    /// Returns two sheets, 0.6 mm apart, that face each other like lips.
    fn sheets() -> (Vec<f64>, Vec<[u32; 3]>) {
        let at = |sheet: u32, x: u32, z: u32| (sheet * SIDE + z) * SIDE + x;
        let mut places = Vec::new();
        let mut triangles = Vec::new();
        for sheet in 0..2 {
            for (z, x) in (0..SIDE).flat_map(|z| (0..SIDE).map(move |x| (z, x))) {
                places.extend([
                    f64::from(x) * 1e-3,
                    f64::from(sheet) * 6e-4,
                    f64::from(z) * 1e-3,
                ]);
                if x + 1 == SIDE || z + 1 == SIDE {
                    continue;
                }
                let [a, b, c, d] =
                    [(x, z), (x + 1, z), (x, z + 1), (x + 1, z + 1)].map(|(x, z)| at(sheet, x, z));
                let pair = [[a, c, b], [b, c, d]];
                // The lower lip faces up, the upper one down.
                triangles.extend(if sheet == 0 {
                    pair
                } else {
                    pair.map(|[a, b, c]| [a, c, b])
                });
            }
        }
        (places, triangles)
    }

    #[test]
    fn sheets_that_a_sum_puts_into_each_other_come_apart() {
        let (reference, triangles) = sheets();
        let untangle = OrderConstraints::find(&reference, &triangles).expect("a mesh");
        let count = (SIDE * SIDE) as usize;
        for seed in 0..50 {
            let mut shape = reference.clone();
            let [x, z, deep] = [0, 1, 2].map(|k| noise::unit(seed, k, 0));
            for v in 0..count {
                let [i, j] = [shape[3 * v] - 0.024 * x, shape[3 * v + 2] - 0.024 * z];
                let bump = 2e-3 * (0.2 + deep) * ops::exp(-(i * i + j * j) / 16e-6);
                shape[3 * v + 1] += bump;
                shape[3 * (count + v) + 1] -= 0.3 * bump;
            }
            untangle.straighten(&mut shape);
            let gap = |v: usize| shape[3 * (count + v) + 1] - shape[3 * v + 1];
            let least = (0..count).map(gap).fold(f64::MAX, f64::min);
            assert!(least > 0.0, "{seed}: {least}");
        }
    }

    #[test]
    fn a_shape_in_order_is_left_as_it_is() {
        let (reference, triangles) = sheets();
        let untangle = OrderConstraints::find(&reference, &triangles).expect("a mesh");
        let mut shape: Vec<f64> = reference.iter().map(|x| 1.1 * x + 0.01).collect();
        let before = shape.clone();
        untangle.straighten(&mut shape);
        assert_eq!(shape, before);
        let mut other = vec![0.0; 9];
        untangle.straighten(&mut other);
        assert_eq!(other, [0.0; 9]);
        assert!(
            OrderConstraints::find(&[], &[]).is_none(),
            "an empty mesh has no order constraints"
        );
        assert!(
            OrderConstraints::find(&reference, &[[0, 1, 4 * SIDE * SIDE]]).is_none(),
            "a triangle beyond the mesh has no order constraints"
        );
    }
}
