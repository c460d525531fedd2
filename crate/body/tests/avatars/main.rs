//! The importer of other people's avatars.
#![cfg(feature = "import")]

mod hostile;
mod made;
mod performs;
