//! Hierarchy of the face's segments after F&H, Table 5.1, on the rendered surface.

use core::ops::RangeInclusive;

use raconteur_base::Side;

use super::Shape;
use super::cage::Key;

/// Segment of the head's skin in the hierarchy of segments that a face space models separately.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct HeadSegment {
    /// Name of the segment.
    pub name: &'static str,
    /// Index of its parent.
    pub parent: Option<usize>,
    /// Vertices of the skin part that belong to this segment itself, as runs (first, count).
    pub runs: Vec<[u32; 2]>,
}

/// Name and parent, parents first.
const TREE: [(&str, Option<usize>); 22] = [
    ("face", None),
    ("forehead", Some(0)),
    ("eyes", Some(0)),
    ("cheeks", Some(0)),
    ("ears", Some(0)),
    ("nose", Some(0)),
    ("mouth", Some(0)),
    ("chin", Some(0)),
    ("rest", Some(0)),
    ("eyebrows", Some(2)),
    ("orbits and brow ridge", Some(2)),
    ("eyes and lids", Some(2)),
    ("nose root", Some(5)),
    ("nose bridge", Some(5)),
    ("nose wings", Some(5)),
    ("nose base", Some(5)),
    ("nose tip", Some(5)),
    ("upper lip", Some(6)),
    ("lower lip", Some(6)),
    ("peripheral oral region", Some(6)),
    ("chin tip", Some(7)),
    ("jaw", Some(7)),
];

const FOREHEAD: usize = 1;
const CHEEKS: usize = 3;
const EARS: usize = 4;
const REST: usize = 8;
const EYEBROWS: usize = 9;
const ORBITS: usize = 10;
const EYES: usize = 11;
const ROOT: usize = 12;
const BRIDGE: usize = 13;
const WINGS: usize = 14;
const BASE: usize = 15;
const TIP: usize = 16;
const UPPER_LIP: usize = 17;
const LOWER_LIP: usize = 18;
const ORAL: usize = 19;
const CHIN_TIP: usize = 20;
const JAW: usize = 21;

/// Columns and rows of the grid for each segment; the first match applies.
const GRID: [(RangeInclusive<u8>, RangeInclusive<u8>, usize); 16] = [
    (0..=1, 3..=3, FOREHEAD),
    (0..=9, 0..=2, FOREHEAD),
    (2..=9, 3..=3, EYEBROWS),
    (0..=4, 4..=5, ORBITS),
    (4..=8, 4..=8, ORBITS),
    (0..=4, 6..=7, ROOT),
    (0..=3, 8..=9, BRIDGE),
    (0..=2, 10..=12, TIP),
    (0..=2, 13..=14, BASE),
    (3..=5, 9..=14, WINGS),
    (0..=4, 15..=20, ORAL),
    (0..=3, 21..=24, CHIN_TIP),
    (4..=11, 21..=25, JAW),
    (5..=10, 7..=20, CHEEKS),
    (9..=10, 3..=6, CHEEKS),
    (0..=20, 0..=31, REST),
];

fn leaf(key: Key) -> usize {
    match key {
        Key::Eye(1..=2, _) => ORBITS,
        Key::Eye(..) => EYES,
        Key::Mouth(_, k) if k <= 6 => UPPER_LIP,
        Key::Mouth(..) => LOWER_LIP,
        Key::Nostril(..) => BASE,
        Key::Ear(..) => EARS,
        Key::Crown(..) => REST,
        Key::Grid(i, j) => GRID
            .iter()
            .find(|(columns, rows, _)| columns.contains(&i) && rows.contains(&j))
            .map_or(REST, |g| g.2),
    }
}

/// Returns the segment tree with each segment's vertices. `drawn` gives the surface vertex of each
/// vertex of the skin's part.
pub(super) fn segments(shape: &Shape, drawn: &[u32]) -> Vec<HeadSegment> {
    // Each vertex belongs to the segment that has most weight in it.
    let mut best: Vec<(f64, usize)> = vec![(0.0, REST); shape.positions.len()];
    for s in 0..TREE.len() {
        let share = shape.surface.apply_by(&shape.cage, |v| {
            let (key, _): (Key, Side) = shape.cage.keys[v];
            if leaf(key) == s { 1.0 } else { 0.0 }
        });
        for (b, w) in best.iter_mut().zip(share) {
            if w > b.0 + 1e-9 {
                *b = (w, s);
            }
        }
    }
    TREE.iter()
        .enumerate()
        .map(|(s, &(name, parent))| {
            let mut runs: Vec<[u32; 2]> = Vec::new();
            for (v, &from) in (0u32..).zip(drawn) {
                if best.get(from as usize).is_none_or(|b| b.1 != s) {
                    continue;
                }
                match runs.last_mut() {
                    Some(run) if run[0] + run[1] == v => run[1] += 1,
                    _ => runs.push([v, 1]),
                }
            }
            HeadSegment { name, parent, runs }
        })
        .collect()
}
