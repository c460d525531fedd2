//! Scalp skin: its texture has the colour of the figure's own hair, which is visible at partings.

use raconteur_base::DVec3;

use super::accessory::landmark;
use super::hairs::{self, Strands};
use super::look::Hair;
use super::speckle::FacePoints;
use super::{Reshaper, wide};
use raconteur_body::figure::{Figure, MaterialKind, Mesh};

/// Radius of the scalp around the roots of hair, metres.
const ABOUT_ROOT_M: f64 = 0.0085;
/// Half the maximum number of triangles between rows of roots.
const GAP_TRIANGLES: usize = 3;
/// Radius around the roots within which the figure's own hair or beard is painted, metres.
const PAINTED_M: f64 = 0.017;
/// Skin between hairs is so much darker than they are.
const BETWEEN: f64 = 0.55;
/// Skin under a figure's own hair is in its shade; without that hair it has at least this much light, 0..255.
const LIT: u8 = 238;
/// Relative height between the bridge of the nose and the hairline at which skin resembles a bare
/// scalp.
const FOREHEAD: f64 = 0.6;

/// Paint for the skin texture under hair of another colour or cut, which replaces the figure's own
/// scalp colour.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ScalpPaint {
    /// Colour of the texture under hair, linear red, green and blue, 0..1.
    pub rgb: [f64; 3],
    /// Texture coordinates of triangles under hair, three to each.
    pub corners: Vec<[f32; 2]>,
    /// Texture coordinates of those triangles where the figure's own hair is painted but no hair
    /// grows.
    pub bare: Vec<[f32; 2]>,
    /// Texture coordinates of skin that resembles a bare scalp.
    pub like: [f32; 2],
}

impl Reshaper {
    /// Returns the paint for the hair and beard of a figure produced by this reshaper; empty if
    /// both are the figure's own and unchanged.
    #[must_use]
    pub fn scalp_paint(&self, figure: &Figure, hair: &Hair, beard: &Hair) -> ScalpPaint {
        let mut paint = self.under_hair(figure, hair);
        if !beard.is_own() {
            paint.bare.extend(self.shaved());
        }
        if !paint.bare.is_empty() {
            paint.like = self.forehead();
        }
        paint
    }

    /// Returns texture coordinates of the triangles on which the figure's own beard is painted.
    fn shaved(&self) -> Vec<[f32; 2]> {
        let own = &self.figure.meshes[self.head];
        let roots = roots(&self.figure, self.origin, Strands::Face);
        let Some(places) =
            FacePoints::from_skin(&own.positions, self.origin).filter(|_| !roots.is_empty())
        else {
            return Vec::new();
        };
        let near = self.about(own, &roots, PAINTED_M);
        let is_skin = |v: u32| {
            let v = v as usize;
            near[v] && !places.on_lips(wide(own.positions[v]) - self.origin)
        };
        self.charted(|t| t.iter().all(|&v| is_skin(v)))
    }

    fn under_hair(&self, figure: &Figure, hair: &Hair) -> ScalpPaint {
        let Some(now) = figure.meshes.get(self.head) else {
            return ScalpPaint::default();
        };
        let rgb = match hair.colour {
            Some(colour) => colour.linear_rgb(),
            None if hair.lender().is_some() => mean_colour(figure),
            None if hair.from == "bald" => [0.0; 3],
            None => return ScalpPaint::default(),
        };
        let is_hairy = match hair.lender() {
            Some(_) => self.without_gaps(self.about(
                now,
                &roots(figure, self.origin, Strands::Scalp),
                ABOUT_ROOT_M,
            )),
            None if hair.from == "bald" => vec![false; self.vertices],
            None => self.scalp().to_vec(),
        };
        let under = |t: &&[u32; 3]| t.iter().all(|&v| is_hairy[v as usize]);
        let mut paint = ScalpPaint {
            corners: self.charted(under),
            ..ScalpPaint::default()
        };
        if !hair.is_own() && hair.from != "none" {
            let own = &self.figure.meshes[self.head];
            let painted = self.about(
                own,
                &roots(&self.figure, self.origin, Strands::Scalp),
                PAINTED_M,
            );
            paint.bare = self.charted(|t| t.iter().any(|&v| painted[v as usize]) && !under(t));
        }
        paint.rgb = self.on_picture(now, &is_hairy, rgb);
        paint
    }

    /// Returns, for each vertex of the skin, true if the figure's own hair grows around it.
    pub(super) fn scalp(&self) -> &[bool] {
        let own = &self.figure.meshes[self.head];
        self.scalp.get_or_init(|| {
            self.about(
                own,
                &roots(&self.figure, self.origin, Strands::Scalp),
                ABOUT_ROOT_M,
            )
        })
    }

    /// Lights the skin that the figure's own hair has shaded.
    pub(super) fn unshade_scalp(&self, skin: &mut Mesh) {
        for (colour, is_scalp) in skin.colors.iter_mut().zip(self.scalp()) {
            if *is_scalp {
                colour[3] = colour[3].max(LIT);
            }
        }
    }

    /// Returns the texture coordinates of the selected triangles of the skin, three per triangle.
    fn charted(&self, is_wanted: impl Fn(&&[u32; 3]) -> bool) -> Vec<[f32; 2]> {
        let uvs = &self.figure.meshes[self.head].uvs;
        let triangles = self.triangles.iter().filter(is_wanted);
        triangles.flatten().map(|&v| uvs[v as usize]).collect()
    }

    /// Converts a colour to that of the texture, which multiplies the colour of some vertices.
    fn on_picture(&self, skin: &Mesh, of: &[bool], rgb: [f64; 3]) -> [f64; 3] {
        let mut tone = [0.0; 3];
        let mut count = 0.0_f64;
        for (colour, _) in skin.colors.iter().zip(of).filter(|(_, is)| **is) {
            let parts = colour.iter().zip(skin.material.base_color);
            for (sum, (c, base)) in tone.iter_mut().zip(parts) {
                *sum += f64::from(*c) / 255.0 * f64::from(base);
            }
            count += 1.0;
        }
        core::array::from_fn(|i| (BETWEEN * rgb[i] * count.max(1.0) / tone[i].max(1e-3)).min(1.0))
    }

    /// Returns the texture coordinates of a point of the forehead.
    fn forehead(&self) -> [f32; 2] {
        let skin = &self.figure.meshes[self.head];
        let at = |v: usize| skin.positions.get(v).map_or(DVec3::ZERO, |&p| wide(p));
        let middle = at(landmark::SELLION).lerp(at(landmark::TRICHION), FOREHEAD);
        let places = skin.positions[..self.vertices].iter().zip(&skin.uvs);
        let nearest = places.min_by(|(a, _), (b, _)| {
            let off = |p: &[f32; 3]| wide(*p).distance_squared(middle);
            off(a).total_cmp(&off(b))
        });
        nearest.map_or([0.0; 2], |(_, uv)| *uv)
    }

    /// Fills the gaps between marked vertices: rows of roots are farther apart than gaps in hair.
    fn without_gaps(&self, mut marked: Vec<bool>) -> Vec<bool> {
        for spreads in [true, false] {
            for _ in 0..GAP_TRIANGLES {
                let before = marked.clone();
                for t in &self.triangles {
                    if t.iter().any(|&v| before[v as usize] == spreads) {
                        t.iter().for_each(|&v| marked[v as usize] = spreads);
                    }
                }
            }
        }
        marked
    }

    /// Returns, for each vertex of a skin, true if a root is near; roots must be sorted by
    /// ascending y.
    fn about(&self, skin: &Mesh, roots: &[DVec3], reach: f64) -> Vec<bool> {
        let near = |p: DVec3| {
            let from = roots.partition_point(|r| r.y < p.y - reach);
            let mut level = roots[from..].iter().take_while(|r| r.y < p.y + reach);
            level.any(|r| r.distance_squared(p) < reach * reach)
        };
        let places = &skin.positions[..self.vertices.min(skin.positions.len())];
        places.iter().map(|&p| near(wide(p))).collect()
    }
}

/// Returns the roots of a figure's hair in one region, sorted by ascending y.
fn roots(figure: &Figure, origin: DVec3, strands: Strands) -> Vec<DVec3> {
    let hair = figure.meshes.iter().filter(is_hair);
    let mut roots: Vec<DVec3> = hair
        .flat_map(hairs::roots_of)
        .filter(|root| hairs::grows(strands, *root - origin))
        .collect();
    roots.sort_by(|a, b| a.y.total_cmp(&b.y).then(a.x.total_cmp(&b.x)));
    roots.dedup();
    roots
}

fn is_hair(mesh: &&Mesh) -> bool {
    mesh.material.kind == MaterialKind::Hair && mesh.name != hairs::BEARD
}

/// Returns the mean colour of the hair on the scalp, linear RGB.
fn mean_colour(figure: &Figure) -> [f64; 3] {
    let mut sum = [0.0; 3];
    let mut count = 0.0_f64;
    for mesh in figure.meshes.iter().filter(is_hair) {
        for colour in &mesh.colors {
            for (i, sum) in sum.iter_mut().enumerate() {
                *sum += f64::from(colour[i]) / 255.0 * f64::from(mesh.material.base_color[i]);
            }
        }
        count += mesh.colors.len() as f64;
    }
    sum.map(|x| x / count.max(1.0))
}
