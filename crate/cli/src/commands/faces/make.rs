//! `raconteur faces make`.

use std::path::PathBuf;

use anyhow::{Context as _, Result, bail};
use clap::Args;
use raconteur_base::noise;
use raconteur_body::write;
use raconteur_faces::{Constraints, FaceModel, MOST_BYTES};
use raconteur_sculpt::head::{Bound, HeadParams};
use raconteur_sculpt::{FigureParams, build, build_face, people};
use raconteur_voice::files::disk::replace;
use raconteur_voice::files::input;

use crate::Outcome;

/// Make a figure of a face: the average one, or one drawn at random, changed by attributes.
#[derive(Args)]
pub(super) struct Make {
    /// A pack that `faces learn` wrote.
    pack: PathBuf,
    /// The figure.
    #[arg(short, long)]
    output: PathBuf,
    /// Draw a face at random instead of the average one.
    #[arg(long)]
    seed: Option<u64>,
    /// An attribute and its value, −1 to 1: `--set "width of the mouth=-0.5"`. Each is held while the
    /// next one changes.
    #[arg(
        long = "set",
        value_name = "ATTRIBUTE=VALUE",
        allow_hyphen_values = true
    )]
    changes: Vec<String>,
    /// Whose skin, hair and clothes the figure has.
    #[arg(long, default_value = "sofia")]
    like: String,
    /// Only the head, without hair, hands and clothes, in a fraction of the time.
    #[arg(long)]
    bare: bool,
}

/// A random face is not farther from the average along a mode, standard deviations.
const MOST_DEVIATIONS: f64 = 2.5;

impl Make {
    pub(super) fn run(&self) -> Result<Outcome> {
        let bytes = input::bytes(&self.pack, MOST_BYTES as u64).context("the pack")?;
        let model = FaceModel::from_bytes(&bytes)?;
        let mut face = match self.seed {
            Some(seed) => random(&model, seed),
            None => vec![0.0; model.shape.dimensions()],
        };
        let mut held = Constraints::default();
        for change in &self.changes {
            let (name, value) = change
                .split_once('=')
                .context("--set takes ATTRIBUTE=VALUE")?;
            let value: f64 = value
                .parse()
                .with_context(|| format!("the value of {name}"))?;
            let Some(named) = model.attributes.iter().find(|a| a.attribute.name == name) else {
                let names: Vec<&str> = model
                    .attributes
                    .iter()
                    .map(|a| a.attribute.name.as_str())
                    .collect();
                bail!("no attribute {name}; there are {}", names.join(", "));
            };
            held.hold(&named.attribute, value);
        }
        held.apply(&model.shape, &mut face)?;
        let cage =
            Bound::from_numbers(&model.cage.at(&face)).context("the pack is of another head")?;
        let like =
            people::preset(&self.like).with_context(|| format!("no figure {}", self.like))?;
        let params = FigureParams {
            head: HeadParams {
                bound: cage,
                ..like.head
            },
            ..like
        };
        let built = if self.bare {
            build_face(&params)
        } else {
            build(&params)
        };
        replace(
            &self.output,
            &write::to_packed_glb(&built.figure, &built.annotations),
        )?;
        Ok(Outcome::Fine)
    }
}

/// A face as likely as those of the examples are.
fn random(model: &FaceModel, seed: u64) -> Vec<f64> {
    let deviations = model.shape.deviations().iter();
    (0..)
        .zip(deviations)
        .map(|(mode, deviation)| {
            // The sum of twelve: a bell of deviation 1.
            let bell: f64 = (0..12).map(|k| noise::unit(seed, mode, k)).sum::<f64>() - 6.0;
            deviation * bell.clamp(-MOST_DEVIATIONS, MOST_DEVIATIONS)
        })
        .collect()
}
