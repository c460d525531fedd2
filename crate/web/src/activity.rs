//! Activity of an instance. A trap leaves no stack to unwind; the page reads the unfinished
//! activity of the instance here.

use std::sync::atomic::{AtomicU32, Ordering};

use raconteur_player::LoadStage;
use wasm_bindgen::prelude::*;

/// Current activity of a module instance, for reports of a trap; the numbers are `Doing` in
/// `web/element/engine/trap.ts`.
#[derive(Clone, Copy)]
#[repr(u32)]
pub(crate) enum Activity {
    /// No activity.
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
    /// Admission of a fragment during playback.
    Fragment = 6,
    /// Computation of a pose.
    Pose = 7,
    /// Rendering of an image.
    Drawing = 8,
}

impl From<LoadStage> for Activity {
    fn from(stage: LoadStage) -> Self {
        match stage {
            LoadStage::Story => Self::Story,
            LoadStage::Speech => Self::Speech,
            LoadStage::Performance => Self::Performance,
        }
    }
}

static ACTIVITY: AtomicU32 = AtomicU32::new(Activity::Nothing as u32);

/// Guard that records an activity until it is dropped; a trap never drops it.
pub(crate) struct ActivityGuard;

impl ActivityGuard {
    pub(crate) fn new(activity: Activity) -> Self {
        note(activity);
        Self
    }
}

impl Drop for ActivityGuard {
    fn drop(&mut self) {
        note(Activity::Nothing);
    }
}

/// Notes another activity, within the life of a [`ActivityGuard`].
pub(crate) fn note(activity: Activity) {
    ACTIVITY.store(activity as u32, Ordering::Relaxed);
}

/// Returns the activity during which the instance trapped; 0 while nothing runs.
#[wasm_bindgen]
pub fn doing() -> u32 {
    ACTIVITY.load(Ordering::Relaxed)
}
