//! Placeholder for an engine that this machine lacks: it plans and does not speak.

use crate::spoken::{Sentence, Spoken};
use anyhow::Result;

use super::super::program::MissingPrograms;
use super::{Engine, VoiceInfo};

/// Error returned when a speech engine is not installed.
pub struct MissingEngine {
    /// Programs that must be installed.
    pub missing: MissingPrograms,
    /// True if its voices are named by language.
    pub by_language: bool,
}

impl Engine for MissingEngine {
    fn version(&self) -> Result<String> {
        Ok("absent".to_owned())
    }

    fn voices(&self) -> Result<Vec<VoiceInfo>> {
        Ok(Vec::new())
    }

    fn voice(&self, name: &str) -> Result<Option<VoiceInfo>> {
        // As it is not known which voices there would be, all are. English is the most usual.
        let tag = name.split('+').next().unwrap_or_default();
        let language = if self.by_language { tag } else { "en-US" };
        Ok(Some(VoiceInfo {
            name: name.to_owned(),
            language: language.to_owned(),
            ..VoiceInfo::default()
        }))
    }

    fn speak(&self, _voice: &str, _sentences: &[Sentence]) -> Result<Vec<Spoken>> {
        Err(self.missing.clone().into())
    }
}
