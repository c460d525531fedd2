//! JSON with word times from speech recognition programs.
//!
//! The programs differ in names and structure, not in content: Whisper (also WhisperX,
//! faster-whisper, OpenAI's and whisper.cpp's) `segments[].words[]` of `word`, `start`, `end`;
//! Google `words[]` of `word`, `startTime`, `endTime` ("0.100s") or `startOffset`; Vosk, Gentle,
//! Deepgram and Amazon likewise. Any object with a word and its times is therefore a word, at any
//! position. Of alternatives, the first is read, and of equivalent lists the longest. If only
//! phrases have times, their words share them by letters.

use serde_json::{Map, Value};

use super::Units;
use super::draft::{Draft, Kind};
use super::rhubarb::read as read_json;
use super::text::{TextError, clip};

/// Names of start times.
const STARTS: [&str; 4] = ["start", "startTime", "startOffset", "start_time"];
/// Names of end times.
const ENDS: [&str; 4] = ["end", "endTime", "endOffset", "end_time"];
/// Names of a word's text, most informative first.
const WORDS: [&str; 2] = ["punctuated_word", "word"];
/// Lists of other hypotheses: the first is the best.
const CHOICES: [&str; 2] = ["alternatives", "channels"];
/// Search distance after one word for the next, to find its line, bytes.
const NEAR: usize = 2048;
/// Pieces of words.
const PIECES: &str = "tokens";

/// A word or a phrase.
struct Timed {
    text: String,
    /// Start and end, seconds; `None` if the program did not find the word in the audio.
    span: Option<(f64, f64)>,
    is_word: bool,
}

pub(super) fn read(text: &str, draft: &mut Draft) -> Result<(), TextError> {
    draft.kind = Kind::Units(Units::None);
    let json: Value = read_json(text)?;
    let mut found = found_in(&json);
    if found.iter().any(|f| f.is_word) {
        found.retain(|f| f.is_word);
    }
    found.retain(|f| !f.text.trim().is_empty());
    if !found.iter().any(|f| f.span.is_some()) {
        let message = "no words with times: objects with \"word\" (or \"text\"), \"start\" and \"end\", or \"startTime\" and \"endTime\"";
        return Err(TextError::new(0, message));
    }
    let (mut next, mut at) = (0, 0);
    while next < found.len() {
        let last = run(&found, next);
        let own = &found[next..=last];
        at = place(text, at, &own[0].text);
        let begin = own.iter().find_map(|f| f.span).map(|s| s.0);
        let end = own.iter().rev().find_map(|f| f.span).map(|s| s.1);
        let (begin, end) = begin.zip(end).unwrap_or_default();
        // A word without a time extends to the start of the next.
        let after = found.get(last + 1).and_then(|f| f.span).map(|s| s.0);
        let open = own.last().is_some_and(|f| f.span.is_none());
        let end = after.filter(|a| open && *a > end).unwrap_or(end);
        let words = own.iter().map(|f| f.text.as_str()).collect::<Vec<_>>();
        let count = draft.phrase(begin, end, &words.join(" "), at)?;
        if count > 1 {
            let told = clip(&words.join(" "));
            draft.warn(
                at,
                format!("{told:?} has one time for {count} words; shared out by letters"),
            );
        }
        next = last + 1;
    }
    Ok(())
}

/// Returns the position of a word, not far after a given position; that position if it is not
/// found.
fn place(text: &str, after: usize, word: &str) -> usize {
    let end = text.floor_char_boundary(after.saturating_add(NEAR));
    let begin = &word[..word.floor_char_boundary(16)];
    text[after..end].find(begin).map_or(after, |i| after + i)
}

/// Returns the last of the words from `first` that share a time span: words without a time, or with
/// an empty one, share that of the preceding word, up to the start of the following one.
fn run(found: &[Timed], first: usize) -> usize {
    let timed = |f: &Timed| f.span.is_some_and(|(a, b)| b > a);
    let mut last = first;
    while !timed(&found[last]) && last + 1 < found.len() {
        last += 1;
    }
    while found.get(last + 1).is_some_and(|f| !timed(f)) {
        last += 1;
    }
    last
}

/// Returns the timed words in a JSON value; its phrases if it has none.
fn found_in(value: &Value) -> Vec<Timed> {
    match value {
        Value::Array(list) => list.iter().flat_map(found_in).collect(),
        Value::Object(object) => {
            let inner = object.iter().filter(|(name, _)| *name != PIECES);
            let inner = inner.map(|(name, value)| match value {
                Value::Array(list) if CHOICES.contains(&name.as_str()) => {
                    list.first().map(found_in).unwrap_or_default()
                }
                value => found_in(value),
            });
            let words = |list: &[Timed]| list.iter().filter(|f| f.is_word).count();
            let mut best: Vec<Timed> = Vec::new();
            for list in inner {
                if (words(&list), list.len()) > (words(&best), best.len()) {
                    best = list;
                }
            }
            if best.is_empty() {
                best.extend(timed(object));
            }
            best
        }
        _ => Vec::new(),
    }
}

/// Reads a JSON object as a timed word or phrase; `None` if it is neither.
fn timed(object: &Map<String, Value>) -> Option<Timed> {
    let text = |name: &str| object.get(name)?.as_str();
    let of_word = WORDS.into_iter().find_map(text);
    // Amazon has the word in its first alternative.
    let content = || object.get("alternatives")?.get(0)?.get("content")?.as_str();
    let label = of_word.or_else(|| text("text")).or_else(content)?;
    let time = |names: [&str; 4]| names.into_iter().find_map(|n| secs(object.get(n)?));
    let millis = |name: &str| Some(object.get("offsets")?.get(name)?.as_f64()? / 1000.0);
    let start = time(STARTS).or_else(|| millis("from"));
    let end = time(ENDS).or_else(|| millis("to"));
    // Google leaves a begin of 0 out.
    let span = match (start, end) {
        (Some(start), Some(end)) => Some((start, end)),
        (None, Some(end)) if of_word.is_some() => Some((0.0, end)),
        _ => None,
    };
    let is_word = of_word.is_some() || object.contains_key("alternatives") && span.is_some();
    (span.is_some() || is_word).then(|| Timed {
        text: label.trim().to_owned(),
        span,
        is_word,
    })
}

/// Parses a time: a number of seconds, the same as a text ("0.100s"), or seconds and nanoseconds.
fn secs(value: &Value) -> Option<f64> {
    let number = |value: &Value| match value {
        Value::Number(number) => number.as_f64(),
        Value::String(text) => text.trim().trim_end_matches('s').parse().ok(),
        _ => None,
    };
    match value {
        Value::Object(object) => {
            let part = |name: &str| object.get(name).and_then(number);
            let (whole, nanos) = (part("seconds"), part("nanos"));
            (whole.is_some() || nanos.is_some())
                .then(|| whole.unwrap_or(0.0) + nanos.unwrap_or(0.0) * 1e-9)
        }
        value => number(value),
    }
}
