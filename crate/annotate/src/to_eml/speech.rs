//! Words and utterances as spoken texts with marks.

use std::ops::RangeInclusive;

use raconteur_eml::{ClauseKind, DivKind, MarkEvent, Name, Span, TextSegment, TimeExpr, VoiceText};

use super::anchors::Anchors;
use super::prosody;
use crate::gestura::Transcription;
use crate::script::{Builder, UNSTRESSED, after, seconds};

/// Silence that ends an utterance where none is annotated, seconds.
const PAUSE_SECS: f64 = 0.6;

/// Utterance to speak.
struct Spoken<'t> {
    words: RangeInclusive<usize>,
    text: &'t str,
    span: Span,
}

/// Adds the utterances, and one for each run of words that belongs to none.
pub(super) fn write(builder: &mut Builder, transcription: &Transcription, anchors: &Anchors) {
    let mut last: Option<(Name, f64)> = None;
    for (number, spoken) in utterances(transcription, builder).iter().enumerate() {
        let words = &transcription.words[spoken.words.clone()];
        let start_secs = words.first().map_or(0.0, |word| word.interval.start_secs);
        let end_secs = words.last().map_or(0.0, |word| word.interval.end_secs);
        let end: Name = format!("e{number}").into();
        let time = match last.take() {
            // In another voice, the pause between utterances stays.
            Some((name, before_secs)) if anchors.are_words() => {
                after(name, (start_secs - before_secs).max(0.0))
            }
            _ => seconds(start_secs),
        };
        let text = text(builder, transcription, anchors, spoken, &end);
        push(builder, time, text);
        last = Some((end, end_secs));
    }
}

fn push(builder: &mut Builder, time: TimeExpr, pieces: Vec<TextSegment>) {
    builder.push(time, ClauseKind::VoiceText(VoiceText { pieces }));
}

/// Returns the annotated utterances in the order of their words, and runs of the words between.
fn utterances<'t>(transcription: &'t Transcription, builder: &mut Builder) -> Vec<Spoken<'t>> {
    let mut annotated: Vec<Spoken<'t>> = transcription
        .utterances
        .iter()
        .filter(|utterance| *utterance.words.end() < transcription.words.len())
        .map(|utterance| Spoken {
            words: utterance.words.clone(),
            text: &utterance.text,
            span: utterance.span,
        })
        .collect();
    annotated.sort_by_key(|spoken| *spoken.words.start());
    let mut all = Vec::new();
    let mut next = 0;
    for spoken in annotated {
        if *spoken.words.start() < next {
            let message = "the utterance overlaps the one before and is not spoken";
            builder.note("gestura::overlap", spoken.span, message);
            continue;
        }
        runs(
            transcription,
            next,
            *spoken.words.start(),
            builder,
            &mut all,
        );
        next = spoken.words.end() + 1;
        all.push(spoken);
    }
    runs(
        transcription,
        next,
        transcription.words.len(),
        builder,
        &mut all,
    );
    all
}

/// Adds the words from `start` to before `end`, one utterance for each run without a pause.
fn runs<'t>(
    transcription: &Transcription,
    start: usize,
    end: usize,
    builder: &mut Builder,
    all: &mut Vec<Spoken<'t>>,
) {
    let words = &transcription.words[..end];
    let mut first = start;
    for index in start..end {
        let ends = words.get(index + 1).is_none_or(|next| {
            next.interval.start_secs - words[index].interval.end_secs >= PAUSE_SECS
        });
        if ends {
            all.push(Spoken {
                words: first..=index,
                text: "",
                span: words[first].span,
            });
            first = index + 1;
        }
    }
    if start < end && !transcription.utterances.is_empty() {
        let message = format!(
            "{} words belong to no utterance; they are spoken",
            end - start
        );
        builder.note("gestura::no-utterance", words[start].span, message);
    }
}

/// Returns the text of an utterance with the marks of its words, and one at its end.
fn text(
    builder: &mut Builder,
    transcription: &Transcription,
    anchors: &Anchors,
    spoken: &Spoken<'_>,
    end: &Name,
) -> Vec<TextSegment> {
    let words = spoken.words.clone();
    let tokens: Vec<(usize, &str)> = words
        .map(|index| (index, &transcription.words[index]))
        .filter(|(_, word)| word.is_spoken())
        .map(|(index, word)| (index, word.token.as_str()))
        .collect();
    let joined = || {
        let tokens: Vec<&str> = tokens.iter().map(|(_, token)| *token).collect();
        tokens.join(" ")
    };
    let mut text = if spoken.text.is_empty() {
        joined()
    } else {
        spoken.text.to_owned()
    };
    let starts = token_starts(&text, &tokens).unwrap_or_else(|| {
        let message = "the text of the utterance is not that of its words, which are spoken";
        builder.note("gestura::text", spoken.span, message);
        text = joined();
        token_starts(&text, &tokens).unwrap_or_default()
    });
    let spoken_words: Vec<usize> = tokens.iter().map(|(word, _)| *word).collect();
    let containers = prosody::of_words(builder, &transcription.prosody, &spoken_words);
    let places = extended(&text, &starts, &tokens);
    let mut pieces = vec![TextSegment::DivStart {
        kind: Some(DivKind::Sentence),
        span: Span::default(),
    }];
    let mut from = 0;
    for (index, &(start, end)) in places.iter().enumerate() {
        push_text(&mut pieces, &text[from..start]);
        from = start;
        pieces.extend(containers.before(index).cloned());
        pieces.extend(anchors.mark(spoken_words[index]).map(mark));
        pieces.extend(containers.opening(index).cloned());
        for _ in 0..containers.closing(index) {
            push_text(&mut pieces, &text[from..end]);
            from = end;
            pieces.push(TextSegment::End);
        }
    }
    push_text(&mut pieces, &text[from..]);
    pieces.push(TextSegment::DivEnd);
    if anchors.are_words() {
        pieces.push(mark(end.clone()));
    }
    pieces
}

/// Returns the bytes of each token with the signs attached to it, such as quotes.
fn extended(text: &str, starts: &[usize], tokens: &[(usize, &str)]) -> Vec<(usize, usize)> {
    let mut places = Vec::with_capacity(starts.len());
    let mut before = 0;
    for (index, (&start, (_, token))) in starts.iter().zip(tokens).enumerate() {
        let next = starts.get(index + 1).copied().unwrap_or(text.len());
        let gap = &text[before..start];
        let first = gap.rfind(char::is_whitespace).map_or(before, |at| {
            let white = gap[at..].chars().next().map_or(1, char::len_utf8);
            before + at + white
        });
        let letters = token.chars().filter(|c| c.is_alphanumeric()).count();
        let rest = &text[start..next];
        let mut inside = rest.char_indices().filter(|(_, c)| c.is_alphanumeric());
        let last = letters.checked_sub(1).and_then(|count| inside.nth(count));
        let last = last.map_or(start, |(at, c)| start + at + c.len_utf8());
        let after = text[last..next].find(char::is_whitespace);
        let end = after.map_or(next, |at| last + at);
        places.push((first, end));
        before = end;
    }
    places
}

fn push_text(pieces: &mut Vec<TextSegment>, text: &str) {
    if !text.is_empty() {
        pieces.push(TextSegment::Text {
            text: text.into(),
            emphasis: UNSTRESSED,
            span: Span::default(),
        });
    }
}

fn mark(name: Name) -> TextSegment {
    TextSegment::Mark {
        name,
        event: MarkEvent::OnStart,
        span: Span::default(),
    }
}

/// Returns the byte in a text at which each token begins; `None` if their letters differ.
fn token_starts(text: &str, tokens: &[(usize, &str)]) -> Option<Vec<usize>> {
    let mut rest = text.char_indices().filter(|(_, c)| c.is_alphanumeric());
    let mut starts = Vec::with_capacity(tokens.len());
    for (_, token) in tokens {
        let mut start = None;
        for wanted in token.chars().filter(|c| c.is_alphanumeric()) {
            let (at, c) = rest.next()?;
            if !c.to_lowercase().eq(wanted.to_lowercase()) {
                return None;
            }
            start.get_or_insert(at);
        }
        starts.push(start?);
    }
    rest.next().is_none().then_some(starts)
}
