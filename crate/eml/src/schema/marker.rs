//! `marker`: notifies listeners of a time in speech.

use super::{Attribute, Context, Element, Fields, Role, VOICE_PARENTS, VoiceBuilder};
use crate::TextSegment;

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text("Notifies listeners when the next word begins."),
    source: super::reference_text("SABLE 1.0 MARKER; not in GEVH"),
    example: super::reference_text(
        "<eml xmlns:r='urn:raconteur:eml:1'><body><voice-text time='0'>And then <r:marker mark='door'/>it opened.</voice-text></body></eml>",
    ),
    extension: true,
    attributes: &[Attribute::identifier("mark", "The text passed to listeners.").required()],
    ..Element::new("marker", VOICE_PARENTS, Role::Voice(read))
};

fn read(cx: &mut Context<'_>, node: usize, fields: &Fields<'_>, voice: &mut VoiceBuilder) {
    cx.children(node, &ELEMENT, |_, _, _| {});
    if let Some(mark) = cx.text(fields, "mark") {
        let span = cx.full_span(node);
        voice.pieces.push(TextSegment::Marker {
            mark: mark.into(),
            span,
        });
    }
}

#[cfg(test)]
mod tests {
    use crate::{ClauseKind, TextSegment};

    #[test]
    fn markers_do_not_cut_words() {
        let text = "<eml xmlns:x='urn:raconteur:eml:1'><body><voice-text time='0'>a<x:marker \
                    mark='m'/>b</voice-text></body></eml>";
        let parsed = crate::parse(text);
        assert_eq!(parsed.diagnostics, []);
        let ClauseKind::VoiceText(voice) = &parsed.document.clauses[0].kind else {
            panic!()
        };
        assert!(
            matches!(&voice.pieces[1], TextSegment::Marker { mark, .. } if mark == "m"),
            "the marker is inside the word"
        );
        assert_eq!(voice.plain_text(), "ab");
    }
}
