//! What an instance is at. A trap leaves no stack to unwind; the page asks here what the instance had
//! begun and not finished.

use std::sync::atomic::{AtomicU32, Ordering};

use raconteur_player::Reading;
use wasm_bindgen::prelude::*;

/// What an instance can be at; the numbers are `Doing` in `web/element/trap.ts`.
#[derive(Clone, Copy)]
#[repr(u32)]
pub(crate) enum Doing {
    /// Nothing that was noted.
    Nothing = 0,
    /// The figure is read or sent to the graphics device.
    Figure = 1,
    /// The text of the story.
    Story = 2,
    /// The speech bundle.
    Speech = 3,
    /// The performance is planned.
    Performance = 4,
    /// Animations are read.
    Animation = 5,
    /// A fragment that comes while the story plays.
    Fragment = 6,
    /// The pose of a moment is computed.
    Pose = 7,
    /// A picture is drawn.
    Drawing = 8,
}

impl From<Reading> for Doing {
    fn from(reading: Reading) -> Self {
        match reading {
            Reading::Story => Self::Story,
            Reading::Speech => Self::Speech,
            Reading::Performance => Self::Performance,
        }
    }
}

static DOING: AtomicU32 = AtomicU32::new(Doing::Nothing as u32);

/// Notes what the instance is at until this is dropped, which a trap never does.
pub(crate) struct Noted;

impl Noted {
    pub(crate) fn new(doing: Doing) -> Self {
        note(doing);
        Self
    }
}

impl Drop for Noted {
    fn drop(&mut self) {
        note(Doing::Nothing);
    }
}

/// Notes what the instance is at from now on, within the life of a [`Noted`].
pub(crate) fn note(doing: Doing) {
    DOING.store(doing as u32, Ordering::Relaxed);
}

/// What the instance was at when it trapped; 0 while nothing runs.
#[wasm_bindgen]
pub fn doing() -> u32 {
    DOING.load(Ordering::Relaxed)
}
