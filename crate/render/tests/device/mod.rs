//! Device without a window.

use raconteur_render::{Headless, Quality, RenderOptions};

/// Opens a device of a quality; if there is none, reports the missing packages.
pub(crate) fn headless(quality: Quality) -> Headless {
    Headless::new_blocking(RenderOptions { quality }).unwrap_or_else(|e| {
        panic!("{e}; on Debian: apt-get install mesa-vulkan-drivers libvulkan1")
    })
}
