//! Papous, a man of about 70 with white hair.

use super::{FigureParams, Person, Wardrobe};
use crate::generator::hair::BobParams;
use crate::generator::hand::HandParams;
use crate::generator::head::HeadParams;
use crate::generator::skin::SkinParams;
use crate::generator::torso::BodyParams;

const PERSON: Person = Person {
    sex: 0.0,
    age_years: 70.0,
    stature_m: 1.72,
    build: 0.15,
};

pub(super) fn params() -> FigureParams {
    FigureParams {
        name: "papous".to_owned(),
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
        smile: 0.5,
        seed: 5,
        ..HeadParams::sofia()
    }
}

fn skin() -> SkinParams {
    SkinParams {
        melanin: 0.27,
        blood: 0.62,
        contrast: 1.15,
        age_years: PERSON.age_years,
        freckles: 0.1,
        moles: 9,
        sun: 0.75,
        vessels: 0.55,
        beard: 0.35,
        beard_colour: [0.34, 0.33, 0.32],
        lips: 0.35,
        lash_line: 0.2,
        seed: 7,
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
