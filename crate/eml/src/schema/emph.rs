//! `emph`: emphasised speech.

use super::values::NumberOrWord;
use super::{
    Attribute, Content, Context, Element, Fields, Kind, Presence, Role, VOICE_PARENTS, VoiceBuilder,
};
use crate::voice::{MODERATE_EMPHASIS, NO_EMPHASIS};

pub(super) static ELEMENT: Element = Element {
    name: "emph",
    aliases: &[],
    doc: "Emphasises spoken text.",
    source: "GEVH D.4.7",
    parents: VOICE_PARENTS,
    content: Content::Mixed,
    attributes: &[Attribute {
        name: "level",
        aliases: &[],
        kind: Kind::NumberOrChoice(&["strong", "moderate", "none", "reduced"]),
        default: Presence::Default("moderate"),
        doc: "How strongly: a word, or SABLE's number for it (strong 2, moderate 1, none 0.5, \
              reduced 0).",
    }],
    required_children: &[],
    most_per_parent: None,
    role: Role::Voice(read),
};

fn read(cx: &mut Context<'_>, node: usize, fields: &Fields<'_>, voice: &mut VoiceBuilder) {
    let level = match cx.number_or_choice(fields, "level") {
        Some(NumberOrWord::Number(level)) => level.clamp(0.0, 2.0),
        Some(NumberOrWord::Word("strong")) => 2.0,
        Some(NumberOrWord::Word("none")) => NO_EMPHASIS,
        Some(NumberOrWord::Word("reduced")) => 0.0,
        _ => MODERATE_EMPHASIS,
    };
    let outside = std::mem::replace(&mut voice.emphasis, level);
    voice.content(cx, node, ELEMENT.name);
    voice.emphasis = outside;
}

#[cfg(test)]
mod tests {
    use crate::ClauseKind;
    use crate::schema::testing::one;

    #[test]
    fn words_count_as_emphasised_from_moderate_on() {
        let kind = one(
            "<voice-text time='0'>a <emph>b <emph level='none'>c</emph></emph> <emph \
             level='Strong'>d</emph> <emph level='0.9'>e</emph></voice-text>",
        );
        let ClauseKind::VoiceText(text) = kind else {
            panic!()
        };
        let emphasized: Vec<bool> = text.words().iter().map(|w| w.emphasized).collect();
        assert_eq!(emphasized, [false, true, false, true, false]);
    }
}
