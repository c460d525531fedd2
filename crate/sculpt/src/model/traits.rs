//! Traits that distinguish people of the model.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

/// Shares of ancestry of a person in the body model; they are normalised by their sum.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Ancestry {
    /// Share of African ancestry.
    #[serde(default)]
    pub african: f64,
    /// Share of East Asian ancestry.
    #[serde(default)]
    pub asian: f64,
    /// Share of European ancestry.
    #[serde(default)]
    pub european: f64,
}

/// Person as a point in the body model's space: age, sex, ancestry, body and face details. The axes
/// are those of MakeHuman.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Traits {
    /// Years, 1 to 90.
    pub age_years: f64,
    /// 0 male to 1 female.
    pub sex: f64,
    /// Shares of ancestry.
    pub ancestry: Ancestry,
    /// 0 slack to 1 trained, 0.5 average.
    pub muscle: f64,
    /// 0 thin to 1 heavy, 0.5 average.
    pub weight: f64,
    /// 0 short to 1 tall, 0.5 average.
    pub height: f64,
    /// 0 uncommon to 1 ideal proportions of the body.
    pub proportions: f64,
    /// Signed amounts of details by name, such as `nose/nose-hump-decr-incr`: below zero the first
    /// of the pair at the name's end, above the second. Within ±0.6 faces look usual.
    pub details: BTreeMap<String, f64>,
}
