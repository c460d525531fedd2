//! The `raconteur` program.

use std::env;
use std::path::Path;
use std::process::ExitCode;

/// Disables Mesa's Vulkan device selection layer: it queries the Wayland session and, if there is
/// none, prints a warning on standard error, which is reserved for diagnostics. Nothing is shown on
/// a screen here, so the layer is not needed.
#[allow(
    unsafe_code,
    reason = "the program has no other thread yet that could read the environment"
)]
fn calm_device_layer() {
    const NO_LAYER: &str = "NODEVICE_SELECT";
    let session = env::var_os("XDG_RUNTIME_DIR").is_some_and(|folder| Path::new(&folder).is_dir());
    if !session && env::var_os(NO_LAYER).is_none() {
        // SAFETY: see above; this is the program's first statement.
        unsafe { env::set_var(NO_LAYER, "1") };
    }
}

fn main() -> ExitCode {
    calm_device_layer();
    raconteur_cli::run()
}
