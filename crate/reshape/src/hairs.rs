//! Hair of one figure on the head of another, its colour, and its beard.

use super::wide;
use raconteur_base::DVec3;
use raconteur_body::figure::Mesh;

/// The name of a mesh of hair that grows in a face.
pub(super) const BEARD: &str = "beard";

/// Region where strands of hair grow: scalp or face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Strands {
    Scalp,
    Face,
}

/// Roots farther to the front and lower than this grow in the face, metres in the frame of the head.
const FACE_FROM_Z_M: f64 = 0.014;
const FACE_BELOW_Y_M: f64 = -0.004;
/// Range of relative brightness that single hairs keep in another colour.
const BRIGHTNESS: std::ops::RangeInclusive<f64> = 0.45..=1.9;

/// Radius of darker skin around the root of a beard hair, metres: shaved or growing stubble.
const STUBBLE_M: f64 = 0.0065;
/// Maximum share of the beard's colour in that skin.
const STUBBLE: f64 = 0.5;

/// Returns true if a strand with its root at a position of the head's frame belongs to the region.
pub(super) fn grows(strands: Strands, root: DVec3) -> bool {
    let is_beard = root.z > FACE_FROM_Z_M && root.y < FACE_BELOW_Y_M;
    is_beard == (strands == Strands::Face)
}

/// Returns for each vertex the first vertex of its strand; triangles connect the vertices of a
/// strand.
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

/// Returns the root position of the strand of each vertex: the point with the smallest v.
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

/// Keeps only the strands of one region; `origin` is that of the head's frame.
pub(super) fn retain(mesh: &mut Mesh, strands: Strands, origin: DVec3) {
    let roots = roots_of(mesh);
    leave(mesh, |v| grows(strands, roots[v as usize] - origin));
}

/// Tints the skin under a beard with the beard's colour.
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
    mesh.drop_unused();
    // Strands have no morph targets of their own; one that had would lose them here.
    mesh.morphs.clear();
}

/// Changes the mean colour of hair, linear; single hairs stay brighter or darker than others.
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
