//! Messages to JavaScript: plain objects, named like the types of `web/element/base`.

use raconteur_player::eml::{self, LineIndex};
use raconteur_player::stage::{Angle, EmotionType, Shot};
use raconteur_player::{Event, MusicCue, UtteranceCue};
use serde::Serialize;

use crate::lesson::Lesson;

/// Summary of a loaded story for the page: duration, utterances, performer and diagnostics.
#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Story {
    /// Duration of the story, seconds.
    pub duration_secs: f64,
    /// Utterances of the story, by time.
    pub utterances: Vec<Utterance>,
    /// The performer that it chooses.
    pub performer: Performer,
    /// Its questions and the paths through it.
    #[serde(flatten)]
    pub lesson: Lesson,
    /// Problems of the text, by position.
    pub diagnostics: Vec<Diagnostic>,
}

/// Figure, voice and language that a story chooses.
#[derive(Debug, Default, Serialize)]
pub struct Performer {
    #[serde(skip_serializing_if = "Option::is_none")]
    figure: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    voice: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    language: Option<String>,
}

impl Performer {
    /// Converts the performer of a parsed story; without one, nothing is chosen.
    #[must_use]
    pub fn from_performer(performer: Option<&eml::Performer>) -> Self {
        performer.map_or_else(Self::default, |p| Self {
            figure: p.figure.clone(),
            voice: p.voice.clone(),
            language: p.language.clone(),
        })
    }
}

/// Problem in the story's text, with its position, for the page.
#[derive(Debug, Serialize)]
pub struct Diagnostic {
    code: &'static str,
    severity: &'static str,
    message: String,
    hints: Vec<String>,
    start: Position,
    end: Position,
}

/// A position in the story's text; all from 1.
#[derive(Debug, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
struct Position {
    line: u32,
    /// Column in characters.
    column: u32,
    /// Column in UTF-16 units, as JavaScript counts.
    column_utf16: u32,
}

/// Utterance of a story for the page: time, audio files and words.
#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Utterance {
    start_secs: f64,
    duration_secs: f64,
    audio: Vec<AudioFile>,
    words: Vec<Word>,
    estimated: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    language: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    voice: Option<String>,
}

#[derive(Debug, Serialize)]
struct AudioFile {
    file: String,
    mime: String,
}

#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
struct Word {
    text: String,
    start_secs: f64,
    end_secs: f64,
    emphasized: bool,
}

/// Piece of music under the story, for the page: time, file and levels.
#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct MusicPiece {
    start_secs: f64,
    end_secs: f64,
    file: String,
    library: bool,
    loops: bool,
    level: Vec<(f64, f64)>,
}

impl From<MusicCue> for MusicPiece {
    fn from(cue: MusicCue) -> Self {
        Self {
            start_secs: cue.start_secs,
            end_secs: cue.end_secs,
            file: cue.file,
            library: cue.library,
            loops: cue.loops,
            level: cue.level,
        }
    }
}

/// Expression of an emotion by the environment, for the page: light, shot and camera angle.
#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct EnvironmentExpression {
    emotion: &'static str,
    potential: f64,
    intensity: f64,
    shot: &'static str,
    angle: &'static str,
    /// sRGB.
    color: [u8; 3],
    attenuation: f64,
    brightness: f64,
    valence: f64,
    arousal: f64,
    music: Vec<String>,
}

impl From<raconteur_player::EnvironmentExpression> for EnvironmentExpression {
    fn from(expressed: raconteur_player::EnvironmentExpression) -> Self {
        let emotion = expressed.emotion.unwrap_or_else(|| EmotionType::neutral());
        Self {
            emotion: emotion.name,
            potential: expressed.potential,
            intensity: expressed.intensity,
            shot: match expressed.shot {
                Shot::Long => "long",
                Shot::Full => "full",
                Shot::Storyteller => "storyteller",
                Shot::Medium => "medium",
                Shot::Close => "closeUp",
                Shot::ExtremeClose => "extremeCloseUp",
            },
            angle: match expressed.angle {
                Angle::Eye => "eye",
                Angle::High => "high",
                Angle::Low => "low",
            },
            color: emotion.key_color,
            attenuation: emotion.attenuation(expressed.intensity),
            brightness: expressed.light.brightness,
            valence: expressed.mood.valence,
            arousal: expressed.mood.arousal,
            music: expressed.music,
        }
    }
}

/// Result of performing a fragment (a piece of a live story), for the page.
#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Performance {
    /// Events for its sender.
    pub events: Vec<Event>,
    /// Utterances of the fragment, by time.
    pub utterances: Vec<Utterance>,
    /// The index of the first of them.
    pub first_utterance: usize,
    /// Questions of the fragment.
    #[serde(flatten)]
    pub lesson: Lesson,
    /// End of everything known, story time, seconds.
    pub end_secs: f64,
    /// Result of `<interrupt/>`, if the text was that instead of a fragment.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cut: Option<InterruptionOutcome>,
}

/// Result of interrupting fragments of a live performance: its time and the new end.
#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct InterruptionOutcome {
    /// Time of the interruption, story time, seconds.
    pub at_secs: f64,
    /// End of everything now known, story time, seconds.
    pub end_secs: f64,
}

impl Story {
    /// Creates the summary of the story that a player read from `source`.
    #[must_use]
    pub fn new(
        source: &str,
        duration_secs: f64,
        utterances: &[UtteranceCue],
        performer: Option<&eml::Performer>,
        lesson: Lesson,
        diagnostics: Vec<eml::Diagnostic>,
    ) -> Self {
        let lines = LineIndex::new(source);
        Self {
            duration_secs,
            utterances: utterances.iter().map(Utterance::new).collect(),
            performer: Performer::from_performer(performer),
            lesson,
            diagnostics: diagnostics
                .into_iter()
                .map(|d| Diagnostic::new(d, &lines))
                .collect(),
        }
    }
}

impl Diagnostic {
    pub(crate) fn new(diagnostic: eml::Diagnostic, lines: &LineIndex<'_>) -> Self {
        let position = |offset| {
            let characters = lines.position(offset);
            Position {
                line: characters.line,
                column: characters.column,
                column_utf16: lines.position_utf16(offset).column,
            }
        };
        Self {
            code: diagnostic.code,
            severity: diagnostic.severity.name(),
            start: position(diagnostic.span.start),
            end: position(diagnostic.span.end),
            message: diagnostic.message,
            hints: diagnostic.hints,
        }
    }
}

impl Utterance {
    pub(crate) fn new(cue: &UtteranceCue) -> Self {
        let timed = &cue.timed;
        let audio = |a: &raconteur_player::speech::AudioFile| AudioFile {
            file: a.file.clone(),
            mime: a.mime.clone(),
        };
        let word = |w: &raconteur_player::speech::Word| Word {
            text: w.text.clone(),
            start_secs: timed.story_secs(w.start_secs),
            end_secs: timed.story_secs(w.end_secs),
            emphasized: w.emphasized,
        };
        Self {
            start_secs: timed.start_secs,
            duration_secs: timed.utterance.duration_secs,
            audio: timed.utterance.audio.iter().map(audio).collect(),
            words: timed.utterance.words.iter().map(word).collect(),
            estimated: cue.estimated,
            language: cue.language.clone(),
            voice: cue.voice.clone(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn places_count_characters_and_utf16_units() {
        let source = "<eml>\n<x y='😀' bad/>";
        let at = u32::try_from(source.find("bad").unwrap()).unwrap();
        let diagnostic = eml::Diagnostic::error("eml::test", eml::Span::new(at, at + 3), "No.");
        let story = Story::new(
            source,
            1.5,
            &[],
            None,
            Lesson::default(),
            vec![diagnostic.hint("Try.")],
        );
        assert_eq!(
            serde_json::to_value(story).unwrap(),
            json!({
                "durationSecs": 1.5,
                "utterances": [],
                "performer": {},
                "questions": [],
                "ways": [],
                "diagnostics": [{
                    "code": "eml::test",
                    "severity": "error",
                    "message": "No.",
                    "hints": ["Try."],
                    "start": { "line": 2, "column": 10, "columnUtf16": 11 },
                    "end": { "line": 2, "column": 13, "columnUtf16": 14 },
                }],
            })
        );
    }
}
