//! Figure as built.

use raconteur_body::annotation::Annotations;
use raconteur_body::figure::Figure;

/// Generated figure with landmarks and segments on its surface.
#[derive(Clone, Debug)]
pub struct AnnotatedFigure {
    /// Generated figure.
    pub figure: Figure,
    /// Names on its meshes.
    pub annotations: Annotations,
}
