//! Tests of `raconteur bake` as a program: stopped at any time, run twice simultaneously, without
//! its required programs, and with stories that try to read files outside their folder.
//!
//! The tests need neither a speech engine nor an encoder: the speech is recorded, and scripts
//! replace `opusenc` and `ffmpeg`.
#![cfg(unix)]

mod hostile;
mod interrupted;
mod missing;
mod outside;
mod workshop;
