//! Self-intersections of surfaces.
//!
//! Two triangles without a common corner cross when an edge of one passes through the inside of the
//! other; coplanar triangles do not. Candidates come from a tree of boxes, so that a whole head
//! takes milliseconds.

use crate::DVec3;

/// Maximum number of triangles in a leaf of the tree.
const LEAF: usize = 4;
/// Normals of less than this cosine between them may be of a fold.
const ALIKE: f64 = 0.8;

/// Returns true if an edge of one triangle passes through the other.
#[must_use]
pub fn cross(a: &[DVec3; 3], b: &[DVec3; 3]) -> bool {
    let through = |t: &[DVec3; 3], p: DVec3, q: DVec3| {
        let n = (t[1] - t[0]).cross(t[2] - t[0]);
        let (dp, dq) = ((p - t[0]).dot(n), (q - t[0]).dot(n));
        if dp * dq >= 0.0 {
            return false;
        }
        let x = p.lerp(q, dp / (dp - dq));
        (0..3).all(|k| n.cross(t[(k + 1) % 3] - t[k]).dot(x - t[k]) >= 0.0)
    };
    (0..3).any(|k| through(a, b[k], b[(k + 1) % 3]) || through(b, a[k], a[(k + 1) % 3]))
}

/// Returns pairs of triangles that share no corner and cross, by their numbers, the lower one
/// first. Coincident points must be one point; any unit of length. Triangles with invalid or
/// non-finite points cross nothing.
#[must_use]
pub fn crossings(points: &[DVec3], triangles: &[[u32; 3]]) -> Vec<[usize; 2]> {
    TriangleTree::from_triangles(points, triangles).crossings(points, &ViewedSurface::All)
}

/// Part of a surface in which to search for self-intersections.
#[derive(Clone, Debug)]
pub enum ViewedSurface<'v> {
    /// Everywhere.
    All,
    /// Folds only: a part whose normals all point to one side of some plane does not cross itself
    /// (Volino and Magnenat Thalmann 1994, doi:10.1111/1467-8659.1330155), and takes no time.
    Folds,
    /// Folds only, and only pairs of triangles with at least one marked vertex.
    FoldsAt(&'v [bool]),
}

/// Bounding volume hierarchy of triangles that finds self-intersections. Built from one shape of a
/// surface, it also serves others; the more similar they are, the faster.
#[derive(Clone, Debug)]
pub struct TriangleTree {
    triangles: Vec<[u32; 3]>,
    /// Triangle numbers in the order of the leaves.
    order: Vec<u32>,
    /// The root first; the left part of each node follows it.
    nodes: Vec<Node>,
}

#[derive(Clone, Copy, Debug)]
struct Node {
    /// First triangle of the node in the sorted order.
    from: u32,
    to: u32,
    /// Index of the right child; 0 for a leaf.
    right: u32,
}

/// Bounds of a node's triangles and of their unit normals.
#[derive(Clone, Copy)]
struct NodeBounds {
    low: DVec3,
    high: DVec3,
    normal_low: DVec3,
    normal_high: DVec3,
    /// True if one of them has a marked vertex.
    is_marked: bool,
}

impl NodeBounds {
    const EMPTY: Self = Self {
        low: DVec3::INFINITY,
        high: DVec3::NEG_INFINITY,
        normal_low: DVec3::INFINITY,
        normal_high: DVec3::NEG_INFINITY,
        is_marked: false,
    };

    fn from_triangle([a, b, c]: [DVec3; 3], is_marked: bool) -> Self {
        let normal = (b - a).cross(c - a).normalize_or_zero();
        Self {
            low: a.min(b).min(c),
            high: a.max(b).max(c),
            normal_low: normal,
            normal_high: normal,
            is_marked,
        }
    }

    fn with(self, other: &Self) -> Self {
        Self {
            low: self.low.min(other.low),
            high: self.high.max(other.high),
            normal_low: self.normal_low.min(other.normal_low),
            normal_high: self.normal_high.max(other.normal_high),
            is_marked: self.is_marked || other.is_marked,
        }
    }

    fn misses(&self, other: &Self) -> bool {
        self.low.cmpgt(other.high).any() || other.low.cmpgt(self.high).any()
    }

    /// Returns true if all normals of one are within a right angle of all of the other.
    fn looks_like(&self, other: &Self) -> bool {
        let ends = |a: DVec3| [a * other.normal_low, a * other.normal_high];
        let ([p, q], [r, s]) = (ends(self.normal_low), ends(self.normal_high));
        p.min(q).min(r).min(s).element_sum() > ALIKE
    }
}

/// Query state for one shape.
struct CrossingQuery<'t> {
    tree: &'t TriangleTree,
    points: &'t [DVec3],
    /// Bounds of each triangle in the sorted order.
    leaves: Vec<NodeBounds>,
    bounds: Vec<NodeBounds>,
    in_folds: bool,
    only_marked: bool,
    found: Vec<[usize; 2]>,
}

impl TriangleTree {
    /// Triangles by where they are among these points; those that name other points, or points that are not finite, are
    /// left out.
    #[must_use]
    pub fn from_triangles(points: &[DVec3], triangles: &[[u32; 3]]) -> Self {
        let is_finite = |v: &u32| points.get(*v as usize).is_some_and(|p| p.is_finite());
        let middle = |t: &[u32; 3]| t.iter().map(|&v| points[v as usize]).sum::<DVec3>();
        let sound = (0u32..).zip(triangles);
        let sound = sound.filter(|(_, t)| t.iter().all(is_finite));
        let mut all: Vec<(u32, DVec3)> = sound.map(|(i, t)| (i, middle(t))).collect();
        let mut tree = Self {
            triangles: triangles.to_vec(),
            order: Vec::new(),
            nodes: Vec::new(),
        };
        if !all.is_empty() {
            tree.split(&mut all, 0);
            tree.order = all.into_iter().map(|(i, _)| i).collect();
        }
        tree
    }

    /// Makes a node of triangles, the first of which is `from`th in the order, and those below it.
    fn split(&mut self, all: &mut [(u32, DVec3)], from: u32) {
        let node = self.nodes.len();
        self.nodes.push(Node {
            from,
            to: from + all.len() as u32,
            right: 0,
        });
        if all.len() <= LEAF {
            return;
        }
        let low = all.iter().fold(DVec3::INFINITY, |low, (_, p)| low.min(*p));
        let high = all
            .iter()
            .fold(DVec3::NEG_INFINITY, |high, (_, p)| high.max(*p));
        let size = (high - low).to_array();
        let axis = (0..3)
            .max_by(|&a, &b| size[a].total_cmp(&size[b]))
            .unwrap_or(0);
        let half = all.len() / 2;
        all.select_nth_unstable_by(half, |a, b| {
            a.1[axis].total_cmp(&b.1[axis]).then(a.0.cmp(&b.0))
        });
        let (left, right) = all.split_at_mut(half);
        self.split(left, from);
        self.nodes[node].right = self.nodes.len() as u32;
        self.split(right, from + half as u32);
    }

    /// Returns pairs of triangles that share no corner and cross in a shape, by their numbers, the
    /// lower one first, in order. Empty if the shape lacks points that the tree was built with.
    #[must_use]
    pub fn crossings(&self, points: &[DVec3], looked: &ViewedSurface<'_>) -> Vec<[usize; 2]> {
        let named = self.order.iter().flat_map(|&t| self.triangles[t as usize]);
        let has_all = named.max().is_some_and(|v| (v as usize) < points.len());
        if !has_all {
            return Vec::new();
        }
        let marks = match looked {
            ViewedSurface::FoldsAt(marks) => Some(*marks),
            _ => None,
        };
        let leaves = self.leaves(points, marks);
        let mut look = CrossingQuery {
            tree: self,
            points,
            bounds: self.bounds(&leaves),
            leaves,
            in_folds: !matches!(looked, ViewedSurface::All),
            only_marked: marks.is_some(),
            found: Vec::new(),
        };
        look.within(0);
        look.found.sort_unstable();
        look.found
    }

    fn leaves(&self, points: &[DVec3], marks: Option<&[bool]>) -> Vec<NodeBounds> {
        let is_marked = |v: u32| marks.is_some_and(|m| m.get(v as usize) == Some(&true));
        let bound = |&t: &u32| {
            let [a, b, c] = self.triangles[t as usize];
            let corners = [points[a as usize], points[b as usize], points[c as usize]];
            NodeBounds::from_triangle(corners, is_marked(a) || is_marked(b) || is_marked(c))
        };
        self.order.iter().map(bound).collect()
    }

    fn bounds(&self, leaves: &[NodeBounds]) -> Vec<NodeBounds> {
        let mut bounds = vec![NodeBounds::EMPTY; self.nodes.len()];
        for (i, node) in self.nodes.iter().enumerate().rev() {
            bounds[i] = if node.right == 0 {
                let own = leaves[node.from as usize..node.to as usize].iter();
                own.fold(NodeBounds::EMPTY, NodeBounds::with)
            } else {
                bounds[i + 1].with(&bounds[node.right as usize])
            };
        }
        bounds
    }
}

impl CrossingQuery<'_> {
    /// Returns true if nothing in a node crosses anything in another, or in the same node.
    fn is_clear(&self, a: usize, b: usize) -> bool {
        let [p, q] = [a, b].map(|node| &self.bounds[node]);
        (self.only_marked && !p.is_marked && !q.is_marked)
            || p.misses(q)
            || (self.in_folds && p.looks_like(q))
    }

    fn within(&mut self, node: usize) {
        if self.is_clear(node, node) {
            return;
        }
        let own = self.tree.nodes[node];
        if own.right == 0 {
            for i in own.from..own.to {
                for j in own.from..i {
                    self.test(i, j);
                }
            }
            return;
        }
        let (left, right) = (node + 1, own.right as usize);
        self.within(left);
        self.within(right);
        self.between(left, right);
    }

    fn between(&mut self, a: usize, b: usize) {
        if self.is_clear(a, b) {
            return;
        }
        let [p, q] = [a, b].map(|node| self.tree.nodes[node]);
        match (p.right, q.right) {
            (0, 0) => {
                for i in p.from..p.to {
                    for j in q.from..q.to {
                        self.test(i, j);
                    }
                }
            }
            // The larger box is split.
            (right, other) if right != 0 && (other == 0 || p.to - p.from >= q.to - q.from) => {
                self.between(a + 1, b);
                self.between(right as usize, b);
            }
            (_, right) => {
                self.between(a, b + 1);
                self.between(a, right as usize);
            }
        }
    }

    fn test(&mut self, i: u32, j: u32) {
        if self.leaves[i as usize].misses(&self.leaves[j as usize]) {
            return;
        }
        let [i, j] = [i, j].map(|k| self.tree.order[k as usize] as usize);
        let (a, b) = (&self.tree.triangles[i], &self.tree.triangles[j]);
        if a.iter().any(|v| b.contains(v)) {
            return;
        }
        let [p, q] = [a, b].map(|t| t.map(|v| self.points[v as usize]));
        if cross(&p, &q) {
            self.found.push([i.min(j), i.max(j)]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::noise;

    #[test]
    fn crossings_are_found_and_neighbours_are_not() {
        let v = DVec3::new;
        let sheet = [
            v(0.0, 0.0, 0.0),
            v(3.0, 0.0, 0.0),
            v(0.0, 3.0, 0.0),
            v(3.0, 3.0, 0.0),
        ];
        let folded = [v(1.0, 1.0, -1.0), v(1.2, 1.0, 1.0), v(1.0, 1.3, 1.0)];
        let far = [v(9.0, 9.0, -1.0), v(9.2, 9.0, 1.0), v(9.0, 9.3, 1.0)];
        let points: Vec<DVec3> = [&sheet[..], &folded, &far].concat();
        let triangles = [[0, 1, 2], [1, 3, 2], [4, 5, 6], [7, 8, 9]];
        assert_eq!(crossings(&points, &triangles), [[0, 2]]);
        let points: Vec<DVec3> = points.iter().map(|p| *p * 1e-3).collect();
        assert_eq!(crossings(&points, &triangles), [[0, 2]]);
    }

    #[test]
    fn what_a_tree_finds_is_what_all_pairs_give() {
        for seed in 0..20 {
            let at = |i: u64, k: u64| noise::signed(seed, 3 * i + k, 0);
            let points: Vec<DVec3> = (0..90)
                .map(|i| DVec3::new(at(i, 0), at(i, 1), 0.4 * at(i, 2)))
                .collect();
            let triangles: Vec<[u32; 3]> = (0..60)
                .map(|i| [i, (7 * i + 13) % 90, (i + 29) % 90])
                .filter(|t| t[0] != t[1] && t[1] != t[2] && t[2] != t[0])
                .collect();
            let corners = |i: usize| triangles[i].map(|v| points[v as usize]);
            let all =
                (0..triangles.len()).flat_map(|i| (i + 1..triangles.len()).map(move |j| [i, j]));
            let wanted: Vec<[usize; 2]> = all
                .filter(|&[i, j]| {
                    let joined = triangles[i].iter().any(|v| triangles[j].contains(v));
                    !joined && cross(&corners(i), &corners(j))
                })
                .collect();
            assert!(wanted.len() > 10, "{}", wanted.len());
            assert_eq!(crossings(&points, &triangles), wanted, "{seed}");
        }
    }

    #[test]
    fn what_is_no_triangle_crosses_nothing() {
        let points = [DVec3::ZERO, DVec3::X, DVec3::splat(f64::NAN)];
        assert!(
            crossings(&points, &[[0, 1, 2], [0, 1, 7]]).is_empty(),
            "an invalid triangle crosses nothing"
        );
        assert!(
            crossings(&[], &[]).is_empty(),
            "an empty mesh has no crossings"
        );
    }
}
