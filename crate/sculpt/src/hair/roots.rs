//! Roots spread over the scalp, with the minimum distance of their layer.

use std::collections::BTreeMap;

use raconteur_base::{DVec3, noise};

use super::line::Line;
use super::space::{Sample, Space};

/// Number of candidate positions over the whole scalp.
const TRIED: usize = 60_000;
/// Distance outside the hairline at which candidates are still placed, for fine hair, metres.
const OUTSIDE_M: f64 = 0.012;
/// Height over the head without ears above which a position counts as ear, metres.
const ON_EAR_M: f64 = 0.0025;

/// Candidate position for the root of a hair on the scalp.
#[derive(Clone, Copy, Debug)]
pub(super) struct Root {
    pub(super) position: DVec3,
    pub(super) normal: DVec3,
    /// Distance inside the hairline, metres.
    pub(super) inside: f64,
}

/// Item with a position, which can be spread over the scalp with a minimum distance.
pub(super) trait Place: Copy {
    fn position(&self) -> DVec3;
}

impl Place for Root {
    fn position(&self) -> DVec3 {
        self.position
    }
}

impl Place for Sample {
    fn position(&self) -> DVec3 {
        self.position
    }
}

/// Scatters positions over triangles, uniformly by area and in random order.
pub(super) fn scattered(
    triangles: &[[Sample; 3]],
    count: usize,
    seed: u64,
) -> impl Iterator<Item = Sample> + '_ {
    let mut total = 0.0;
    let sums: Vec<f64> = triangles
        .iter()
        .map(|t| {
            let [a, b, c] = t.map(|c| c.position);
            total += (b - a).cross(c - a).length();
            total
        })
        .collect();
    (0..count as i64).filter_map(move |i| {
        let dice = |k: u64| noise::unit(seed, 900 + k, i);
        let [a, b, c] = triangles.get(sums.partition_point(|s| *s < dice(0) * total))?;
        let (mut u, mut v) = (dice(1), dice(2));
        if u + v > 1.0 {
            (u, v) = (1.0 - u, 1.0 - v);
        }
        let w = 1.0 - u - v;
        Some(Sample {
            position: a.position * w + b.position * u + c.position * v,
            normal: (a.normal * w + b.normal * u + c.normal * v).normalize_or(DVec3::Y),
        })
    })
}

/// Returns candidate positions over the whole scalp.
pub(super) fn candidates(space: &Space, line: &Line, seed: u64) -> Vec<Root> {
    let is_wanted = |t: &[Sample; 3]| {
        let middle = t.iter().map(|c| c.position).sum::<DVec3>() / 3.0;
        middle.y > -0.13 && line.smooth_distance(middle) > -2.0 * OUTSIDE_M
    };
    let corner = |v: u32| {
        let s = &space.skin[v as usize];
        Sample {
            position: s.position,
            normal: s.normal,
        }
    };
    let wanted: Vec<[Sample; 3]> = space
        .triangles
        .iter()
        .map(|t| t.map(corner))
        .filter(is_wanted)
        .collect();
    scattered(&wanted, TRIED, seed)
        .filter_map(|s| {
            let inside = line.distance(s.position);
            let is_scalp = inside > -OUTSIDE_M && space.height_without_ears(s.position) < ON_EAR_M;
            is_scalp.then_some(Root {
                position: s.position,
                normal: s.normal,
                inside,
            })
        })
        .collect()
}

/// Selects positions such that none is nearer to an earlier one than that one's own distance; those
/// with a distance of 0 or less are skipped.
pub(super) fn spread<P: Place>(places: &[P], distance: impl Fn(&P) -> f64) -> Vec<P> {
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
        let [x, y, z] = cell(root.position());
        let reach = (farthest / CELL).ceil() as i32;
        let is_free = (-reach..=reach).all(|i| {
            (-reach..=reach).all(|j| {
                (-reach..=reach).all(|k| {
                    cells.get(&[x + i, y + j, z + k]).is_none_or(|near| {
                        near.iter()
                            .all(|(p, d)| p.distance_squared(root.position()) >= d * d)
                    })
                })
            })
        });
        if is_free {
            farthest = farthest.max(own);
            cells
                .entry([x, y, z])
                .or_default()
                .push((root.position(), own));
            kept.push(*root);
        }
    }
    kept
}
