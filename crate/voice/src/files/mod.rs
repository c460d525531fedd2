//! File access on a machine: files are written completely or not at all, read only where a story
//! may read, and only up to a size.

use std::path::Path;
use std::sync::OnceLock;

pub mod disk;
pub mod input;
pub mod inside;
pub mod media;

static LOG: OnceLock<fn(&Path)> = OnceLock::new();

/// Registers a callback for every file opened for reading; only the first registration counts.
pub fn on_open(log: fn(&Path)) {
    LOG.get_or_init(|| log);
}

/// Reports an opened file to the log, if one is installed.
pub(crate) fn opened(path: &Path) {
    if let Some(log) = LOG.get() {
        log(path);
    }
}
