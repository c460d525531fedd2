//! The skin that hair grows on: its picture has the colour of the figure's own hair, which shows at partings.

use raconteur_base::DVec3;

use super::hairs::{self, Strands};
use super::{Reshaper, wide};
use crate::figure::{Figure, MaterialKind};

/// The scalp reaches so far about the roots of hair, metres.
const ABOUT_ROOT_M: f64 = 0.0085;
/// Skin between hairs is so much darker than they are.
const BETWEEN: f64 = 0.55;

/// What to paint on the picture of a figure's skin, so that hair of another colour has a scalp of its own.
#[derive(Clone, Debug, PartialEq)]
pub struct ScalpPaint {
    /// Colour of the picture, linear red, green and blue, 0..1.
    pub rgb: [f64; 3],
    /// Texture coordinates of triangles, three to each.
    pub corners: Vec<[f32; 2]>,
}

impl Reshaper {
    /// What to paint for hair of a colour (linear) on a figure that this one made; no triangles where the
    /// figure has no hair of its own.
    #[must_use]
    pub fn scalp_paint(&self, figure: &Figure, hair: [f64; 3]) -> ScalpPaint {
        let is_scalp = self.scalp();
        let own = self.triangles.iter();
        let triangles: Vec<&[u32; 3]> = own
            .filter(|t| t.iter().all(|&v| is_scalp[v as usize]))
            .collect();
        let skin = &self.figure.meshes[self.head];
        let corners = triangles.iter().flat_map(|t| t.iter());
        let corners: Vec<[f32; 2]> = corners.map(|&v| skin.uvs[v as usize]).collect();
        // The picture multiplies the colour of the vertices.
        let now = figure.meshes.get(self.head).unwrap_or(skin);
        let base = now.material.base_color;
        let mut tone = [0.0; 3];
        let mut count = 0.0_f64;
        for (colour, _) in now.colors.iter().zip(&is_scalp).filter(|(_, is)| **is) {
            for (sum, (c, base)) in tone.iter_mut().zip(colour.iter().zip(base)) {
                *sum += f64::from(*c) / 255.0 * f64::from(base);
            }
            count += 1.0;
        }
        let part = |i: usize| (BETWEEN * hair[i] * count.max(1.0) / tone[i].max(1e-3)).min(1.0);
        ScalpPaint {
            rgb: core::array::from_fn(part),
            corners,
        }
    }

    /// Whether hair grows about each vertex of the skin.
    pub(super) fn scalp(&self) -> Vec<bool> {
        let meshes = self.figure.meshes.iter();
        let hair = meshes.filter(|m| m.material.kind == MaterialKind::Hair);
        let mut roots: Vec<DVec3> = hair
            .flat_map(hairs::roots_of)
            .filter(|root| hairs::grows(Strands::Scalp, *root - self.origin))
            .collect();
        roots.sort_by(|a, b| a.y.total_cmp(&b.y).then(a.x.total_cmp(&b.x)));
        roots.dedup();
        let near = |p: DVec3| {
            let from = roots.partition_point(|r| r.y < p.y - ABOUT_ROOT_M);
            let mut level = roots[from..]
                .iter()
                .take_while(|r| r.y < p.y + ABOUT_ROOT_M);
            level.any(|r| (*r - p).length() < ABOUT_ROOT_M)
        };
        let places = &self.figure.meshes[self.head].positions[..self.vertices];
        places.iter().map(|&p| near(wide(p))).collect()
    }
}
