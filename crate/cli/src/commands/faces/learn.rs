//! `raconteur faces learn`.

use std::io::Write as _;
use std::path::PathBuf;

use anyhow::{Context as _, Result, ensure};
use clap::Args;
use raconteur_faces::{
    Attribute, FaceModel, FaceSpace, Follower, NamedAttribute, Segment, Segments,
};
use raconteur_sculpt::examples::Example;
use raconteur_sculpt::head::HeadSegment;
use raconteur_sculpt::labels::{LABELS, Label};
use raconteur_voice::files::disk::replace;

use super::examples::Crowd;
use crate::{Outcome, terminal};

/// Learn a face space with its attributes from heads drawn at random, and write it as a pack.
#[derive(Args)]
pub(super) struct Learn {
    #[command(flatten)]
    crowd: Crowd,
    /// The pack.
    #[arg(short, long)]
    output: PathBuf,
    /// As many modes are kept as explain this share of the variance of faces that nothing was learned
    /// from.
    #[arg(long, default_value_t = 0.99)]
    explains: f64,
}

/// One head of so many is held out.
const HELD_OUT: usize = 10;

impl Learn {
    pub(super) fn run(&self) -> Result<Outcome> {
        let examples = self.crowd.make()?;
        ensure!(
            examples.len() > HELD_OUT,
            "a face space takes more than {HELD_OUT} heads"
        );
        let skins: Vec<Vec<f64>> = examples.iter().map(|e| e.skin.clone()).collect();
        let (held, kept): (Vec<_>, Vec<_>) = (0..)
            .zip(skins.iter().cloned())
            .partition(|(i, _)| i % HELD_OUT == 0);
        let [held, kept] = [held, kept].map(without_index);
        let errors = FaceSpace::learn(&kept)?.errors_by_modes(&held)?;
        let modes = enough(&errors, self.explains);
        // What is shipped is learned from all.
        let shape = FaceSpace::learn(&skins)?.truncated(modes);
        let model = model(shape, &examples)?;
        let bytes = model.to_bytes()?;
        replace(&self.output, &bytes)?;
        let mut out = terminal::out();
        writeln!(out, "modes\trms_mm of faces held out")?;
        for (count, error) in errors.iter().enumerate() {
            if count <= 10 || count % 10 == 0 || count == modes {
                // Of a vertex, not of one of its three numbers.
                writeln!(out, "{count}\t{:.3}", 1e3 * error * 3.0_f64.sqrt())?;
            }
        }
        writeln!(
            out,
            "{}: {} faces, {modes} modes of {} vertices, {} attributes, {} bytes",
            self.output.display(),
            examples.len(),
            model.shape.length() / 3,
            model.attributes.len(),
            bytes.len()
        )?;
        Ok(Outcome::Fine)
    }
}

fn without_index(faces: Vec<(usize, Vec<f64>)>) -> Vec<Vec<f64>> {
    faces.into_iter().map(|(_, face)| face).collect()
}

/// The least number of modes that explains a share of the variance.
fn enough(errors: &[f64], explains: f64) -> usize {
    let all = errors[0] * errors[0];
    let is_enough = |error: &f64| error * error <= (1.0 - explains) * all;
    errors
        .iter()
        .position(is_enough)
        .unwrap_or(errors.len() - 1)
}

fn model(shape: FaceSpace, examples: &[Example]) -> Result<FaceModel> {
    let own = examples
        .iter()
        .map(|e| shape.coefficients(&e.skin))
        .collect::<Result<Vec<_>, _>>()?;
    let cages: Vec<Vec<f64>> = examples.iter().map(|e| e.bound.numbers()).collect();
    let named = |label: &Label| {
        let labels = label
            .of_all(examples)
            .with_context(|| format!("no head has a {}", label.name))?;
        Ok(NamedAttribute {
            group: label.group.to_owned(),
            terms: label.terms.map(str::to_owned),
            attribute: Attribute::learn(label.name, &shape, &own, &labels)?,
        })
    };
    let first = examples.first().context("a head")?;
    let segment = |of: &HeadSegment| Segment {
        name: of.name.to_owned(),
        parent: of.parent.map(|p| p as u32),
        runs: of.runs.clone(),
    };
    let segments = first.segments.iter().map(segment).collect();
    Ok(FaceModel {
        triangles: first.triangles.clone(),
        segments: Segments::new(segments, shape.length() / 3)
            .context("segments of another head")?,
        cage: Follower::learn(&shape, &own, &cages),
        attributes: LABELS.iter().map(named).collect::<Result<_>>()?,
        examples: own,
        shape,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn as_many_modes_are_kept_as_explain_the_share() {
        let errors = [10.0, 5.0, 2.0, 1.0, 0.9];
        assert_eq!(
            [0.0, 0.5, 0.95, 0.99, 0.999].map(|s| enough(&errors, s)),
            [0, 1, 2, 3, 4]
        );
    }
}
