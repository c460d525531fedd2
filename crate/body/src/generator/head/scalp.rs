//! Where hair grows: the hairline and the skin above it.

use raconteur_base::{DVec3, ops};

use super::rig::smooth;

/// A vertex of the head's skin as hair sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScalpPoint {
    /// Position, metres, frame of the head.
    pub position: DVec3,
    /// Outward unit normal.
    pub normal: DVec3,
    /// 1 where hair grows densely, falling to 0 over the hairline.
    pub density: f64,
}

/// The part of the skin on which hair grows.
#[derive(Clone, Debug, Default)]
pub struct Scalp {
    /// Vertices.
    pub points: Vec<ScalpPoint>,
    /// Triangles, counter-clockwise from outside; each has a vertex of density above zero.
    pub triangles: Vec<[u32; 3]>,
}

/// Height of the hairline, mm, by angle from the front in degrees.
const HAIRLINE: [[f64; 2]; 14] = [
    [0.0, 80.0],
    [15.0, 80.0],
    [28.0, 82.0],
    [40.0, 79.0],
    [52.0, 66.0],
    [62.0, 54.0],
    [72.0, 42.0],
    [80.0, 22.0],
    [88.0, -6.0],
    [100.0, 26.0],
    [112.0, 20.0],
    [125.0, -24.0],
    [150.0, -48.0],
    [180.0, -54.0],
];

/// Density of hair at a place, 0..1; mm.
pub(super) fn hairline(p: DVec3) -> f64 {
    let angle = ops::atan2(p.x.abs(), p.z).to_degrees();
    let next = HAIRLINE
        .iter()
        .position(|h| h[0] >= angle)
        .unwrap_or(13)
        .max(1);
    let ([a, low], [b, high]) = (HAIRLINE[next - 1], HAIRLINE[next]);
    let line = low + (high - low) * ((angle - a) / (b - a)).clamp(0.0, 1.0);
    smooth(-4.0, 11.0, p.y - line)
}

/// The part of the skin with hair; positions in mm.
pub(super) fn scalp(
    positions: &[DVec3],
    normals: &[DVec3],
    density: &[f64],
    all: &[[u32; 3]],
) -> Scalp {
    let mut index = vec![u32::MAX; positions.len()];
    let mut scalp = Scalp::default();
    for t in all
        .iter()
        .filter(|t| t.iter().any(|&v| density[v as usize] > 0.0))
    {
        scalp.triangles.push(t.map(|v| {
            let slot = &mut index[v as usize];
            if *slot == u32::MAX {
                *slot = scalp.points.len() as u32;
                scalp.points.push(ScalpPoint {
                    position: positions[v as usize] * 1e-3,
                    normal: normals[v as usize],
                    density: density[v as usize],
                });
            }
            *slot
        }));
    }
    scalp
}
