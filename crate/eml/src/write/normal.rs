//! Properties of a document that do not depend on its spelling.

use crate::{ClauseKind, Document, Span, TextSegment, Track};

/// Returns the document without source spans, and with text segments joined across references and
/// comments. Two texts with the same meaning give the same result.
#[must_use]
pub fn normal_form(document: &Document) -> Document {
    let mut document = document.clone();
    let nowhere = Span::default();
    document.performer_span = nowhere;
    for set in &mut document.sets {
        set.span = nowhere;
    }
    for clause in &mut document.clauses {
        clause.span = nowhere;
        clause.tag_span = nowhere;
        clause.start.span = nowhere;
        clause.start.names.iter_mut().for_each(|n| n.span = nowhere);
        if let Some(group) = clause.kind.group_mut() {
            group.repetition_span = nowhere;
        }
        match &mut clause.kind {
            ClauseKind::VoiceText(text) => text.pieces = joined(std::mem::take(&mut text.pieces)),
            ClauseKind::GestureKey(gesture) => {
                gesture.hand_shapes.iter_mut().for_each(forget);
                gesture.palms.iter_mut().for_each(forget);
                gesture.motions.iter_mut().for_each(forget);
            }
            ClauseKind::Ask(ask) => {
                let options = &mut ask.question.options;
                options.iter_mut().for_each(|option| option.span = nowhere);
            }
            ClauseKind::VoiceSay(say) => say.content_span = nowhere,
            _ => {}
        }
    }
    document
}

fn forget<K>(track: &mut Track<K>) {
    track.span = Span::default();
    track
        .keys
        .iter_mut()
        .for_each(|key| key.span = Span::default());
}

fn joined(pieces: Vec<TextSegment>) -> Vec<TextSegment> {
    let mut out: Vec<TextSegment> = Vec::new();
    for mut piece in pieces {
        match &mut piece {
            TextSegment::Text {
                text,
                emphasis,
                span,
            } => {
                if let Some(TextSegment::Text {
                    text: before,
                    emphasis: level,
                    ..
                }) = out.last_mut()
                    && level == emphasis
                {
                    *before = [before.as_str(), text.as_str()].concat().into();
                    continue;
                }
                *span = Span::default();
            }
            TextSegment::Break { span, .. }
            | TextSegment::Audio { span, .. }
            | TextSegment::Marker { span, .. }
            | TextSegment::Start { span, .. }
            | TextSegment::DivStart { span, .. }
            | TextSegment::Mark { span, .. } => *span = Span::default(),
            TextSegment::End | TextSegment::DivEnd => {}
        }
        out.push(piece);
    }
    out
}
