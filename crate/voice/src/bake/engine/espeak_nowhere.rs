//! Placeholder for espeak-ng's library where none can be loaded.

use anyhow::Result;

use super::super::program::MissingPrograms;
use super::espeak::{Host, Synthesis};

/// Host for builds without the espeak-ng library: every call fails.
pub(super) struct Installed;

impl Host for Installed {
    fn version(&self) -> Result<String> {
        Err(missing())
    }

    fn files(&self, _folder: &str) -> Result<Vec<String>> {
        Err(missing())
    }

    fn text(&self, _path: &str) -> Result<String> {
        Err(missing())
    }

    fn speak(&self, _voice: &str, _texts: &[String]) -> Result<Vec<Synthesis>> {
        Err(missing())
    }
}

fn missing() -> anyhow::Error {
    MissingPrograms::one("espeak-ng", "libespeak-ng1").into()
}
