//! `body-player-change-priority`: the order of players that move the same bone.

use super::{Attribute, Element};
use crate::ClauseKind;

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text("Changes the priority of an animation player."),
    decision: super::reference_text(
        "The player with the highest priority drives a bone; with equal priorities, the one added last.",
    ),
    source: super::reference_text("GEVH D.3.14"),
    example: super::reference_text("<body-player-change-priority time='5' priority='10'/>"),
    attributes: &[
        Attribute::identifier("name", "The player; by default the first one."),
        Attribute::integer(
            "priority",
            i32::MIN as i64,
            i32::MAX as i64,
            "The new priority.",
        )
        .required(),
    ],
    ..Element::record("body-player-change-priority", || {
        ClauseKind::PlayerChangePriority(Default::default())
    })
};

#[cfg(test)]
mod tests {
    use crate::ClauseKind;
    use crate::schema::testing::{clause_codes, one};

    #[test]
    fn priorities_are_whole_numbers() {
        let kind = one("<body-player-change-priority time='5' priority='-10'/>");
        let ClauseKind::PlayerChangePriority(change) = kind else {
            panic!("{kind:?}")
        };
        assert_eq!((change.name, change.priority), (None, -10));
    }
    #[test]
    fn the_player_must_exist() {
        assert_eq!(
            clause_codes("<body-player-change-priority time='5' name='nobody' priority='1'/>"),
            ["eml::unknown-player"]
        );
        assert_eq!(
            clause_codes("<body-player-change-priority time='5' priority='1.5'/>"),
            ["eml::bad-number"]
        );
    }
}
