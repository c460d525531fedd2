//! Words of utterances of which only the whole has times.

use raconteur_eml::Diagnostic;

use super::{Extent, TrackElement};
use crate::gestura::{Interval, Word};
use crate::names::TEXT;

/// Maximum number of words; later ones are left out.
const MAX_WORDS: usize = 100_000;

/// Returns the words of the texts of elements with times, and reports that they are spread evenly.
pub(super) fn words(elements: &[TrackElement], problems: &mut Vec<Diagnostic>) -> Vec<Word> {
    let mut words: Vec<Word> = elements
        .iter()
        .flat_map(spread)
        .take(MAX_WORDS + 1)
        .collect();
    if let Some(late) = words.get(MAX_WORDS) {
        let message = format!("only the first {MAX_WORDS} words are read");
        problems.push(Diagnostic::error("gestura::too-large", late.span, message));
        words.truncate(MAX_WORDS);
    }
    if let Some(first) = words.first() {
        let message = "the file has utterances without words: their words are spread evenly";
        problems.push(Diagnostic::warning(
            "gestura::no-words",
            first.span,
            message,
        ));
    }
    words
}

/// Returns the words of an element, each as long as its share of the letters.
fn spread(element: &TrackElement) -> Vec<Word> {
    let Extent::Times(whole) = element.extent else {
        return Vec::new();
    };
    let text = element.value(TEXT).unwrap_or_default();
    let count = |text: &str| text.split_whitespace().flat_map(str::chars).count().max(1);
    let secs_per_letter = whole.length_secs() / count(&text) as f64;
    let mut start_secs = whole.start_secs;
    let word = |token: &str| {
        let end_secs = start_secs + count(token) as f64 * secs_per_letter;
        let interval = Interval::new(start_secs, end_secs);
        start_secs = end_secs;
        Word {
            token: token.to_owned(),
            interval,
            span: element.span,
        }
    };
    let tokens = text.split_whitespace().take(MAX_WORDS + 1);
    tokens.map(word).collect()
}
