//! A device that draws without a window.

use raconteur_render::{Headless, Quality, RenderOptions};

/// A device of a quality; says which packages are missing where there is none.
pub(crate) fn headless(quality: Quality) -> Headless {
    Headless::new_blocking(RenderOptions { quality }).unwrap_or_else(|e| {
        panic!("{e}; on Debian: apt-get install mesa-vulkan-drivers libvulkan1")
    })
}
