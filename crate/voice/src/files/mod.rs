//! Files as a program on a machine has to treat them: written whole or not at all, read only
//! where a story may look, and only up to a size.

pub mod disk;
pub mod input;
pub mod inside;
pub mod media;
