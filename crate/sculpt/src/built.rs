//! A figure as it comes from the making of it.

use raconteur_body::annotation::Annotations;
use raconteur_body::figure::Figure;

/// A figure with what is known of its surface.
#[derive(Clone, Debug)]
pub struct Built {
    /// What is posed and drawn.
    pub figure: Figure,
    /// Names on its meshes.
    pub annotations: Annotations,
}
