//! Hand charts in the skin atlas: back and palm of the hand flattened as a whole, each finger's
//! back and inner side unrolled; cut along the sides and the roots of the fingers. All of it
//! follows from the mean adult hand, so one texture fits every hand.

use std::collections::BTreeMap;
use std::sync::OnceLock;

use raconteur_base::{DVec2, DVec3, ops};

use super::anatomy::{Anatomy, FINGER_COUNT, Finger, HandBuild};
use super::field::Field;
use super::surface::{self, Skin};
use crate::atlas::{SIZE, conformal, unfold};
use crate::subdivide::edge_faces;

/// Columns of the atlas left to the hand, texels.
const LEFT: f64 = 716.0;
const RIGHT: f64 = 1018.0;
/// Back and palm of the hand: top, and height of each.
const BODY_TOP: [f64; 2] = [6.0, 262.0];
const BODY_HEIGHT: f64 = 248.0;
/// Ten halves of fingers in three rows: thumb's two and two of the index, and so on.
const FINGERS_TOP: f64 = 518.0;
const FINGERS_IN_A_ROW: usize = 4;
const CELL: [f64; 2] = [75.0, 168.0];
/// Texels a millimetre on the fingers.
const FINGER_DENSITY: f64 = 1.95;
/// Room about each piece, texels.
const PADDING: f64 = 5.0;
/// Share of texels that the forearm gets along its length; a sleeve hides most of it.
const FOREARM_SHARE: f64 = 0.25;
/// Start of a finger's cap: one radius before the tip, as a joint coordinate.
const CAP_FROM: f64 = 2.58;

/// Texture chart of the hand: the skin with its vertices doubled along the cut.
pub(super) struct Chart {
    pub(super) faces: Vec<Vec<u32>>,
    /// Skin vertex of each chart vertex; the skin's own vertices come first.
    pub(super) source: Vec<u32>,
    /// Texture coordinates in the atlas, 0..1.
    pub(super) uv: Vec<[f64; 2]>,
}

/// A piece of the chart: a finger or, beyond them, the hand; back 0 or palm 1.
type Piece = (usize, usize);

/// Returns the palmar orientation of each vertex, −1..1, smoothed over its neighbours.
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

/// Assigns a chart piece to each face; every piece is connected.
fn pieces(anatomy: &Anatomy, skin: &Skin) -> Vec<Piece> {
    let side = palmar(anatomy, skin);
    let mut piece: Vec<Piece> = skin
        .faces
        .iter()
        .map(|face| {
            let n = face.len() as f64;
            let mean = |f: usize| {
                face.iter()
                    .map(|&v| skin.ownership[v as usize][f])
                    .sum::<f64>()
                    / n
            };
            let middle = face
                .iter()
                .map(|&v| skin.positions[v as usize])
                .sum::<DVec3>()
                / n;
            match (0..FINGER_COUNT).find(|&f| mean(f) > 0.75) {
                // On a finger, the angle around its axis decides: pieces cannot meet behind.
                Some(f) => (f, usize::from(anatomy.fingers[f].local(middle).z > 0.0)),
                None => {
                    let palm = face.iter().map(|&v| side[v as usize]).sum::<f64>() > 0.0;
                    (FINGER_COUNT, usize::from(palm))
                }
            }
        })
        .collect();
    let mut beside: Vec<Vec<usize>> = vec![Vec::new(); skin.faces.len()];
    for pair in edge_faces(&skin.faces).values() {
        if let [a, b] = pair[..] {
            beside[a as usize].push(b as usize);
            beside[b as usize].push(a as usize);
        }
    }
    // Stray faces go to the piece of most of their neighbours.
    for _ in 0..3 {
        let group = connected(&piece, &beside);
        let mut size: BTreeMap<usize, usize> = BTreeMap::new();
        let mut largest: BTreeMap<Piece, (usize, usize)> = BTreeMap::new();
        for &g in &group {
            *size.entry(g).or_insert(0) += 1;
        }
        for (f, &g) in group.iter().enumerate() {
            let best = largest.entry(piece[f]).or_insert((0, g));
            if size[&g] > best.0 {
                *best = (size[&g], g);
            }
        }
        let before = piece.clone();
        for (f, near) in beside.iter().enumerate() {
            if group[f] != largest[&before[f]].1 {
                let other = near.iter().map(|&g| before[g]).find(|p| *p != before[f]);
                piece[f] = other.unwrap_or(before[f]);
            }
        }
    }
    piece
}

/// Labels the faces by connected groups of one piece.
fn connected(piece: &[Piece], beside: &[Vec<usize>]) -> Vec<usize> {
    let mut group = vec![usize::MAX; piece.len()];
    for start in 0..piece.len() {
        if group[start] != usize::MAX {
            continue;
        }
        group[start] = start;
        let mut open = vec![start];
        while let Some(f) = open.pop() {
            for &g in &beside[f] {
                if group[g] == usize::MAX && piece[g] == piece[start] {
                    group[g] = start;
                    open.push(g);
                }
            }
        }
    }
    group
}

/// Sex and age of the hand that is laid out: between man and woman, before age shows.
const MEAN: (f64, f64) = (0.5, 30.0);

/// Returns the chart of all hands, computed once: it has no inputs, because every hand has the same
/// faces.
pub(super) fn chart() -> &'static Chart {
    static CHART: OnceLock<Chart> = OnceLock::new();
    CHART.get_or_init(|| {
        let anatomy = Anatomy::new(HandBuild::from_sex_and_age(MEAN.0, MEAN.1));
        let field = Field::new(&anatomy);
        let skin = surface::build(&anatomy, &field, &super::cage::build(&anatomy, &field));
        make(&anatomy, &skin)
    })
}

/// Cuts and flattens the skin.
fn make(anatomy: &Anatomy, skin: &Skin) -> Chart {
    let piece = pieces(anatomy, skin);
    let n = skin.positions.len();
    let mut chart = Chart {
        faces: skin.faces.clone(),
        source: (0..n as u32).collect(),
        uv: Vec::new(),
    };
    // The first piece with a vertex owns it, the others use copies.
    let mut owner: Vec<Option<Piece>> = vec![None; n];
    let mut twin: BTreeMap<(u32, Piece), u32> = BTreeMap::new();
    for (face, &own) in chart.faces.iter_mut().zip(&piece) {
        for v in face {
            if *owner[*v as usize].get_or_insert(own) != own {
                let source = &mut chart.source;
                *v = *twin.entry((*v, own)).or_insert_with(|| {
                    source.push(*v);
                    source.len() as u32 - 1
                });
            }
        }
    }
    let mut flat = vec![DVec2::ZERO; chart.source.len()];
    for part in 0..=FINGER_COUNT {
        for side in 0..2 {
            let kept = chart
                .faces
                .iter()
                .zip(&piece)
                .filter(|(_, p)| **p == (part, side));
            let faces: Vec<&Vec<u32>> = kept.map(|(f, _)| f).collect();
            let placed = match anatomy.fingers.get(part) {
                Some(finger) => unroll(finger, skin, &chart.source, &faces, part, side),
                None => unwrap(skin, &chart.source, &faces, side),
            };
            for (v, place) in placed {
                flat[v as usize] = place;
            }
        }
    }
    // Skin pressed in under a nail or bulging at a root would cover its neighbour.
    let triangles: Vec<[u32; 3]> = chart
        .faces
        .iter()
        .flat_map(|f| f[1..].windows(2).map(|w| [f[0], w[0], w[1]]))
        .collect();
    unfold(&triangles, &mut flat);
    chart.uv = flat.iter().map(|p| (*p / SIZE as f64).to_array()).collect();
    chart
}

fn used(faces: &[&Vec<u32>]) -> Vec<u32> {
    let mut used: Vec<u32> = faces.iter().flat_map(|f| f.iter().copied()).collect();
    used.sort_unstable();
    used.dedup();
    used
}

/// Unrolls one side of a finger: angle about the axis across, length along; its cap uses the
/// sinusoidal projection of a sphere.
fn unroll(
    finger: &Finger,
    skin: &Skin,
    source: &[u32],
    faces: &[&Vec<u32>],
    f: usize,
    side: usize,
) -> Vec<(u32, DVec2)> {
    let from = finger.along(CAP_FROM);
    let section = finger.section(from);
    let radius = (section.half_width + (section.dorsal + section.palmar) / 2.0) / 2.0;
    let towards = if side == 1 { 1.0 } else { -1.0 };
    let reach = finger.joints()[3] + 1.0 - from;
    let flat: Vec<(u32, DVec2)> = used(faces)
        .into_iter()
        .map(|v| {
            let p = finger.local(skin.positions[source[v as usize] as usize]);
            // Fingers are thicker on the palm side, so the axis of angles is halfway.
            let turn = ops::atan2(p.x, towards * p.z + 0.15 * radius);
            let around = (p.x * p.x + p.z * p.z).sqrt();
            let (wide, along) = if p.y <= from {
                (around, p.y)
            } else {
                // Latitude depends on the length alone, because skin pressed in under a nail must
                // not fold.
                let latitude = ops::asin(((p.y - from) / reach).clamp(0.0, 1.0));
                (radius * ops::cos(latitude), from + 1.15 * radius * latitude)
            };
            // +x is radial; seen from outside, it is left on the back and right on the palm of a
            // right hand with its fingers up.
            (v, DVec2::new(towards * turn * wide, along))
        })
        .collect();
    let low = flat.iter().map(|p| p.1).fold(DVec2::MAX, DVec2::min);
    let high = flat.iter().map(|p| p.1).fold(DVec2::MIN, DVec2::max);
    let room = DVec2::from_array(CELL) - 2.0 * PADDING;
    let scale = (room / (high - low)).min(DVec2::splat(FINGER_DENSITY));
    let cell = 2 * f + side;
    let corner = DVec2::new(
        LEFT + CELL[0] * (cell % FINGERS_IN_A_ROW) as f64 + PADDING,
        FINGERS_TOP + CELL[1] * (cell / FINGERS_IN_A_ROW) as f64 + PADDING,
    );
    flat.into_iter()
        .map(|(v, p)| {
            let q = DVec2::new(p.x - low.x, high.y - p.y) * scale;
            (v, corner + q)
        })
        .collect()
}

/// Unwraps the back or the palm of the hand to the plane, fingers up.
fn unwrap(skin: &Skin, source: &[u32], faces: &[&Vec<u32>], side: usize) -> Vec<(u32, DVec2)> {
    let used = used(faces);
    let slot = |v: u32| used.binary_search(&v).unwrap_or(0) as u32;
    let positions: Vec<DVec3> = used
        .iter()
        .map(|&v| skin.positions[source[v as usize] as usize])
        .collect();
    let triangles: Vec<[u32; 3]> = faces
        .iter()
        .flat_map(|f| f[1..].windows(2).map(|w| [f[0], w[0], w[1]].map(slot)))
        .collect();
    // Two fixed vertices along the middle of the hand.
    let turn = if side == 1 { 1.0 } else { -1.0 };
    let flat = |p: DVec3| DVec2::new(turn * p.x, p.y);
    let nearest = |x: f64, y: f64| {
        let d = |i: &usize| (positions[*i].truncate() - DVec2::new(x, y)).length_squared();
        (0..positions.len())
            .min_by(|a, b| d(a).total_cmp(&d(b)))
            .unwrap_or(0)
    };
    let held = [nearest(0.0, 0.0), nearest(-5.0, 78.0)].map(|i| (i as u32, flat(positions[i])));
    let laid = conformal(&triangles, &positions, held);
    // The forearm below the wrist is compressed.
    let squeezed: Vec<DVec2> = laid
        .iter()
        .map(|p| {
            let low = (p.y + 10.0).min(0.0);
            DVec2::new(p.x, p.y.max(-10.0) + low * FOREARM_SHARE)
        })
        .collect();
    let low = squeezed.iter().copied().fold(DVec2::MAX, DVec2::min);
    let high = squeezed.iter().copied().fold(DVec2::MIN, DVec2::max);
    let scale = DVec2::new(RIGHT - LEFT, BODY_HEIGHT) / (high - low);
    // Broad and low room: across may be finer than along.
    let scale = DVec2::new(scale.x.min(1.25 * scale.y), scale.y.min(1.25 * scale.x));
    used.iter()
        .zip(squeezed)
        .map(|(&v, p)| {
            let q = DVec2::new(p.x - low.x, high.y - p.y) * scale;
            (v, q + DVec2::new(LEFT, BODY_TOP[side]))
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_hand_has_the_faces_of_the_mean_one() {
        let faces = |sex: f64, age_years: f64| {
            let anatomy = Anatomy::new(HandBuild::from_sex_and_age(sex, age_years));
            let field = Field::new(&anatomy);
            super::super::cage::build(&anatomy, &field).faces
        };
        let mean = faces(MEAN.0, MEAN.1);
        for (sex, age_years) in [(0.0, 9.0), (1.0, 35.0), (0.0, 80.0)] {
            assert_eq!(faces(sex, age_years), mean);
        }
    }
}
