//! `performer`: who performs, in what voice and language.

use super::{Attribute, Element};

pub(super) static ELEMENT: Element = Element {
    doc: doc!(
        "Says who performs the script, and in what voice and language. Whoever shows the story may choose otherwise."
    ),
    source: doc!("Extension; GEVH 3.1, 3.4"),
    example: doc!(
        "<eml xmlns:r='urn:raconteur:eml:1'><head><r:performer figure='papous' language='en'/></head><body><null time='1'/></body></eml>"
    ),
    extension: true,
    one_of: &["figure", "voice", "language"],
    most_per_parent: Some(1),
    attributes: &[
        Attribute::identifier("figure", doc!("The figure's name.")),
        Attribute::identifier("voice", doc!("The voice's name.")),
        Attribute::identifier(
            "language",
            doc!("The language of the speech, as in BCP 47."),
        ),
    ],
    ..Element::part("performer", &["head"])
};

#[cfg(test)]
mod tests {

    #[test]
    fn the_choice_is_kept() {
        let text = "<eml xmlns:x='urn:raconteur:eml:1'><head><x:performer figure='papous'/></head>\
                    <body><null time='1'/></body></eml>";
        let parsed = crate::parse(text);
        assert_eq!(parsed.diagnostics, []);
        assert_eq!(
            parsed.document.performer.unwrap().figure.as_deref(),
            Some("papous")
        );
    }
}
