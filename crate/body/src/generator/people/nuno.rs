//! Nuno, a boy of about 9.

use super::{FigureParams, Person};
use crate::generator::cloth::{Hoodie, Outfit};
use crate::generator::hair::BobParams;
use crate::generator::hand::HandParams;
use crate::generator::head::{HeadParams, Measure, Measures};
use crate::generator::torso::BodyParams;

const PERSON: Person = Person {
    sex: 0.0,
    age_years: 9.0,
    stature_m: 1.34,
    build: -0.2,
};

pub(super) fn params() -> FigureParams {
    let head = head();
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
        smile: 0.8,
        measures: Measures::of(&[
            (Measure::NoseBreadth, 0.3),
            (Measure::FissureHeight, 0.5),
            (Measure::MouthBreadth, 0.4),
            (Measure::UpperRed, -0.3),
            (Measure::HeadBreadth, 0.3),
            (Measure::CheekFullness, 0.8),
            (Measure::EarProtrusion, 2.5),
            (Measure::TipLift, 0.6),
            (Measure::Bridge, -0.5),
            (Measure::BrowHeight, -0.6),
            (Measure::ChinBreadth, -0.6),
            (Measure::CanthalTilt, -0.3),
        ]),
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
