//! Driver errors, caught so that the next frame reports them.

use std::sync::{Arc, Mutex, PoisonError};

#[cfg(all(target_arch = "wasm32", feature = "webgpu"))]
use wasm_bindgen::{JsCast, prelude::*};

/// Collector of the first error that the graphics device reports, until it is taken.
#[derive(Clone, Default)]
pub(crate) struct DeviceErrors(Arc<Mutex<Option<String>>>);

impl DeviceErrors {
    /// Listens to a device from now on.
    pub(crate) fn new(device: &wgpu::Device) -> Self {
        let refusal = Self::default();
        let heard = refusal.clone();
        #[cfg(all(target_arch = "wasm32", feature = "webgpu"))]
        if let Some(device) = device.as_webgpu() {
            // wgpu's own listener converts it to an error whose texts add Unicode's tables to the
            // page, and terminates the player at an internal error.
            let listener = Closure::new(move |event: Event| heard.note(|| event.error().message()));
            device
                .unchecked_ref::<Listened>()
                .set_onuncapturederror(&listener);
            // The device owns it for its lifetime.
            listener.forget();
            return refusal;
        }
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
            heard.note(|| error.to_string());
        }));
        refusal
    }

    fn note(&self, message: impl FnOnce() -> String) {
        let mut slot = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        slot.get_or_insert_with(message);
    }

    /// Takes the error, if any.
    pub(crate) fn take_first(&self) -> Option<String> {
        let mut slot = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        slot.take()
    }
}

#[cfg(all(target_arch = "wasm32", feature = "webgpu"))]
#[wasm_bindgen]
extern "C" {
    /// A `GPUDevice`.
    type Listened;

    #[wasm_bindgen(method, setter, structural)]
    fn set_onuncapturederror(this: &Listened, listener: &Closure<dyn FnMut(Event)>);

    /// A `GPUUncapturedErrorEvent`.
    type Event;

    #[wasm_bindgen(method, getter, structural)]
    fn error(this: &Event) -> Refused;

    /// A `GPUError`.
    type Refused;

    #[wasm_bindgen(method, getter, structural)]
    fn message(this: &Refused) -> String;
}
