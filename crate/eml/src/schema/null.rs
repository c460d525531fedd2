//! `null`: keeps the script running.

use super::Element;
use crate::ClauseKind;

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text(
        "Does nothing, but keeps the script or the group running until its time.",
    ),
    source: super::reference_text("GEVH D.1.5"),
    example: super::reference_text("<null time='5'/>"),
    ..Element::clause("null", |_, _, _| Some(ClauseKind::Null))
};

#[cfg(test)]
mod tests {
    use crate::ClauseKind;
    use crate::schema::testing::{codes, one};

    #[test]
    fn it_holds_nothing() {
        assert_eq!(one("<null time='5'/>"), ClauseKind::Null);
        assert_eq!(
            codes("<eml><body><null time='5'>x</null></body></eml>"),
            ["eml::stray-text"]
        );
    }
}
