//! From parameters to forms and their amounts: the forms of sex and age, then as much of
//! each measure's own form as brings its distance to the requested one.

use raconteur_base::{DVec3, Side};

use super::HeadParams;
use super::cage::{Cage, Key};
use super::fitted::fit;
use super::form::{CHILD, Form, MAN, OLD, SMILE, WOMAN};
use super::measure::{DEFINITIONS, Definition, Take};
use super::points::{Individual, named, points};
use super::solve::{self, Given};
use crate::person::Person;
use crate::statistics::Row;

/// How much of a child of nine there is at an age: growth of the face ends at about 18.
fn childhood(age_years: f64) -> f64 {
    ((18.0 - age_years) / 9.0).clamp(0.0, 1.12)
}

/// How much of a person of seventy there is at an age.
fn ageing(age_years: f64) -> f64 {
    ((age_years - 30.0) / 40.0).clamp(0.0, 1.25)
}

/// The person's forms with the measures that are given in millimetres; the others are not
/// yet set.
fn untuned(person: &Person, params: &HeadParams) -> Individual {
    let child = childhood(person.age_years);
    // Girls and boys differ little before puberty.
    let sex = (2.0 * person.sex - 1.0).clamp(-1.0, 1.0) * (1.0 - 0.8 * child.min(1.0));
    let mut terms: Vec<(&'static Form, f64)> = vec![
        (&WOMAN, sex.max(0.0)),
        (&MAN, (-sex).max(0.0)),
        (&CHILD, child),
        (&OLD, ageing(person.age_years)),
        (&SMILE, params.smile),
    ];
    for d in &DEFINITIONS {
        if d.norm.is_none() {
            terms.push((&d.form, params.measures.get(d.measure)));
        }
    }
    terms.retain(|t| t.1 != 0.0);
    Individual {
        terms,
        fitted: None,
    }
}

/// The measures with statistics.
fn known() -> impl Iterator<Item = (&'static Definition, &'static Row, Take)> {
    DEFINITIONS
        .iter()
        .filter_map(|d| d.norm.as_ref().map(|(row, take)| (d, row, *take)))
}

/// Share of the difference between the mean head and the surveys' means that is kept.
///
/// Landmarks are found on skin here, by spreading callipers with pressure there, and the
/// surveys differ among themselves by up to a deviation, while the mean head as a whole
/// agrees with the yardstick: its own distances count as one more survey of equal weight.
const OWN_MEAN_SHARE: f64 = 0.5;
/// Adult age for which the table of points holds.
const TABLE_AGE_YEARS: f64 = 28.0;

/// What each known measure shall be, mm.
fn targets(person: &Person, params: &HeadParams) -> Vec<f64> {
    let mean_head = |key: Key| mean_points_at(key);
    known()
        .map(|(d, row, take)| {
            let norm = row.at(person.sex, person.age_years);
            let own = take(&mean_head) - row.at(0.5, TABLE_AGE_YEARS).mean;
            norm.mean + own * OWN_MEAN_SHARE + params.measures.get(d.measure) * norm.sd
        })
        .collect()
}

fn mean_points_at(key: Key) -> DVec3 {
    use std::sync::OnceLock;
    static MEAN: OnceLock<super::cage::Points> = OnceLock::new();
    MEAN.get_or_init(|| points(&Individual::default()))
        .get(&key)
        .copied()
        .unwrap_or(DVec3::ZERO)
}

fn distances(individual: &Individual) -> Vec<f64> {
    let all = points(individual);
    let at = |key: Key| all.get(&key).copied().unwrap_or(DVec3::ZERO);
    known().map(|(_, _, take)| take(&at)).collect()
}

/// Rounds of Newton's method on the named points; the distances are nearly linear.
const ROUNDS: usize = 4;
/// Rounds against the solved surface, which passes near the named points only.
const SURFACE_ROUNDS: usize = 3;
/// Weight of an amount against a millimetre of error: keeps forms from fighting each other.
const DAMPING: f64 = 0.02;

/// Amounts that bring the named points' distances to the targets.
fn tune(base: &Individual, targets: &[f64], amounts: &mut [f64]) {
    let forms: Vec<&'static Form> = known().map(|(d, _, _)| &d.form).collect();
    let with = |amounts: &[f64]| {
        let mut individual = base.clone();
        individual
            .terms
            .extend(forms.iter().copied().zip(amounts.iter().copied()));
        individual
    };
    let n = targets.len();
    for round in 0..ROUNDS {
        let now = distances(&with(amounts));
        let error: Vec<f64> = targets.iter().zip(&now).map(|(t, d)| t - d).collect();
        if round > 0 && error.iter().all(|e| e.abs() < 1e-3) {
            break;
        }
        // Columns of the Jacobian.
        let columns: Vec<Vec<f64>> = (0..n)
            .map(|j| {
                let mut moved = amounts.to_vec();
                moved[j] += 1.0;
                let there = distances(&with(&moved));
                there.iter().zip(&now).map(|(a, b)| a - b).collect()
            })
            .collect();
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
        let mut normal: Vec<Vec<f64>> = (0..n)
            .map(|i| (0..n).map(|j| dot(&columns[i], &columns[j])).collect())
            .collect();
        for (i, row) in normal.iter_mut().enumerate() {
            row[i] += DAMPING * DAMPING;
        }
        let right: Vec<f64> = columns.iter().map(|c| dot(c, &error)).collect();
        for (a, step) in amounts.iter_mut().zip(solve_dense(normal, right)) {
            *a += step.clamp(-12.0, 12.0);
        }
    }
}

/// Solves a symmetric positive definite system by elimination without pivots.
fn solve_dense(mut a: Vec<Vec<f64>>, mut b: Vec<f64>) -> Vec<f64> {
    let n = b.len();
    for i in 0..n {
        let (above, rest) = a.split_at_mut(i + 1);
        let pivot = &above[i];
        for (row, j) in rest.iter_mut().zip(i + 1..n) {
            let f = row[i] / pivot[i];
            for (x, p) in row.iter_mut().zip(pivot).skip(i) {
                *x -= f * p;
            }
            b[j] -= f * b[i];
        }
    }
    for i in (0..n).rev() {
        let known: f64 = (i + 1..n).map(|k| a[i][k] * b[k]).sum();
        b[i] = (b[i] - known) / a[i][i];
    }
    b
}

/// The person with all measures set.
pub(crate) fn individual(person: &Person, params: &HeadParams, cage: &Cage) -> Individual {
    let base = untuned(person, params);
    if let Some(bound) = &params.bound {
        let neck = |key| Some(base.place(key, named(key)?));
        return Individual {
            fitted: Some(fit(bound, neck)),
            ..base
        };
    }
    let wanted = targets(person, params);
    let mut aims = wanted.clone();
    let mut amounts = vec![0.0; wanted.len()];
    tune(&base, &aims, &mut amounts);
    for _ in 0..SURFACE_ROUNDS {
        let solved = solve::solve(cage, &points(&complete(&base, &amounts)), Given::Named);
        let at = |key: Key| solved.limit_of(cage.at(key, Side::Left), &solved.cage_points);
        for ((aim, want), (_, _, take)) in aims.iter_mut().zip(&wanted).zip(known()) {
            *aim += (want - take(&at)).clamp(-3.0, 3.0);
        }
        tune(&base, &aims, &mut amounts);
    }
    complete(&base, &amounts)
}

fn complete(base: &Individual, amounts: &[f64]) -> Individual {
    let mut all = base.clone();
    for ((d, _, _), &amount) in known().zip(amounts) {
        all.terms.push((&d.form, amount));
    }
    all
}

/// Whose head a named figure's is; of another name the mean adult's, midway between the
/// sexes.
#[cfg(test)]
pub(super) fn one(name: &str) -> (Person, HeadParams) {
    let mean = || {
        let person = Person {
            sex: 0.5,
            age_years: TABLE_AGE_YEARS,
            stature_m: 1.7,
            build: 0.0,
        };
        (person, HeadParams::default())
    };
    crate::people::preset(name).map_or_else(mean, |p| (p.person, p.head))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::head::Measure;

    fn tuned(person: &Person, params: &HeadParams) -> Vec<f64> {
        let base = untuned(person, params);
        let wanted = targets(person, params);
        let mut amounts = vec![0.0; wanted.len()];
        tune(&base, &wanted, &mut amounts);
        distances(&complete(&base, &amounts))
    }

    #[test]
    fn each_measure_moves_by_its_parameter_and_leaves_the_others() {
        for name in ["mean", "sofia", "papous", "nuno"] {
            let (who, params) = one(name);
            let before = tuned(&who, &params);
            for (i, (d, row, _)) in known().enumerate() {
                for step in [-1.0, 1.0] {
                    let value = params.measures.get(d.measure) + step;
                    let moved = HeadParams {
                        measures: params.measures.with(d.measure, value),
                        ..params.clone()
                    };
                    let after = tuned(&who, &moved);
                    let sd = row.at(who.sex, who.age_years).sd;
                    for (k, ((a, b), (other, ..))) in
                        after.iter().zip(&before).zip(known()).enumerate()
                    {
                        let want = if k == i { step * sd } else { 0.0 };
                        let error = a - b - want;
                        // A tenth of a millimetre, or five per cent of the step.
                        let most = 0.1f64.max(0.05 * sd);
                        assert!(
                            error.abs() < most,
                            "{name}: {} {step:+} moves {} by {error:.2} mm too much",
                            d.name,
                            other.name,
                        );
                    }
                }
            }
        }
    }

    #[test]
    fn the_solved_surface_has_the_measures_asked_for() {
        let cage = Cage::new();
        for name in ["sofia", "papous", "nuno"] {
            let (who, params) = one(name);
            let params = HeadParams {
                bound: None,
                ..params
            };
            let person = individual(&who, &params, &cage);
            let solved = solve::solve(&cage, &points(&person), Given::Named);
            let at = |key: Key| solved.limit_of(cage.at(key, Side::Left), &solved.cage_points);
            for ((d, _, take), want) in known().zip(targets(&who, &params)) {
                let got = take(&at);
                assert!(
                    (got - want).abs() < 1.0,
                    "{name}: {} {got} for {want}",
                    d.name
                );
            }
        }
    }

    #[test]
    fn designed_measures_move_the_face_and_leave_the_distances() {
        for name in ["mean", "sofia", "papous", "nuno"] {
            let (who, params) = one(name);
            let (plain, before) = (points(&untuned(&who, &params)), tuned(&who, &params));
            for d in DEFINITIONS.iter().filter(|d| d.norm.is_none()) {
                let value = params.measures.get(d.measure) + 1.0;
                let changed = HeadParams {
                    measures: params.measures.with(d.measure, value),
                    ..params.clone()
                };
                let moved = points(&untuned(&who, &changed));
                let most = plain
                    .iter()
                    .map(|(key, p)| (moved[key] - *p).length())
                    .fold(0.0, f64::max);
                assert!((0.2..3.0).contains(&most), "{name}: {} {most} mm", d.name);
                let after = tuned(&who, &changed);
                for ((a, b), (other, row, _)) in after.iter().zip(&before).zip(known()) {
                    let sd = row.at(who.sex, who.age_years).sd;
                    assert!(
                        (a - b).abs() < 0.1f64.max(0.05 * sd),
                        "{name}: {} moves {} by {:.2} mm",
                        d.name,
                        other.name,
                        a - b
                    );
                }
            }
        }
    }

    #[test]
    fn names_name_measures() {
        assert_eq!(
            Measure::from_name("nose_breadth"),
            Some(Measure::NoseBreadth)
        );
        assert!(Measure::all().all(|m| Measure::from_name(m.name()) == Some(m)));
    }

    #[test]
    fn every_measure_is_taken_between_named_points() {
        let all = points(&Individual::default());
        for (d, _, take) in known() {
            take(&|key| {
                *all.get(&key)
                    .unwrap_or_else(|| panic!("{} needs {key:?}", d.name))
            });
        }
    }
}
