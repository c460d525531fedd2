//! `engine`: speaks another text on one speech engine.

use super::{Attribute, Element};
use crate::Markup;

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text("Replaces the content on one speech engine."),
    source: super::reference_text("GEVH D.4.8"),
    example: super::reference_text(
        "<voice-text time='0'>An example is <engine id='festival' data='our own synthesizer'>the synthesizer</engine>.</voice-text>",
    ),
    attributes: &[
        Attribute::identifier("id", "The engine's name.").required(),
        Attribute::text("data", "The text spoken instead of the content.").required(),
    ],
    ..Element::container("engine", || Markup::Engine(Default::default()))
};

#[cfg(test)]
mod tests {
    use crate::Markup;
    use crate::schema::testing::markup;

    #[test]
    fn the_other_text_is_kept() {
        let (Markup::Engine(engine), codes) = markup("<engine id='festival' data='a b'>c</engine>")
        else {
            panic!()
        };
        assert_eq!(
            (engine.id.as_str(), engine.data.as_str()),
            ("festival", "a b")
        );
        assert_eq!(codes, [""; 0]);
    }
}
