//! Roots spread over the scalp, none nearer to another than its layer allows.

use std::collections::BTreeMap;

use raconteur_base::{DVec3, noise};

use super::line::Line;
use super::space::Space;

/// Places that are tried, over the whole scalp.
const TRIED: usize = 60_000;
/// How far outside the line places are still tried: fine hair goes on there, metres.
const OUTSIDE_M: f64 = 0.012;
/// Above this height over the head without ears a place lies on an ear, metres.
const ON_EAR_M: f64 = 0.0025;

/// A place where a hair may be rooted.
#[derive(Clone, Copy, Debug)]
pub(super) struct Root {
    pub(super) position: DVec3,
    pub(super) normal: DVec3,
    /// Distance inside the hairline, metres.
    pub(super) inside: f64,
}

/// Places all over the scalp, evenly by area and in no order.
pub(super) fn candidates(space: &Space, line: &Line, seed: u64) -> Vec<Root> {
    let corners = |t: &[u32; 3]| t.map(|v| space.skin[v as usize]);
    let wanted: Vec<[u32; 3]> = space
        .triangles
        .iter()
        .filter(|t| {
            let middle = corners(t).map(|c| c.position).iter().sum::<DVec3>() / 3.0;
            middle.y > -0.13 && line.smooth_distance(middle) > -2.0 * OUTSIDE_M
        })
        .copied()
        .collect();
    let mut total = 0.0;
    let sums: Vec<f64> = wanted
        .iter()
        .map(|t| {
            let [a, b, c] = corners(t).map(|c| c.position);
            total += (b - a).cross(c - a).length();
            total
        })
        .collect();
    (0..TRIED as i64)
        .filter_map(|i| {
            let dice = |k: u64| noise::unit(seed, 900 + k, i);
            let t = wanted.get(sums.partition_point(|s| *s < dice(0) * total))?;
            let (mut u, mut v) = (dice(1), dice(2));
            if u + v > 1.0 {
                (u, v) = (1.0 - u, 1.0 - v);
            }
            let [a, b, c] = corners(t);
            let w = 1.0 - u - v;
            let position = a.position * w + b.position * u + c.position * v;
            let inside = line.distance(position);
            (inside > -OUTSIDE_M && space.height_without_ears(position) < ON_EAR_M).then(|| Root {
                position,
                normal: (a.normal * w + b.normal * u + c.normal * v).normalize_or(DVec3::Y),
                inside,
            })
        })
        .collect()
}

/// Some of the places, none nearer to an earlier one than that one's own distance; those with a
/// distance of 0 or less are left out.
pub(super) fn spread(places: &[Root], distance: impl Fn(&Root) -> f64) -> Vec<Root> {
    const CELL: f64 = 0.016;
    let cell = |p: DVec3| (p / CELL).floor().to_array().map(|c| c as i32);
    let mut cells: BTreeMap<[i32; 3], Vec<(DVec3, f64)>> = BTreeMap::new();
    let mut kept = Vec::new();
    let mut farthest: f64 = 0.0;
    for root in places {
        let own = distance(root);
        if own <= 0.0 {
            continue;
        }
        let [x, y, z] = cell(root.position);
        let reach = (farthest / CELL).ceil() as i32;
        let is_free = (-reach..=reach).all(|i| {
            (-reach..=reach).all(|j| {
                (-reach..=reach).all(|k| {
                    cells.get(&[x + i, y + j, z + k]).is_none_or(|near| {
                        near.iter()
                            .all(|(p, d)| p.distance_squared(root.position) >= d * d)
                    })
                })
            })
        });
        if is_free {
            farthest = farthest.max(own);
            cells
                .entry([x, y, z])
                .or_default()
                .push((root.position, own));
            kept.push(*root);
        }
    }
    kept
}
