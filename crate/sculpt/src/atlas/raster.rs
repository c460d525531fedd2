//! Rasteriser of triangles to texels, and filling beyond them.

use raconteur_base::DVec2;

/// Side of the square atlas, texels.
pub(crate) const SIZE: usize = 1024;

/// Margin beyond a chart's edge to which its surface is extended, texels: the reach of bilinear
/// filtering and two levels of a mip chain.
const MARGIN: usize = 5;

/// Surface point under a texel, as a triangle with barycentric weights. In the margin beyond the
/// triangle's edge, weights leave 0..1.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Hit {
    pub(crate) triangle: u32,
    pub(crate) weights: [f32; 3],
    /// Inside a triangle, not in the margin.
    #[cfg(test)]
    pub(crate) inside: bool,
}

impl Hit {
    /// Interpolates a quantity of the corners.
    pub(crate) fn blend<T>(&self, corners: [T; 3]) -> T
    where
        T: core::ops::Mul<f64, Output = T> + core::ops::Add<Output = T>,
    {
        let [a, b, c] = corners;
        let [x, y, z] = self.weights.map(f64::from);
        a * x + b * y + c * z
    }
}

/// Rasterised texture atlas: the surface point of each texel, and the number of overlaps.
pub(crate) struct Raster {
    /// Hits in rows from the top; `None` where no surface lies.
    pub(crate) hits: Vec<Option<Hit>>,
    /// Number of texels whose centre lies in more than one triangle.
    #[cfg(test)]
    pub(crate) overlaps: usize,
}

fn weights_at(corners: [DVec2; 3], p: DVec2) -> Option<[f64; 3]> {
    let [a, b, c] = corners;
    let whole = (b - a).perp_dot(c - a);
    if whole.abs() < 1e-9 {
        return None;
    }
    let (x, y) = (
        (b - p).perp_dot(c - p) / whole,
        (c - p).perp_dot(a - p) / whole,
    );
    Some([x, y, 1.0 - x - y])
}

fn centre(x: usize, y: usize) -> DVec2 {
    DVec2::new(x as f64 + 0.5, y as f64 + 0.5)
}

impl Raster {
    /// Rasterises triangles with texture coordinates `uv`, 0..1 over the atlas.
    pub(crate) fn new(uv: &[[f64; 2]], triangles: &[[u32; 3]]) -> Self {
        let texel = |v: u32| DVec2::from_array(uv[v as usize]) * SIZE as f64;
        let mut hits: Vec<Option<Hit>> = vec![None; SIZE * SIZE];
        #[cfg(test)]
        let mut overlaps = 0;
        let limit = |x: f64| x.clamp(0.0, SIZE as f64) as usize;
        for (i, t) in triangles.iter().enumerate() {
            let corners = t.map(texel);
            let low = corners[0].min(corners[1]).min(corners[2]);
            let high = corners[0].max(corners[1]).max(corners[2]);
            for y in limit(low.y)..limit(high.y + 1.0) {
                for x in limit(low.x)..limit(high.x + 1.0) {
                    let Some(w) = weights_at(corners, centre(x, y)) else {
                        continue;
                    };
                    if w.iter().any(|&k| k < 0.0) {
                        continue;
                    }
                    let slot = &mut hits[y * SIZE + x];
                    // On a shared edge, both triangles give the same value.
                    #[cfg(test)]
                    if slot.is_some() && w.iter().all(|&k| k > 1e-9) {
                        overlaps += 1;
                    }
                    *slot = Some(Hit {
                        triangle: i as u32,
                        weights: w.map(|k| k as f32),
                        #[cfg(test)]
                        inside: true,
                    });
                }
            }
        }
        for _ in 0..MARGIN {
            let before: Vec<Option<u32>> = hits.iter().map(|h| h.map(|h| h.triangle)).collect();
            for (i, slot) in hits.iter_mut().enumerate() {
                if slot.is_some() {
                    continue;
                }
                let (x, y) = (i % SIZE, i / SIZE);
                let near = [
                    (x > 0).then(|| i - 1),
                    (x + 1 < SIZE).then_some(i + 1),
                    (y > 0).then(|| i.saturating_sub(SIZE)),
                    (y + 1 < SIZE).then_some(i + SIZE),
                ];
                let Some(triangle) = near.into_iter().flatten().find_map(|j| before[j]) else {
                    continue;
                };
                let corners = triangles[triangle as usize].map(texel);
                if let Some(w) = weights_at(corners, centre(x, y)) {
                    // A sliver would move the point far away.
                    let w = w.map(|k| k.clamp(-2.0, 3.0));
                    let sum: f64 = w.iter().sum();
                    *slot = Some(Hit {
                        triangle,
                        weights: w.map(|k| (k / sum) as f32),
                        #[cfg(test)]
                        inside: false,
                    });
                }
            }
        }
        Self {
            hits,
            #[cfg(test)]
            overlaps,
        }
    }
}

/// Fills the empty texels of a square image from their surroundings, by averaging to coarser images
/// and reading back, so that no background colour bleeds into a mip level and the encoder meets no
/// edges.
pub(crate) fn fill(picture: &mut [Option<[f32; 3]>], side: usize) {
    if side <= 1 {
        picture[0].get_or_insert([0.0; 3]);
        return;
    }
    let half = side / 2;
    let mut coarse: Vec<Option<[f32; 3]>> = vec![None; half * half];
    for (i, slot) in coarse.iter_mut().enumerate() {
        let first = 2 * (i / half) * side + 2 * (i % half);
        let known = [first, first + 1, first + side, first + side + 1].map(|j| picture[j]);
        let count = known.iter().flatten().count() as f32;
        if count > 0.0 {
            let mut sum = [0.0; 3];
            for k in known.iter().flatten() {
                for (s, x) in sum.iter_mut().zip(k) {
                    *s += x / count;
                }
            }
            *slot = Some(sum);
        }
    }
    fill(&mut coarse, half);
    for (i, slot) in picture.iter_mut().enumerate() {
        if slot.is_none() {
            *slot = coarse[(i / side / 2) * half + (i % side) / 2];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_square_is_covered_once_and_its_margin_goes_on() {
        let uv = [[0.25, 0.25], [0.5, 0.25], [0.5, 0.5], [0.25, 0.5]];
        let raster = Raster::new(&uv, &[[0, 1, 2], [0, 2, 3]]);
        assert_eq!(raster.overlaps, 0);
        let inside = raster.hits.iter().flatten().filter(|h| h.inside).count();
        assert_eq!(inside, (SIZE / 4) * (SIZE / 4));
        let beside = raster.hits[300 * SIZE + SIZE / 4 - 3].unwrap();
        assert!(!beside.inside, "the texel next to the square is outside");
        let u =
            beside.blend([[0, 1, 2], [0, 2, 3]][beside.triangle as usize].map(|v: usize| uv[v][0]));
        assert!(
            (u * SIZE as f64 - (SIZE as f64 / 4.0 - 2.5)).abs() < 1e-3,
            "the texel blends to its own position"
        );
        let twice = Raster::new(&uv, &[[0, 1, 2], [0, 2, 3], [0, 1, 2]]);
        assert!(twice.overlaps > inside / 3, "a repeated triangle overlaps");
    }

    #[test]
    fn filling_leaves_no_hole_and_keeps_what_is_known() {
        let mut picture = vec![None; 64];
        picture[9] = Some([0.5, 0.25, 1.0]);
        picture[40] = Some([0.0, 0.75, 0.0]);
        fill(&mut picture, 8);
        assert_eq!(picture[9], Some([0.5, 0.25, 1.0]));
        for p in picture {
            assert!(
                (0.0..=0.75).contains(&p.unwrap()[1]),
                "the filled texel is within the range of the known ones"
            );
        }
    }
}
