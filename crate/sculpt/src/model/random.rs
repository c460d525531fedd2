//! Random people, for tests of properties that hold for everyone.

use std::collections::BTreeMap;

use raconteur_base::noise::{signed, unit};

use super::{Ancestry, Detail, Traits};

/// Range of random ages, years: the range covered by the statistics.
const AGES: [f64; 2] = [8.0, 80.0];
/// Limit of a detail: beyond it faces are unusual.
const MAX_DETAIL: f64 = 0.6;

impl Traits {
    /// Returns person number `index` of a random crowd: any age, sex and mixture of ancestries.
    /// Details scatter around the mean (0), two in three within ±0.2. The same `seed` and `index`
    /// give the same person.
    #[must_use]
    pub fn random(details: &[Detail], seed: u64, index: u64) -> Self {
        let mut drawn = 0;
        let mut next = || {
            drawn += 1;
            unit(seed, index, drawn)
        };
        let mut between = |[low, high]: [f64; 2]| low + (high - low) * next();
        let age_years = between(AGES);
        let blend = between([0.0, 0.1]);
        let sex = if between([0.0, 1.0]) < 0.5 {
            blend
        } else {
            1.0 - blend
        };
        // Cubes: most people are mainly of one ancestry.
        let mut share = || between([0.01, 1.0]).powi(3);
        let ancestry = Ancestry {
            african: share(),
            asian: share(),
            european: share(),
        };
        let [muscle, weight, proportions] = [[0.3, 0.7], [0.3, 0.75], [0.4, 0.9]].map(between);
        let amount = |detail: i64| {
            // The sum of three: a bell.
            let sum: f64 = (0..3).map(|k| signed(!seed, index, 3 * detail + k)).sum();
            (0.2 * sum).clamp(-MAX_DETAIL, MAX_DETAIL)
        };
        let details: BTreeMap<String, f64> = (0..)
            .zip(details)
            .flat_map(|(i, detail)| {
                detail
                    .names
                    .iter()
                    .map(move |name| (name.clone(), amount(i)))
            })
            .collect();
        Self {
            age_years,
            sex,
            ancestry,
            muscle,
            weight,
            height: 0.5,
            proportions,
            details,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn people_are_usual_symmetric_and_the_same_for_a_seed() {
        let names = |all: &[&str]| Detail {
            names: all.iter().map(|n| (*n).to_owned()).collect(),
        };
        let details = [
            names(&["nose/a-decr-incr"]),
            names(&["eyes/l-b-in-out", "eyes/r-b-in-out"]),
        ];
        let crowd = |seed| (0..300).map(move |i| (seed, i));
        let people: Vec<Traits> = crowd(1)
            .map(|(s, i)| Traits::random(&details, s, i))
            .collect();
        for p in &people {
            assert!(
                (AGES[0]..=AGES[1]).contains(&p.age_years),
                "the age is in its range"
            );
            assert!(
                p.details.len() == 3 && p.details.values().all(|d| d.abs() <= MAX_DETAIL),
                "the three details are within their bound"
            );
            assert_eq!(p.details["eyes/l-b-in-out"], p.details["eyes/r-b-in-out"]);
        }
        let share = |of: fn(&Traits) -> bool| people.iter().filter(|p| of(p)).count();
        // Half of them are women, and a third mainly of each ancestry.
        assert!(
            (110..190).contains(&share(|p| p.sex > 0.5)),
            "about half of the people are of each sex"
        );
        let mainly_asian: fn(&Traits) -> bool =
            |p| p.ancestry.asian > p.ancestry.african.max(p.ancestry.european);
        assert!(
            (70..130).contains(&share(mainly_asian)),
            "about a third of the people are mainly Asian"
        );
        assert!(
            (150..250).contains(&share(|p| p.details["nose/a-decr-incr"].abs() < 0.2)),
            "most noses are near the mean"
        );
        assert!(
            crowd(1)
                .map(|(s, i)| Traits::random(&details, s, i))
                .eq(people.iter().cloned()),
            "the same seed gives the same people"
        );
        assert!(
            Traits::random(&details, 2, 0) != people[0],
            "another seed gives another person"
        );
    }
}
