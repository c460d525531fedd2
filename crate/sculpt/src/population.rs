//! Fitting of heads to a population: their measures receive the means, deviations and correlations
//! of surveys, and the rest of each head follows as in the crowd's heads.

use faer::linalg::solvers::Solve as _;
use faer::{Mat, Side as Half};

use crate::head::{CENTRED, Measure, ModelHeadShape, eye_mm, known_measures, measures};
use crate::model::Traits;

/// Correlations between measures of adults of one sex: means of those of 4,082 men and 1,986 women
/// of ANSUR II (its public data, 2012), which differ by 0.09 at most. Pairs that it has not are left
/// as the body model has them.
const KNOWN: [Measure; 8] = [
    Measure::HeadLength,
    Measure::HeadBreadth,
    Measure::HeadHeight,
    Measure::FaceBreadth,
    Measure::FaceHeight,
    Measure::PupilDistance,
    Measure::EarLength,
    Measure::EarBreadth,
];
#[rustfmt::skip]
const CORRELATIONS: [[f64; 8]; 8] = [
    [1.0, 0.20, 0.29, 0.17, 0.30, 0.31, 0.14, 0.11],
    [0.20, 1.0, 0.32, 0.63, 0.17, 0.29, 0.10, 0.06],
    [0.29, 0.32, 1.0, 0.23, 0.18, 0.16, 0.12, -0.03],
    [0.17, 0.63, 0.23, 1.0, 0.20, 0.46, 0.22, 0.08],
    [0.30, 0.17, 0.18, 0.20, 1.0, 0.19, 0.17, 0.12],
    [0.31, 0.29, 0.16, 0.46, 0.19, 1.0, 0.15, 0.10],
    [0.14, 0.10, 0.12, 0.22, 0.17, 0.15, 1.0, 0.32],
    [0.11, 0.06, -0.03, 0.08, 0.12, 0.10, 0.32, 1.0],
];

const COUNT: usize = Measure::COUNT;
/// People are not farther from the mean of their sex and age, standard deviations.
const MAX_DEVIATIONS: f64 = 2.8;
/// Minimum eigenvalue of a correlation matrix: below it, measures would be functions of each other.
const MIN_EIGENVALUE: f64 = 0.02;
/// Number of rounds: measures are not exactly linear in a head's positions.
const ROUNDS: usize = 3;

/// Returns the published correlation of two measures; `None` if it is unknown.
#[must_use]
pub fn known_correlation(a: Measure, b: Measure) -> Option<f64> {
    let place = |m| KNOWN.iter().position(|known| *known == m);
    Some(CORRELATIONS[place(a)?][place(b)?])
}

/// Fits the heads of people to the population's measures, each as close to its own as the
/// statistics allow. There must be many more people than measures. `drawn` measures a person's
/// rendered skin, which closes the lips and smooths the head's positions.
pub fn fit_population(
    people: &[Traits],
    heads: &mut [ModelHeadShape],
    drawn: &dyn Fn(&Traits, &ModelHeadShape) -> [f64; COUNT],
) {
    let wanted = targets(people, heads);
    approach(heads, &wanted);
    let sample: Vec<usize> = (0..heads.len()).step_by(SAMPLED).collect();
    let own: Vec<[f64; COUNT]> = sample.iter().map(|&i| measures(&heads[i])).collect();
    let skin: Vec<[f64; COUNT]> = sample
        .iter()
        .map(|&i| drawn(&people[i], &heads[i]))
        .collect();
    let lines: Vec<[f64; 2]> = (0..COUNT).map(|m| line(&own, &skin, m)).collect();
    let aimed = Mat::from_fn(heads.len(), COUNT, |i, m| {
        let [at_mean, slope] = lines[m];
        (wanted[(i, m)] - at_mean) / slope
    });
    approach(heads, &aimed);
    set_eyes(heads, &wanted);
}

/// Maximum difference of an eyeball from the mean offset to its lids, mm.
const MAX_DEVIATION_MM: f64 = 1.2;

/// Share of an eyeball's displacement that remains after it is fitted to its lids.
const EYES_GO: f64 = 1.0 - CENTRED;

/// Sets the distance of the pupils to that of surveys: pupils lie farther out than the midpoint
/// between the eye's corners. Moves only the eyeballs.
fn set_eyes(heads: &mut [ModelHeadShape], wanted: &Mat<f64>) {
    let Some(measure) = Measure::all().position(|m| m == Measure::PupilDistance) else {
        return;
    };
    let missing: Vec<f64> = (0..heads.len())
        .map(|i| wanted[(i, measure)] / 2.0 - eye_mm(&heads[i]))
        .collect();
    let mean = missing.iter().sum::<f64>() / missing.len().max(1) as f64;
    for (head, own) in heads.iter_mut().zip(missing) {
        let by = mean + (own - mean).clamp(-MAX_DEVIATION_MM, MAX_DEVIATION_MM);
        *head = head.clone().with_eyes_apart(by / EYES_GO);
    }
}

/// Sampling step over the heads that are checked as rendered.
const SAMPLED: usize = 8;
/// Minimum slope of the rendered measures against those of a head's positions.
const MIN_SLOPE: f64 = 0.7;

/// Fits the measure of the skin as a linear function of that of the positions: intercept and slope.
fn line(own: &[[f64; COUNT]], skin: &[[f64; COUNT]], measure: usize) -> [f64; 2] {
    let spread = |all: &[[f64; COUNT]]| {
        let count = all.len().max(1) as f64;
        let mean = all.iter().map(|m| m[measure]).sum::<f64>() / count;
        let square = all.iter().map(|m| (m[measure] - mean).powi(2)).sum::<f64>();
        (mean, (square / count).sqrt())
    };
    let ((from, off), (to, drawn)) = (spread(own), spread(skin));
    let slope = if off > 0.0 {
        (drawn / off).clamp(MIN_SLOPE, 1.0 / MIN_SLOPE)
    } else {
        1.0
    };
    [to - slope * from, slope]
}

/// Moves heads towards measures, one row for each.
fn approach(heads: &mut [ModelHeadShape], wanted: &Mat<f64>) {
    for _ in 0..ROUNDS {
        let (numbers, own) = table(heads);
        let follows = regression(&numbers, &own);
        for (i, head) in heads.iter_mut().enumerate() {
            let missing = Mat::from_fn(COUNT, 1, |m, _| wanted[(i, m)] - own[(i, m)]);
            let step = &follows * missing;
            let moved: Vec<f64> = (0..numbers.ncols())
                .map(|k| numbers[(i, k)] + step[(k, 0)])
                .collect();
            if let Some(moved) = ModelHeadShape::from_numbers(&moved) {
                *head = moved;
            }
        }
    }
}

/// Numbers and measures of heads, one row for each.
fn table(heads: &[ModelHeadShape]) -> (Mat<f64>, Mat<f64>) {
    let numbers: Vec<Vec<f64>> = heads
        .iter()
        .map(ModelHeadShape::flat_coordinates_mm)
        .collect();
    let own: Vec<[f64; COUNT]> = heads.iter().map(measures).collect();
    let width = numbers.first().map_or(0, Vec::len);
    (
        Mat::from_fn(heads.len(), width, |i, k| numbers[i][k]),
        Mat::from_fn(heads.len(), COUNT, |i, m| own[i][m]),
    )
}

/// Returns the regression of head positions on their measures: least squares over the heads.
fn regression(numbers: &Mat<f64>, own: &Mat<f64>) -> Mat<f64> {
    let (x, y) = (centred(own), centred(numbers));
    let square = x.transpose() * &x;
    let both = x.transpose() * &y;
    square.full_piv_lu().solve(&both).transpose().to_owned()
}

/// Returns the table with the mean of each column subtracted.
fn centred(table: &Mat<f64>) -> Mat<f64> {
    let rows = table.nrows();
    let mean: Vec<f64> = (0..table.ncols())
        .map(|k| (0..rows).map(|i| table[(i, k)]).sum::<f64>() / rows.max(1) as f64)
        .collect();
    Mat::from_fn(rows, table.ncols(), |i, k| table[(i, k)] - mean[k])
}

/// Computes the target measures of each head, one row per head, so that the crowd has the known
/// correlations.
fn targets(people: &[Traits], heads: &[ModelHeadShape]) -> Mat<f64> {
    let (_, own) = table(heads);
    let left = residuals(people, &own);
    let given = correlations(&left);
    let wanted = valid(&Mat::from_fn(COUNT, COUNT, |i, j| {
        let known = || known_correlation(measure_at(i)?, measure_at(j)?);
        known().unwrap_or(given[(i, j)])
    }));
    // The smallest change that gives these correlations.
    let turn = power(&valid(&given), -0.5) * power(&wanted, 0.5);
    let mixed = left * turn;
    let rows: Vec<_> = known_measures().map(|m| m.row).collect();
    Mat::from_fn(people.len(), COUNT, |i, m| {
        let norm = rows[m].norm_at(people[i].sex, people[i].age_years);
        norm.mean + norm.sd * mixed[(i, m)].clamp(-MAX_DEVIATIONS, MAX_DEVIATIONS)
    })
}

fn measure_at(index: usize) -> Option<Measure> {
    Measure::all().nth(index)
}

/// Returns the residuals of the measures after removing sex and age, in standard deviations.
fn residuals(people: &[Traits], own: &Mat<f64>) -> Mat<f64> {
    let known = Mat::from_fn(people.len(), 6, |i, k| {
        let (sex, age) = (people[i].sex, people[i].age_years / 40.0);
        [1.0, sex, age, age * age, sex * age, age * age * age][k]
    });
    let square = known.transpose() * &known;
    let explained = square.full_piv_lu().solve(&(known.transpose() * own));
    let left = own - &known * explained;
    let deviation: Vec<f64> = (0..COUNT)
        .map(|m| {
            let sum: f64 = (0..people.len()).map(|i| left[(i, m)] * left[(i, m)]).sum();
            (sum / people.len().max(1) as f64).sqrt()
        })
        .collect();
    Mat::from_fn(people.len(), COUNT, |i, m| left[(i, m)] / deviation[m])
}

/// Returns the correlation matrix of the columns of a centred table.
fn correlations(table: &Mat<f64>) -> Mat<f64> {
    let square = table.transpose() * table;
    Mat::from_fn(COUNT, COUNT, |i, j| {
        square[(i, j)] / (square[(i, i)] * square[(j, j)]).sqrt()
    })
}

/// Returns the nearest correlation matrix whose eigenvalues are at least [`MIN_EIGENVALUE`].
fn valid(correlations: &Mat<f64>) -> Mat<f64> {
    let all = with_eigenvalues(correlations, |x| x.max(MIN_EIGENVALUE));
    Mat::from_fn(COUNT, COUNT, |i, j| {
        all[(i, j)] / (all[(i, i)] * all[(j, j)]).sqrt()
    })
}

/// Returns the square root of a correlation matrix, or its inverse if `exponent` is negative.
fn power(correlations: &Mat<f64>, exponent: f64) -> Mat<f64> {
    with_eigenvalues(correlations, |x| {
        if exponent < 0.0 {
            1.0 / x.max(MIN_EIGENVALUE).sqrt()
        } else {
            x.max(0.0).sqrt()
        }
    })
}

/// Returns the symmetric matrix with modified eigenvalues; the matrix itself if the decomposition
/// fails.
fn with_eigenvalues(matrix: &Mat<f64>, change: impl Fn(f64) -> f64) -> Mat<f64> {
    let Ok(eigen) = matrix.self_adjoint_eigen(Half::Lower) else {
        return matrix.clone();
    };
    let (vectors, values) = (eigen.U(), eigen.S().column_vector());
    Mat::from_fn(matrix.nrows(), matrix.nrows(), |i, j| {
        (0..matrix.nrows())
            .map(|k| vectors[(i, k)] * change(values[k]) * vectors[(j, k)])
            .sum()
    })
}

#[cfg(test)]
mod tests {
    use raconteur_base::noise;

    use super::*;
    use crate::head::FIELDS;
    use crate::model::Ancestry;

    /// Heads that differ by fields and by size along the axes.
    fn crowd(count: u64) -> (Vec<Traits>, Vec<ModelHeadShape>) {
        let person = |i: u64| Traits {
            age_years: 18.0 + 60.0 * noise::unit(3, i, 1),
            sex: f64::from(u8::from(i.is_multiple_of(2))),
            ancestry: Ancestry {
                african: 1.0,
                asian: 1.0,
                european: 1.0,
            },
            muscle: 0.5,
            weight: 0.5,
            height: 0.5,
            proportions: 0.5,
            details: std::collections::BTreeMap::new(),
        };
        let head = |i: u64| {
            let amounts: Vec<f64> = (0..FIELDS.len() as i64)
                .map(|k| noise::signed(5, i, k))
                .collect();
            let scale: Vec<f64> = (0..3)
                .map(|k| 1.0 + 0.03 * noise::signed(6, i, k))
                .collect();
            let numbers = ModelHeadShape::default()
                .with_fields(&amounts)
                .flat_coordinates_mm();
            let scaled: Vec<f64> = numbers
                .iter()
                .enumerate()
                .map(|(k, x)| x * scale[k % 3] + 1.2 * noise::signed(7, i, k as i64))
                .collect();
            ModelHeadShape::from_numbers(&scaled).expect("a head")
        };
        (
            (0..count).map(person).collect(),
            (0..count).map(head).collect(),
        )
    }

    #[test]
    fn a_crowd_gets_the_means_deviations_and_correlations_of_surveys() {
        let (people, mut heads) = crowd(400);
        fit_population(&people, &mut heads, &|_, head| measures(head));
        let (_, own) = table(&heads);
        let rows: Vec<_> = known_measures().map(|m| (m.name, m.row)).collect();
        let z = Mat::from_fn(people.len(), COUNT, |i, m| {
            let norm = rows[m].1.norm_at(people[i].sex, people[i].age_years);
            (own[(i, m)] - norm.mean) / norm.sd
        });
        for (m, (name, _)) in rows.iter().enumerate() {
            let mean = (0..people.len()).map(|i| z[(i, m)]).sum::<f64>() / 400.0;
            let square = (0..people.len())
                .map(|i| z[(i, m)] * z[(i, m)])
                .sum::<f64>()
                / 400.0;
            assert!(mean.abs() < 0.25, "{name}: mean {mean:.2}");
            assert!(
                (square.sqrt() - 1.0).abs() < 0.2,
                "{name}: deviation {:.2}",
                square.sqrt()
            );
        }
        let found = correlations(&centred(&z));
        for i in 0..COUNT {
            for j in 0..COUNT {
                let known = measure_at(i)
                    .zip(measure_at(j))
                    .and_then(|(a, b)| known_correlation(a, b));
                if let Some(known) = known {
                    let off = found[(i, j)] - known;
                    assert!(
                        off.abs() < 0.15,
                        "{} and {}: {off:.2}",
                        rows[i].0,
                        rows[j].0
                    );
                }
            }
        }
    }
}
