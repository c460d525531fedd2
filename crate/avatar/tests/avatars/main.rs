//! The importer of other people's avatars.

mod animated;
mod dressed;
mod hostile;
mod made;
mod named;
mod packed;
mod performs;
