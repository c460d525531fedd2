//! Nuno, a boy of about 9.

use super::{FigureParams, Person};
use crate::generator::cloth::{Hoodie, Outfit};
use crate::generator::hair::{HairColour, HairParams, HairStyle};
use crate::generator::hand::HandParams;
use crate::generator::head::{BrowParams, HeadParams};
use crate::generator::torso::BodyParams;

const PERSON: Person = Person {
    sex: 0.0,
    age_years: 9.0,
    stature_m: 1.34,
    build: -0.2,
};

pub(super) fn params() -> FigureParams {
    let mut head = head();
    head.brow = brow();
    head.colours.brow = [0.15, 0.075, 0.036];
    FigureParams {
        name: "nuno".to_owned(),
        person: PERSON,
        body: body(),
        hand: hand(&head),
        hair: hair(),
        wardrobe: wardrobe(),
        head,
    }
}

fn head() -> HeadParams {
    HeadParams {
        person: PERSON,
        smile: 0.7,
        seed: 8,
        ..HeadParams::sofia()
    }
}

fn body() -> BodyParams {
    BodyParams {
        sex: PERSON.sex,
        age_years: PERSON.age_years,
        stature_m: PERSON.stature_m,
        build: PERSON.build,
        bust: 0.0,
    }
}

fn hand(head: &HeadParams) -> HandParams {
    HandParams::woman(PERSON.stature_m, head.colours.skin)
}

fn hair() -> HairParams {
    HairParams {
        style: HairStyle::Tousled,
        colour: HairColour {
            eumelanin: 0.17,
            pheomelanin: 0.24,
            grey: 0.0,
        },
        wave: 0.001,
        seed: 31,
        ..HairParams::default()
    }
}

fn brow() -> BrowParams {
    BrowParams {
        density: 0.85,
        length: 0.8,
        height: 0.85,
        unruly: 0.25,
        asymmetry: 0.3,
        lash_length: 0.95,
        lash_tone: 0.4,
    }
}

fn wardrobe() -> Outfit {
    Outfit::Hoodie(Hoodie {
        fleece: [0.36, 0.135, 0.022],
        shirt: [0.52, 0.52, 0.50],
        cord: [0.58, 0.56, 0.51],
        denim: [0.034, 0.060, 0.115],
        shoe: [0.050, 0.075, 0.135],
        sole: [0.60, 0.59, 0.55],
        lace: [0.62, 0.61, 0.58],
        sock: [0.50, 0.49, 0.46],
    })
}
