//! `raconteur bake` as a program: stopped at any moment, run twice at once, without the programs
//! that it needs, and with stories that try to read files outside their folder.
//!
//! No speech engine and no encoder is needed: the speech is recorded, and scripts
//! stand for `opusenc` and `ffmpeg`.
#![cfg(unix)]

mod hostile;
mod interrupted;
mod missing;
mod outside;
mod workshop;
