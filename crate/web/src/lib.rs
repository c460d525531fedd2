//! The browser's door to a storyteller: one opaque class, plain objects in and out.
//!
//! Does: read a story, show any moment of it on a canvas, tell the cues passed on the way,
//! and digest poses for comparison with the native program.
//! Does not: fetch, play sound or keep time; `web/element` does. Nothing is called back
//! into JavaScript, and an error is a value or an exception, never a trap.
//!
//! A page makes one wasm instance for each player, so a trap would end that player alone.
//! With the feature `avatar` it is another, smaller door: it turns other people's avatars
//! into figures and plays nothing.

#![deny(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::indexing_slicing
)]
#![cfg_attr(
    test,
    allow(
        clippy::unwrap_used,
        clippy::indexing_slicing,
        reason = "a test may stop at what is not there"
    )
)]

pub mod message;

/// The standard library's own allocator takes two kilobytes more to download.
#[cfg(target_arch = "wasm32")]
#[global_allocator]
static ALLOCATOR: talc::wasm::WasmDynamicTalc = talc::wasm::new_wasm_dynamic_allocator();

#[cfg(all(target_arch = "wasm32", feature = "avatar"))]
mod avatar;
#[cfg(all(target_arch = "wasm32", feature = "avatar"))]
pub use avatar::{convert, convert_animation};
#[cfg(all(target_arch = "wasm32", not(feature = "avatar")))]
mod cast;
#[cfg(all(target_arch = "wasm32", not(feature = "avatar")))]
mod clips;
#[cfg(all(target_arch = "wasm32", not(feature = "avatar")))]
mod curves;
#[cfg(all(target_arch = "wasm32", not(feature = "avatar")))]
mod doing;
#[cfg(all(target_arch = "wasm32", not(feature = "avatar")))]
mod drawn;
#[cfg(all(target_arch = "wasm32", not(feature = "avatar")))]
mod edit;
#[cfg(all(target_arch = "wasm32", not(feature = "avatar")))]
mod measure;
#[cfg(all(target_arch = "wasm32", not(feature = "avatar")))]
mod more;
#[cfg(all(target_arch = "wasm32", not(feature = "avatar")))]
mod player;
#[cfg(all(target_arch = "wasm32", not(feature = "avatar")))]
pub use cast::performer;
#[cfg(all(target_arch = "wasm32", not(feature = "avatar")))]
pub use doing::doing;
#[cfg(all(target_arch = "wasm32", not(feature = "avatar")))]
pub use player::{Player, face_joined, more_joined, pose_digests};
