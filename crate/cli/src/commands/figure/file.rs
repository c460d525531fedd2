//! Writing a file so that a failure leaves the old one whole.

use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, Result};

/// Writes beside the file and renames.
pub(super) fn replace(path: &Path, bytes: &[u8]) -> Result<()> {
    let mut name = OsString::from(path.as_os_str());
    name.push(".part");
    let part = PathBuf::from(name);
    fs::write(&part, bytes)
        .and_then(|()| fs::rename(&part, path))
        .inspect_err(|_| {
            // What was begun is of no use; that it cannot be removed changes nothing.
            let _ = fs::remove_file(&part);
        })
        .with_context(|| format!("cannot write {}", path.display()))
}
