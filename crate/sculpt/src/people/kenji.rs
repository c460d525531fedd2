//! Kenji, a man of 45 of East Asian ancestry.

use super::{FigureParams, Person, bound, traits};
use crate::cloth::{Cardigan, Legs, Outfit};
use crate::hair::{HairColour, HairParams, HairStyle};
use crate::hand::HandProportions;
use crate::head::{BrowParams, HeadParams};
use crate::skin::SkinParams;

const TRAITS: &str = include_str!("kenji.json");
const BOUND: &str = include_str!("kenji.tsv");
const PERSON: Person = Person {
    sex: 0.0,
    age_years: 45.0,
    stature_m: 1.713,
    build: 0.22,
};

pub(super) fn params() -> FigureParams {
    FigureParams {
        name: "kenji".to_owned(),
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
        iris: [0.060, 0.032, 0.017],
        seed: 17,
        brow: brow(),
        asymmetry: 1.0,
    }
}

fn skin() -> SkinParams {
    SkinParams {
        melanin: 0.23,
        blood: 0.48,
        contrast: 1.0,
        // Weathered: his skin is older than he.
        age_years: 56.0,
        moles: 5,
        sun: 0.45,
        vessels: 0.05,
        beard: 0.35,
        lips: 0.3,
        lash_line: 0.3,
        seed: 17,
        ..SkinParams::plain()
    }
}

fn hair() -> HairParams {
    HairParams {
        style: HairStyle::Crop,
        colour: HairColour {
            eumelanin: 1.3,
            pheomelanin: 0.05,
            grey: 0.25,
        },
        seed: 19,
        square: true,
        ..HairParams::default()
    }
}

fn brow() -> BrowParams {
    BrowParams {
        colour: [0.030, 0.024, 0.021],
        density: 0.8,
        height: 1.15,
        unruly: 0.6,
        lash_length: 0.8,
        lash_tone: 0.3,
        ..BrowParams::default()
    }
}

fn wardrobe() -> Outfit {
    Outfit::Cardigan(Cardigan {
        knit: [0.046, 0.060, 0.092],
        shirt: [0.56, 0.57, 0.58],
        button: [0.022, 0.020, 0.020],
        legs: Legs {
            trousers: [0.085, 0.078, 0.066],
            shoe: [0.030, 0.017, 0.010],
            sole: [0.024, 0.017, 0.013],
            sock: [0.020, 0.020, 0.026],
        },
    })
}
