//! Accessories and hair of a head, in addition to its face.

use std::collections::BTreeMap;

use serde::Deserialize;

use super::accessory::{self, Accessory, Fit};
use super::donor::HairDonor;
use super::hairs::{self, Strands};
use super::{NewFace, ReshapeError, Reshaper, carry};
use raconteur_body::HairColour;
use raconteur_body::figure::{Figure, MaterialKind, Mesh};

/// Hair of a head: its source (own, none or a donor) and colour.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(default)]
pub struct Hair {
    /// `own` (same as an empty text), `none` (shaved), `bald` (never grew), or the name of a
    /// [`HairDonor`].
    pub from: String,
    /// Colour of the hair; `None` keeps the original one.
    pub colour: Option<HairColour>,
}

impl Hair {
    pub(super) fn is_own(&self) -> bool {
        matches!(self.from.as_str(), "" | "own")
    }

    fn is_untouched(&self) -> bool {
        self.is_own() && self.colour.is_none()
    }

    fn is_none(&self) -> bool {
        matches!(self.from.as_str(), "none" | "bald")
    }

    /// Returns the name of the hair donor; `None` if the hair is the figure's own or there is none.
    #[must_use]
    pub fn lender(&self) -> Option<&str> {
        (!self.is_own() && !self.is_none()).then_some(self.from.as_str())
    }
}

/// Look of a head in addition to its face: hair, beard, colours and accessories. The default leaves
/// the figure unchanged.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(default)]
pub struct Look {
    /// Hair on the scalp.
    pub hair: Hair,
    /// Beard on cheeks, chin and upper lip.
    pub beard: Hair,
    /// Colour of brows and lashes; that of the face without.
    pub brows: Option<HairColour>,
    /// Colour of the irises, linear red, green and blue, 0..1; that of the face without.
    pub iris: Option<[f64; 3]>,
    /// Lines of age: [`Tissue::lines`](raconteur_body::face::Tissue::lines).
    pub lines: Option<f32>,
    /// Accessories, at most one of each kind.
    pub wear: Vec<Accessory>,
}

/// Hair donors by name.
pub type HairDonors = BTreeMap<String, HairDonor>;

impl Reshaper {
    /// Returns the figure with a face and a look.
    ///
    /// # Errors
    /// Returns the same errors as [`Self::with_face`], and an error if no donor provides the
    /// requested hair.
    pub fn with_look(
        &self,
        face: &NewFace<'_>,
        look: &Look,
        lenders: &HairDonors,
    ) -> Result<Figure, ReshapeError> {
        let mut figure = self.with_face(face)?;
        self.change_hair(&mut figure, face, look, lenders)?;
        if let Some(colour) = &look.brows {
            for mesh in &mut figure.meshes {
                if mesh.material.kind == MaterialKind::Lash {
                    hairs::colour(mesh, colour.linear_rgb());
                }
            }
        }
        if let Some(iris) = look.iris {
            for mesh in &mut figure.meshes {
                if mesh.material.kind == MaterialKind::Eye {
                    carry::recolour(mesh, iris);
                }
            }
        }
        if let (Some(tissue), Some(lines)) = (&mut figure.tissue, look.lines) {
            tissue.lines = lines.clamp(0.0, 1.0);
        }
        if look.wear.is_empty() {
            return Ok(figure);
        }
        let fit = Fit::new(self, &figure, face);
        if let Some(cover) = look
            .wear
            .iter()
            .find_map(|w| accessory::cover(w.kind, &fit))
        {
            for mesh in &mut figure.meshes {
                if mesh.material.kind == MaterialKind::Hair {
                    cover.press(mesh, self.origin);
                }
            }
        }
        for worn in &look.wear {
            figure.meshes.extend(accessory::meshes(worn, &fit));
        }
        Ok(figure)
    }

    fn change_hair(
        &self,
        figure: &mut Figure,
        face: &NewFace<'_>,
        look: &Look,
        lenders: &HairDonors,
    ) -> Result<(), ReshapeError> {
        if look.hair.is_untouched() && look.beard.is_untouched() {
            return Ok(());
        }
        let is_hair = |kind: MaterialKind| kind == MaterialKind::Hair;
        let all = std::mem::take(&mut figure.meshes);
        let (own, rest): (Vec<Mesh>, Vec<Mesh>) =
            all.into_iter().partition(|m| is_hair(m.material.kind));
        figure.meshes = rest;
        let head = figure.meshes.iter().position(|m| m.name == "head");
        let head = head.unwrap_or_default();
        let places = [(&look.hair, Strands::Scalp), (&look.beard, Strands::Face)];
        for (wanted, strands) in places {
            let mut meshes = match wanted.lender() {
                _ if wanted.is_none() => Vec::new(),
                None => own.clone(),
                Some(name) => {
                    let lender = lenders.get(name);
                    let lender = lender.ok_or_else(|| ReshapeError::NoDonor(name.to_owned()))?;
                    lender.fit_hair(self, face)?
                }
            };
            for mesh in &mut meshes {
                if wanted.is_own() {
                    hairs::retain(mesh, strands, self.origin);
                }
                if strands == Strands::Face {
                    hairs::BEARD.clone_into(&mut mesh.name);
                }
                if let Some(colour) = &wanted.colour {
                    hairs::colour(mesh, colour.linear_rgb());
                }
            }
            meshes.retain(|m| !m.indices.is_empty());
            if strands == Strands::Face && wanted.lender().is_some() {
                let skin = &mut figure.meshes[head];
                meshes.iter().for_each(|beard| hairs::shade(skin, beard));
            }
            figure.meshes.extend(meshes);
        }
        if !look.hair.is_own() {
            self.unshade_scalp(&mut figure.meshes[head]);
        }
        Ok(())
    }
}
