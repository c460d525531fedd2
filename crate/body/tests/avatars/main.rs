//! The importer of other people's avatars.
#![cfg(feature = "import")]

mod animated;
mod hostile;
mod made;
mod performs;
