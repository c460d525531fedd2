//! Panic message for the page.

use wasm_bindgen::prelude::*;

/// Stores messages of panics from the start of the instance.
#[wasm_bindgen(start)]
pub fn start() {
    raconteur_player::base::panic::keep_messages();
}

/// Returns the message and source location of the panic that ended this instance; `None` for
/// another trap.
#[wasm_bindgen(js_name = panicMessage)]
pub fn panic_message() -> Option<String> {
    raconteur_player::base::panic::last_message()
}
