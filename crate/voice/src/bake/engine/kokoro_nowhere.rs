//! Placeholder for Kokoro on a machine without it: a page has its own.

use anyhow::Result;

use super::super::program::MissingPrograms;
use super::kokoro::{Host, Output};

/// Host for builds without the Kokoro network: every call fails.
#[derive(Default)]
pub(super) struct Installed;

impl Host for Installed {
    fn voices(&self) -> Result<Vec<String>> {
        Err(missing())
    }

    fn word(&self, _word: &str) -> Result<Option<(String, Option<String>)>> {
        Err(missing())
    }

    fn ipa(&self, _language: &str, _text: &str) -> Result<String> {
        Err(missing())
    }

    fn guess(&self, _word: &str) -> Result<String> {
        Err(missing())
    }

    fn infer(&self, _voice: &str, _letters: &str, _pace: f64) -> Result<Output> {
        Err(missing())
    }
}

fn missing() -> anyhow::Error {
    MissingPrograms::without_package("Kokoro does not run here".to_owned()).into()
}
