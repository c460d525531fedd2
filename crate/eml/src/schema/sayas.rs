//! `sayas`: specifies the kind of a text, and thereby its reading.

use super::{Attribute, Element};
use crate::{Markup, SayAsMode, SayAsType};

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text("Specifies the type of a text, and so how it is read out."),
    decision: super::reference_text("GEVH calls it SABLE's rate; SAYAS is meant."),
    source: super::reference_text("GEVH D.4.12"),
    example: super::reference_text(
        "<voice-text time='0'>A year <sayas mode='date' modetype='YMD'>1998</sayas>, an ordinal <sayas mode='ordinal'>1998</sayas></voice-text>",
    ),
    attributes: &[
        Attribute::choice("mode", SayAsMode::WORDS, "The type of the text.").required(),
        Attribute::choice(
            "modetype",
            SayAsType::WORDS,
            "The order of the parts of a date or a time, or the kind of internet address.",
        ),
    ],
    ..Element::container("sayas", || Markup::SayAs(Default::default()))
};

#[cfg(test)]
mod tests {
    use crate::schema::testing::{clause_codes, markup};
    use crate::{Markup, SayAsMode, SayAsType};

    #[test]
    fn modes_are_read() {
        let (Markup::SayAs(say), codes) =
            markup("<sayas mode='Date' modetype='dmy'>1/2/98</sayas>")
        else {
            panic!()
        };
        assert_eq!(
            (say.mode, say.mode_type),
            (SayAsMode::Date, Some(SayAsType::Dmy))
        );
        assert_eq!(codes, [""; 0]);
    }
    #[test]
    fn a_mode_is_needed() {
        assert_eq!(
            clause_codes("<voice-text time='0'><sayas modetype='DMY'>a</sayas></voice-text>"),
            ["eml::missing-attribute"]
        );
    }
}
