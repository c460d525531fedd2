//! `speaker`: changes the speaker.

use super::{Attribute, Element};
use crate::{Age, Gender, Markup};

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text("Changes the speaker."),
    decision: super::reference_text("One of its attributes is required."),
    source: super::reference_text("SABLE 1.0 SPEAKER; not in GEVH"),
    example: super::reference_text(
        "<eml xmlns:r='urn:raconteur:eml:1'><body><voice-text time='0'>And <r:speaker gender='male' age='older'>the old man</r:speaker> spoke.</voice-text></body></eml>",
    ),
    one_of: &["gender", "age", "name"],
    extension: true,
    attributes: &[
        Attribute::choice("gender", Gender::WORDS, "The speaker's sex."),
        Attribute::choice("age", Age::WORDS, "The speaker's age."),
        Attribute::identifier("name", "The voice's name."),
    ],
    ..Element::container("speaker", || Markup::Speaker(Default::default()))
};

#[cfg(test)]
mod tests {
    use crate::schema::testing::markup;
    use crate::{Gender, Markup};

    #[test]
    fn speakers_are_kept() {
        let (Markup::Speaker(speaker), codes) =
            markup("<x:speaker gender='Male' name='kal'>a</x:speaker>")
        else {
            panic!()
        };
        assert_eq!((speaker.gender, speaker.age), (Some(Gender::Male), None));
        assert_eq!(codes, [""; 0]);
    }
}
