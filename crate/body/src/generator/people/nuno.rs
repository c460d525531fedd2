//! Nuno, a boy of about 9.

use super::{FigureParams, Person, Wardrobe};
use crate::generator::hair::BobParams;
use crate::generator::hand::HandParams;
use crate::generator::head::HeadParams;
use crate::generator::skin::SkinParams;
use crate::generator::torso::BodyParams;

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
        smile: 0.7,
        seed: 8,
        ..HeadParams::sofia()
    }
}

fn skin() -> SkinParams {
    SkinParams {
        melanin: 0.24,
        blood: 0.5,
        contrast: 1.0,
        age_years: PERSON.age_years,
        freckles: 0.5,
        moles: 3,
        sun: 0.1,
        vessels: 0.0,
        beard: 0.0,
        lips: 0.6,
        lash_line: 0.35,
        seed: 11,
        ..SkinParams::plain()
    }
}

fn body() -> BodyParams {
    BodyParams {
        sex: PERSON.sex,
        stature_m: PERSON.stature_m,
        build: PERSON.build,
        bust: 0.0,
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
