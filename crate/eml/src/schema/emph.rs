//! `emph`: emphasised speech.

use super::{Attribute, Element};
use crate::voice::{MODERATE_EMPHASIS, NO_EMPHASIS};
use crate::{Level, Markup};

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text("Emphasises spoken text."),
    source: super::reference_text("GEVH D.4.7"),
    example: super::reference_text(
        "<voice-text time='0'><emph>Two roads</emph> diverged.</voice-text>",
    ),
    attributes: &[Attribute::level(
        "level",
        &["strong", "moderate", "none", "reduced"],
        [0.0, 2.0],
        None,
        "The strength: a word, or SABLE's number for it (strong 2, moderate 1, none 0.5, reduced 0).",
    )
    .default("moderate")],
    ..Element::container("emph", || Markup::Emph(Default::default()))
};

/// Returns SABLE's number for a level of emphasis, 0 to 2.
pub(crate) fn number(level: Level) -> f64 {
    match level {
        Level::Number(level) => level.clamp(0.0, 2.0),
        Level::Word("strong") => 2.0,
        Level::Word("none") => NO_EMPHASIS,
        Level::Word("reduced") => 0.0,
        Level::Word(_) | Level::Percent(_) => MODERATE_EMPHASIS,
    }
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
