//! `body-player-remove`: removes an animation player.

use super::{Attribute, Element};
use crate::ClauseKind;

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text("Removes an animation player."),
    source: super::reference_text("GEVH D.3.15"),
    example: super::reference_text("<body-player-remove time='7'/>"),
    attributes: &[Attribute::identifier(
        "name",
        "The player; by default the first one.",
    )],
    ..Element::record("body-player-remove", || {
        ClauseKind::PlayerRemove(Default::default())
    })
};

#[cfg(test)]
mod tests {
    use crate::ClauseKind;
    use crate::schema::testing::{clause_codes, one};

    #[test]
    fn the_first_player_is_meant_without_a_name() {
        let kind = one("<body-player-remove time='7'/>");
        let ClauseKind::PlayerRemove(remove) = kind else {
            panic!("{kind:?}")
        };
        assert_eq!(remove.name, None);
    }
    #[test]
    fn the_player_must_exist() {
        assert_eq!(
            clause_codes(
                "<body-player-add time='0' name='mPlayer' type='pose'/><body-player-remove time='7' name='mPlayre'/>"
            ),
            ["eml::unknown-player"]
        );
    }
}
