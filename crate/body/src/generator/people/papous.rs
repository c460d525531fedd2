//! Papous, a man of about 70 with white hair.

use super::{FigureParams, Person};
use crate::generator::cloth::{Cardigan, Outfit};
use crate::generator::hair::{BeardParams, HairColour, HairParams, HairStyle};
use crate::generator::hand::HandParams;
use crate::generator::head::{BrowParams, HeadParams};
use crate::generator::torso::BodyParams;

const PERSON: Person = Person {
    sex: 0.0,
    age_years: 70.0,
    stature_m: 1.72,
    build: 0.15,
};

pub(super) fn params() -> FigureParams {
    let mut head = head();
    head.brow = brow();
    head.colours.brow = [0.34, 0.33, 0.31];
    FigureParams {
        name: "papous".to_owned(),
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
        smile: 0.5,
        seed: 5,
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
        style: HairStyle::Swept,
        colour: HairColour {
            eumelanin: 0.5,
            pheomelanin: 0.0,
            grey: 0.94,
        },
        recession: 0.75,
        thinning: 0.6,
        beard: Some(BeardParams {
            length_m: 0.018,
            moustache: true,
        }),
        seed: 23,
        ..HairParams::default()
    }
}

fn brow() -> BrowParams {
    BrowParams {
        density: 1.25,
        length: 1.55,
        height: 1.25,
        unruly: 0.9,
        asymmetry: 0.8,
        lash_length: 0.7,
        lash_tone: 0.6,
    }
}

fn wardrobe() -> Outfit {
    Outfit::Cardigan(Cardigan {
        knit: [0.150, 0.030, 0.032],
        shirt: [0.46, 0.53, 0.62],
        button: [0.060, 0.034, 0.020],
        trousers: [0.082, 0.066, 0.048],
        shoe: [0.072, 0.030, 0.013],
        sole: [0.024, 0.017, 0.013],
        sock: [0.045, 0.040, 0.034],
    })
}
