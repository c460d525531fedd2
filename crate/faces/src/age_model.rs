//! Ageing: the mean face of people as a function of their years. Growth is not ageing, and neither
//! is linear, so no single direction describes them.

#[cfg(any(test, feature = "learn"))]
use crate::person::PersonRecord;

/// Age at which growth ends, years.
pub(crate) const GROWN_YEARS: f64 = 20.0;
/// The oldest face is as many years older.
const AGEING_YEARS: f64 = 60.0;
/// Ages that a life is known for, years.
const KNOWN_YEARS: core::ops::RangeInclusive<f64> = 8.0..=80.0;
/// Number of regression terms formed from age and sex.
const TERMS: usize = 6;

/// Returns the growth and ageing terms of the age model for an age in years and a sex from 0 (male)
/// to 1 (female).
fn terms(years: f64, sex: f64) -> [f64; TERMS] {
    let years = years.clamp(*KNOWN_YEARS.start(), *KNOWN_YEARS.end());
    let growth = (GROWN_YEARS - years).max(0.0) / GROWN_YEARS;
    let ageing = (years - GROWN_YEARS).max(0.0) / AGEING_YEARS;
    [
        growth,
        growth * growth,
        ageing,
        ageing * ageing,
        growth * sex,
        ageing * sex,
    ]
}

/// Linear model of the change of face-space coefficients with age and sex; used to make a face
/// older or younger.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct AgeModel {
    /// Coefficients added by one unit of each age and sex term; empty if the model has no age data.
    pub(crate) effects: Vec<Vec<f64>>,
}

impl AgeModel {
    /// Fits the model to people and their faces by least squares, together with sex and ancestry.
    /// Returns an empty model if there are too few people.
    #[cfg(feature = "learn")]
    #[must_use]
    pub fn learn(people: &[PersonRecord], faces: &[Vec<f64>]) -> Self {
        use faer::linalg::solvers::Solve as _;
        // The mean, sex and two ancestries in addition to the terms.
        const ALL: usize = TERMS + 4;
        if people.len() <= 2 * ALL || people.len() != faces.len() {
            return Self::default();
        }
        let known = faer::Mat::from_fn(people.len(), ALL, |i, k| {
            let p = &people[i];
            match k {
                TERMS => 1.0,
                _ if k == TERMS + 1 => p.sex,
                _ if k > TERMS + 1 => p.ancestry[k - TERMS - 1],
                _ => terms(p.age_years, p.sex)[k],
            }
        });
        let modes = faces.first().map_or(0, Vec::len);
        let wanted = faer::Mat::from_fn(faces.len(), modes, |i, mode| faces[i][mode]);
        let square = known.transpose() * &known;
        let solution = square.full_piv_lu().solve(&(known.transpose() * wanted));
        let row = |k: usize| (0..modes).map(|mode| solution[(k, mode)]).collect();
        Self {
            effects: (0..TERMS).map(row).collect(),
        }
    }

    /// Returns true if each term has this number of coefficients, or if the model is empty.
    pub(crate) fn fits(&self, modes: usize) -> bool {
        let is_whole = |row: &Vec<f64>| row.len() == modes && row.iter().all(|x| x.is_finite());
        self.effects.is_empty()
            || (self.effects.len() == TERMS && self.effects.iter().all(is_whole))
    }

    /// Returns the change of the coefficients between two ages for a person of the given sex; ages
    /// from 8 to 80.
    #[must_use]
    pub fn change(&self, from_years: f64, to_years: f64, sex: f64) -> Vec<f64> {
        let [from, to] = [from_years, to_years].map(|years| terms(years, sex.clamp(0.0, 1.0)));
        let mut along = vec![0.0; self.effects.first().map_or(0, Vec::len)];
        for (k, effect) in self.effects.iter().enumerate() {
            for (sum, by) in along.iter_mut().zip(effect) {
                *sum += (to[k] - from[k]) * by;
            }
        }
        along
    }
}

#[cfg(test)]
mod tests {
    use raconteur_base::noise;

    use super::*;

    fn people() -> Vec<PersonRecord> {
        let one = |i: u64| PersonRecord {
            sex: f64::from(u8::from(i.is_multiple_of(2))),
            age_years: 8.0 + 72.0 * noise::unit(1, i, 0),
            ancestry: [0, 1, 2].map(|k| noise::unit(2, i, k)),
        };
        (0..400).map(one).collect()
    }

    #[test]
    #[cfg(feature = "learn")]
    fn a_life_is_told_from_people_of_all_ages() {
        let people = people();
        // One number that grows up to 20 years, and another that starts at 20 and grows faster for
        // women.
        let face = |p: &PersonRecord| {
            let noise = 0.1 * noise::signed(3, (p.age_years * 1e6) as u64, 0);
            let late = (p.age_years - GROWN_YEARS).max(0.0) / AGEING_YEARS;
            vec![
                p.age_years.min(GROWN_YEARS) / GROWN_YEARS + noise,
                late * (1.0 + p.sex) + noise,
            ]
        };
        let faces: Vec<Vec<f64>> = people.iter().map(face).collect();
        let life = AgeModel::learn(&people, &faces);
        assert!(
            life.fits(2) && !life.fits(3),
            "two attributes fit and three do not"
        );
        let off = |change: Vec<f64>, wanted: [f64; 2]| {
            change
                .iter()
                .zip(wanted)
                .map(|(a, b)| (a - b).abs())
                .fold(0.0, f64::max)
        };
        assert!(
            off(life.change(10.0, 20.0, 0.0), [0.5, 0.0]) < 0.05,
            "the change from 10 to 20 years"
        );
        assert!(
            off(life.change(20.0, 80.0, 1.0), [0.0, 2.0]) < 0.05,
            "the change from 20 to 80 years"
        );
        assert!(
            off(life.change(70.0, 10.0, 0.0), [-0.5, -50.0 / 60.0]) < 0.05,
            "the change from 70 to 10 years"
        );
        assert_eq!(life.change(44.0, 44.0, 0.3), [0.0, 0.0]);
        assert_eq!(
            AgeModel::learn(&people[..9], &faces[..9]),
            AgeModel::default()
        );
    }

    #[test]
    fn ages_that_nobody_has_are_the_nearest_ones() {
        assert_eq!(terms(-5.0, 1.0), terms(8.0, 1.0));
        assert_eq!(terms(500.0, 0.0), terms(80.0, 0.0));
        assert!(
            people()
                .iter()
                .all(|p| terms(p.age_years, p.sex).iter().all(|x| x.is_finite())),
            "all terms of unusual ages are finite"
        );
    }
}
