//! `bones`: the bones that a player moves.

use super::{Content, Element};

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text("Lists bones: sets, body groups and single bones."),
    decision: super::reference_text("Without it, a player drives the whole skeleton."),
    source: super::reference_text("GEVH D.3.13"),
    example: super::reference_text(
        "<body-player-add time='0' name='p' type='pose'><bones><bg name='left_arm'/><bone name='skull'/></bones></body-player-add>",
    ),
    content: Content::Elements,
    max_per_parent: Some(1),
    ..Element::part("bones", &["body-player-add", "body-player-set-exclusive"])
};

#[cfg(test)]
mod tests {
    use crate::schema::testing::clause_codes;

    #[test]
    fn there_is_one_list() {
        assert_eq!(
            clause_codes(
                "<body-player-add time='0' name='p' type='pose'><bones/><bones/></body-player-add>"
            ),
            ["eml::surplus-element"]
        );
    }
}
