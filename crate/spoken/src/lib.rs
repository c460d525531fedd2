//! Speech content of a script: its spoken clauses in document order, with their voices and
//! emotions, and the keys of their utterances in a speech bundle.
//!
//! Bakers and the player use the same key for a clause. The crate is separate from both, so that a
//! change of motion does not recompile the voices.

#![cfg_attr(
    test,
    allow(
        clippy::unwrap_used,
        clippy::expect_used,
        reason = "tests fail by panicking"
    )
)]

mod key;

use raconteur_eml::{ClauseId, ClauseKind, Document, Emotion};
use raconteur_speech::emotion::{EmotionPoint, place};

/// The potential at which an emotion has the strength of F&H table 4.4.
pub const PLAIN_POTENTIAL: f64 = 5.0;

/// Returns the place of a scripted emotion in the emotion space; `None` for neutral. Given
/// dimensions replace those of the word.
#[must_use]
pub fn place_of(emotion: &Emotion) -> Option<EmotionPoint> {
    let word = emotion.kind.and_then(|kind| place(kind.word()));
    let of_word = word.unwrap_or_default();
    let place = EmotionPoint {
        activation: emotion.activation.unwrap_or(of_word.activation),
        evaluation: emotion.evaluation.unwrap_or(of_word.evaluation),
        power: emotion.power.unwrap_or(of_word.power),
    };
    (!place.is_neutral()).then_some(place)
}

/// Returns the word of an emotion with the place of the table; `None` if a dimension was given.
#[must_use]
pub fn word_of(emotion: &Emotion) -> Option<&'static str> {
    let given = [emotion.activation, emotion.evaluation, emotion.power];
    let kind = emotion.kind?;
    given.iter().all(Option::is_none).then(|| kind.word())
}

/// Clause with speech to synthesise, and its speech state: voice, emotion and beat in force at the
/// clause, from the elements before it in document order.
///
/// # Examples
///
/// ```
/// use raconteur_spoken::spoken_clauses;
///
/// let script = "<eml><body><voice-text time='0'>Hello!</voice-text>\
///     <voice-text time='2'>Hello!</voice-text></body></eml>";
/// let parsed = raconteur_eml::parse(script);
/// let spoken = spoken_clauses(&parsed.document);
/// assert_eq!(spoken.len(), 2);
/// assert_eq!(spoken[0].key(), spoken[1].key(), "the same speech has the same key");
/// ```
#[derive(Clone, Copy, Debug)]
pub struct SpokenClause<'d> {
    /// Identifier of the clause in the document.
    pub id: ClauseId,
    /// Kind of the clause.
    pub kind: &'d ClauseKind,
    /// Name of the voice in the script; `None` for the story's own.
    pub voice: Option<&'d str>,
    /// The emotion, unless it is neutral.
    pub emotion: Option<&'d Emotion>,
    /// Tension of the story, 0 to 1; `None` derives it from the text.
    pub tension: Option<f64>,
}

impl SpokenClause<'_> {
    /// Returns the key of the clause's utterance in a bundle: a digest of the words, their markup,
    /// the voice and the emotion.
    #[must_use]
    pub fn key(&self) -> u64 {
        key::key_of(self)
    }

    /// Returns the emotion elicited for it: its word, if the place is that of the word in the
    /// table, and its place, scaled by the potential.
    #[must_use]
    pub fn elicited(&self) -> Option<(Option<&'static str>, EmotionPoint)> {
        let emotion = self.emotion?;
        let place = place_of(emotion)?.scaled(emotion.intensity() / PLAIN_POTENTIAL);
        Some((word_of(emotion), place))
    }
}

/// Returns the spoken clauses of a document, in document order.
#[must_use]
pub fn spoken_clauses(document: &Document) -> Vec<SpokenClause<'_>> {
    let mut clauses = Vec::new();
    let (mut voice, mut emotion, mut tension) = (None, None, None);
    for (id, clause) in document.iter() {
        let kind = &clause.kind;
        match kind {
            ClauseKind::VoiceChange(change) => voice = Some(change.voice.as_str()),
            ClauseKind::Beat(beat) => tension = beat.tension,
            ClauseKind::Emotion(next) => {
                let felt = place_of(next).is_some() && next.intensity() > 0.0;
                emotion = felt.then_some(next);
            }
            ClauseKind::VoiceText(_) | ClauseKind::VoiceSay(_) => clauses.push(SpokenClause {
                id,
                kind,
                voice,
                emotion,
                tension,
            }),
            _ => {}
        }
    }
    clauses
}
