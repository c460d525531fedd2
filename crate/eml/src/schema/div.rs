//! `div`: a sentence or a paragraph of speech.

use super::{
    Attribute, Content, Context, Element, Fields, Kind, Presence, Role, VOICE_PARENTS, VoiceBuilder,
};
use crate::{DivKind, Piece};

pub(super) static ELEMENT: Element = Element {
    name: "div",
    aliases: &[],
    doc: "Marks a division of spoken text.",
    source: "GEVH D.4.6",
    parents: VOICE_PARENTS,
    content: Content::Mixed,
    attributes: &[Attribute {
        name: "type",
        aliases: &[],
        kind: Kind::Choice(&["sentence", "paragraph"]),
        default: Presence::Optional,
        doc: "What the division is.",
    }],
    required_children: &[],
    most_per_parent: None,
    role: Role::Voice(read),
};

fn read(cx: &mut Context<'_>, node: usize, fields: &Fields<'_>, voice: &mut VoiceBuilder) {
    let kind = cx.choice(fields, "type").map(|kind| match kind {
        "sentence" => DivKind::Sentence,
        _ => DivKind::Paragraph,
    });
    voice.pieces.push(Piece::DivStart {
        kind,
        span: fields.tag,
    });
    voice.content(cx, node, ELEMENT.name);
    voice.pieces.push(Piece::DivEnd);
}

#[cfg(test)]
mod tests {
    use crate::schema::testing::one;
    use crate::{ClauseKind, DivKind, Piece};

    #[test]
    fn divisions_open_and_close_around_their_text() {
        let kind = one("<voice-text time='0'><div type='SENTENCE'>Hello</div></voice-text>");
        let ClauseKind::VoiceText(text) = kind else {
            panic!()
        };
        let sentence = Some(DivKind::Sentence);
        assert!(matches!(text.pieces[0], Piece::DivStart { kind, .. } if kind == sentence));
        assert!(matches!(text.pieces[2], Piece::DivEnd));
    }
}
