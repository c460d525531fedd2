//! `pron`: specifies the pronunciation of a text.

use super::{Attribute, Element};
use crate::Markup;

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text("Specifies the pronunciation of its content."),
    decision: super::reference_text("One of ipa and sub is required."),
    source: super::reference_text("GEVH D.4.10"),
    example: super::reference_text(
        "<voice-text time='0'>He <pron sub='lyves'>lives</pron> many <pron ipa='laɪvz'>lives</pron>.</voice-text>",
    ),
    one_of: &["ipa", "sub"],
    attributes: &[
        Attribute::text(
            "ipa",
            "The pronunciation in the International Phonetic Alphabet.",
        ),
        Attribute::text("sub", "A respelling with the wanted sound."),
        Attribute::text("origin", "The language of origin of the text."),
    ],
    ..Element::container("pron", || Markup::Pron(Default::default()))
};

#[cfg(test)]
mod tests {
    use crate::Markup;
    use crate::schema::testing::{clause_codes, markup};

    #[test]
    fn pronunciations_are_kept() {
        let (Markup::Pron(pron), codes) = markup("<pron sub='lyves' origin='en'>lives</pron>")
        else {
            panic!()
        };
        assert_eq!((pron.ipa, pron.sub.as_deref()), (None, Some("lyves")));
        assert_eq!(codes, [""; 0]);
    }
    #[test]
    fn a_pronunciation_is_needed() {
        assert_eq!(
            clause_codes("<voice-text time='0'><pron origin='en'>a</pron></voice-text>"),
            ["eml::missing-attribute"]
        );
    }
}
