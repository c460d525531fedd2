//! Lia, a girl of 8.

use super::{FigureParams, Person, bound, traits};
use crate::cloth::{Cardigan, Legs, Outfit};
use crate::hair::{HairColour, HairParams, HairStyle};
use crate::hand::HandProportions;
use crate::head::{BrowParams, HeadParams};
use crate::skin::SkinParams;

const TRAITS: &str = include_str!("lia.json");
const BOUND: &str = include_str!("lia.tsv");
const PERSON: Person = Person {
    sex: 1.0,
    age_years: 8.0,
    stature_m: 1.31,
    build: -0.1,
};

pub(super) fn params() -> FigureParams {
    FigureParams {
        name: "lia".to_owned(),
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
        iris: [0.070, 0.120, 0.150],
        seed: 21,
        brow: brow(),
        asymmetry: 1.0,
    }
}

fn skin() -> SkinParams {
    SkinParams {
        melanin: 0.12,
        blood: 0.55,
        contrast: 1.15,
        age_years: PERSON.age_years,
        freckles: 0.1,
        moles: 2,
        lips: 0.38,
        lash_line: 0.35,
        seed: 21,
        ..SkinParams::plain()
    }
}

fn hair() -> HairParams {
    HairParams {
        style: HairStyle::Long,
        colour: HairColour {
            eumelanin: 0.10,
            pheomelanin: 0.18,
            grey: 0.0,
        },
        // To the shoulders.
        length: 0.74,
        seed: 37,
        ..HairParams::default()
    }
}

fn brow() -> BrowParams {
    BrowParams {
        colour: [0.20, 0.11, 0.055],
        density: 0.8,
        length: 0.8,
        height: 0.8,
        unruly: 0.2,
        lash_length: 0.95,
        lash_tone: 0.4,
        ..BrowParams::default()
    }
}

fn wardrobe() -> Outfit {
    Outfit::Cardigan(Cardigan {
        knit: [0.270, 0.060, 0.110],
        shirt: [0.60, 0.59, 0.56],
        button: [0.45, 0.40, 0.34],
        legs: Legs {
            trousers: [0.040, 0.075, 0.140],
            shoe: [0.085, 0.036, 0.017],
            sole: [0.030, 0.022, 0.017],
            sock: [0.50, 0.30, 0.36],
        },
    })
}
