//! Dents: narrow folds of moved skin where faces have none.
//!
//! A fold of width w is half a wave of 2 w. Relative to the surface at rest, its depth at a point
//! is the distance below (or above) the midpoint of the two points on both sides of it, minus the
//! share of the wider curve through points twice as far away: for a wave of depth D and length four
//! times the distance `s`, D / 4, for one of 2 `s`, all of it.

use raconteur_base::DVec3;
use raconteur_body::face::tissue::FibreCurve;
use raconteur_body::face::{Muscle, NodeState, Tissue};
use raconteur_body::{Figure, Mesh};

/// Distances to the sides of a point, millimetres on the reference head. The widest detects waves
/// up to 12 mm and folds up to 6 mm wide, with more than half of their depth.
const WAYS_MM: [f64; 3] = [2.0, 3.0, 4.0];
/// Maximum depth of such a fold, millimetres on the reference head.
pub const MAX_FOLD_DEPTH_MM: f64 = 0.4;
/// Sampling rate of a sweep, frames per second.
pub(super) const RATE_HZ: f64 = 12.0;
const DIRECTIONS: usize = 8;
/// Radius of the searched triangles around a point, millimetres: twice the widest distance and an
/// edge.
const AROUND_MM: f64 = 12.0;

/// A point of the surface: three vertices and their weights.
type Place = [(u32, f32); 3];
/// Points at one distance and at twice that distance, on both sides.
type Across = [Place; 4];

/// Measuring points on a face mesh that detect narrow folds (dents) of the skin.
#[derive(Clone, Debug)]
pub struct Folds {
    /// Index of the mesh.
    mesh: usize,
    vertices: Vec<MeasuredFace>,
    displacements: Vec<[f32; 3]>,
}

#[derive(Clone, Debug)]
struct MeasuredFace {
    vertex: u32,
    normal: [f32; 3],
    across: Vec<Across>,
}

/// Deepest fold of a face, with its position.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Fold {
    /// Depth of the fold, metres.
    pub depth_m: f32,
    /// Position, bind pose, metres.
    pub place: [f32; 3],
}

impl Folds {
    /// Returns the measuring points of a figure's face; `None` without tissue or a mesh bound to
    /// it.
    #[must_use]
    pub fn new(figure: &Figure) -> Option<Self> {
        let tissue = figure.tissue.as_ref()?;
        let bound = |m: &Mesh| m.binding.as_ref().map_or(0, |b| b.vertices.len());
        let (index, mesh) = (figure.meshes.iter().enumerate()).max_by_key(|(_, m)| bound(m))?;
        let smooth = SmoothRegion::from_tissue(tissue)?;
        let scale = f64::from(tissue.scale) * 1e-3;
        let surface = Surface::from_mesh(mesh);
        let vertices = mesh.binding.as_ref()?.vertices.iter().copied();
        let vertices = vertices
            .filter(|&v| smooth.has(mesh.positions[v as usize]))
            .map(|v| MeasuredFace {
                vertex: v,
                normal: mesh.normals[v as usize],
                across: surface.around(v, scale),
            })
            .filter(|m| !m.across.is_empty())
            .collect();
        Some(Self {
            mesh: index,
            vertices,
            displacements: vec![[0.0; 3]; mesh.positions.len()],
        })
    }

    /// Returns the number of measured vertices.
    #[must_use]
    pub fn count(&self) -> usize {
        self.vertices.len()
    }

    /// Returns the deepest fold of the figure passed to [`Self::new`], for a state of its tissue.
    pub fn deepest(&mut self, figure: &Figure, nodes: &[NodeState]) -> Fold {
        let mesh = &figure.meshes[self.mesh];
        let Some(binding) = &mesh.binding else {
            return Fold::default();
        };
        self.displacements.fill([0.0; 3]);
        for (v, moved, _) in binding.apply(nodes) {
            self.displacements[v] = moved;
        }
        let mut deepest = Fold::default();
        for own in &self.vertices {
            let out = |d: [f32; 3]| (0..3).map(|k| d[k] * own.normal[k]).sum::<f32>();
            let height = |place: &Place| -> f32 {
                let shares = place.iter();
                shares
                    .map(|&(v, share)| share * out(self.displacements[v as usize]))
                    .sum()
            };
            let here = out(self.displacements[own.vertex as usize]);
            for across in &own.across {
                let [a, b, c, d] = [0, 1, 2, 3].map(|k| height(&across[k]));
                let depth = (here - 0.5 * (a + b)) - 0.25 * (here - 0.5 * (c + d));
                if depth.abs() > deepest.depth_m {
                    deepest = Fold {
                        depth_m: depth.abs(),
                        place: mesh.positions[own.vertex as usize],
                    };
                }
            }
        }
        deepest
    }
}

/// Region in which skin must stay smooth: cheeks, temples, forehead, chin and neck. Lips, lids,
/// nose and natural folds are excluded: between the brows, crow's feet, the nasolabial fold and the
/// creases at the corners of the mouth.
struct SmoothRegion {
    scale: f64,
    eyes: Vec<DVec3>,
    lips: Vec<DVec3>,
    corners: [DVec3; 2],
    /// Sides of the nose's wings, left and right, bind pose, metres.
    wings: [DVec3; 2],
}

impl SmoothRegion {
    fn from_tissue(tissue: &Tissue) -> Option<Self> {
        let at = |p: [f32; 3]| DVec3::from_array(p.map(f64::from));
        let eyes: Vec<DVec3> = tissue
            .fibres
            .iter()
            .filter_map(|f| match f.course {
                FibreCurve::Towards(centre) => Some(at(centre)),
                _ => None,
            })
            .collect();
        let lips: Vec<DVec3> = (tissue.lips.iter())
            .map(|l| at(tissue.rest[usize::from(l.node)]))
            .collect();
        let far = |sign: f64| {
            let order = |a: &&DVec3, b: &&DVec3| (sign * a.x).total_cmp(&(sign * b.x));
            lips.iter().max_by(order).copied()
        };
        let wing = |muscle: Muscle, sign: f64| {
            let fibres = tissue.fibres.iter().filter(|f| f.muscle == muscle);
            let points = fibres.flat_map(|f| {
                let first = usize::from(f.first);
                tissue.points[first..first + usize::from(f.count)].iter()
            });
            let points: Vec<DVec3> = points.map(|p| at(p.rest)).collect();
            let low = points.iter().map(|p| p.y).fold(f64::MAX, f64::min);
            let out = points.iter().map(|p| sign * p.x).fold(0.0, f64::max);
            let z = points.iter().map(|p| p.z).fold(f64::MIN, f64::max);
            (!points.is_empty()).then(|| DVec3::new(sign * out, low, z))
        };
        Some(Self {
            scale: f64::from(tissue.scale) * 1e-3,
            corners: [far(1.0)?, far(-1.0)?],
            wings: [
                wing(Muscle::NasalisLeft, 1.0)?,
                wing(Muscle::NasalisRight, -1.0)?,
            ],
            eyes,
            lips,
        })
    }

    /// Returns true if skin at this position must stay smooth.
    fn has(&self, place: [f32; 3]) -> bool {
        let p = DVec3::from_array(place.map(f64::from));
        let mm = self.scale;
        let side = usize::from(p.x < 0.0);
        let sign = if side == 0 { 1.0 } else { -1.0 };
        let nearest = |all: &[DVec3]| all.iter().map(|q| q.distance(p)).fold(f64::MAX, f64::min);
        if nearest(&self.lips) < 6.0 * mm {
            return false;
        }
        let Some(eye) = self.eyes.iter().min_by(|a, b| {
            let far = |q: &DVec3| q.distance(p);
            far(a).total_cmp(&far(b))
        }) else {
            return false;
        };
        let off = p - *eye;
        let aside = sign * off.x;
        // The orbit up to the brow; crow's feet beyond its outer edge.
        if off.truncate().length() < 22.0 * mm
            || (aside > 0.0 && aside < 38.0 * mm && off.y.abs() < 16.0 * mm)
        {
            return false;
        }
        let (corner, wing) = (self.corners[side], self.wings[side]);
        // Between the brows, and the nose down to its base.
        let between = sign * eye.x - 12.0 * mm;
        if sign * p.x < between && p.y < eye.y + 30.0 * mm && p.y > wing.y - 4.0 * mm
            || sign * p.x < sign * wing.x + 6.0 * mm && p.y < eye.y && p.y > wing.y - 6.0 * mm
        {
            return false;
        }
        // From the wing of the nose past the corner of the mouth and down next to the chin.
        let past = corner + DVec3::new(sign * 8.0, 0.0, 0.0) * mm;
        let down = corner + DVec3::new(sign * 4.0, -18.0, 0.0) * mm;
        let off_line = |a: DVec3, b: DVec3| {
            let (way, from) = ((b - a).truncate(), (p - a).truncate());
            let on = (from.dot(way) / way.dot(way)).clamp(0.0, 1.0);
            (from - way * on).length()
        };
        off_line(wing, past) > 7.0 * mm && off_line(past, down) > 6.0 * mm
    }
}

/// A mesh with a spatial index of its triangles.
struct Surface<'a> {
    mesh: &'a Mesh,
    /// The triangles of each vertex.
    own: Vec<Vec<u32>>,
}

impl<'a> Surface<'a> {
    fn from_mesh(mesh: &'a Mesh) -> Self {
        let mut own = vec![Vec::new(); mesh.positions.len()];
        for (i, triangle) in (0u32..).zip(mesh.indices.chunks_exact(3)) {
            for &v in triangle {
                own[v as usize].push(i);
            }
        }
        Self { mesh, own }
    }

    fn position(&self, v: u32) -> DVec3 {
        DVec3::from_array(self.mesh.positions[v as usize].map(f64::from))
    }

    fn triangle(&self, i: u32) -> [u32; 3] {
        let first = 3 * i as usize;
        [0, 1, 2].map(|k| self.mesh.indices[first + k])
    }

    /// Returns the triangles connected with a vertex within a distance, metres.
    fn connected_triangles(&self, v: u32, within: f64) -> Vec<[u32; 3]> {
        let middle = self.position(v);
        let (mut open, mut seen) = (vec![v], std::collections::BTreeSet::from([v]));
        let mut all = std::collections::BTreeSet::new();
        while let Some(v) = open.pop() {
            for &i in &self.own[v as usize] {
                all.insert(i);
                for w in self.triangle(i) {
                    if self.position(w).distance(middle) < within && seen.insert(w) {
                        open.push(w);
                    }
                }
            }
        }
        all.into_iter().map(|i| self.triangle(i)).collect()
    }

    /// Returns the points on both sides of a vertex, in all directions in which the surface
    /// continues.
    fn around(&self, v: u32, scale: f64) -> Vec<Across> {
        let middle = self.position(v);
        let normal = DVec3::from_array(self.mesh.normals[v as usize].map(f64::from));
        let u = normal.any_orthonormal_vector();
        let w = normal.cross(u);
        let flat = |v: u32| {
            let off = self.position(v) - middle;
            [off.dot(u), off.dot(w)]
        };
        let near = self.connected_triangles(v, AROUND_MM * scale);
        let near: Vec<_> = near.iter().map(|t| (*t, t.map(flat))).collect();
        let find = |x: f64, y: f64| {
            near.iter()
                .find_map(|(t, flat)| barycentric(*t, flat, [x, y]))
        };
        let mut all = Vec::new();
        for direction in 0..DIRECTIONS {
            let angle = core::f64::consts::PI * direction as f64 / DIRECTIONS as f64;
            let (y, x) = (
                raconteur_base::ops::sin(angle),
                raconteur_base::ops::cos(angle),
            );
            for way in WAYS_MM {
                let at = |k: f64| find(k * way * scale * x, k * way * scale * y);
                let found = at(1.0).zip(at(-1.0)).zip(at(2.0).zip(at(-2.0)));
                if let Some(((a, b), (c, d))) = found {
                    all.push([a, b, c, d]);
                }
            }
        }
        all
    }
}

/// Returns the barycentric position in a triangle of a plane; `None` outside, or seen from behind.
fn barycentric(triangle: [u32; 3], [a, b, c]: &[[f64; 2]; 3], p: [f64; 2]) -> Option<Place> {
    let cross = |a: &[f64; 2], b: &[f64; 2], c: &[f64; 2]| {
        (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    };
    let all = cross(a, b, c);
    if all <= 1e-12 {
        return None;
    }
    let shares = [cross(b, c, &p), cross(c, a, &p), cross(a, b, &p)].map(|x| x / all);
    let is_in = shares.iter().all(|s| *s >= -1e-9);
    is_in.then(|| [0, 1, 2].map(|k| (triangle[k], shares[k] as f32)))
}
