//! Figure with a face of a face model, as a file for any story.

use raconteur_body::annotation::annotations;
use raconteur_body::figure::Image;
use raconteur_body::read::{ReadError, read_figure};
use raconteur_body::write::to_packed_glb;
use raconteur_reshape::{HairDonor, HairDonors, Look, NewFace, ReshapeError, Reshaper};

/// Contents of a figure file to create: base figure, face, hair and accessories, and skin texture.
#[derive(Debug)]
pub struct FaceFile<'a> {
    /// The name of the new figure.
    pub name: &'a str,
    /// The figure that gets the face.
    pub glb: &'a [u8],
    /// New face to put on the figure.
    pub face: NewFace<'a>,
    /// Hair and accessories of the figure.
    pub look: &'a Look,
    /// Files of the figures that lend hair, by name.
    pub lenders: Vec<(String, Vec<u8>)>,
    /// Skin texture, if it was painted.
    pub skin: Option<Image>,
}

/// Error returned when a figure file cannot be created from a face model.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum FileError {
    /// A figure cannot be read.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// The figure cannot have the face.
    #[error(transparent)]
    Reshape(#[from] ReshapeError),
}

/// Creates a figure file (GLB) with a face of a face model, usable by any story.
///
/// # Errors
/// Returns an error if a figure cannot be read or cannot have the face.
pub fn face_file(parts: FaceFile<'_>) -> Result<Vec<u8>, FileError> {
    let vertices = parts.face.skin.len() / 3;
    // The meshes stay in place, so names on them stay valid.
    let names = annotations(parts.glb)?;
    let reshaper = Reshaper::new(read_figure(parts.name, parts.glb)?, vertices)?;
    let mut lenders = HairDonors::new();
    for (name, glb) in parts.lenders {
        let lender = HairDonor::new(&read_figure(&name, &glb)?, vertices)?;
        lenders.insert(name, lender);
    }
    let mut figure = reshaper.with_look(&parts.face, parts.look, &lenders)?;
    if let (Some(image), Some(at)) = (parts.skin, reshaper.skin_picture())
        && let Some(own) = figure.images.get_mut(at)
    {
        *own = image;
    }
    Ok(to_packed_glb(&figure, &names))
}
