//! Fitting of a person of the body model to statistics: face details that bring its measures to the
//! wanted ones.

use std::collections::BTreeMap;

use faer::Mat;
use faer::linalg::solvers::Solve as _;
use raconteur_base::DVec3;

use super::binding::{Binding, ModelHeadShape};
use super::fitted_half::fit;
use super::measure::{At, DEFINITIONS, Measure};
use crate::model::{Detail, Model, ModelError, Traits};
use crate::statistics::Row;

/// Within it faces stay usual.
const MAX_DETAIL: f64 = 0.6;
/// Weight of a change of a detail by its whole usual range, relative to one standard deviation of a
/// measure. Designed: most faces come within 0.2 deviations and no detail reaches its limit.
const STAY: f64 = 0.5;
/// Step by which a detail's effect is found. Effects are straight on either side of zero.
const STEP: f64 = 0.1;
/// Rounds; the second knows on which side of zero each detail ends.
const ROUNDS: usize = 3;

/// Current and target value of a measure of a head, in standard deviations from the mean for its
/// sex and age; report of the fitting.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeasureGoal {
    /// Measure that the goal is about.
    pub measure: Measure,
    /// Value before fitting, standard deviations.
    pub before: f64,
    /// Value after fitting, standard deviations.
    pub after: f64,
    /// Target value, standard deviations.
    pub target: f64,
}

/// Computes the measures of a head, millimetres, in the order of [`Measure::all`].
#[must_use]
pub fn measures(bound: &ModelHeadShape) -> [f64; Measure::COUNT] {
    let points = fit(bound, |_| None).points;
    let at: At<'_> = &|key| points.get(&key).copied().unwrap_or(DVec3::ZERO);
    core::array::from_fn(|i| (DEFINITIONS[i].measurer)(at))
}

/// A measure to reach.
struct Target {
    measure: Measure,
    row: &'static Row,
    target: f64,
}

impl Target {
    fn all(wanted: &BTreeMap<Measure, f64>) -> Vec<Self> {
        let known = DEFINITIONS.iter().filter_map(|d| {
            let wanted = *wanted.get(&d.measure)?;
            Some(Self {
                measure: d.measure,
                row: &d.row,
                target: wanted,
            })
        });
        known.collect()
    }
}

/// The body model, ready to be fitted.
struct Fitting<'a> {
    model: &'a Model,
    binding: Binding,
    details: Vec<Detail>,
    targets: Vec<Target>,
}

impl Fitting<'_> {
    /// Deviations of the targets' measures on a person's head.
    fn deviations(&self, traits: &Traits) -> Result<Vec<f64>, ModelError> {
        let bound = self.binding.bind(&self.model.shape(traits)?);
        let all = measures(&bound);
        let deviation = |t: &Target| {
            let norm = t.row.norm_at(traits.sex, traits.age_years);
            (all[t.measure as usize] - norm.mean) / norm.sd
        };
        Ok(self.targets.iter().map(deviation).collect())
    }

    fn amounts(&self, traits: &Traits) -> Vec<f64> {
        let of = |d: &Detail| {
            let each = d
                .names
                .iter()
                .map(|n| traits.details.get(n).copied().unwrap_or(0.0));
            each.sum::<f64>() / d.names.len() as f64
        };
        self.details.iter().map(of).collect()
    }

    /// Returns the person with each detail changed; the difference between the halves stays.
    fn moved(&self, traits: &Traits, by: &[f64]) -> Traits {
        let mut all = traits.clone();
        for (detail, by) in self.details.iter().zip(by) {
            for name in detail.names.iter().filter(|_| *by != 0.0) {
                let amount = all.details.entry(name.clone()).or_default();
                *amount = (*amount + by)
                    .clamp(-MAX_DETAIL.max(amount.abs()), MAX_DETAIL.max(amount.abs()));
            }
        }
        all
    }

    /// Computes one step of the detail amounts towards the targets, with the smallest possible
    /// change of the person.
    fn step(&self, own: &[f64], traits: &Traits) -> Result<Vec<f64>, ModelError> {
        let now = self.deviations(traits)?;
        let amounts = self.amounts(traits);
        let (m, n) = (self.targets.len(), self.details.len());
        let mut effect = Mat::<f64>::zeros(m, n);
        for d in 0..n {
            // Away from zero, where the effect is that of one target.
            let step = if amounts[d] < 0.0 { -STEP } else { STEP };
            let mut by = vec![0.0; n];
            by[d] = step;
            let there = self.deviations(&self.moved(traits, &by))?;
            for t in 0..m {
                effect[(t, d)] = (there[t] - now[t]) / step;
            }
        }
        // Least change of x for effect · x = missing, softly: x = Eᵀ (E Eᵀ + s I)⁻¹ (missing − E
        // pull) + pull, where the pull leads back to the person's own amounts.
        let pull: Vec<f64> = own.iter().zip(&amounts).map(|(a, b)| a - b).collect();
        let share = STAY * STAY;
        let square = &effect * effect.transpose();
        let system = Mat::from_fn(m, m, |i, j| {
            square[(i, j)] + if i == j { share } else { 0.0 }
        });
        let missing = Mat::from_fn(m, 1, |t, _| {
            let led: f64 = (0..n).map(|d| effect[(t, d)] * pull[d]).sum();
            self.targets[t].target - now[t] - led
        });
        let solved = system.full_piv_lu().solve(&missing);
        Ok((0..n)
            .map(|d| pull[d] + (0..m).map(|t| effect[(t, d)] * solved[(t, 0)]).sum::<f64>())
            .collect())
    }
}

/// Adjusts the details of a person's face, as little as possible and within ±0.6, until its
/// measures reach wanted values: standard deviations from the mean for sex and age, by measure.
///
/// # Errors
/// Returns an error if the model lacks a target that the traits name.
pub fn fit_measures(
    model: &Model,
    traits: &Traits,
    wanted: &BTreeMap<Measure, f64>,
) -> Result<(Traits, Vec<MeasureGoal>), ModelError> {
    let fitting = Fitting {
        model,
        binding: Binding::new(model.faces()),
        details: model.details()?,
        targets: Target::all(wanted),
    };
    let before = fitting.deviations(traits)?;
    let own = fitting.amounts(traits);
    let mut fitted = traits.clone();
    for _ in 0..ROUNDS {
        let by = fitting.step(&own, &fitted)?;
        fitted = fitting.moved(&fitted, &by);
    }
    let after = fitting.deviations(&fitted)?;
    let aims = fitting.targets.iter().zip(before.iter().zip(&after));
    let aims = aims.map(|(t, (&before, &after))| MeasureGoal {
        measure: t.measure,
        before,
        after,
        target: t.target,
    });
    // A hundredth of a detail is invisible.
    let mut rounded = fitted.clone();
    for amount in rounded.details.values_mut() {
        *amount = (*amount * 1e3).round() / 1e3;
    }
    rounded.details.retain(|_, amount| *amount != 0.0);
    Ok((rounded, aims.collect()))
}
