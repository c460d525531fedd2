//! What a script says, by which voice and in which emotion, and when each word and phone of
//! it is heard.

mod key;

use std::sync::Arc;

use raconteur_actor::Library;
use raconteur_eml::{
    ClauseId, ClauseKind, Document, Durations, Emotion, EstimatedDurations, PhoneTime, VoiceText,
    VoiceTiming, WordTime,
};
use raconteur_speech::emotion::{EmotionPoint, place};
use raconteur_speech::{Bundle, Utterance};

/// The potential at which an emotion has the strength of F&H table 4.4.
pub(crate) const PLAIN_POTENTIAL: f64 = 5.0;

/// Where an emotion of a script lies; none for neutral. A dimension that is given takes the place
/// of that of the word.
pub(crate) fn place_of(emotion: &Emotion) -> Option<EmotionPoint> {
    let word = emotion.kind.and_then(|kind| place(kind.word()));
    let of_word = word.unwrap_or_default();
    let place = EmotionPoint {
        activation: emotion.activation.unwrap_or(of_word.activation),
        evaluation: emotion.evaluation.unwrap_or(of_word.evaluation),
        power: emotion.power.unwrap_or(of_word.power),
    };
    (!place.is_neutral()).then_some(place)
}

/// The word of an emotion that is there as the table has it; none where a dimension was given.
pub(crate) fn word_of(emotion: &Emotion) -> Option<&'static str> {
    let given = [emotion.activation, emotion.evaluation, emotion.power];
    let kind = emotion.kind?;
    given.iter().all(Option::is_none).then(|| kind.word())
}

/// A clause that says something, heard or made ready, and how: by the last `voice-change` and
/// the last emotion before it, as one reads the document.
#[derive(Clone, Copy, Debug)]
pub struct SpokenClause<'d> {
    /// Which clause of the document.
    pub id: ClauseId,
    /// What it is.
    pub kind: &'d ClauseKind,
    /// The voice, as the script names it; none: the story's own.
    pub voice: Option<&'d str>,
    /// The emotion, unless it is neutral.
    pub emotion: Option<&'d Emotion>,
}

impl SpokenClause<'_> {
    /// The key of its utterance in a bundle: a digest of the words, their markup, the voice and
    /// the emotion.
    #[must_use]
    pub fn key(&self) -> u64 {
        key::of(self)
    }

    /// The emotion that is elicited for it: its word, where the place is that of the word as the
    /// table has it, and its place, scaled by the potential.
    #[must_use]
    pub fn elicited(&self) -> Option<(Option<&'static str>, EmotionPoint)> {
        let emotion = self.emotion?;
        let place = place_of(emotion)?.scaled(emotion.intensity() / PLAIN_POTENTIAL);
        Some((word_of(emotion), place))
    }
}

/// What a document says, in document order.
#[must_use]
pub fn spoken_clauses(document: &Document) -> Vec<SpokenClause<'_>> {
    let mut clauses = Vec::new();
    let (mut voice, mut emotion) = (None, None);
    for (id, clause) in document.iter() {
        let kind = &clause.kind;
        match kind {
            ClauseKind::VoiceChange(change) => voice = Some(change.voice.as_str()),
            ClauseKind::Emotion(next) => {
                let felt = place_of(next).is_some() && next.intensity() > 0.0;
                emotion = felt.then_some(next);
            }
            ClauseKind::VoiceText(_) | ClauseKind::VoiceSay(_) => clauses.push(SpokenClause {
                id,
                kind,
                voice,
                emotion,
            }),
            _ => {}
        }
    }
    clauses
}

/// The utterances of a bundle that belong to the clauses of a document.
#[derive(Clone, Debug, Default)]
pub(crate) struct Voices {
    /// By clause; only what was baked.
    found: Vec<(ClauseId, usize)>,
    /// The voices that the script names, by clause.
    named: Vec<(ClauseId, String)>,
}

impl Voices {
    /// Finds what was baked for a document.
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

    /// The voice that the script names for a clause.
    pub(crate) fn named(&self, clause: ClauseId) -> Option<&str> {
        let place = self.named.partition_point(|(id, _)| *id < clause);
        let (_, voice) = self.named.get(place).filter(|(id, _)| *id == clause)?;
        Some(voice)
    }

    /// The utterance of a clause.
    pub(crate) fn of<'b>(
        &self,
        clause: ClauseId,
        bundle: Option<&'b Bundle>,
    ) -> Option<&'b Arc<Utterance>> {
        let place = self.found.partition_point(|(id, _)| *id < clause);
        let (_, index) = self.found.get(place).filter(|(id, _)| *id == clause)?;
        bundle?.utterances.get(*index)
    }
}

/// Answers the timeline from a speech bundle, by estimate where the bundle is silent, and
/// from a library of animations.
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
        let Some(utterance) = self.voices.of(clause, self.bundle) else {
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
