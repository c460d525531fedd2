//! Nuno, a boy of about 9.

use super::{FigureParams, Person, bound, traits};
use crate::cloth::{Hoodie, Legs, Outfit};
use crate::hair::{HairColour, HairParams, HairStyle};
use crate::hand::HandProportions;
use crate::head::{BrowParams, HeadParams};
use crate::skin::SkinParams;

const TRAITS: &str = include_str!("nuno.json");
const BOUND: &str = include_str!("nuno.tsv");
const PERSON: Person = Person {
    sex: 0.0,
    age_years: 9.0,
    stature_m: 1.34,
    build: -0.2,
};

pub(super) fn params() -> FigureParams {
    FigureParams {
        name: "nuno".to_owned(),
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
        seed: 8,
        iris: [0.115, 0.105, 0.045],
        brow: brow(),
        asymmetry: 1.0,
    }
}

fn skin() -> SkinParams {
    SkinParams {
        melanin: 0.24,
        blood: 0.5,
        contrast: 1.25,
        age_years: PERSON.age_years,
        freckles: 1.1,
        moles: 3,
        sun: 0.1,
        vessels: 0.0,
        beard: 0.0,
        lips: 0.22,
        lash_line: 0.35,
        seed: 11,
        ..SkinParams::plain()
    }
}

fn hair() -> HairParams {
    HairParams {
        style: HairStyle::Tousled,
        colour: HairColour {
            eumelanin: 0.17,
            pheomelanin: 0.24,
            grey: 0.0,
        },
        volume: 0.7,
        seed: 31,
        square: true,
        ..HairParams::default()
    }
}

fn brow() -> BrowParams {
    BrowParams {
        colour: [0.115, 0.055, 0.026],
        density: 1.1,
        length: 0.95,
        height: 1.0,
        unruly: 0.25,
        asymmetry: 0.3,
        lash_length: 0.68,
        lash_tone: 0.4,
    }
}

fn wardrobe() -> Outfit {
    Outfit::Hoodie(Hoodie {
        fleece: [0.36, 0.135, 0.022],
        shirt: [0.52, 0.52, 0.50],
        cord: [0.58, 0.56, 0.51],
        legs: Legs {
            trousers: [0.034, 0.060, 0.115],
            shoe: [0.050, 0.075, 0.135],
            sole: [0.60, 0.59, 0.55],
            sock: [0.50, 0.49, 0.46],
        },
        lace: [0.62, 0.61, 0.58],
    })
}
