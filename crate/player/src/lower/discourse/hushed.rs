//! Hushed speech: quiet by its markup, or said to be whispered.

use raconteur_actor::TimeSpan;
use raconteur_base::text::language::Language;
use raconteur_base::text::sentence::ends_after;
use raconteur_base::text::word::Word;

use super::spoken::{MarkedUtterance, MarkedWord, bare};

/// Pause within which hushed words are one interval, seconds. *Designed*.
const PAUSE_SECS: f64 = 1.0;
/// Verbs of sentences that are whispered, in English, German and Portuguese.
const VERBS: [&str; 16] = [
    "whisper",
    "whispers",
    "whispered",
    "whispering",
    "flüstern",
    "flüstert",
    "flüsterte",
    "flüsterten",
    "wisperte",
    "raunte",
    "sussurra",
    "sussurrou",
    "sussurrava",
    "sussurram",
    "cochichou",
    "cochichava",
];

/// Returns the intervals of hushed speech, by time.
pub(super) fn spans(utterances: &[MarkedUtterance<'_>]) -> Vec<TimeSpan> {
    let mut spans: Vec<TimeSpan> = Vec::new();
    let hushed = utterances.iter().flat_map(hushed_words);
    for word in hushed {
        match spans.last_mut() {
            Some(last) if word.start_secs - last.end_secs < PAUSE_SECS => {
                last.end_secs = last.end_secs.max(word.end_secs);
            }
            _ => spans.push(TimeSpan {
                start_secs: word.start_secs,
                end_secs: word.end_secs,
            }),
        }
    }
    spans
}

/// Returns the hushed words of an utterance.
fn hushed_words<'u>(utterance: &'u MarkedUtterance<'_>) -> Vec<&'u MarkedWord> {
    let language = utterance.language.and_then(Language::from_tag);
    let words = &utterance.words;
    let written: Vec<Word<'_>> = words.iter().map(|word| Word::parse(&word.text)).collect();
    let mut hushed = Vec::new();
    let mut first = 0;
    for at in 0..words.len() {
        let next = words.get(at + 1);
        let divided = next.is_none_or(|word| word.follows_division);
        if !divided && !ends_after(&written, at, language) {
            continue;
        }
        let sentence = &words[first..=at];
        let whispered = (sentence.iter()).any(|word| VERBS.contains(&bare(&word.text).as_str()));
        hushed.extend(sentence.iter().filter(|word| whispered || word.quiet));
        first = at + 1;
    }
    hushed
}
