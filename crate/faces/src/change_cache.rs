//! Cache of recent changes: a moving slider repeats the same requests, and so does navigating
//! between a few states of the history.

use crate::edit::{Change, Face, Part};

/// Maximum size of the cache, bytes.
const MAX_BYTES: usize = 48 << 20;
/// Numbers in a row that are zero part two runs.
const GAP: usize = 24;

/// A change without the numbers that are zero: most features are small.
#[derive(Clone, Debug)]
struct SparseChange {
    part: Part,
    /// Start index and numbers of each run.
    runs: Vec<(usize, Vec<f64>)>,
    organs: Vec<f64>,
}

impl SparseChange {
    fn from_change(change: &Change) -> Self {
        let numbers = change.numbers();
        let mut runs: Vec<(usize, Vec<f64>)> = Vec::new();
        let mut zeros = GAP;
        for (i, &x) in numbers.iter().enumerate() {
            if x == 0.0 {
                zeros += 1;
                continue;
            }
            match runs.last_mut().filter(|_| zeros < GAP) {
                Some((start, run)) => {
                    run.resize(i - *start, 0.0);
                    run.push(x);
                }
                None => runs.push((i, vec![x])),
            }
            zeros = 0;
        }
        runs.iter_mut().for_each(|(_, run)| run.shrink_to_fit());
        Self {
            part: change.part(),
            runs,
            organs: change.organs().to_vec(),
        }
    }

    fn bytes(&self) -> usize {
        let runs = self
            .runs
            .iter()
            .map(|(_, run)| 8 * run.len() + size_of::<(usize, Vec<f64>)>());
        runs.sum::<usize>() + 8 * self.organs.len()
    }

    /// Adds a multiple of the change to a face, as [`Face::add`] does.
    fn add_to(&self, face: &mut Face, amount: f64) {
        let numbers = match self.part {
            Part::Shape => &mut face.shape,
            Part::Texture => &mut face.texture,
        };
        for (start, run) in &self.runs {
            let own = numbers.iter_mut().skip(*start);
            for (x, by) in own.zip(run) {
                *x += amount * by;
            }
        }
        for (x, by) in face.organs.iter_mut().zip(&self.organs) {
            *x += amount * by;
        }
    }
}

/// Cache of face changes by request key, most recent last.
#[derive(Debug, Default)]
pub(crate) struct ChangeCache {
    changes: Vec<(String, SparseChange)>,
    bytes: usize,
}

impl ChangeCache {
    /// Adds a multiple of the change with the given key to a face, and computes the change if it is
    /// not cached.
    pub(crate) fn add<E>(
        &mut self,
        face: &mut Face,
        key: String,
        amount: f64,
        make: impl FnOnce() -> Result<Change, E>,
    ) -> Result<(), E> {
        let known = self.changes.iter().position(|(asked, _)| *asked == key);
        let entry = match known {
            Some(index) => self.changes.remove(index),
            None => {
                let kept = SparseChange::from_change(&make()?);
                self.bytes += kept.bytes();
                (key, kept)
            }
        };
        entry.1.add_to(face, amount);
        self.changes.push(entry);
        while self.bytes > MAX_BYTES && self.changes.len() > 1 {
            self.bytes -= self.changes.remove(0).1.bytes();
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Region;
    use crate::edit::tests::editor;

    #[test]
    fn what_is_kept_adds_what_the_change_does() {
        let editor = editor();
        let mut lately = ChangeCache::default();
        let (mut face, mut wanted) = (editor.average(), editor.average());
        let names: Vec<&str> = editor
            .attributes(Part::Shape)
            .iter()
            .map(|a| a.attribute.name.as_str())
            .collect();
        let regions = [
            Region::whole_head(),
            editor.region(&["nose"], None).expect("a nose"),
        ];
        for round in 0..3 {
            for (name, (index, region)) in names
                .iter()
                .flat_map(|n| (0..).zip(&regions).map(move |r| (n, r)))
            {
                let amount = 0.3 - 0.2 * f64::from(round);
                let change = editor
                    .attribute_change(Part::Shape, name, region)
                    .expect("an attribute");
                wanted.add(&change, amount);
                let made = lately.add(&mut face, format!("{name} {index}"), amount, || {
                    Ok::<_, ()>(change)
                });
                assert_eq!(made, Ok(()));
            }
        }
        assert_eq!(face.shape, wanted.shape);
        assert_eq!(face.organs, wanted.organs);
        assert_eq!(lately.changes.len(), names.len() * regions.len());
    }
}
