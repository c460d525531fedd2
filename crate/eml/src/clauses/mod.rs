//! Content of clauses by topic.

pub(crate) mod asking;
pub(crate) mod environment;
pub(crate) mod functions;
pub(crate) mod geometry;
pub(crate) mod manipulators;
pub(crate) mod parameters;
pub(crate) mod players;
pub(crate) mod sets;
pub(crate) mod speech;
