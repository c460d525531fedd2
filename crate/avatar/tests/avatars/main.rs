//! Tests of the avatar importer.

mod animated;
mod dressed;
mod hostile;
mod made;
mod named;
mod packed;
mod performs;
