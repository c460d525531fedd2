//! Papous, a man of about 70 with white hair.

use super::{FigureParams, Person, bound, traits};
use crate::cloth::{Cardigan, Legs, Outfit};
use crate::hair::{BeardCut, BeardParams, HairColour, HairParams, HairStyle};
use crate::hand::HandProportions;
use crate::head::{BrowParams, HeadParams};
use crate::skin::SkinParams;

const TRAITS: &str = include_str!("papous.json");
const BOUND: &str = include_str!("papous.tsv");
const PERSON: Person = Person {
    sex: 0.0,
    age_years: 70.0,
    stature_m: 1.72,
    build: 0.15,
};

pub(super) fn params() -> FigureParams {
    FigureParams {
        name: "papous".to_owned(),
        person: PERSON,
        bust: 0.0,
        head: head(),
        skin: skin(),
        hand: HandProportions::default(),
        hair: hair(),
        wardrobe: wardrobe(),
    }
}

fn head() -> HeadParams {
    HeadParams {
        traits: traits(TRAITS),
        bound: bound(BOUND),
        seed: 5,
        iris: [0.085, 0.130, 0.170],
        brow: brow(),
        asymmetry: 1.0,
    }
}

fn skin() -> SkinParams {
    SkinParams {
        melanin: 0.27,
        blood: 0.62,
        contrast: 1.15,
        age_years: PERSON.age_years,
        freckles: 0.1,
        moles: 9,
        sun: 0.75,
        vessels: 0.55,
        beard: 0.3,
        short_beard: 0.97,
        beard_colour: [0.60, 0.58, 0.55],
        lips: 0.22,
        lash_line: 0.2,
        seed: 7,
    }
}

fn hair() -> HairParams {
    HairParams {
        style: HairStyle::Swept,
        colour: HairColour {
            eumelanin: 0.5,
            pheomelanin: 0.0,
            grey: 0.94,
        },
        recession: 0.8,
        thinning: 0.3,
        beard: Some(BeardParams {
            length_m: 0.018,
            cut: BeardCut::Full,
            density: 0.88,
        }),
        seed: 29,
        square: true,
        ..HairParams::default()
    }
}

fn brow() -> BrowParams {
    BrowParams {
        colour: [0.40, 0.36, 0.31],
        density: 1.25,
        length: 1.55,
        height: 1.25,
        unruly: 0.9,
        asymmetry: 0.8,
        lash_length: 0.8,
        lash_tone: 0.28,
    }
}

fn wardrobe() -> Outfit {
    Outfit::Cardigan(Cardigan {
        knit: [0.150, 0.030, 0.032],
        shirt: [0.46, 0.53, 0.62],
        button: [0.060, 0.034, 0.020],
        legs: Legs {
            trousers: [0.082, 0.066, 0.048],
            shoe: [0.072, 0.030, 0.013],
            sole: [0.024, 0.017, 0.013],
            sock: [0.045, 0.040, 0.034],
        },
    })
}
