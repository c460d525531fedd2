//! `div`: a sentence or a paragraph of speech.

use super::{Attribute, Content, Context, Element, Fields, Role, VOICE_PARENTS, VoiceBuilder};
use crate::{DivKind, TextSegment};

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text("Marks a division of spoken text."),
    decision: super::reference_text(
        "Some examples in GEVH seem to have overlapping tags; EML is XML, so elements nest.",
    ),
    source: super::reference_text("GEVH D.4.6"),
    example: super::reference_text(
        "<voice-text time='0'><div type='sentence'>Two roads diverged in a yellow wood.</div></voice-text>",
    ),
    content: Content::Mixed,
    attributes: &[Attribute::choice(
        "type",
        &["sentence", "paragraph"],
        "The type of division.",
    )],
    ..Element::new("div", VOICE_PARENTS, Role::Voice(read))
};

fn read(cx: &mut Context<'_>, node: usize, fields: &Fields<'_>, voice: &mut VoiceBuilder) {
    let kind = cx.choice(fields, "type").map(|kind| match kind {
        "sentence" => DivKind::Sentence,
        _ => DivKind::Paragraph,
    });
    voice.pieces.push(TextSegment::DivStart {
        kind,
        span: fields.tag,
    });
    voice.content(cx, node, ELEMENT.name);
    voice.pieces.push(TextSegment::DivEnd);
}

#[cfg(test)]
mod tests {
    use crate::schema::testing::one;
    use crate::{ClauseKind, DivKind, TextSegment};

    #[test]
    fn divisions_open_and_close_around_their_text() {
        let kind = one("<voice-text time='0'><div type='SENTENCE'>Hello</div></voice-text>");
        let ClauseKind::VoiceText(text) = kind else {
            panic!()
        };
        let sentence = Some(DivKind::Sentence);
        assert!(
            matches!(text.pieces[0], TextSegment::DivStart { kind, .. } if kind == sentence),
            "the sentence division starts the text"
        );
        assert!(
            matches!(text.pieces[2], TextSegment::DivEnd),
            "the division ends after its text"
        );
    }
}
