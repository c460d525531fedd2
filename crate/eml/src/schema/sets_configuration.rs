//! `sets-configuration`: the named sets.

use super::{Content, Element};

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text("Contains the named sets of tracks."),
    decision: super::reference_text(
        "The entry of set in GEVH calls it tracks-configuration, which is accepted as an alias.",
    ),
    source: super::reference_text("GEVH D.3.2"),
    example: super::reference_text(
        "<eml><head><body-expression-configuration><sets-configuration><set name='arms' type='bodyGroup'><it name='left_arm'/><it name='right_arm'/></set></sets-configuration></body-expression-configuration></head><body><null time='1'/></body></eml>",
    ),
    aliases: &["tracks-configuration"],
    content: Content::Elements,
    max_per_parent: Some(1),
    ..Element::part("sets-configuration", &["body-expression-configuration"])
};

#[cfg(test)]
mod tests {
    use crate::schema::testing::codes;

    #[test]
    fn the_other_name_of_the_source_is_accepted() {
        let text = "<eml><head><body-expression-configuration><tracks-configuration/>\
                    </body-expression-configuration></head><body><null time='1'/></body></eml>";
        assert_eq!(codes(text), ["eml::alias"]);
    }
}
