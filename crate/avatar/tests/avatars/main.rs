//! The importer of other people's avatars.

mod animated;
mod hostile;
mod made;
mod packed;
mod performs;
