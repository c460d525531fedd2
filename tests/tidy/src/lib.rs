//! Workspace rules that the compiler does not check, checked by `cargo test`: dependencies between
//! crates, no cycles of files or folders in a crate, locations of platform crates, length of files,
//! duration of the gate, and no traces of a developer's machine in the tree.

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
