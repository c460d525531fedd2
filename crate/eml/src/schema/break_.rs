//! `break`: a pause in speech.

use super::values::NumberOrWord;
use super::{
    Attribute, Content, Context, Element, Fields, Kind, Presence, Role, VOICE_PARENTS, VoiceBuilder,
};
use crate::{Diagnostic, Piece};

/// Pauses of SABLE's levels in milliseconds: *designed*, near Festival's mean pause
/// of 200 ms and its long one at the end of an utterance.
const LEVELS: [(&str, f64); 4] = [
    ("none", 0.0),
    ("small", 150.0),
    ("medium", 350.0),
    ("large", 800.0),
];

/// The longest pause, in milliseconds.
const LONGEST_MSEC: f64 = 60_000.0;

pub(super) static ELEMENT: Element = Element {
    name: "break",
    aliases: &[],
    doc: "Pauses in spoken text.",
    source: "GEVH D.4.5",
    parents: VOICE_PARENTS,
    content: Content::Empty,
    attributes: &[
        Attribute {
            name: "level",
            aliases: &[],
            kind: Kind::NumberOrChoice(&["large", "medium", "small", "none"]),
            default: Presence::Default("medium"),
            doc: "How long: large 800 ms, medium 350 ms, small 150 ms, none 0 ms, or a number from \
                  0 (none) to 3 (large).",
        },
        Attribute {
            name: "msec",
            aliases: &[],
            kind: Kind::Number,
            default: Presence::Optional,
            doc: "How long in milliseconds, at most 60000; counts instead of the level.",
        },
        Attribute {
            name: "type",
            aliases: &[],
            kind: Kind::Choice(&["?", "!", ".", ","]),
            default: Presence::Optional,
            doc: "The punctuation mark whose intonation goes before the pause.",
        },
    ],
    required_children: &[],
    most_per_parent: None,
    role: Role::Voice(read),
};

fn read(cx: &mut Context<'_>, node: usize, fields: &Fields<'_>, voice: &mut VoiceBuilder) {
    cx.children(node, &ELEMENT, |_, _, _| {});
    cx.choice(fields, "type");
    let of_level = match cx.number_or_choice(fields, "level") {
        Some(NumberOrWord::Number(level)) => interpolated(level),
        Some(NumberOrWord::Word(word)) => LEVELS
            .iter()
            .find(|(name, _)| *name == word)
            .map_or(0.0, |(_, msec)| *msec),
        None => 0.0,
    };
    let msec = match cx.number(fields, "msec") {
        Some(msec) if (0.0..=LONGEST_MSEC).contains(&msec) => msec,
        Some(_) => {
            cx.sink.push(Diagnostic::error(
                "eml::bad-value",
                fields.span_of("msec"),
                "a pause is from 0 to 60000 milliseconds long",
            ));
            of_level
        }
        None => of_level,
    };
    voice.pieces.push(Piece::Break {
        msec: msec.round() as u32,
        span: cx.full_span(node),
    });
}

/// A numeric level: 0 to 3 between the named ones.
fn interpolated(level: f64) -> f64 {
    let level = level.clamp(0.0, 3.0);
    let below = (level as usize).min(2);
    raconteur_base::curve::lerp(LEVELS[below].1, LEVELS[below + 1].1, level - below as f64)
}

#[cfg(test)]
mod tests {
    use crate::schema::testing::one;
    use crate::{ClauseKind, Piece};

    fn msec(attributes: &str) -> u32 {
        let kind = one(&format!(
            "<voice-text time='0'>a<break {attributes}/>b</voice-text>"
        ));
        let ClauseKind::VoiceText(text) = kind else {
            panic!()
        };
        let Piece::Break { msec, .. } = text.pieces[1] else {
            panic!()
        };
        msec
    }

    #[test]
    fn levels_have_lengths_and_msec_counts_instead() {
        assert_eq!(
            [msec(""), msec("level='large'"), msec("level='none'")],
            [350, 800, 0]
        );
        assert_eq!([msec("level='1.5'"), msec("level='99'")], [250, 800]);
        assert_eq!(msec("level='large' msec='40'"), 40);
    }
}
