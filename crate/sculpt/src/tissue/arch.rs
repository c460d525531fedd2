//! Outer face of a row of teeth with its gums, as distances from an upright axis.

use raconteur_base::DVec3;

use super::narrow;
use crate::part::{MeshPart, PartVertex};
use raconteur_tissue::tissue::Arch;

/// Rows this far apart, metres.
const STEP_M: f64 = 0.0015;
const COLUMNS: usize = 49;
/// Number of samples along each side of a face.
const PIECES: usize = 8;

/// Returns the arch of the teeth and gums whose vertices `own` accepts.
pub(super) fn arch(rigid: &[&MeshPart], own: impl Fn(&PartVertex) -> bool) -> Arch {
    let mut points: Vec<DVec3> = Vec::new();
    for part in rigid {
        for [a, b, c] in part.triangles_about_middles(&own) {
            for i in 0..=PIECES {
                for j in 0..=PIECES - i {
                    let (u, v) = (i as f64 / PIECES as f64, j as f64 / PIECES as f64);
                    points.push(a * (1.0 - u - v) + b * u + c * v);
                }
            }
        }
    }
    let Some(front) = points.iter().map(|p| p.z).reduce(f64::max) else {
        return Arch::default();
    };
    let low = points.iter().map(|p| p.y).fold(f64::MAX, f64::min);
    let high = points.iter().map(|p| p.y).fold(f64::MIN, f64::max);
    let back = points.iter().map(|p| p.z).fold(f64::MAX, f64::min);
    // The axis is at the widest part of the arch.
    let origin = DVec3::new(0.0, low, back.max(front - 0.043));
    let rows = ((high - low) / STEP_M).ceil() as usize + 1;
    let mut radii = vec![0.0f32; rows * COLUMNS];
    for p in &points {
        let d = *p - origin;
        if d.z <= 0.0 {
            continue;
        }
        let along = f64::from(Arch::direction(d.x as f32, d.z as f32));
        // Rounded from the middle outwards, so that both halves are rounded alike.
        let half = COLUMNS / 2;
        let aside = ((along.abs() * half as f64).round() as usize).min(half);
        let column = if along < 0.0 {
            half - aside
        } else {
            half + aside
        };
        let row = ((p.y - low) / STEP_M).round() as usize;
        let r = &mut radii[row.min(rows - 1) * COLUMNS + column];
        *r = r.max(d.with_y(0.0).length() as f32);
    }
    // Gaps between two samples of a row are no gaps between teeth.
    for row in radii.chunks_exact_mut(COLUMNS) {
        for c in 1..COLUMNS - 1 {
            if row[c] == 0.0 && row[c - 1] > 0.0 && row[c + 1] > 0.0 {
                row[c] = 0.5 * (row[c - 1] + row[c + 1]);
            }
        }
    }
    Arch {
        origin: narrow(origin),
        step_m: STEP_M as f32,
        rows: rows as u16,
        columns: COLUMNS as u16,
        radii,
    }
}
