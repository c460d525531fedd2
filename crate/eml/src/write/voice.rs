//! Spoken text with its markup.

use quick_xml::escape::partial_escape;

use super::tag::Tag;
use crate::{Boundary, DivKind, MarkEvent, TextSegment, VoiceText};

/// The pauses that have a word.
const LEVELS: [(u32, &str); 4] = [(350, ""), (0, "none"), (150, "small"), (800, "large")];

/// Returns the content of a voice-text, and true if it contains extensions.
pub(super) fn content(text: &VoiceText) -> (String, bool) {
    let mut out = String::new();
    let mut open: Vec<String> = Vec::new();
    let mut extended = false;
    for piece in &text.pieces {
        let (mut tag, opens) = match piece {
            TextSegment::Text { text, .. } => {
                // In text, a quote is an ordinary character.
                out.push_str(&partial_escape(text.as_str()));
                continue;
            }
            TextSegment::DivEnd | TextSegment::End => {
                close(&mut open, &mut out);
                continue;
            }
            TextSegment::Break { .. } => (Tag::new("break"), false),
            TextSegment::Audio { audio, .. } => {
                (Tag::from_record(&mut audio.as_ref().clone()), false)
            }
            TextSegment::Marker { .. } => (Tag::new("marker"), false),
            TextSegment::Mark { .. } => (Tag::new("tm"), false),
            TextSegment::DivStart { .. } => (Tag::new("div"), true),
            TextSegment::Start { markup, .. } => {
                (Tag::from_record(markup.as_ref().clone().record()), true)
            }
        };
        match piece {
            TextSegment::Break { msec, boundary, .. } => {
                match LEVELS.iter().find(|(length, _)| length == msec) {
                    Some((_, "")) => {}
                    Some((_, word)) => tag.word("level", Some(word)),
                    None => tag.number("msec", Some(f64::from(*msec))),
                }
                tag.word("type", boundary.map(Boundary::word));
            }
            TextSegment::Marker { mark, .. } => tag.text("mark", Some(mark)),
            TextSegment::Mark { name, event, .. } => {
                tag.text("name", Some(name));
                match event {
                    MarkEvent::OnStart => {}
                    MarkEvent::OnEnd => tag.word("event", Some("onEnd")),
                    MarkEvent::OnPhone(phone) => {
                        tag.word("event", Some("onPhone"));
                        tag.text("phone", Some(phone));
                    }
                }
            }
            TextSegment::DivStart { kind, .. } => tag.word(
                "type",
                kind.map(|kind| match kind {
                    DivKind::Sentence => "sentence",
                    DivKind::Paragraph => "paragraph",
                }),
            ),
            _ => {}
        }
        extended |= tag.is_extended();
        let end = if opens { ">" } else { "/>" };
        out.push_str(&format!("<{}{}{end}", tag.name(), tag.attributes()));
        if opens {
            open.push(tag.name());
        }
    }
    while !open.is_empty() {
        close(&mut open, &mut out);
    }
    (out, extended)
}

fn close(open: &mut Vec<String>, out: &mut String) {
    if let Some(name) = open.pop() {
        out.push_str(&format!("</{name}>"));
    }
}
