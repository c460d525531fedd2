//! Stands for espeak-ng's library where none can be loaded.

use std::path::PathBuf;

use anyhow::Result;

use super::super::program::Missing;
use super::espeak_events::Synthesis;

/// # Errors
/// Always: it is not here.
pub(super) fn about() -> Result<(String, PathBuf)> {
    Err(Missing::one("espeak-ng", "libespeak-ng1").into())
}

/// # Errors
/// Always: it is not here.
pub(super) fn say(_voice: &str, _texts: &[String]) -> Result<Vec<Synthesis>> {
    Err(Missing::one("espeak-ng", "libespeak-ng1").into())
}
