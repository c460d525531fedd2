//! `ly`: refers to a layer of a player.

use super::{Attribute, Element};

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text("Refers to a layer of a player."),
    decision: super::reference_text(
        "GEVH does not list its attributes; a name or a number is assumed. A name stands for the number at its end: layer1 is 1.",
    ),
    source: super::reference_text("GEVH D.3.10"),
    example: super::reference_text(
        "<body-deterministic-primitive time='0' primitive='pop'><tracks><ly index='1'/></tracks></body-deterministic-primitive>",
    ),
    one_of: &["name", "index"],
    attributes: &[
        Attribute::identifier("name", "The name of the layer."),
        Attribute::integer(
            "index",
            0,
            i32::MAX as i64,
            "The number of the layer, from 0.",
        ),
    ],
    ..Element::part("ly", &["tracks"])
};

#[cfg(test)]
mod tests {
    use crate::ClauseKind;
    use crate::schema::testing::{clause_codes, one};

    #[test]
    fn a_number_is_as_good_as_a_name() {
        let kind = one(
            "<body-deterministic-primitive time='0' primitive='pop'><tracks><ly name='a1'/><ly index='7'/></tracks></body-deterministic-primitive>",
        );
        let ClauseKind::DeterministicPrimitive(primitive) = kind else {
            panic!("{kind:?}")
        };
        let members = primitive.tracks.unwrap().members;
        assert_eq!(
            (members[0].name.as_str(), members[1].name.as_str()),
            ("a1", "7")
        );
    }
    #[test]
    fn one_of_them_is_needed() {
        assert_eq!(
            clause_codes(
                "<body-deterministic-primitive time='0' primitive='pop'><tracks><ly/></tracks></body-deterministic-primitive>"
            ),
            ["eml::missing-attribute"]
        );
    }
}
