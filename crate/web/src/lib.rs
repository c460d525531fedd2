//! Browser bindings of a storyteller: one opaque class, plain objects in and out.
//!
//! Scope: reading a story, rendering any time of it to a canvas, delivering the passed cues, and
//! digesting poses for comparison with the native program.
//! Out of scope: fetching, audio playback and timekeeping, which `web/element` provides. Nothing is
//! called back into JavaScript, and an error is a value or an exception, never a trap.
//!
//! A page makes one wasm instance for each player, so a trap would end only that player; the
//! instance still returns the message of its panic.

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

pub mod lesson;
pub mod message;

#[cfg(target_arch = "wasm32")]
mod panic_report;
#[cfg(target_arch = "wasm32")]
pub use panic_report::{panic_message, start};

#[cfg(target_arch = "wasm32")]
mod activity;
#[cfg(target_arch = "wasm32")]
mod cast;
#[cfg(target_arch = "wasm32")]
mod clips;
#[cfg(target_arch = "wasm32")]
mod curves;
#[cfg(target_arch = "wasm32")]
mod decode;
#[cfg(target_arch = "wasm32")]
mod edit;
#[cfg(target_arch = "wasm32")]
mod face;
#[cfg(target_arch = "wasm32")]
mod measure;
#[cfg(target_arch = "wasm32")]
mod narration;
#[cfg(target_arch = "wasm32")]
mod palm;
#[cfg(target_arch = "wasm32")]
mod player;
#[cfg(target_arch = "wasm32")]
mod reading;
#[cfg(target_arch = "wasm32")]
pub use activity::doing;
#[cfg(target_arch = "wasm32")]
pub use cast::performer;
#[cfg(target_arch = "wasm32")]
pub use decode::decode_script;
#[cfg(target_arch = "wasm32")]
pub use narration::{continue_narration, narrate, split_clauses};
#[cfg(target_arch = "wasm32")]
pub use palm::{hand_directions, palm_of};
#[cfg(target_arch = "wasm32")]
pub use player::Player;
#[cfg(target_arch = "wasm32")]
pub use reading::pose_digests;
