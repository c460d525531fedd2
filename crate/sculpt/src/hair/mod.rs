//! Hair: strand cards that follow a combing field over the head, a cap of short hair under
//! them, and beards.
//!
//! Each card is a strip of two columns along a guide curve. Curves start on the scalp, run
//! along the skin at the height of their layer and give way to gravity; neighbours gather
//! into locks. The renderer draws the strands on the cards from the texture coordinates.
//!
//! A style (`cut::Cut`) is described on the common head of
//! [`crate::head::Proportions`], so that each fits every head.

mod beard;
mod bob;
mod bun;
mod card;
mod colour;
mod cut;
mod ground;
mod grow;
mod roots;
mod short;
mod skin;
#[cfg(test)]
mod tests;

use std::collections::BTreeMap;

use raconteur_base::DVec3;
use raconteur_base::curve::lerp;
use serde::{Deserialize, Serialize};

pub use beard::BeardParams;
pub use colour::HairColour;

use self::cut::Cut;
use self::ground::Ground;
use crate::assemble::Piece;
use crate::head::Head;
use crate::part::MeshPart;
use raconteur_body::figure::{Maps, Material, MaterialKind};

/// How hair is cut and combed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum HairStyle {
    /// None on the scalp.
    Bald,
    /// A few millimetres all over.
    Buzz,
    /// Short and tidy, combed forward and to the side.
    Crop,
    /// A boy's unruly hair about a whorl, with a fringe and a cowlick.
    Tousled,
    /// Short, combed back from the forehead.
    Swept,
    /// To the jaw with a side parting, tucked behind the ear on the parting's side.
    Bob,
    /// Past the shoulders with a side parting.
    Long,
    /// Drawn back into a knot.
    Bun,
}

impl HairStyle {
    /// Every style with its name in parameter files.
    pub const NAMES: [(Self, &'static str); 8] = [
        (Self::Bald, "bald"),
        (Self::Buzz, "buzz"),
        (Self::Crop, "crop"),
        (Self::Tousled, "tousled"),
        (Self::Swept, "swept"),
        (Self::Bob, "bob"),
        (Self::Long, "long"),
        (Self::Bun, "bun"),
    ];
}

/// Hair and beard of a person.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct HairParams {
    /// Cut and combing.
    pub style: HairStyle,
    /// Colour of scalp hair and beard.
    pub colour: HairColour,
    /// Length against the style's own, 0.6..1.4.
    pub length: f64,
    /// Height of the volume against the style's own, 0.5..1.5.
    pub volume: f64,
    /// Width of the waves to either side, metres, 0..0.01.
    pub wave: f64,
    /// Where the hair is parted, to the left, metres on the common head.
    pub parting_x: f64,
    /// How far the hairline has receded at the temples, 0..1.
    pub recession: f64,
    /// How thin the crown has become, 0..1.
    pub thinning: f64,
    /// A beard.
    pub beard: Option<BeardParams>,
    /// Seed of all that is scattered.
    pub seed: u64,
}

impl Default for HairParams {
    fn default() -> Self {
        Self {
            style: HairStyle::Crop,
            colour: HairColour::default(),
            length: 1.0,
            volume: 1.0,
            wave: 0.0,
            parting_x: 0.018,
            recession: 0.0,
            thinning: 0.0,
            beard: None,
            seed: 11,
        }
    }
}

/// Signed distance to the dressed body and its outward normal, frame of the head, metres.
pub type BodyDistance<'a> = dyn Fn(DVec3) -> (f64, DVec3) + 'a;

fn cut_of(p: &HairParams) -> Option<Box<dyn Cut>> {
    Some(match p.style {
        HairStyle::Bald => return None,
        HairStyle::Buzz | HairStyle::Crop | HairStyle::Tousled | HairStyle::Swept => {
            Box::new(short::Short::new(p))
        }
        HairStyle::Bob | HairStyle::Long => Box::new(bob::Bob::new(p)),
        HairStyle::Bun => Box::new(bun::Bun::new(p)),
    })
}

/// Share of each point of the scalp that hair covers, 0..1.
fn cover(head: &Head, p: &HairParams) -> Vec<f64> {
    let cut = cut_of(p);
    let common = |at: DVec3| head.scalp.proportions.common(at);
    head.scalp
        .points
        .iter()
        .map(|s| {
            cut.as_ref().map_or(0.0, |c| {
                s.density * cut::kept(p, common(s.position)) * c.density(common(s.position))
            })
        })
        .collect()
}

/// Reflectance below which a beard's roots darken the skin. Chosen by eye.
const SKIN: f64 = 0.25;

/// Tints the skin under hair and beard: it gets little light, and the roots of a beard
/// show in its gaps. Call it on the head's skin before [`hair`] is laid on it.
pub fn shade_skin(skin: &mut MeshPart, head: &Head, p: &HairParams) {
    let key = |p: DVec3| p.to_array().map(|x| (x * 1e6).round() as i64);
    let covered: BTreeMap<[i64; 3], f64> = head
        .scalp
        .points
        .iter()
        .zip(cover(head, p))
        .map(|(s, c)| (key(s.position), c))
        .collect();
    for v in &mut skin.vertices {
        if let Some(c) = covered.get(&key(v.position)) {
            v.color[3] *= 1.0 - 0.6 * c * c;
        }
    }
    let Some(beard) = &p.beard else {
        return;
    };
    let roots = p.colour.linear_rgb();
    for (v, share) in skin.vertices.iter_mut().zip(beard::cover(head, beard)) {
        for (c, root) in v.color.iter_mut().zip(roots) {
            *c *= lerp(1.0, (root / SKIN).min(1.0), 0.5 * share);
        }
    }
}

/// Makes the hair of a head, in the head's frame.
#[must_use]
pub fn hair(head: &Head, p: &HairParams, body: &BodyDistance<'_>) -> Vec<Piece> {
    let palette = p.colour.palette();
    let [r, g, b] = palette.base.map(|x| x as f32);
    let material = Material {
        kind: MaterialKind::Hair,
        base_color: [r, g, b, 1.0],
        roughness: 0.45,
        double_sided: true,
        maps: Maps::default(),
    };
    let mut pieces = Vec::new();
    if let Some(cut) = cut_of(p) {
        let cover = cover(head, p);
        let ground = Ground::new(head, body);
        pieces.push(card::cap(&material, head, &cover, &palette));
        let strands = grow::strands(head, p, &*cut, &cover, &ground, &palette);
        pieces.push(card::cards("hair", &material, &strands, &|at| {
            cut.hang(head.scalp.proportions.common(at))
        }));
    }
    if let Some(b) = &p.beard {
        pieces.push(beard::beard(head, b, &material, &palette, p.seed));
    }
    pieces
}
