//! Hair of one figure on the head of another, its colour, and what of it is beard.

use raconteur_base::DVec3;
use serde::Deserialize;

use super::{NewFace, ReshapeError, Reshaper, narrow, wide};
use crate::figure::{Figure, MaterialKind, Mesh};
use crate::skeleton::{Bone, Drive};

/// How much of a beard there is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum BeardCut {
    /// All of it.
    #[default]
    Full,
    /// On the upper lip.
    Moustache,
    /// On the chin.
    Goatee,
}

/// Where strands grow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Strands {
    Scalp,
    /// In the face; and where the lips meet, in the frame of the head.
    Face(BeardCut, DVec3),
}

/// Roots farther to the front and lower than this grow in the face, metres in the frame of the head.
const FACE_FROM_Z_M: f64 = 0.014;
const FACE_BELOW_Y_M: f64 = -0.004;
/// Shares of the brightness of single hairs that they keep in another colour.
const BRIGHTNESS: std::ops::RangeInclusive<f64> = 0.45..=1.9;

/// Half the breadth of a goatee, and how far below the lips it begins, metres.
const GOATEE_M: [f64; 2] = [0.021, 0.008];
/// The skin is darker so far about the root of a hair of a beard, metres: what was shaved, or grows yet.
const STUBBLE_M: f64 = 0.0065;
/// How much of the beard's colour the skin there has, at most.
const STUBBLE: f64 = 0.5;

/// Whether a strand with its root at a place of the head's frame is one of those.
pub(super) fn grows(strands: Strands, root: DVec3) -> bool {
    let is_beard = root.z > FACE_FROM_Z_M && root.y < FACE_BELOW_Y_M;
    let Strands::Face(cut, lips) = strands else {
        return !is_beard;
    };
    let [half, below] = GOATEE_M;
    is_beard
        && match cut {
            BeardCut::Full => true,
            BeardCut::Moustache => root.y > lips.y && root.x.abs() < 0.034,
            BeardCut::Goatee => root.x.abs() < half && root.y < lips.y - below,
        }
}

/// The first vertex of the strand that each vertex is of: strands hang together by their triangles.
fn strands_of(mesh: &Mesh) -> Vec<u32> {
    let mut parent: Vec<u32> = (0..mesh.positions.len() as u32).collect();
    fn root(parent: &mut [u32], mut v: u32) -> u32 {
        while parent[v as usize] != v {
            parent[v as usize] = parent[parent[v as usize] as usize];
            v = parent[v as usize];
        }
        v
    }
    let lists = std::iter::once(&mesh.indices).chain(&mesh.coarser);
    for t in lists.flat_map(|list| list.as_chunks::<3>().0) {
        let [a, b, c] = t.map(|v| root(&mut parent, v));
        let least = a.min(b).min(c);
        for v in [a, b, c] {
            parent[v as usize] = least;
        }
    }
    (0..parent.len() as u32)
        .map(|v| root(&mut parent, v))
        .collect()
}

/// Where the strand of each vertex has its root: where v is least.
pub(super) fn roots_of(mesh: &Mesh) -> Vec<DVec3> {
    let of = strands_of(mesh);
    let mut roots = vec![(f32::INFINITY, DVec3::ZERO); of.len()];
    for (v, strand) in of.iter().enumerate() {
        let along = mesh.uvs.get(v).map_or(0.0, |uv| uv[1]);
        let root = &mut roots[*strand as usize];
        if along < root.0 {
            *root = (along, wide(mesh.positions[v]));
        }
    }
    of.iter().map(|&s| roots[s as usize].1).collect()
}

/// Leaves the strands that grow in one place; `origin` is that of the head's frame.
pub(super) fn keep(mesh: &mut Mesh, strands: Strands, origin: DVec3) {
    let roots = roots_of(mesh);
    leave(mesh, |v| grows(strands, roots[v as usize] - origin));
    if strands != Strands::Scalp {
        "beard".clone_into(&mut mesh.name);
    }
}

/// Gives the skin under a beard some of its colour.
pub(super) fn shade(skin: &mut Mesh, beard: &Mesh) {
    let mut roots = roots_of(beard);
    roots.sort_by(|a, b| a.y.total_cmp(&b.y).then(a.x.total_cmp(&b.x)));
    roots.dedup_by(|a, b| (*a - *b).length() < 1e-4);
    let count = beard.colors.len().max(1) as f64;
    let mean: [f64; 3] = core::array::from_fn(|i| {
        let sum: f64 = beard.colors.iter().map(|c| f64::from(c[i])).sum();
        sum / count / 255.0 * f64::from(beard.material.base_color[i])
    });
    for (p, colour) in skin.positions.iter().zip(&mut skin.colors) {
        let p = wide(*p);
        let from = roots.partition_point(|r| r.y < p.y - STUBBLE_M);
        let near = roots[from..].iter().take_while(|r| r.y < p.y + STUBBLE_M);
        let nearest = near.map(|r| (*r - p).length()).fold(STUBBLE_M, f64::min);
        let share = STUBBLE * (1.0 - nearest / STUBBLE_M).sqrt();
        for (c, beard) in colour.iter_mut().zip(mean) {
            let own = f64::from(*c) / 255.0;
            *c = (255.0 * (own + (beard - own) * share))
                .round()
                .clamp(0.0, 255.0) as u8;
        }
    }
}

/// Leaves the triangles of which all corners stay, and the vertices that they have.
pub(super) fn leave(mesh: &mut Mesh, stays: impl Fn(u32) -> bool) {
    for list in std::iter::once(&mut mesh.indices).chain(&mut mesh.coarser) {
        let triangles = list.as_chunks::<3>().0.iter();
        *list = triangles
            .filter(|t| t.iter().all(|&v| stays(v)))
            .flatten()
            .copied()
            .collect();
    }
    let shrinks = |lists: &[Vec<u32>], first: usize| {
        let lengths = std::iter::once(first).chain(lists.iter().map(Vec::len));
        lengths.clone().zip(lengths.skip(1)).all(|(a, b)| b < a)
    };
    if !shrinks(&mesh.coarser, mesh.indices.len()) {
        mesh.coarser.clear();
    }
    compact(mesh);
}

fn compact(mesh: &mut Mesh) {
    const GONE: u32 = u32::MAX;
    let mut to = vec![GONE; mesh.positions.len()];
    for &v in mesh.indices.iter().chain(mesh.coarser.iter().flatten()) {
        to[v as usize] = 0;
    }
    let used = to.iter_mut().filter(|t| **t != GONE);
    for (count, t) in (0..).zip(used) {
        *t = count;
    }
    fn pick<T: Copy>(all: &mut Vec<T>, to: &[u32]) {
        let mut at = to.iter();
        all.retain(|_| at.next().is_some_and(|&t| t != GONE));
    }
    pick(&mut mesh.positions, &to);
    pick(&mut mesh.normals, &to);
    pick(&mut mesh.uvs, &to);
    pick(&mut mesh.colors, &to);
    pick(&mut mesh.joints, &to);
    pick(&mut mesh.weights, &to);
    for v in std::iter::once(&mut mesh.indices)
        .chain(&mut mesh.coarser)
        .flatten()
    {
        *v = to[*v as usize];
    }
    if let Some(binding) = &mut mesh.binding {
        let own = std::mem::take(binding);
        binding.starts.push(0);
        for (&v, row) in own.vertices.iter().zip(own.starts.windows(2)) {
            if to[v as usize] == GONE {
                continue;
            }
            let row = row[0] as usize..row[1] as usize;
            binding.vertices.push(to[v as usize]);
            binding.nodes.extend(&own.nodes[row.clone()]);
            binding.weights.extend(&own.weights[row]);
            binding.starts.push(binding.nodes.len() as u32);
        }
    }
    // Strands have no morph targets of their own; one that had would lose them here.
    mesh.morphs.clear();
}

/// Gives hair another mean colour, linear; single hairs stay brighter or darker than others.
pub(super) fn colour(mesh: &mut Mesh, rgb: [f64; 3]) {
    let bright = |c: &[u8; 4]| {
        let parts = c.iter().zip(&mesh.material.base_color);
        let weighted = parts.zip([0.2126, 0.7152, 0.0722]);
        weighted
            .map(|((&c, &base), w)| f64::from(c) * f64::from(base) * w)
            .sum::<f64>()
    };
    let all: Vec<f64> = mesh.colors.iter().map(bright).collect();
    let mean = (all.iter().sum::<f64>() / all.len().max(1) as f64).max(1e-9);
    let most = *BRIGHTNESS.end();
    for (c, own) in mesh.colors.iter_mut().zip(all) {
        let share = (own / mean).clamp(*BRIGHTNESS.start(), most);
        let level = (255.0 * share / most).round() as u8;
        *c = [level, level, level, c[3]];
    }
    let [r, g, b] = rgb.map(|x| (x * most).min(1.0) as f32);
    mesh.material.base_color = [r, g, b, mesh.material.base_color[3]];
}

/// A figure that lends its hair.
#[derive(Clone, Debug)]
pub struct Lender {
    reshaper: Reshaper,
}

impl Lender {
    /// Takes the hair of a figure whose head begins with the skin of a face model of so many vertices.
    ///
    /// # Errors
    /// When its head is another.
    pub fn new(mut figure: Figure, vertices: usize) -> Result<Self, ReshapeError> {
        let is_needed = |m: &Mesh| m.name == "head" || m.material.kind == MaterialKind::Hair;
        figure.meshes.retain(is_needed);
        figure.images.clear();
        Ok(Self {
            reshaper: Reshaper::new(figure, vertices)?,
        })
    }

    /// The hair as it lies on a face, on the skeleton of another figure: what swings on the lender is
    /// stiff there.
    pub(super) fn lend(
        &self,
        to: &Reshaper,
        face: &NewFace<'_>,
    ) -> Result<Vec<Mesh>, ReshapeError> {
        let bare = NewFace { tone: &[], ..*face };
        let figure = self.reshaper.with_face(&bare)?;
        let joints = self.joints();
        let by = to.origin - self.reshaper.origin;
        let is_hair = |m: &Mesh| m.material.kind == MaterialKind::Hair;
        let mut meshes: Vec<Mesh> = figure.meshes.into_iter().filter(is_hair).collect();
        for mesh in &mut meshes {
            for p in &mut mesh.positions {
                *p = narrow(wide(*p) + by);
            }
            for joint in mesh.joints.iter_mut().flatten() {
                *joint = joints.get(usize::from(*joint)).copied().unwrap_or(0);
            }
        }
        Ok(meshes)
    }

    /// The joint of every figure that stands for each of the lender's: the bone that it hangs on.
    fn joints(&self) -> Vec<u16> {
        let joints = self.reshaper.figure.skeleton.joints();
        let skull = Bone::Skull.index();
        let own = |mut at: usize| loop {
            match joints[at].drive {
                Drive::Spring(..) | Drive::Fixed => match joints[at].parent {
                    Some(parent) => at = parent,
                    None => return skull as u16,
                },
                // Bones and standard helpers are the same in every figure.
                _ => return at as u16,
            }
        };
        (0..joints.len()).map(own).collect()
    }
}
