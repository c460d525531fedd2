//! Functions exported to web pages. The wasm file is separate from the player's, because most pages
//! never load it.

use raconteur_eml::{ClauseKind, Document, LineIndex, Span, thinned};
use serde::Serialize;
use serde_wasm_bindgen::Serializer;
use wasm_bindgen::prelude::*;

use crate::elan::Mapping;
use crate::gestura::{
    self, Dimension, GestureClass, Hands, Level, PhaseKind, Transcription, Viewpoint, Vocabulary,
};
use crate::plain::{self, Item, PlainTranscription};
use crate::{Anchoring, anvil, read_transcription};

/// Result of opening a file; `Opened` in `web/pages/transcribe/types.ts`.
#[derive(Serialize)]
struct Opened {
    text: String,
    transcription: PlainTranscription,
    diagnostics: Vec<Diagnostic>,
}

/// Script of a transcription; `Script` in `web/pages/transcribe/types.ts`.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Script {
    eml: String,
    /// Start of the first gesture, from which a player derives how long its hands need.
    first_gesture_secs: Option<f64>,
    diagnostics: Vec<Diagnostic>,
}

/// Problem; `Problem` in `web/pages/transcribe/types.ts`.
#[derive(Serialize)]
struct Diagnostic {
    code: &'static str,
    severity: &'static str,
    message: String,
    hints: Vec<String>,
    start: Option<Position>,
    end: Option<Position>,
    item: Option<Item>,
    field: Option<&'static str>,
    /// Range in the field, bytes.
    range: Option<[u32; 2]>,
}

/// Position in the text of a file; `Place` in `web/element/base/types.ts`.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Position {
    line: u32,
    column: u32,
    column_utf16: u32,
}

/// Words of the lists; `Lists` in `web/pages/transcribe/types.ts`.
#[derive(Serialize)]
struct Lists {
    levels: Vec<&'static str>,
    classes: Vec<&'static str>,
    phases: Vec<&'static str>,
    dimensions: Vec<&'static str>,
    hands: Vec<&'static str>,
    viewpoints: Vec<&'static str>,
}

/// Opens an annotation file of any format. `mapping` is the text of a mapping for ELAN; without it
/// the tiers are guessed.
#[wasm_bindgen]
#[allow(
    clippy::needless_pass_by_value,
    reason = "JavaScript hands over owned texts"
)]
pub fn open(bytes: &[u8], mapping: Option<String>) -> Result<JsValue, JsError> {
    let mut unread = Vec::new();
    let mapping = mapping.filter(|text| !text.trim().is_empty());
    let given = mapping
        .as_ref()
        .map(|text| Mapping::read(text, &mut unread));
    let read = read_transcription(bytes, given.as_ref());
    let items = plain::items(&read.transcription);
    let in_mapping = LineIndex::new(mapping.as_deref().unwrap_or_default());
    let in_file = LineIndex::new(&read.text);
    let diagnostics = unread
        .into_iter()
        .map(|problem| placed(problem, &in_mapping, None))
        .chain(read.diagnostics.into_iter().map(|problem| {
            let item = item_in_file(problem.span, &items, &read.text);
            placed(problem, &in_file, item)
        }))
        .collect();
    hand_over(&Opened {
        transcription: (&read.transcription).into(),
        diagnostics,
        text: read.text,
    })
}

/// Converts a transcription to a script that performs it; `anchoring` is `words` or `seconds`.
/// Problems of the transcription and notes on what was filled in name the annotations they are
/// about.
#[wasm_bindgen(js_name = toEml)]
pub fn to_eml(transcription: JsValue, anchoring: &str) -> Result<JsValue, JsError> {
    let (transcription, mut problems) = taken(transcription)?;
    let anchoring = match anchoring {
        "words" => Anchoring::Words,
        _ => Anchoring::Seconds,
    };
    let (document, notes) = crate::to_eml(&transcription, anchoring);
    problems.extend(gestura::check(&transcription));
    problems.extend(notes);
    let items = plain::items(&transcription);
    hand_over(&Script {
        eml: raconteur_eml::write(&document),
        first_gesture_secs: first_gesture_secs(&document),
        diagnostics: thinned(problems)
            .into_iter()
            .map(|problem| about(problem, &items))
            .collect(),
    })
}

/// Converts a transcription to a file of ANVIL.
#[wasm_bindgen(js_name = toAnvil)]
pub fn to_anvil(transcription: JsValue) -> Result<String, JsError> {
    let (transcription, _) = taken(transcription)?;
    Ok(anvil::write(&anvil::from_transcription(&transcription)))
}

/// Counts a transcription.
#[wasm_bindgen]
pub fn statistics(transcription: JsValue) -> Result<JsValue, JsError> {
    let (transcription, _) = taken(transcription)?;
    hand_over(&gestura::Statistics::new(&transcription))
}

/// Returns the words of all lists.
#[wasm_bindgen]
pub fn lists() -> Result<JsValue, JsError> {
    fn words<V: Vocabulary>() -> Vec<&'static str> {
        V::WORDS.iter().map(|(_, word)| *word).collect()
    }
    hand_over(&Lists {
        levels: words::<Level>(),
        classes: words::<GestureClass>(),
        phases: words::<PhaseKind>(),
        dimensions: words::<Dimension>(),
        hands: words::<Hands>(),
        viewpoints: words::<Viewpoint>(),
    })
}

fn taken(
    transcription: JsValue,
) -> Result<(Transcription, Vec<raconteur_eml::Diagnostic>), JsError> {
    let plain: PlainTranscription = serde_wasm_bindgen::from_value(transcription)?;
    plain
        .transcription()
        .map_err(|message| JsError::new(&message))
}

fn hand_over<T: Serialize>(value: &T) -> Result<JsValue, JsError> {
    Ok(value.serialize(&Serializer::new())?)
}

/// Returns the start of the first gesture whose time is in plain seconds.
fn first_gesture_secs(document: &Document) -> Option<f64> {
    let gestures = document.clauses.iter();
    let gestures = gestures.filter(|c| matches!(c.kind, ClauseKind::GestureKey(_)));
    let starts = gestures.filter(|c| c.start.names.is_empty());
    starts.map(|c| c.start.offset_secs).reduce(f64::min)
}

/// Returns the annotation in whose element a place of a file lies.
fn item_in_file(span: Span, items: &[(Span, Item)], text: &str) -> Option<Item> {
    let before = items.iter().filter(|(tag, _)| tag.start <= span.start);
    let (tag, item) = before.max_by_key(|(tag, _)| tag.start)?;
    let between = Span::new(tag.start, span.start.max(tag.start)).slice(text);
    let is_past = ["</el>", "</ANNOTATION>"]
        .iter()
        .any(|end| between.contains(end));
    (!is_past && span.end > span.start).then(|| item.clone())
}

/// Returns a problem of a file with its lines.
fn placed(
    problem: raconteur_eml::Diagnostic,
    lines: &LineIndex<'_>,
    item: Option<Item>,
) -> Diagnostic {
    let position = |offset| {
        let characters = lines.position(offset);
        Position {
            line: characters.line,
            column: characters.column,
            column_utf16: lines.position_utf16(offset).column,
        }
    };
    // A problem of the whole file has no place.
    let has_place = problem.span != Span::default();
    Diagnostic {
        start: has_place.then(|| position(problem.span.start)),
        end: has_place.then(|| position(problem.span.end)),
        item,
        ..unplaced(problem)
    }
}

/// Returns a problem of a transcription with its annotation.
fn about(problem: raconteur_eml::Diagnostic, items: &[(Span, Item)]) -> Diagnostic {
    let item = items
        .iter()
        .find(|(span, _)| plain::is_at(problem.span, *span));
    let field = plain::field_of(problem.span);
    let range = problem.related.first().filter(|_| field.is_some());
    Diagnostic {
        item: item.map(|(_, item)| item.clone()),
        field,
        range: range.map(|(span, _)| [span.start, span.end]),
        ..unplaced(problem)
    }
}

fn unplaced(problem: raconteur_eml::Diagnostic) -> Diagnostic {
    Diagnostic {
        code: problem.code,
        severity: problem.severity.name(),
        message: problem.message,
        hints: problem.hints,
        start: None,
        end: None,
        item: None,
        field: None,
        range: None,
    }
}

/// Installs the panic handler when the wasm module is instantiated.
#[wasm_bindgen(start)]
pub fn start() {
    raconteur_base::panic::keep_messages();
}

/// Returns the message and source location of the panic that ended this instance; `None` for any
/// other trap.
#[wasm_bindgen(js_name = panicMessage)]
#[must_use]
pub fn panic_message() -> Option<String> {
    raconteur_base::panic::last_message()
}
