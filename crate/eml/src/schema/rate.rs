//! `rate`: changes the speech rate.

use super::common::FOURFOLD;
use super::{Attribute, Element};
use crate::Markup;

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text("Changes the speech rate."),
    decision: super::reference_text(
        "Percentages multiply the surrounding changes. The total is limited to a factor of four from the voice's own rate.",
    ),
    source: super::reference_text("GEVH D.4.11"),
    example: super::reference_text(
        "<voice-text time='0'>Two roads <rate speed='-40%'>diverged in a yellow wood,</rate></voice-text>",
    ),
    attributes: &[Attribute::level(
        "speed",
        &["fastest", "fast", "medium", "slow", "slowest"],
        // Voices speak 100 to 250 words per minute.
        [25.0, 1000.0],
        Some(FOURFOLD),
        "A word, a signed percentage, or words per minute.",
    )
    .required()],
    ..Element::container("rate", || Markup::Rate(Default::default()))
};

#[cfg(test)]
mod tests {
    use crate::schema::testing::{clause_codes, markup};
    use crate::{Level, Markup};

    #[test]
    fn speeds_are_read() {
        let (Markup::Rate(rate), codes) = markup("<rate speed='-40%'>a</rate>") else {
            panic!()
        };
        assert_eq!(rate.speed, Level::Percent(-40.0));
        assert_eq!(codes, [""; 0]);
    }
    #[test]
    fn a_speed_is_needed() {
        assert_eq!(
            clause_codes("<voice-text time='0'><rate>a</rate></voice-text>"),
            ["eml::missing-attribute"]
        );
    }
}
