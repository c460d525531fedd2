//! Renderings of the shipped figures: near, and at each level of detail.

#![allow(clippy::expect_used, reason = "tests fail by panicking")]

mod close;
#[path = "../device/mod.rs"]
mod device;
mod figures;
mod levels;
