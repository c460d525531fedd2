//! Papous, a man of about 70 with white hair.

use super::{FigureParams, Person};
use crate::generator::cloth::{Cardigan, Outfit};
use crate::generator::hair::BobParams;
use crate::generator::hand::HandParams;
use crate::generator::head::{HeadParams, Measure, Measures};
use crate::generator::torso::BodyParams;

const PERSON: Person = Person {
    sex: 0.0,
    age_years: 70.0,
    stature_m: 1.72,
    build: 0.15,
};

pub(super) fn params() -> FigureParams {
    let head = head();
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
        smile: 0.6,
        measures: Measures::of(&[
            (Measure::FaceHeight, 0.4),
            (Measure::NoseProtrusion, 0.6),
            (Measure::EarLength, 0.4),
            (Measure::MouthBreadth, 0.3),
            (Measure::JawBreadth, 0.3),
            (Measure::Dorsum, 1.0),
            (Measure::BrowRidge, 0.8),
            (Measure::Cheekbone, 1.2),
            (Measure::EyeBag, 1.2),
            (Measure::NasolabialFold, 1.3),
            (Measure::Jowl, 0.8),
            (Measure::NeckCord, 1.4),
            (Measure::MouthCorner, 0.8),
            (Measure::LidHood, 0.3),
            (Measure::CheekFullness, -0.6),
        ]),
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

fn hair() -> BobParams {
    BobParams {
        colour: [0.150, 0.067, 0.032],
        parting_x: 0.016,
        hem_y: -0.086,
        wave: 0.0025,
        seed: 11,
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
