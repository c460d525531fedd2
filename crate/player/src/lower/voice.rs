//! Times of each word and phone of a script.

use std::sync::Arc;

use raconteur_actor::Library;
use raconteur_eml::{
    ClauseId, ClauseKind, Document, Durations, EstimatedDurations, PhoneTime, VoiceText,
    VoiceTiming, WordTime,
};
use raconteur_speech::{Bundle, Utterance};
use raconteur_spoken::spoken_clauses;

/// Mapping from the clauses of a document to the utterances of a speech bundle.
#[derive(Clone, Debug, Default)]
pub(crate) struct Voices {
    /// Baked utterances, by clause.
    found: Vec<(ClauseId, usize)>,
    /// The voices that the script names, by clause.
    named: Vec<(ClauseId, String)>,
}

impl Voices {
    /// Finds the baked speech of a document.
    pub(crate) fn find(document: &Document, bundle: Option<&Bundle>) -> Self {
        let (mut found, mut named) = (Vec::new(), Vec::new());
        for spoken in spoken_clauses(document) {
            if let Some(voice) = spoken.voice {
                named.push((spoken.id, voice.to_owned()));
            }
            let Some(bundle) = bundle else { continue };
            let index = bundle.find(spoken.key());
            // The words of a text are those of its utterance, or marks would be amiss.
            let fits = |index: &usize| match spoken.kind {
                ClauseKind::VoiceText(text) => {
                    bundle.utterances[*index].words.len() == text.words().len()
                }
                _ => true,
            };
            if let Some(index) = index.filter(fits) {
                found.push((spoken.id, index));
            }
        }
        Self { found, named }
    }

    /// Returns the voice that the script names for a clause; `None` if it names none.
    pub(crate) fn named(&self, clause: ClauseId) -> Option<&str> {
        let place = self.named.partition_point(|(id, _)| *id < clause);
        let (_, voice) = self.named.get(place).filter(|(id, _)| *id == clause)?;
        Some(voice)
    }

    /// Returns the utterance of a clause in a bundle; `None` if it has none.
    pub(crate) fn match_clauses<'b>(
        &self,
        clause: ClauseId,
        bundle: Option<&'b Bundle>,
    ) -> Option<&'b Arc<Utterance>> {
        let place = self.found.partition_point(|(id, _)| *id < clause);
        let (_, index) = self.found.get(place).filter(|(id, _)| *id == clause)?;
        bundle?.utterances.get(*index)
    }
}

/// Durations for the timeline: of speech from a bundle, or estimated where it has none, and of
/// animations from a library.
pub(crate) struct KnownDurations<'a> {
    pub(crate) bundle: Option<&'a Bundle>,
    pub(crate) voices: &'a Voices,
    pub(crate) library: &'a Library,
}

impl Durations for KnownDurations<'_> {
    fn animation(&self, name: &str) -> Option<f64> {
        let body = self.library.get(name).map(|clip| clip.duration_secs());
        let face = || self.library.parameters(name).map(|c| c.duration_secs());
        body.or_else(face)
    }

    fn voice(&self, clause: ClauseId, text: &VoiceText) -> VoiceTiming {
        let Some(utterance) = self.voices.match_clauses(clause, self.bundle) else {
            return EstimatedDurations.voice(clause, text);
        };
        VoiceTiming {
            duration_secs: utterance.duration_secs,
            words: utterance
                .words
                .iter()
                .map(|w| WordTime {
                    start_secs: w.start_secs,
                    end_secs: w.end_secs,
                })
                .collect(),
            phones: utterance
                .phones
                .iter()
                .filter_map(|p| {
                    Some(PhoneTime {
                        symbol: p.symbol.clone(),
                        start_secs: p.start_secs,
                        end_secs: p.end_secs,
                        word: p.word?,
                    })
                })
                .collect(),
            estimated: false,
        }
    }
}
