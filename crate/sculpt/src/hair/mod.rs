//! Hair: guides that grow along a combing field, gather in locks and become narrow cards of strands
//! in several layers, over a scalp painted in the hair's colour.
//!
//! A style is a table of numbers (`style`) in a normalised frame of the head (`space`). The
//! renderer draws the strands on the cards from its own atlas; the light within the hair is baked
//! here (`light`).

mod beard;
mod cap;
mod card;
mod chains;
mod coil;
mod colour;
mod comb;
mod cut;
mod grid;
mod grow;
mod layers;
mod light;
mod line;
mod locks;
mod roots;
mod space;
mod style;
mod tail;
#[cfg(test)]
mod tests;

use raconteur_base::curve::lerp;
use serde::{Deserialize, Serialize};

pub use crate::springs::HairChain;
pub use beard::BeardParams;
pub(crate) use cap::Cap;
pub use cut::BeardCut;
pub use raconteur_body::HairColour;

use colour::Palette;
pub use space::Sample;

use self::cap::Scalp;
use self::chains::Chains;
use self::comb::Field;
use self::light::Shade;
use self::line::Line;
use self::locks::Grower;
use self::space::Space;
use self::style::Comb;
use crate::assemble::PartWithNormals;
use crate::head::Head;
use crate::part::MeshPart;
use raconteur_body::figure::{Material, MaterialKind, TextureMaps};

/// Hair style of a figure: cut and combing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum HairStyle {
    /// No hair on the scalp.
    Bald,
    /// A few millimetres all over.
    Buzz,
    /// Short and tidy, combed forward and to the side.
    Crop,
    /// A boy's unruly hair about a whorl.
    Tousled,
    /// Short, combed back from the forehead.
    Swept,
    /// A wreath of short hair about a bald crown.
    Balding,
    /// Tight coils that extend a few centimetres from the head.
    Coily,
    /// Hair to the jaw with a side parting.
    Bob,
    /// Hair to the collar bones, in waves, with a side parting.
    Wavy,
    /// Hair to the chin in curls, with a side parting.
    Curly,
    /// Past the shoulders, straight, with a side parting.
    Long,
    /// Tied back into a ponytail.
    Ponytail,
    /// Tied back into a bun.
    Bun,
    /// Tied back into a braid.
    Braid,
}

impl HairStyle {
    /// Names of the styles in parameter files.
    pub const NAMES: [(Self, &'static str); 14] = [
        (Self::Bald, "bald"),
        (Self::Buzz, "buzz"),
        (Self::Crop, "crop"),
        (Self::Tousled, "tousled"),
        (Self::Swept, "swept"),
        (Self::Balding, "balding"),
        (Self::Coily, "coily"),
        (Self::Bob, "bob"),
        (Self::Wavy, "wavy"),
        (Self::Curly, "curly"),
        (Self::Long, "long"),
        (Self::Ponytail, "ponytail"),
        (Self::Bun, "bun"),
        (Self::Braid, "braid"),
    ];
}

/// Parameters of a person's hair and beard: style, colour, length, volume.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct HairParams {
    /// Cut and combing of the hair.
    pub style: HairStyle,
    /// Colour of scalp hair and beard.
    pub colour: HairColour,
    /// Length against the style's own, 0.6..1.4.
    pub length: f64,
    /// Height of the volume against the style's own, 0.5..1.5.
    pub volume: f64,
    /// Reach of the waves against the style's own, 0..2.
    pub wave: f64,
    /// Position of the parting, to the left, metres on a head whose eyes lie 107 mm below the
    /// vertex.
    pub parting_x: f64,
    /// True if the hairline has male corners and sideburns.
    pub square: bool,
    /// Recession of the hairline at the temples, 0..1.
    pub recession: f64,
    /// Baldness of the crown, 0..1.
    pub thinning: f64,
    /// Beard; `None` for a shaved face.
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
            wave: 1.0,
            parting_x: 0.024,
            square: false,
            recession: 0.0,
            thinning: 0.0,
            beard: None,
            seed: 11,
        }
    }
}

/// Grown hair of a head: hair cards, guide chains, and its effects on the skin.
pub struct Grown {
    /// Cards of the scalp and the beard, in the frame of the head.
    pub pieces: Vec<PartWithNormals>,
    /// The chains that it swings with, in the frame of the head.
    pub chains: Vec<HairChain>,
    /// Share of light that the hair lets through to each vertex of the head's skin, 0..1.
    pub skin_light: Vec<f64>,
    /// Hair painted on the scalp.
    pub(crate) cap: Option<Cap>,
}

/// Minimum light on the scalp under dense hair, from scattering, which is stronger in white hair
/// than in black.
const MIN_LIGHT: [f64; 2] = [0.25, 0.8];

/// Makes the hair of a head whose neighbourhood is clothed with `clothes`, in the head's frame.
#[must_use]
pub fn hair(head: &Head, p: &HairParams, clothes: &[Sample]) -> Grown {
    let palette = Palette::new(&p.colour, p.seed);
    let [r, g, b] = palette.base.map(|x| x as f32);
    let material = Material {
        kind: MaterialKind::Hair,
        base_color: [r, g, b, 1.0],
        roughness: 0.45,
        double_sided: true,
        maps: TextureMaps::default(),
    };
    let mut grown = Grown {
        pieces: Vec::new(),
        chains: Vec::new(),
        skin_light: vec![1.0; head.skin().vertices.len()],
        cap: None,
    };
    if let Some(style) = style::style(p.style) {
        let space = Space::new(head, clothes);
        let line = Line::new(p);
        let field = Field::new(p, &style);
        let places = roots::candidates(&space, &line, p.seed);
        let grower = Grower {
            space: &space,
            field: &field,
            style: &style,
            params: p,
            places: &places,
        };
        let mut cards = match style.comb {
            Comb::Coily => grower.coils(),
            _ => grower.cards(),
        };
        match p.style {
            HairStyle::Ponytail => cards.extend(grower.tail()),
            HairStyle::Bun => cards.extend(grower.knot()),
            HairStyle::Braid => cards.extend(grower.plait()),
            _ => {}
        }
        // The cards are rendered from the scalp outwards.
        cards.sort_by_key(|c| c.layer);
        let shade = Shade::new(&space, &cards);
        light::bake(&shade, &mut cards);
        let [dark, white] = MIN_LIGHT;
        let least = lerp(dark, white, palette.base.iter().sum::<f64>() / 3.0);
        grown.skin_light = space
            .drawn(head)
            .iter()
            .map(|s| lerp(least, 1.0, shade.on_skin(s)))
            .collect();
        let frame = space.frame;
        let chains = Chains::new(&style, &cards);
        let piece = card::piece(&material, &frame, &cards, &palette, &|card, row, arc| {
            chains.joints(card, row, arc)
        });
        grown.pieces.push(piece);
        grown.chains = chains.guides;
        for p in grown.chains.iter_mut().flat_map(|c| &mut c.points) {
            *p = frame.place_back(*p);
        }
        let roots = palette.root();
        let scalp = Scalp { space, line, field };
        grown.cap = Some(Cap::new(scalp, &style, &places, roots, p.seed));
    }
    if let Some(b) = &p.beard {
        grown
            .pieces
            .push(beard::beard(head, b, &material, &palette, p.seed));
    }
    grown
}

/// Reflectance below which a beard's roots darken the skin. Chosen by eye.
const SKIN: f64 = 0.25;

/// Tints the skin under a beard, whose roots show in its gaps.
pub fn shade_skin(skin: &mut MeshPart, head: &Head, p: &HairParams) {
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
