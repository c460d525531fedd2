//! `raconteur faces make`.

use std::path::PathBuf;

use anyhow::{Context as _, Result, ensure};
use clap::Args;
use raconteur_body::annotation::{Annotations, annotations};
use raconteur_body::read::read_figure;
use raconteur_body::{Figure, write};
use raconteur_faces::{Editor, Face, FaceModel, Part};
use raconteur_sculpt::head::{HeadParams, ModelHeadShape};
use raconteur_sculpt::looks::{self, Look};
use raconteur_sculpt::{FigureParams, build, build_face, people};
use raconteur_voice::files::disk::replace;

use super::edits::Edits;
use super::{pack, put_on};
use crate::{Outcome, assets};

/// Make a figure with a face: the average one, one of the database or a random one, changed by
/// edits. The face is put on a bundled figure, or a new figure is built.
#[derive(Args)]
pub(super) struct Make {
    /// A pack that `faces learn` wrote.
    pack: PathBuf,
    /// The figure.
    #[arg(short, long)]
    output: PathBuf,
    #[command(flatten)]
    edits: Edits,
    /// Figure that provides skin, hair and clothes.
    #[arg(long, default_value = "sofia")]
    like: String,
    /// Build the whole figure from parameters, with its own hair, brows and maps, in about 20 s.
    /// The face is the nearest one in the spaces.
    #[arg(long)]
    build: bool,
    /// Build only the head, without hair, hands and clothes.
    #[arg(long)]
    bare: bool,
}

impl Make {
    pub(super) fn run(&self) -> Result<Outcome> {
        let editor = Editor::new(pack::read(&self.pack)?)?;
        let face = self.edits.face(&editor)?;
        let (figure, annotations) = if self.build || self.bare {
            self.built(&editor, &face)?
        } else {
            let bytes = assets::read(&format!("figures/{}.glb", self.like))?;
            let figure = read_figure(&self.like, &bytes)?;
            let annotations = annotations(&bytes)?;
            let on = put_on::PutOn::new(figure, editor.model())?;
            (on.figure(&editor, &face)?, annotations)
        };
        replace(&self.output, &write::to_packed_glb(&figure, &annotations))?;
        Ok(Outcome::Fine)
    }

    fn built(&self, editor: &Editor, face: &Face) -> Result<(Figure, Annotations)> {
        let params = built_params(editor, face, &self.like)?;
        let built = if self.bare {
            build_face(&params)
        } else {
            build(&params)
        };
        Ok((built.figure, built.annotations))
    }
}

/// Returns the parameters for building a figure with a face.
pub(super) fn built_params(editor: &Editor, face: &Face, like: &str) -> Result<FigureParams> {
    let model: &FaceModel = editor.model();
    let own = editor.coefficients(face, Part::Shape)?;
    let bound = ModelHeadShape::from_numbers(&model.cage.evaluate(&own))
        .context("the pack is of another head")?;
    let like = people::preset(like).with_context(|| format!("no figure {like}"))?;
    let params = FigureParams {
        head: HeadParams {
            bound,
            // The face has its own asymmetry.
            asymmetry: 1.0,
            ..like.head
        },
        ..like
    };
    let Some(texture) = &model.texture else {
        return Ok(params);
    };
    let numbers = texture.look_values(&face.texture);
    ensure!(
        numbers.len() >= looks::COUNT,
        "the pack is of other textures"
    );
    let look: Look = std::array::from_fn(|i| numbers[i]);
    Ok(looks::dress(params, &look))
}
