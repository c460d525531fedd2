//! Faces of a model on shipped figures.

use anyhow::{Context as _, Result};
use raconteur_body::Figure;
use raconteur_body::read::read_figure;
use raconteur_faces::{Editor, Face, FaceModel};
use raconteur_reshape::{Hair, HairDonor, HairDonors, Look, NewFace, NewOrgans, Reshaper};

use crate::assets;

/// Bundled figure on which faces of a model are put, with donors of hair and beards.
pub(super) struct PutOn {
    reshaper: Reshaper,
    name: String,
    lenders: HairDonors,
}

impl PutOn {
    pub(super) fn new(figure: Figure, model: &FaceModel) -> Result<Self> {
        let name = figure.name.clone();
        Ok(Self {
            reshaper: Reshaper::new(figure, model.vertices())?,
            name,
            lenders: HairDonors::new(),
        })
    }

    /// Loads hair of the library by name, so that the figure can wear it.
    pub(super) fn load_hair(&mut self, model: &FaceModel, name: &str) -> Result<()> {
        let glb = assets::read(&format!("hair/{name}.glb"))?;
        let lender = HairDonor::new(&read_figure(name, &glb)?, model.vertices())?;
        self.lenders.insert(name.to_owned(), lender);
        Ok(())
    }

    /// Returns the figure with a face and its own hair.
    pub(super) fn figure(&self, editor: &Editor, face: &Face) -> Result<Figure> {
        self.with_hair(editor, face, &Look::default())
    }

    /// Returns the figure with a face and loaded hair and beard; an empty name keeps its own.
    pub(super) fn dressed(
        &self,
        editor: &Editor,
        face: &Face,
        [hair, beard]: [&str; 2],
    ) -> Result<Figure> {
        let from = |name: &str| Hair {
            from: name.to_owned(),
            colour: None,
        };
        let look = Look {
            hair: from(hair),
            beard: from(beard),
            ..Look::default()
        };
        self.with_hair(editor, face, &look)
    }

    fn with_hair(&self, editor: &Editor, face: &Face, look: &Look) -> Result<Figure> {
        let organs = NewOrgans::from_numbers(&face.organs);
        let organs = organs.context("the pack knows no eyes")?;
        let textures = editor.model().texture.as_ref();
        let factors = textures.and_then(|t| t.factors(&face.texture, &self.name));
        let face = NewFace {
            skin: &editor.drawn(face),
            tone: factors.as_ref().map_or(&[], |f| &f.skin),
            organs,
            iris: factors.as_ref().map_or([1.0; 3], |f| f.iris),
            brows: factors.as_ref().map_or([1.0; 3], |f| f.brows),
        };
        Ok(self.reshaper.with_look(&face, look, &self.lenders)?)
    }
}
