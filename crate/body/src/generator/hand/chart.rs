//! Where the hand's skin lies in the skin's atlas: its back and its palm as two flat pieces,
//! cut along the sides of hand and fingers.

use std::collections::BTreeMap;

use raconteur_base::{DVec2, DVec3};

use super::anatomy::{Anatomy, FINGER_COUNT};
use super::surface::Skin;
use crate::generator::skin::raster::SIZE;
use crate::generator::skin::unwrap::conformal;
use crate::generator::subdivide::edge_faces;

/// Rectangles of back and palm in the atlas, texels: left, top, right, bottom.
const RECTANGLES: [[f64; 4]; 2] = [[720.0, 8.0, 1016.0, 508.0], [720.0, 520.0, 1016.0, 1016.0]];

/// Share of texels that the forearm gets along its length; a sleeve hides most of it.
const FOREARM_SHARE: f64 = 0.3;

/// The skin with vertices doubled along the cut.
pub(super) struct Chart {
    pub(super) faces: Vec<Vec<u32>>,
    /// Vertex of the skin behind each; the skin's own vertices come first.
    pub(super) source: Vec<u32>,
    /// Place in the atlas, 0..1.
    pub(super) uv: Vec<[f64; 2]>,
}

/// How much a vertex looks to the palm's side, −1..1, smoothed over its neighbours.
fn palmar(anatomy: &Anatomy, skin: &Skin) -> Vec<f64> {
    let mut side: Vec<f64> = (0..skin.positions.len())
        .map(|v| {
            let owned = &skin.ownership[v];
            let body = (1.0 - owned.iter().sum::<f64>()).max(0.0);
            let axis = (0..FINGER_COUNT)
                .map(|f| anatomy.fingers[f].frame.z_axis * owned[f])
                .sum::<DVec3>()
                + DVec3::Z * body;
            skin.normals[v].dot(axis)
        })
        .collect();
    for _ in 0..3 {
        let before = side.clone();
        for (v, near) in skin.neighbours.iter().enumerate() {
            let mean = near.iter().map(|&u| before[u as usize]).sum::<f64>() / near.len() as f64;
            side[v] = 0.5 * before[v] + 0.5 * mean;
        }
    }
    side
}

/// Which faces lie on the palm; each side is one connected piece.
fn sides(anatomy: &Anatomy, skin: &Skin) -> Vec<bool> {
    let side = palmar(anatomy, skin);
    let mut palm: Vec<bool> = skin
        .faces
        .iter()
        .map(|f| f.iter().map(|&v| side[v as usize]).sum::<f64>() > 0.0)
        .collect();
    let edges = edge_faces(&skin.faces);
    let mut beside: Vec<Vec<usize>> = vec![Vec::new(); skin.faces.len()];
    for pair in edges.values() {
        if let [a, b] = pair[..] {
            beside[a as usize].push(b as usize);
            beside[b as usize].push(a as usize);
        }
    }
    // A face with more neighbours on the other side straightens the cut.
    for _ in 0..4 {
        let before = palm.clone();
        for (f, near) in beside.iter().enumerate() {
            let other = near.iter().filter(|&&g| before[g] != before[f]).count();
            if other > 2 {
                palm[f] = !before[f];
            }
        }
    }
    for wanted in [false, true] {
        // Islands other than the largest go to the other side.
        let mut piece = vec![usize::MAX; palm.len()];
        let mut sizes = Vec::new();
        for start in 0..palm.len() {
            if palm[start] != wanted || piece[start] != usize::MAX {
                continue;
            }
            let mut open = vec![start];
            piece[start] = sizes.len();
            let mut size = 0;
            while let Some(f) = open.pop() {
                size += 1;
                for &g in &beside[f] {
                    if palm[g] == wanted && piece[g] == usize::MAX {
                        piece[g] = sizes.len();
                        open.push(g);
                    }
                }
            }
            sizes.push(size);
        }
        let largest = (0..sizes.len()).max_by_key(|&i| sizes[i]);
        for (p, k) in palm.iter_mut().zip(&piece) {
            if *k != usize::MAX && Some(*k) != largest {
                *p = !*p;
            }
        }
    }
    palm
}

/// Cuts and flattens the skin.
pub(super) fn chart(anatomy: &Anatomy, skin: &Skin) -> Chart {
    let palm = sides(anatomy, skin);
    let n = skin.positions.len();
    let mut chart = Chart {
        faces: skin.faces.clone(),
        source: (0..n as u32).collect(),
        uv: vec![[0.0; 2]; n],
    };
    // The palm takes copies of the vertices that the back has too.
    let mut on_back = vec![false; n];
    for (f, _) in skin.faces.iter().zip(&palm).filter(|(_, p)| !**p) {
        for &v in f {
            on_back[v as usize] = true;
        }
    }
    let mut twin: BTreeMap<u32, u32> = BTreeMap::new();
    for (face, _) in chart.faces.iter_mut().zip(&palm).filter(|(_, p)| **p) {
        for v in face {
            if on_back[*v as usize] {
                let source = &mut chart.source;
                *v = *twin.entry(*v).or_insert_with(|| {
                    source.push(*v);
                    source.len() as u32 - 1
                });
            }
        }
    }
    chart.uv.resize(chart.source.len(), [0.0; 2]);
    for (wanted, rectangle) in [false, true].into_iter().zip(RECTANGLES) {
        let kept = chart.faces.iter().zip(&palm).filter(|(_, p)| **p == wanted);
        let faces: Vec<&Vec<u32>> = kept.map(|(f, _)| f).collect();
        for (v, place) in lay(skin, &chart.source, &faces, wanted, rectangle) {
            chart.uv[v as usize] = place.to_array();
        }
    }
    chart
}

/// Flattens one side into a rectangle, fingers up; palm mirrored so that nothing is turned
/// inside out.
fn lay(
    skin: &Skin,
    source: &[u32],
    faces: &[&Vec<u32>],
    palm: bool,
    [left, top, right, bottom]: [f64; 4],
) -> Vec<(u32, DVec2)> {
    let mut used: Vec<u32> = faces.iter().flat_map(|f| f.iter().copied()).collect();
    used.sort_unstable();
    used.dedup();
    let slot = |v: u32| used.binary_search(&v).unwrap_or(0) as u32;
    let positions: Vec<DVec3> = used
        .iter()
        .map(|&v| skin.positions[source[v as usize] as usize])
        .collect();
    let triangles: Vec<[u32; 3]> = faces
        .iter()
        .flat_map(|f| f[1..].windows(2).map(|w| [f[0], w[0], w[1]].map(slot)))
        .collect();
    // Held: the furthest vertices along the hand; +x of the plane is radial on the back
    // seen from outside, ulnar on the palm.
    let turn = if palm { 1.0 } else { -1.0 };
    let flat = |p: DVec3| DVec2::new(turn * p.x, p.y);
    let by_y = |a: &usize, b: &usize| positions[*a].y.total_cmp(&positions[*b].y);
    let low = (0..positions.len()).min_by(by_y).unwrap_or(0);
    let high = (0..positions.len()).max_by(by_y).unwrap_or(0);
    let held = [low, high].map(|i| (i as u32, flat(positions[i])));
    let laid = conformal(&triangles, &positions, held);
    // The forearm below the wrist is drawn together.
    let squeezed: Vec<DVec2> = laid
        .iter()
        .map(|p| {
            DVec2::new(
                p.x,
                if p.y < -10.0 {
                    -10.0 + (p.y + 10.0) * FOREARM_SHARE
                } else {
                    p.y
                },
            )
        })
        .collect();
    let lowest = squeezed.iter().copied().fold(DVec2::MAX, DVec2::min);
    let highest = squeezed.iter().copied().fold(DVec2::MIN, DVec2::max);
    let room = DVec2::new(right - left, bottom - top);
    let scale = (room / (highest - lowest)).min_element();
    used.iter()
        .zip(squeezed)
        .map(|(&v, p)| {
            let q = DVec2::new(p.x - lowest.x, highest.y - p.y) * scale;
            (v, (q + DVec2::new(left, top)) / SIZE as f64)
        })
        .collect()
}
