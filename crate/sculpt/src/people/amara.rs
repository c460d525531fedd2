//! Amara, a woman of 28 of African ancestry.

use super::{FigureParams, Person, bound, traits};
use crate::cloth::{Legs, Outfit, Sweater};
use crate::hair::{HairColour, HairParams, HairStyle};
use crate::hand::HandProportions;
use crate::head::{BrowParams, HeadParams};
use crate::skin::SkinParams;

const TRAITS: &str = include_str!("amara.json");
const BOUND: &str = include_str!("amara.tsv");
const PERSON: Person = Person {
    sex: 1.0,
    age_years: 28.0,
    stature_m: 1.68,
    build: -0.15,
};

pub(super) fn params() -> FigureParams {
    FigureParams {
        name: "amara".to_owned(),
        person: PERSON,
        bust: 0.9,
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
        iris: [0.045, 0.022, 0.012],
        seed: 13,
        brow: brow(),
        asymmetry: 1.0,
    }
}

fn skin() -> SkinParams {
    SkinParams {
        melanin: 0.93,
        blood: 0.4,
        contrast: 1.0,
        age_years: PERSON.age_years,
        moles: 4,
        sun: 0.1,
        lips: 0.2,
        lash_line: 0.7,
        seed: 13,
        ..SkinParams::plain()
    }
}

fn hair() -> HairParams {
    HairParams {
        style: HairStyle::Coily,
        colour: HairColour {
            eumelanin: 1.5,
            pheomelanin: 0.1,
            grey: 0.0,
        },
        length: 0.8,
        seed: 17,
        ..HairParams::default()
    }
}

fn brow() -> BrowParams {
    BrowParams {
        colour: [0.016, 0.012, 0.010],
        density: 1.05,
        lash_length: 1.05,
        ..BrowParams::default()
    }
}

fn wardrobe() -> Outfit {
    Outfit::Sweater(Sweater {
        knit: [0.440, 0.170, 0.012],
        legs: Legs {
            trousers: [0.020, 0.022, 0.040],
            shoe: [0.030, 0.020, 0.015],
            sole: [0.024, 0.017, 0.013],
            sock: [0.020, 0.020, 0.026],
        },
    })
}
