//! `bone`: refers to one bone.

use super::{Attribute, Element};

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text("Refers to one bone."),
    decision: super::reference_text("GEVH does not list its attribute; it is name."),
    source: super::reference_text("GEVH D.3.13, appendix A"),
    example: super::reference_text(
        "<body-player-add time='0' name='hand' type='pose'><bones><bone name='r_wrist'/></bones></body-player-add>",
    ),
    attributes: &[Attribute::identifier(
        "name",
        "The bone, with or without the prefix bone_, such as r_wrist.",
    )
    .required()],
    ..Element::part("bone", &["bones"])
};

#[cfg(test)]
mod tests {
    use crate::ClauseKind;
    use crate::schema::testing::one;

    #[test]
    fn the_prefix_is_optional() {
        let kind = one(
            "<body-player-add time='0' name='p' type='pose'><bones><bone name='bone_r_wrist'/><bone name='skull'/></bones></body-player-add>",
        );
        let ClauseKind::PlayerAdd(player) = kind else {
            panic!("{kind:?}")
        };
        let members = player.bones.unwrap().members;
        assert_eq!(
            (members[0].name.as_str(), members[1].name.as_str()),
            ("r_wrist", "skull")
        );
    }
}
