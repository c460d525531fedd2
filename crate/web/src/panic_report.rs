//! The page's side of [`raconteur_player::base::panic`].

use wasm_bindgen::prelude::*;

/// Runs when an instance is made.
#[wasm_bindgen(start)]
pub fn start() {
    raconteur_player::base::panic::keep_messages();
}

/// What the panic said that ended this instance, and where in the source; none where it was
/// another trap.
#[wasm_bindgen(js_name = panicMessage)]
pub fn panic_message() -> Option<String> {
    raconteur_player::base::panic::last_message()
}
