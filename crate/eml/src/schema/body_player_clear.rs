//! `body-player-clear`: removes all animation players.

use super::Element;
use crate::ClauseKind;

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text("Removes all animation players."),
    source: super::reference_text("GEVH D.3.16"),
    example: super::reference_text("<body-player-clear time='15'/>"),
    ..Element::clause("body-player-clear", |_, _, _| Some(ClauseKind::PlayerClear))
};

#[cfg(test)]
mod tests {
    use crate::ClauseKind;
    use crate::schema::testing::one;

    #[test]
    fn it_has_nothing_but_a_time() {
        assert_eq!(
            one("<body-player-clear time='15'/>"),
            ClauseKind::PlayerClear
        );
    }
}
