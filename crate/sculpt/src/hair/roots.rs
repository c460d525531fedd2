//! Roots spread over the scalp by area and density.

use raconteur_base::{DVec3, noise};

use super::cut::{Cut, Layer, Where, slope};
use crate::head::{Head, ScalpPoint};

/// Roots of one layer; `number` keeps the layers' dice apart.
pub(super) fn roots(
    head: &Head,
    cut: &dyn Cut,
    cover: &[f64],
    layer: &Layer,
    seed: u64,
    number: u64,
) -> Vec<ScalpPoint> {
    let scalp = &head.scalp;
    let share = |t: &[u32; 3]| t.iter().map(|&i| cover[i as usize]).sum::<f64>() / 3.0;
    let corner = |t: &[u32; 3]| t.map(|i| scalp.points[i as usize]);
    let mut total = 0.0;
    let sums: Vec<f64> = scalp
        .triangles
        .iter()
        .map(|t| {
            let [a, b, c] = corner(t).map(|s| s.position);
            let area = (b - a).cross(c - a).length();
            let middle = scalp.proportions.common((a + b + c) / 3.0);
            let parting = 3.0 * cut.parting(middle);
            let d = share(t);
            let wanted = match layer.roots {
                // Denser where it begins to thin, so that the line is not bare; but before
                // the line a long lock would start on the forehead.
                Where::All => d.sqrt() * slope(0.12, 0.45, d) * (1.0 + parting),
                Where::Hairline if middle.z > -0.012 => 4.0 * d * (1.0 - d),
                Where::Hairline => 0.0,
                Where::Parting => d * slope(0.12, 0.45, d) * parting,
            };
            total += area * wanted;
            total
        })
        .collect();
    (0..layer.cards)
        .filter_map(|i| {
            let dice = |k: u64| noise::unit(seed, k + 8 * number, i as i64);
            let want = (i as f64 + dice(1)) / layer.cards as f64 * total;
            let t = scalp.triangles.get(sums.partition_point(|s| *s < want))?;
            let [a, b, c] = corner(t);
            let (mut u, mut v) = (dice(2), dice(3));
            if u + v > 1.0 {
                (u, v) = (1.0 - u, 1.0 - v);
            }
            let w = 1.0 - u - v;
            let mix = |f: fn(&ScalpPoint) -> DVec3| f(&a) * w + f(&b) * u + f(&c) * v;
            Some(ScalpPoint {
                position: mix(|s| s.position),
                normal: mix(|s| s.normal).try_normalize()?,
                density: share(t),
            })
        })
        .collect()
}
