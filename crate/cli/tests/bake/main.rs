//! `raconteur bake` as a program: stopped at any moment, run twice at once, without the programs
//! that it needs, and with stories that want to read what is not theirs.
//!
//! No speech engine and no encoder is needed: people have recorded what is said, and scripts
//! stand for `opusenc` and `ffmpeg`.
#![cfg(unix)]

mod hostile;
mod interrupted;
mod missing;
mod workshop;
