//! Sofia, a woman of about 35.

use super::{FigureParams, Person};
use crate::generator::cloth::{Outfit, Sweater};
use crate::generator::hair::{HairColour, HairParams, HairStyle};
use crate::generator::hand::HandParams;
use crate::generator::head::{BrowParams, HeadParams};
use crate::generator::torso::BodyParams;

const PERSON: Person = Person {
    sex: 1.0,
    age_years: 35.0,
    stature_m: 1.66,
    build: 0.0,
};

pub(super) fn params() -> FigureParams {
    let mut head = head();
    head.brow = brow();
    FigureParams {
        name: "sofia".to_owned(),
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

        ..HeadParams::sofia()
    }
}

fn body() -> BodyParams {
    BodyParams {
        sex: PERSON.sex,
        age_years: PERSON.age_years,
        stature_m: PERSON.stature_m,
        build: PERSON.build,
        bust: 0.95,
    }
}

fn hand(head: &HeadParams) -> HandParams {
    HandParams::woman(PERSON.stature_m, head.colours.skin)
}

fn hair() -> HairParams {
    HairParams {
        style: HairStyle::Bob,
        colour: HairColour {
            eumelanin: 0.22,
            pheomelanin: 0.46,
            grey: 0.0,
        },
        wave: 0.003,
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
        trousers: [0.022, 0.022, 0.028],
        shoe: [0.085, 0.036, 0.017],
        sole: [0.030, 0.022, 0.017],
        sock: [0.020, 0.020, 0.026],
    })
}
