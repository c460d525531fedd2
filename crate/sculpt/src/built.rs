//! Figure as built.

use raconteur_body::annotation::Annotations;
use raconteur_body::figure::Figure;

/// A figure with data on its surface.
#[derive(Clone, Debug)]
pub struct AnnotatedFigure {
    /// The figure itself.
    pub figure: Figure,
    /// Names on its meshes.
    pub annotations: Annotations,
}
