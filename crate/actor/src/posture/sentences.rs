//! Sentences of a performance on the story clock.

use raconteur_base::order::sort_by_number;
use raconteur_base::text::sentence::ends_after;
use raconteur_base::text::word::Word;
use raconteur_speech::TimedUtterance;

/// Distance of a paragraph's start from a sentence's start within which they coincide, seconds.
const NEAR_SECS: f64 = 0.4;

/// Sentence of the speech with its times, seconds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct SentenceSpan {
    pub(crate) start_secs: f64,
    pub(crate) end_secs: f64,
    /// True if a paragraph begins with it.
    pub(crate) begins_paragraph: bool,
}

/// Returns the sentences of all utterances, sorted by time; those of an utterance without known
/// sentences end with the punctuation of its words. `paragraphs` are sorted.
pub(crate) fn sentence_spans(speech: &[TimedUtterance], paragraphs: &[f64]) -> Vec<SentenceSpan> {
    let mut spans = Vec::new();
    for timed in speech {
        let words = &timed.utterance.words;
        let mut add = |first: usize, count: usize| {
            let last = first.saturating_add(count).min(words.len());
            let Some((first, last)) = words
                .get(first)
                .zip(last.checked_sub(1).and_then(|i| words.get(i)))
            else {
                return;
            };
            let [start_secs, end_secs] =
                [first.start_secs, last.end_secs].map(|secs| timed.story_secs(secs));
            if start_secs.is_finite() && end_secs.is_finite() && start_secs <= end_secs {
                spans.push(SentenceSpan {
                    start_secs,
                    end_secs,
                    begins_paragraph: is_near(paragraphs, start_secs),
                });
            }
        };
        if timed.utterance.sentences.is_empty() {
            let written: Vec<Word<'_>> = words.iter().map(|word| Word::parse(&word.text)).collect();
            let mut first = 0;
            for at in 0..words.len() {
                if at + 1 == words.len() || ends_after(&written, at, None) {
                    add(first, at + 1 - first);
                    first = at + 1;
                }
            }
        }
        for sentence in &timed.utterance.sentences {
            add(sentence.first_word, sentence.words);
        }
    }
    sort_by_number(&mut spans, |span| span.start_secs);
    spans
}

/// Returns true if one of some ascending times is near another.
fn is_near(times: &[f64], time_secs: f64) -> bool {
    let next = times.partition_point(|t| *t < time_secs - NEAR_SECS);
    times.get(next).is_some_and(|t| *t <= time_secs + NEAR_SECS)
}
