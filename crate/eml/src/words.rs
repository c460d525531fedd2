//! Limits on the speech of a document: the costs of times, captions and lips grow with its words.

use std::ops::ControlFlow;

use crate::diagnostic::Sink;
use crate::voice::Item;
use crate::{
    Clause, ClauseKind, Diagnostic, Document, Limits, Span, TextSegment, VoiceSay, VoiceText,
};

/// Leaves out words beyond [`Limits::clause_words`] and [`Limits::words`], and returns where.
/// Pauses, recordings and events go with the words that they stood between; time markers stay, and
/// name the end of the clause.
pub(crate) fn enforce_limits(document: &mut Document, limits: &Limits, sink: &mut Sink) {
    // A word takes one byte and one of white space, or the end of its piece: after a pause, the
    // next word begins without white space. Most documents therefore need no counting.
    let most = |clause: &Clause| match &clause.kind {
        ClauseKind::VoiceText(text) => text.pieces.iter().map(most_words).sum::<usize>(),
        ClauseKind::VoiceSay(say) => say.content.len().div_ceil(2),
        _ => 0,
    };
    let all = document.clauses.iter().map(most).sum::<usize>();
    let mut left = limits.words;
    let mut told = false;
    for clause in &mut document.clauses {
        if all <= limits.words && most(clause) <= limits.clause_words {
            continue;
        }
        let allowed = left.min(limits.clause_words);
        let (words, rest) = match &mut clause.kind {
            ClauseKind::VoiceText(text) => hold_text(text, allowed),
            ClauseKind::VoiceSay(say) if !say.is_file() => hold_say(say, allowed),
            _ => continue,
        };
        left -= words;
        let is_story = allowed < limits.clause_words;
        if let Some(rest) = rest.filter(|_| !(is_story && told)) {
            told |= is_story;
            sink.push(too_many(rest, is_story, limits));
        }
    }
}

/// Returns an upper bound of the number of words in a segment.
fn most_words(piece: &TextSegment) -> usize {
    match piece {
        TextSegment::Text { text, .. } => text.len().div_ceil(2),
        _ => 0,
    }
}

fn too_many(rest: Span, is_story: bool, limits: &Limits) -> Diagnostic {
    let (most, what, hint) = if is_story {
        (limits.words, "story", "split it into several stories")
    } else {
        (
            limits.clause_words,
            "clause",
            "split it into several clauses",
        )
    };
    let message = format!("more than {most} words in one {what}; the rest is not spoken");
    Diagnostic::error("eml::too-many-words", rest, message).hint(hint)
}

/// Returns the number of words in a text, up to a limit, and the span of the rest: from the first
/// excess word to the end.
fn count(text: &VoiceText, allowed: usize) -> (usize, Option<Span>) {
    let mut words = 0;
    let mut rest = None;
    let _ = text.scan(&mut |item| {
        if let Item::Word(token) = item {
            if words == allowed {
                rest = Some(token.span);
                return ControlFlow::Break(());
            }
            words += 1;
        }
        ControlFlow::Continue(())
    });
    let end = text.pieces.iter().rev().find_map(|piece| match piece {
        TextSegment::Text { span, .. } => Some(*span),
        _ => None,
    });
    (
        words,
        rest.map(|from| Span::new(from.start, end.map_or(from.end, |s| s.end))),
    )
}

/// Removes the words of a text beyond a limit; returns the number of remaining words and the
/// removed span.
fn hold_text(text: &mut VoiceText, allowed: usize) -> (usize, Option<Span>) {
    let (words, rest) = count(text, allowed);
    let Some(rest) = rest else {
        return (words, None);
    };
    text.pieces.retain_mut(|piece| match piece {
        TextSegment::Text { text, span, .. } => {
            // A word begins only inside verbatim text: a reference is one character.
            if span.end > rest.start
                && span.start < rest.start
                && let Some(head) = text.get(..(rest.start - span.start) as usize)
            {
                *text = head.into();
                span.end = rest.start;
            }
            span.start < rest.start
        }
        TextSegment::Break { span, .. }
        | TextSegment::Audio { span, .. }
        | TextSegment::Marker { span, .. } => span.start < rest.start,
        _ => true,
    });
    (words, Some(rest))
}

/// Removes the words of plain text beyond a limit; its length may differ from that of its source.
fn hold_say(say: &mut VoiceSay, allowed: usize) -> (usize, Option<Span>) {
    let (words, rest) = count(&say.text(), allowed);
    let Some(rest) = rest else {
        return (words, None);
    };
    let mut seen = 0;
    let is_beyond = |word: &&str| {
        seen += usize::from(word.contains(char::is_alphanumeric));
        seen > allowed
    };
    let beyond = say
        .content
        .split_ascii_whitespace()
        .find(is_beyond)
        .map(|word| word.as_ptr() as usize - say.content.as_ptr() as usize);
    say.content.truncate(beyond.unwrap_or(say.content.len()));
    (words, Some(rest))
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use crate::{ClauseKind, Limits, parse_with};

    /// Returns the number of words spoken by each clause, and the codes of diagnostics.
    fn spoken_words(
        clauses: &[String],
        clause_words: usize,
        words: usize,
    ) -> (Vec<usize>, Vec<String>) {
        let source = format!("<eml><body>{}</body></eml>", clauses.concat());
        let limits = Limits {
            clause_words,
            words,
            ..Limits::default()
        };
        let parsed = parse_with(&source, &limits);
        let spoken = |kind: &ClauseKind| kind.spoken_text().map(|text| text.words().len());
        let counts = parsed.document.clauses.iter();
        let codes = parsed
            .diagnostics
            .iter()
            .filter(|d| d.code == "eml::too-many-words");
        (
            counts.filter_map(|c| spoken(&c.kind)).collect(),
            codes.map(|d| d.message.clone()).collect(),
        )
    }

    /// Generates a word, perhaps with markup in or around it, for property tests.
    fn word() -> impl Strategy<Value = String> {
        prop::sample::select(vec![
            "word",
            "caf&#233;",
            "&lt;a",
            "<emph>w</emph>ord",
            "<emph>one two</emph>",
            "été, ",
            "<tm name='N'/>m",
            "x <break msec='10'/>",
            ":-)",
            "<![CDATA[data]]>",
        ])
        .prop_map(str::to_owned)
    }

    fn clause() -> impl Strategy<Value = (Vec<String>, bool)> {
        (prop::collection::vec(word(), 1..40), any::<bool>())
    }

    proptest! {
        #[test]
        fn the_first_words_are_spoken_and_no_others(
            clauses in prop::collection::vec(clause(), 1..8),
            most_in_clause in 1..30_usize,
            most in 1..80_usize,
        ) {
            let mut names = 0;
            let texts: Vec<String> = clauses.iter().map(|(words, is_say)| {
                let inner = words.join(" ").split('N').fold(String::new(), |text, part| {
                    names += 1;
                    if text.is_empty() { part.to_owned() } else { format!("{text}n{names}{part}") }
                });
                if *is_say && !inner.contains("<e") && !inner.contains("<t") && !inner.contains("<b") {
                    format!("<voice-say time='0' voiceOperation='text'>{inner}</voice-say>")
                } else {
                    format!("<voice-text time='0'>{inner}</voice-text>")
                }
            }).collect();
            let (whole, none) = spoken_words(&texts, usize::MAX, usize::MAX);
            prop_assert!(none.is_empty());
            let (held, told) = spoken_words(&texts, most_in_clause, most);
            let mut left = most;
            let expected: Vec<usize> = whole.iter().map(|&words| {
                let spoken = words.min(most_in_clause).min(left);
                left -= spoken;
                spoken
            }).collect();
            let is_held = expected != whole;
            prop_assert_eq!(held, expected);
            prop_assert_eq!(is_held, !told.is_empty());
            prop_assert!(told.iter().filter(|m| m.contains("story")).count() <= 1);
        }
    }

    #[test]
    fn words_parted_by_pauses_alone_are_counted() {
        for between in [
            "<break/>",
            "<emph/>",
            "<break msec='1'/><audio src='a.wav'/>",
        ] {
            let inner = format!("a{between}").repeat(100);
            let clause = format!("<voice-text time='0'>{inner}</voice-text>");
            let (whole, none) = spoken_words(std::slice::from_ref(&clause), usize::MAX, usize::MAX);
            assert!(none.is_empty(), "{none:?}");
            for most in [1, 50, 51, 60, 99] {
                let spoken = most.min(whole[0]);
                for (in_clause, in_story) in [(most, usize::MAX), (usize::MAX, most)] {
                    let (held, told) =
                        spoken_words(std::slice::from_ref(&clause), in_clause, in_story);
                    assert_eq!(held, [spoken], "{between}");
                    assert_eq!(told.len(), usize::from(spoken < whole[0]), "{between}");
                }
            }
        }
    }

    #[test]
    fn a_long_clause_keeps_its_first_words_and_says_where_the_rest_begins() {
        let text = "<voice-text time='0'>one two <tm name='t'/>three four</voice-text>".to_owned();
        let source = format!("<eml><body>{text}</body></eml>");
        let limits = Limits {
            clause_words: 2,
            ..Limits::default()
        };
        let parsed = parse_with(&source, &limits);
        let [problem] = parsed.diagnostics.as_slice() else {
            panic!("{:?}", parsed.diagnostics);
        };
        assert_eq!(problem.code, "eml::too-many-words");
        assert_eq!(problem.span.slice(&source), "three four");
        assert_eq!(
            problem.message,
            "more than 2 words in one clause; the rest is not spoken"
        );
        let ClauseKind::VoiceText(text) = &parsed.document.clauses[0].kind else {
            panic!("no text");
        };
        assert_eq!(text.plain_text(), "one two");
        // A time that other clauses can refer to still exists, at the end.
        assert_eq!(text.marks()[0].word, 2);
    }
}
