//! `tracks`: the tracks that a clause affects.

use super::{Content, Element};

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text("Lists tracks: sets, body groups and layers."),
    decision: super::reference_text(
        "GEVH calls its parent deterministic-track-property; body-configure-deterministic-track-property is meant.",
    ),
    source: super::reference_text("GEVH D.3.7"),
    example: super::reference_text(
        "<body-deterministic-primitive time='0' primitive='pop'><tracks><bg name='torso'/></tracks></body-deterministic-primitive>",
    ),
    content: Content::Elements,
    max_per_parent: Some(1),
    ..Element::part(
        "tracks",
        &[
            "body-configure-deterministic-track-property",
            "body-deterministic-primitive",
        ],
    )
};

#[cfg(test)]
mod tests {
    use crate::schema::testing::clause_codes;

    #[test]
    fn it_holds_no_bones() {
        assert_eq!(
            clause_codes(
                "<body-deterministic-primitive time='0' primitive='pop'><tracks><bone name='x'/></tracks></body-deterministic-primitive>"
            ),
            ["eml::wrong-parent"]
        );
    }
}
