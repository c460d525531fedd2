//! `body-player-add`: adds an animation player.

use super::{Attribute, Content, Element};
use crate::{ClauseKind, PlayerKind};

/// The words for kinds of players in the source's examples.
const PLAYER_KINDS: &[(&str, &str)] = &[
    ("multipleAnimation", "multiple"),
    ("bodyGroupAnimation", "bodyGroup"),
    ("poseAnimation", "pose"),
];

/// The attributes of every element that makes a player.
pub(super) const ATTRIBUTES: &[Attribute] = &[
    Attribute::identifier(
        "name",
        "The unique name of the player; by default it is the first player, to which clauses without a name refer.",
    ),
    Attribute::choice("type", PlayerKind::WORDS, "The type of player.")
        .required()
        .word_aliases(PLAYER_KINDS),
    Attribute::integer(
        "numberOfLayers",
        1,
        64,
        "The number of layers, 2 by default; only with type multiple.",
    ),
];

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text("Adds an animation player."),
    decision: super::reference_text(
        "There is one player without a name. It is the first, even if others were added before it. The example writes multipleAnimation for multiple: this and similar words are aliases. Type pose, described in GEVH 3.2.3, is accepted.",
    ),
    source: super::reference_text("GEVH D.3.11"),
    example: super::reference_text(
        "<body-player-add time='0' name='mPlayer' type='multiple' numberOfLayers='2'><bones><bg name='torso'/></bones></body-player-add>",
    ),
    content: Content::Elements,
    attributes: ATTRIBUTES,
    ..Element::record("body-player-add", || {
        ClauseKind::PlayerAdd(Default::default())
    })
};

#[cfg(test)]
mod tests {
    use crate::schema::testing::{clause_codes, one};
    use crate::{ClauseKind, PlayerKind};

    #[test]
    fn bones_are_all_unless_it_says_otherwise() {
        let kind = one("<body-player-add time='0' name='p' type='bodyGroup'/>");
        let ClauseKind::PlayerAdd(player) = kind else {
            panic!("{kind:?}")
        };
        assert_eq!(
            (player.name.as_deref(), player.kind),
            (Some("p"), PlayerKind::BodyGroup)
        );
        assert_eq!((player.layers, player.bones), (None, None));
    }
    #[test]
    fn names_kinds_and_layers_are_checked() {
        assert_eq!(
            clause_codes("<body-player-add time='0' name='p' type='multipleAnimation'/>"),
            ["eml::alias"]
        );
        assert_eq!(
            clause_codes("<body-player-add time='0' type='pose'/>"),
            [""; 0]
        );
        let two = "<body-player-add time='0' type='pose'/><body-player-add time='1' type='pose'/>";
        assert_eq!(clause_codes(two), ["eml::duplicate-player"]);
        assert_eq!(
            clause_codes("<body-player-add time='0' name='p' type='pose' numberOfLayers='2'/>"),
            ["eml::ignored-attribute"]
        );
        assert_eq!(
            clause_codes(
                "<body-player-add time='0' name='p' type='pose'/><body-player-add time='1' name='p' type='pose'/>"
            ),
            ["eml::duplicate-player"]
        );
    }
}
