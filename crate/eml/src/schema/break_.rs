//! `break`: a pause in speech.

use super::{Attribute, Context, Element, Fields, Role, VOICE_PARENTS, VoiceBuilder};
use crate::record::{Field as _, Value};
use crate::{Boundary, TextSegment};

/// Pauses of SABLE's levels in milliseconds: *designed*, near Festival's mean pause
/// of 200 ms and its long one at the end of an utterance.
const LEVELS: [(&str, f64); 4] = [
    ("none", 0.0),
    ("small", 150.0),
    ("medium", 350.0),
    ("large", 800.0),
];

/// The longest pause, in milliseconds.
const MAX_MSEC: f64 = 60_000.0;

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text("Pauses in spoken text."),
    decision: super::reference_text(
        "The lengths of the levels are designed: GEVH leaves them to the speech engine.",
    ),
    source: super::reference_text("GEVH D.4.5"),
    example: super::reference_text(
        "<voice-text time='0'>Two roads diverged, <break level='small'/> and sorry I could not travel both.</voice-text>",
    ),
    attributes: &[
        Attribute::level(
            "level",
            &["large", "medium", "small", "none"],
            [0.0, 3.0],
            None,
            "The length: large 800 ms, medium 350 ms, small 150 ms, none 0 ms, or a number from 0 (none) to 3 (large).",
        )
        .default("medium"),
        Attribute::between(
            "msec",
            0.0,
            MAX_MSEC,
            "The length; overrides the level.",
        )
        .unit("ms"),
        Attribute::choice(
            "type",
            Boundary::WORDS,
            "The punctuation mark whose intonation precedes the pause.",
        ),
    ],
    ..Element::new("break", VOICE_PARENTS, Role::Voice(read))
};

fn read(cx: &mut Context<'_>, node: usize, fields: &Fields<'_>, voice: &mut VoiceBuilder) {
    cx.children(node, &ELEMENT, |_, _, _| {});
    let mut boundary: Option<Boundary> = None;
    boundary.set(cx.value(fields, "type"));
    let of_level = match cx.value(fields, "level") {
        Value::Number(level) => interpolated(level),
        Value::Word(word) => LEVELS
            .iter()
            .find(|(name, _)| *name == word)
            .map_or(0.0, |(_, msec)| *msec),
        _ => 0.0,
    };
    let msec = cx.number(fields, "msec").unwrap_or(of_level);
    voice.pieces.push(TextSegment::Break {
        msec: msec.round() as u32,
        boundary,
        span: cx.full_span(node),
    });
}

/// Returns the pause for a numeric level, interpolated between the named levels 0 to 3.
fn interpolated(level: f64) -> f64 {
    let level = level.clamp(0.0, 3.0);
    let below = (level as usize).min(2);
    raconteur_base::curve::lerp(LEVELS[below].1, LEVELS[below + 1].1, level - below as f64)
}

#[cfg(test)]
mod tests {
    use crate::schema::testing::one;
    use crate::{ClauseKind, TextSegment};

    fn msec(attributes: &str) -> u32 {
        let kind = one(&format!(
            "<voice-text time='0'>a<break {attributes}/>b</voice-text>"
        ));
        let ClauseKind::VoiceText(text) = kind else {
            panic!()
        };
        let TextSegment::Break { msec, .. } = text.pieces[1] else {
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
        assert_eq!([msec("level='1.5'"), msec("level='3'")], [250, 800]);
        assert_eq!(msec("level='large' msec='40'"), 40);
    }
}
