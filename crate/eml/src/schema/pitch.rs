//! `pitch`: changes the pitch of speech.

use super::common::FOURFOLD;
use super::{Attribute, Element};
use crate::Markup;

/// SABLE's words for heights.
const HEIGHTS: &[&str] = &["highest", "high", "medium", "low", "lowest", "default"];

/// SABLE's words for a range: those for heights, and its own.
const RANGES: &[&str] = &[
    "highest", "high", "medium", "low", "lowest", "default", "largest", "large", "small",
    "smallest",
];

/// Frequencies in hertz within [`FOURFOLD`] of some voice: pitch is at 80 to 500 Hz, and its range
/// may be a tenth of that.
const HERTZ: [f64; 2] = [2.0, 2000.0];

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text("Changes the pitch of speech."),
    decision: super::reference_text(
        "SABLE's own words for a range, largest to smallest, are also accepted, and its med for middle. Percentages multiply the surrounding changes. The total is limited to a factor of four from the voice's own value.",
    ),
    source: super::reference_text("GEVH D.4.9"),
    example: super::reference_text(
        "<voice-text time='0'>The penguin, <pitch base='-30%'>which he left at home,</pitch> could not enter.</voice-text>",
    ),
    attributes: &[
        Attribute::level(
            "base",
            HEIGHTS,
            HERTZ,
            Some(FOURFOLD),
            "The base line: a word, a signed percentage, or hertz.",
        ),
        Attribute::level(
            "middle",
            HEIGHTS,
            HERTZ,
            Some(FOURFOLD),
            "The middle line: a word, a signed percentage, or hertz.",
        )
        .aliases(&["med"]),
        Attribute::level(
            "range",
            RANGES,
            HERTZ,
            Some(FOURFOLD),
            "The range: a word, a signed percentage, or hertz.",
        ),
    ],
    ..Element::container("pitch", || Markup::Pitch(Default::default()))
};

#[cfg(test)]
mod tests {
    use crate::schema::testing::{clause_codes, markup};
    use crate::{Level, Markup};

    #[test]
    fn words_changes_and_hertz_are_read() {
        let (Markup::Pitch(pitch), codes) =
            markup("<pitch base='-30%' middle='HIGH' range='40'>a</pitch>")
        else {
            panic!()
        };
        assert_eq!(pitch.base, Some(Level::Percent(-30.0)));
        assert_eq!(pitch.middle, Some(Level::Word("high")));
        assert_eq!(pitch.range, Some(Level::Number(40.0)));
        assert_eq!(codes, [""; 0]);
    }
    #[test]
    fn other_spellings_of_sable_are_accepted() {
        assert_eq!(
            clause_codes(
                "<voice-text time='0'><pitch med='low' range='largest'>a</pitch></voice-text>"
            ),
            ["eml::alias"]
        );
        assert_eq!(
            clause_codes("<voice-text time='0'><pitch base='deep'>a</pitch></voice-text>"),
            ["eml::bad-choice"]
        );
    }
}
