//! Sofia, a woman of about 35.

use super::{BROWN, FigureParams, Person, bound, traits};
use crate::cloth::{Legs, Outfit, Sweater};
use crate::hair::{HairColour, HairParams, HairStyle};
use crate::hand::HandProportions;
use crate::head::{BrowParams, HeadParams};
use crate::skin::SkinParams;

const TRAITS: &str = include_str!("sofia.json");
const BOUND: &str = include_str!("sofia.tsv");
const PERSON: Person = Person {
    sex: 1.0,
    age_years: 35.0,
    stature_m: 1.66,
    build: 0.0,
};

pub(super) fn params() -> FigureParams {
    FigureParams {
        name: "sofia".to_owned(),
        person: PERSON,
        bust: 0.95,
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
        seed: 3,
        brow: brow(),
        iris: BROWN,
        asymmetry: 1.0,
    }
}

fn skin() -> SkinParams {
    SkinParams {
        melanin: 0.205,
        blood: 0.56,
        contrast: 1.05,
        age_years: PERSON.age_years,
        freckles: 0.35,
        moles: 5,
        sun: 0.2,
        vessels: 0.0,
        beard: 0.0,
        lips: 0.42,
        lash_line: 0.75,
        seed: 3,
        ..SkinParams::plain()
    }
}

fn hair() -> HairParams {
    HairParams {
        style: HairStyle::Bob,
        colour: HairColour {
            eumelanin: 0.22,
            pheomelanin: 0.46,
            grey: 0.0,
        },
        wave: 0.55,
        seed: 22,
        ..HairParams::default()
    }
}

fn brow() -> BrowParams {
    BrowParams {
        lash_length: 1.05,
        ..BrowParams::default()
    }
}

fn wardrobe() -> Outfit {
    Outfit::Sweater(Sweater {
        knit: [0.030, 0.110, 0.118],
        legs: Legs {
            trousers: [0.022, 0.022, 0.028],
            shoe: [0.085, 0.036, 0.017],
            sole: [0.030, 0.022, 0.017],
            sock: [0.020, 0.020, 0.026],
        },
    })
}
