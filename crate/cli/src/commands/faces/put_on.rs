//! Faces of a model on shipped figures.

use anyhow::{Context as _, Result};
use raconteur_body::Figure;
use raconteur_body::reshape::{NewFace, NewOrgans, Reshaper};
use raconteur_faces::{Face, FaceModel};

/// A figure that takes faces.
pub(super) struct PutOn {
    reshaper: Reshaper,
    name: String,
}

impl PutOn {
    pub(super) fn new(figure: Figure, model: &FaceModel) -> Result<Self> {
        let name = figure.name.clone();
        Ok(Self {
            reshaper: Reshaper::new(figure, model.vertices())?,
            name,
        })
    }

    /// The figure with a face.
    pub(super) fn figure(&self, model: &FaceModel, face: &Face) -> Result<Figure> {
        let organs = NewOrgans::from_numbers(&face.organs);
        let organs = organs.context("the pack knows no eyes")?;
        let textures = model.texture.as_ref();
        let factors = textures.and_then(|t| t.factors(&face.texture, &self.name));
        Ok(self.reshaper.with_face(&NewFace {
            skin: &face.shape,
            tone: factors.as_ref().map_or(&[], |f| &f.skin),
            organs,
            iris: factors.as_ref().map_or([1.0; 3], |f| f.iris),
            brows: factors.as_ref().map_or([1.0; 3], |f| f.brows),
        })?)
    }
}
