//! `volume`: changes the volume of speech.

use super::{Attribute, Element};
use crate::Markup;

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text("Changes the volume of speech."),
    decision: super::reference_text(
        "The example writes discreteLevel. GEVH calls it SABLE's rate; VOLUME is meant. Percentages multiply the surrounding changes; the total is at most four times the voice's own volume.",
    ),
    source: super::reference_text("GEVH D.4.13"),
    example: super::reference_text(
        "<voice-text time='0'>Two roads <volume level='quiet'>diverged in a yellow wood</volume>.</voice-text>",
    ),
    attributes: &[Attribute::level(
        "level",
        &["loudest", "loud", "medium", "quiet"],
        [0.0, 4.0],
        Some([-100.0, 300.0]),
        "A word, a signed percentage, or a gain: 1 is the normal volume.",
    )
    .required()
    .aliases(&["discreteLevel"])],
    ..Element::container("volume", || Markup::Volume(Default::default()))
};

#[cfg(test)]
mod tests {
    use crate::schema::testing::{clause_codes, markup};
    use crate::{Level, Markup};

    #[test]
    fn levels_are_read() {
        let (Markup::Volume(volume), codes) = markup("<volume level='quiet'>a</volume>") else {
            panic!()
        };
        assert_eq!(volume.level, Level::Word("quiet"));
        assert_eq!(codes, [""; 0]);
    }
    #[test]
    fn the_example_of_the_source_is_accepted() {
        assert_eq!(
            clause_codes(
                "<voice-text time='0'><volume discreteLevel='quiet'>a</volume></voice-text>"
            ),
            ["eml::alias"]
        );
    }
}
