//! Speech: its text with the syncs as marks.

use raconteur_eml::{ClauseKind, MarkEvent, Name, Span, TextSegment, VoiceText};

use super::behaviour::Point;
use super::output::Output;
use crate::script::{UNSTRESSED, permitted};

/// Adds a speech.
pub(super) fn add(output: &mut Output<'_>, index: usize) {
    let behaviour = output.behaviour(index);
    let element = behaviour.element;
    let content = element.child("text").unwrap_or(element);
    output.check_children(index, element, &["text", "sync"]);
    if !std::ptr::eq(content, element) {
        output.check_children(index, content, &["sync"]);
    }
    let text = permitted(&content.text.value);
    if text.is_empty() {
        let message = "the speech has no text";
        output.lost(index, "bml::no-text", element.tag, message);
    }
    let Some((start, end)) = &behaviour.ends else {
        return;
    };
    let mut pieces = Vec::new();
    let mut from = 0;
    for mark in &behaviour.marks {
        // Positions are in the order of the text.
        push_text(&mut pieces, text.get(from..mark.position).unwrap_or(""));
        pieces.push(segment(mark.name.clone()));
        from = from.max(mark.position);
    }
    push_text(&mut pieces, text.get(from..).unwrap_or(""));
    pieces.push(segment(end.clone()));
    let time = output.time(index, Point::Start);
    let kind = ClauseKind::VoiceText(VoiceText { pieces });
    output.builder.push_named(time, Some(start.clone()), kind);
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

fn segment(name: Name) -> TextSegment {
    TextSegment::Mark {
        name,
        event: MarkEvent::OnStart,
        span: Span::default(),
    }
}
