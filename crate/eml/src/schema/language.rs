//! `language`: changes the language of speech.

use super::{Attribute, Element};
use crate::Markup;

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text("Changes the language of speech."),
    source: super::reference_text("SABLE 1.0 LANGUAGE; not in GEVH"),
    example: super::reference_text(
        "<eml xmlns:r='urn:raconteur:eml:1'><body><voice-text time='0'>She said <r:language id='pt'>bom dia</r:language>.</voice-text></body></eml>",
    ),
    extension: true,
    attributes: &[
        Attribute::identifier("id", "The language's name or code.").required(),
        Attribute::identifier("code", "The character encoding."),
    ],
    ..Element::container("language", || Markup::Language(Default::default()))
};

#[cfg(test)]
mod tests {
    use crate::Markup;
    use crate::schema::testing::{clause_codes, markup};

    #[test]
    fn languages_are_kept() {
        let (Markup::Language(language), codes) =
            markup("<x:language id='pt'>bom dia</x:language>")
        else {
            panic!()
        };
        assert_eq!(language.id, "pt");
        assert_eq!(codes, [""; 0]);
    }
    #[test]
    fn it_is_no_part_of_the_language_itself() {
        assert_eq!(
            clause_codes("<voice-text time='0'><language id='pt'>a</language></voice-text>"),
            ["eml::unknown-element"]
        );
    }
}
