//! From parameters to forms and their amounts.

use super::HeadParams;
use super::form::{CHILD, MAN, OLD, SMILE, WOMAN};
use super::points::Individual;

/// How much of a child of nine there is at an age: growth of the face ends at about 18.
fn childhood(age_years: f64) -> f64 {
    ((18.0 - age_years) / 9.0).clamp(0.0, 1.12)
}

/// How much of a person of seventy there is at an age.
fn ageing(age_years: f64) -> f64 {
    ((age_years - 30.0) / 40.0).clamp(0.0, 1.25)
}

/// The person's forms; the measured distances are not yet set.
pub(crate) fn untuned(params: &HeadParams) -> Individual {
    let person = params.person;
    let child = childhood(person.age_years);
    // Girls and boys differ little before puberty.
    let sex = (2.0 * person.sex - 1.0).clamp(-1.0, 1.0) * (1.0 - 0.8 * child.min(1.0));
    let all = [
        (&WOMAN, sex.max(0.0)),
        (&MAN, (-sex).max(0.0)),
        (&CHILD, child),
        (&OLD, ageing(person.age_years)),
        (&SMILE, params.smile),
    ];
    Individual {
        terms: all.into_iter().filter(|t| t.1 != 0.0).collect(),
    }
}
