//! `body-player-set-exclusive`: the only animation player.

use super::body_player_add::ATTRIBUTES;
use super::{Content, Element};
use crate::ClauseKind;

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text("Replaces all animation players with one."),
    source: super::reference_text("GEVH D.3.12"),
    example: super::reference_text(
        "<body-player-set-exclusive time='0' name='alone' type='pose'/>",
    ),
    content: Content::Elements,
    attributes: ATTRIBUTES,
    ..Element::record("body-player-set-exclusive", || {
        ClauseKind::PlayerSetExclusive(Default::default())
    })
};

#[cfg(test)]
mod tests {
    use crate::schema::testing::one;
    use crate::{ClauseKind, PlayerKind};

    #[test]
    fn it_is_a_player_like_others() {
        let kind = one(
            "<body-player-set-exclusive time='0' name='p' type='multiple' numberOfLayers='3'/>",
        );
        let ClauseKind::PlayerSetExclusive(player) = kind else {
            panic!("{kind:?}")
        };
        assert_eq!(
            (player.kind, player.layers),
            (PlayerKind::Multiple, Some(3))
        );
    }
}
