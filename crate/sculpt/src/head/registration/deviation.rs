//! How far a finished head lies from the body model's surface.

use crate::head::Shape;
use crate::head::binding::Binding;
use crate::head::cage::Zone;
use crate::model::{Model, ModelError, Traits};
use crate::person::Person;

use super::ModelHead;

/// Distances of the drawn vertices of a region from the model's surface, mm.
#[derive(Clone, Debug, PartialEq)]
pub struct Deviation {
    /// Which.
    pub region: &'static str,
    /// How many vertices.
    pub count: usize,
    /// Root of the mean square.
    pub rms_mm: f64,
    /// That 95 of 100 do not exceed.
    pub p95_mm: f64,
    /// The largest.
    pub most_mm: f64,
}

/// Parts of the head; linings and the neck are made by formulas and belong to none.
fn region(zone: Zone) -> Option<&'static str> {
    match zone {
        Zone::Grid(0..=10, 0..=25) => Some("face"),
        Zone::Grid(_, 0..=20) | Zone::Crown => Some("cranium"),
        Zone::Eye(0..=4) => Some("orbit and lids"),
        Zone::Mouth(0..=4) => Some("lips"),
        Zone::Ear(0..=8) => Some("ears"),
        _ => None,
    }
}

/// Measures the head of a person by region, the finished one against the model's. Lids and lips
/// differ on purpose: eyes of life size, and lips that meet.
///
/// # Errors
/// When the model lacks what the traits name.
pub fn deviations(model: &Model, traits: &Traits) -> Result<Vec<Deviation>, ModelError> {
    let shape = model.shape(traits)?;
    let binding = Binding::new(model.faces());
    let theirs = ModelHead::new(model, &binding, &shape);
    let person = Person {
        sex: traits.sex,
        age_years: traits.age_years,
        stature_m: 1.7,
        build: 0.0,
    };
    let ours = Shape::build(&person, &binding.bind(&shape), 1.0);
    let mut zone_of = vec![None; ours.positions.len()];
    for (face, &zone) in ours.surface.faces.iter().zip(&ours.surface.zones) {
        for &v in face {
            zone_of[v as usize] = region(zone);
        }
    }
    let regions = ["face", "orbit and lids", "lips", "ears", "cranium"];
    let all = regions.into_iter().filter_map(|region| {
        let mut far: Vec<f64> = ours
            .positions
            .iter()
            .zip(&zone_of)
            .filter(|(_, own)| **own == Some(region))
            .filter_map(|(&p, _)| Some(theirs.surface.nearest(p, |_| true)?.at.distance(p)))
            .collect();
        far.sort_by(f64::total_cmp);
        let count = far.len();
        Some(Deviation {
            region,
            count,
            rms_mm: (far.iter().map(|d| d * d).sum::<f64>() / count as f64).sqrt(),
            p95_mm: *far.get(count * 95 / 100)?,
            most_mm: *far.last()?,
        })
    });
    Ok(all.collect())
}
