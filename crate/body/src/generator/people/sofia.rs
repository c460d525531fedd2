//! Sofia, a woman of about 35.

use super::{FigureParams, Person};
use crate::generator::cloth::{Outfit, Sweater};
use crate::generator::hair::BobParams;
use crate::generator::hand::HandParams;
use crate::generator::head::{HeadParams, Measure, Measures};
use crate::generator::torso::BodyParams;

const PERSON: Person = Person {
    sex: 1.0,
    age_years: 35.0,
    stature_m: 1.66,
    build: 0.0,
};

pub(super) fn params() -> FigureParams {
    let head = head();
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
        smile: 0.6,
        measures: Measures::of(&[
            (Measure::FaceHeight, 0.2),
            (Measure::NoseBreadth, -0.5),
            (Measure::NoseProtrusion, 0.3),
            (Measure::MouthBreadth, -0.3),
            (Measure::UpperRed, 0.7),
            (Measure::LowerRed, 0.6),
            (Measure::FissureHeight, 0.4),
            (Measure::JawBreadth, -0.9),
            (Measure::InnerCanthalBreadth, -0.3),
            (Measure::PhiltrumBreadth, -0.4),
            (Measure::Bridge, 0.8),
            (Measure::TipLift, 0.6),
            (Measure::ChinBreadth, -1.5),
            (Measure::Cheekbone, 1.0),
            (Measure::CanthalTilt, 0.4),
            (Measure::BrowHeight, 0.5),
            (Measure::LipProtrusion, 0.4),
        ]),
        seed: 3,
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
    Outfit::Sweater(Sweater {
        knit: [0.030, 0.110, 0.118],
        trousers: [0.022, 0.022, 0.028],
        shoe: [0.085, 0.036, 0.017],
        sole: [0.030, 0.022, 0.017],
        sock: [0.020, 0.020, 0.026],
    })
}
