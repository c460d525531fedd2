//! `volume`: changes the volume of speech.

use super::{Attribute, Element};
use crate::Markup;

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text("Changes the volume of speech."),
    decision: super::reference_text(
        "The example writes discreteLevel. GEVH says that it is SABLE's rate; VOLUME is meant. Changes in percent multiply those around them; all together are four times the voice's own at most.",
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
        "A word, a change in percent with its sign, or a gain: 1 as without it.",
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
