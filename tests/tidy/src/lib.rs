//! Rules of the workspace that the compiler does not know, checked by `cargo test`:
//! which crate may use which, that no files and no folders of a crate need each other, where
//! platform crates may appear, how long files grow, how long the gate may take,
//! and that nothing of a maker's machine is left in the tree.

#[cfg(test)]
mod budget;
#[cfg(test)]
mod cycles;
#[cfg(test)]
mod edges;
#[cfg(test)]
mod files;
#[cfg(test)]
mod folders;
#[cfg(test)]
mod modules;
#[cfg(test)]
mod words;
