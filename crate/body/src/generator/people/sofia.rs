//! Sofia, a woman of about 35.

use super::{FigureParams, Person, Wardrobe};
use crate::generator::hair::BobParams;
use crate::generator::hand::HandParams;
use crate::generator::head::HeadParams;
use crate::generator::skin::SkinParams;
use crate::generator::torso::BodyParams;

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
        body: body(),
        hand: hand(),
        hair: hair(),
        wardrobe: wardrobe(),
        head: head(),
        skin: skin(),
    }
}

fn head() -> HeadParams {
    HeadParams {
        person: PERSON,

        ..HeadParams::sofia()
    }
}

fn skin() -> SkinParams {
    SkinParams {
        melanin: 0.17,
        blood: 0.52,
        contrast: 1.05,
        age_years: PERSON.age_years,
        freckles: 0.35,
        moles: 5,
        sun: 0.2,
        vessels: 0.0,
        beard: 0.0,
        lips: 0.62,
        lash_line: 0.75,
        seed: 3,
        ..SkinParams::plain()
    }
}

fn body() -> BodyParams {
    BodyParams {
        sex: PERSON.sex,
        stature_m: PERSON.stature_m,
        build: PERSON.build,
        bust: 0.95,
    }
}

fn hand() -> HandParams {
    HandParams::woman(PERSON.stature_m, skin().base_colour())
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

fn wardrobe() -> Wardrobe {
    Wardrobe {
        sweater: [0.045, 0.145, 0.165],
        trousers: [0.030, 0.032, 0.045],
        shoe: [0.085, 0.036, 0.017],
        sole: [0.030, 0.022, 0.017],
        sock: [0.020, 0.020, 0.026],
    }
}
