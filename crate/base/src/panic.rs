//! Storage of panic messages. A panic ends the instance by a trap without a message, so this module
//! stores the message for the page to query. Only the bindings use it: no other code has a global.

use std::panic::{PanicHookInfo, set_hook};
use std::sync::{Mutex, PoisonError};

/// The message of the last panic; empty before the first.
static MESSAGE: Mutex<String> = Mutex::new(String::new());

/// Stores the messages of panics from now on, instead of printing them to a console that may not
/// exist.
pub fn keep_messages() {
    set_hook(Box::new(store_message));
}

fn store_message(info: &PanicHookInfo<'_>) {
    let message = info.payload_as_str().unwrap_or("a panic without a message");
    let place = info.location().map_or_else(String::new, |at| {
        format!(" ({}:{}:{})", at.file(), at.line(), at.column())
    });
    *MESSAGE.lock().unwrap_or_else(PoisonError::into_inner) = format!("{message}{place}");
}

/// Returns the message of the last panic with its source location; `None` before the first.
#[must_use]
pub fn last_message() -> Option<String> {
    let message = MESSAGE.lock().unwrap_or_else(PoisonError::into_inner);
    (!message.is_empty()).then(|| message.clone())
}

#[cfg(test)]
mod tests {
    use std::panic::{catch_unwind, take_hook};

    use super::*;

    #[test]
    fn a_panic_is_told_with_its_message_and_its_place() {
        assert_eq!(last_message(), None);
        keep_messages();
        let line = line!() + 2;
        let list = Vec::<u8>::new();
        let reached = catch_unwind(|| list[std::hint::black_box(7)]);
        drop(take_hook());
        assert!(reached.is_err(), "the panic is caught");
        let expected = format!(
            "index out of bounds: the len is 0 but the index is 7 ({}:{line}:",
            file!()
        );
        let told = last_message().unwrap();
        assert!(told.starts_with(&expected), "{told}");
    }
}
