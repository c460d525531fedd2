//! Constraints: values that edited faces are brought back to, also for segments (F&H 3.2.3 and
//! 5.1.7).

use super::{Change, Editor, Face, Part, Region, difference};
use crate::error::FaceError;
use crate::pack::Difference;

/// Constraint that holds an attribute of an edited face at a value.
#[derive(Clone, Debug, PartialEq)]
pub struct Constraint {
    /// Part of the face (shape or texture) that the attribute belongs to.
    pub part: Part,
    /// Name of the attribute.
    pub name: String,
    /// Value to hold.
    pub value: f64,
    /// Region in which the face may change to meet the constraint.
    pub region: Region,
}

/// Threshold below which the remainder of a column of the system, as a share of its own square,
/// carries no information.
const SAME: f64 = 1e-9;
/// Values that differ by less are the same.
const MEETS: f64 = 1e-6;

impl Editor {
    /// Brings a face to the given values by multiples of the attributes' changes (equation 3.6),
    /// each in its region.
    ///
    /// # Errors
    /// Returns an error if no multiples satisfy all constraints, or an attribute does not exist;
    /// the face is then unchanged. The error names the first constraint that contradicts the ones
    /// before it.
    pub fn constrain(&self, face: &mut Face, held: &[Constraint]) -> Result<(), FaceError> {
        for part in [Part::Shape, Part::Texture] {
            let own: Vec<&Constraint> = held.iter().filter(|c| c.part == part).collect();
            if own.is_empty() {
                continue;
            }
            let changes: Vec<Change> = own
                .iter()
                .map(|c| self.attribute_change(part, &c.name, &c.region))
                .collect::<Result<_, _>>()?;
            let amounts = self.amounts(face, &own, &changes)?;
            for (change, amount) in changes.iter().zip(amounts) {
                face.add(change, amount);
            }
        }
        Ok(())
    }

    /// Returns the change for one unit of an attribute in isolation: for a feature, the change
    /// within its segments; for a trait of the whole person, the change of the whole head at which
    /// other attributes of its part keep their values. Values are linear in the face, so the result
    /// is the same for every face.
    ///
    /// # Errors
    /// Returns an error if an attribute does not exist, or if a kept attribute is equivalent to the
    /// changed one.
    pub fn change_alone(&self, part: Part, name: &str, kept: &[&str]) -> Result<Change, FaceError> {
        if self.named(part, name)?.feature.is_some() {
            return self.attribute_change(part, name, &Region::whole_head());
        }
        let before = self.average();
        let region = self.region(&[], None)?;
        let held = |(name, more): (&str, f64)| {
            Ok(Constraint {
                part,
                value: self.value(&before, part, name)? + more,
                region: region.clone(),
                name: name.to_owned(),
            })
        };
        let names = std::iter::once((name, 1.0)).chain(kept.iter().map(|&name| (name, 0.0)));
        let all: Vec<Constraint> = names.map(held).collect::<Result<_, FaceError>>()?;
        let mut after = before.clone();
        self.constrain(&mut after, &all)?;
        let difference = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a - b).collect();
        Ok(match part {
            Part::Shape => Change {
                part,
                numbers: difference(&after.shape, &before.shape),
                organs: difference(&after.organs, &before.organs),
            },
            Part::Texture => Change {
                part,
                numbers: difference(&after.texture, &before.texture),
                organs: Vec::new(),
            },
        })
    }

    /// Returns the amount of each change that meets the values, all of one part. The equations are
    /// solved by elimination, row by row in the order of the constraints.
    fn amounts(
        &self,
        face: &Face,
        held: &[&Constraint],
        changes: &[Change],
    ) -> Result<Vec<f64>, FaceError> {
        let count = held.len();
        let mut rows: Vec<Vec<f64>> = Vec::with_capacity(count);
        let Some(part) = held.first().map(|c| c.part) else {
            return Ok(Vec::new());
        };
        let space = self.space(part)?;
        let own = difference(face.part(part), space)?;
        let own = Difference::new(&own);
        let effects: Vec<Difference<'_>> = changes
            .iter()
            .map(|c| Difference::new(&c.numbers))
            .collect();
        for constraint in held {
            let named = self.named(part, &constraint.name)?;
            let missing = constraint.value - named.value_of(space, &own);
            let effects = effects.iter().map(|change| named.value_of(space, change));
            let mut row: Vec<f64> = effects.collect();
            row.push(missing);
            rows.push(row);
        }
        let mut pivots: Vec<Option<usize>> = Vec::with_capacity(count);
        for (i, constraint) in held.iter().enumerate() {
            let (done, rest) = rows.split_at_mut(i);
            let Some(row) = rest.first_mut() else { break };
            let size = row[..count].iter().map(|x| x.abs()).fold(0.0, f64::max);
            for (before, pivot) in done.iter().zip(&pivots) {
                let Some(column) = *pivot else { continue };
                let factor = row[column] / before[column];
                for (x, y) in row.iter_mut().zip(before) {
                    *x -= factor * y;
                }
            }
            let best = (0..count).max_by(|&a, &b| row[a].abs().total_cmp(&row[b].abs()));
            let best = best.filter(|&k| row[k].abs() > SAME * size);
            if best.is_none() && row[count].abs() > MEETS {
                return Err(FaceError::Contradiction {
                    name: constraint.name.clone(),
                    value: constraint.value,
                });
            }
            pivots.push(best);
        }
        let mut amounts = vec![0.0; count];
        for i in (0..count).rev() {
            let Some(column) = pivots[i] else { continue };
            let known: f64 = (0..count)
                .filter(|&k| k != column)
                .map(|k| rows[i][k] * amounts[k])
                .sum();
            amounts[column] = (rows[i][count] - known) / rows[i][column];
        }
        Ok(amounts)
    }
}
