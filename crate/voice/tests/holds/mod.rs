//! Invariants of any lexicon text, shared by the tests and the fuzz target.

use raconteur_voice::content::Content;
use raconteur_voice::plan::plan;
use raconteur_voice::text::Lexicon;

/// Checks a text as a lexicon: it is rejected at an existing position, or its pronunciations can be
/// spoken. The text itself is spoken, so that its words occur.
pub(crate) fn lexicon(text: &str) {
    let lexicon = match Lexicon::parse(text) {
        Ok(lexicon) => lexicon,
        Err(error) => {
            let text = text.strip_prefix('\u{feff}').unwrap_or(text);
            let line = text.lines().nth(error.line - 1);
            let columns = line.expect("a line of the text").chars().count();
            assert!((1..=columns + 1).contains(&error.column), "{error}");
            return;
        }
    };
    let begin: String = text.chars().take(2000).collect();
    for language in ["en", "de", "pt", "xx"] {
        let _ = plan(&Content::plain(&begin), language, "test", &lexicon);
    }
}
