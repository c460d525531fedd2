//! `par`: parallel clauses.

use super::group::REPETITION;
use super::{CLAUSE_PARENTS, Content, Element, Role};
use crate::ClauseKind;

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text(
        "Plays its clauses simultaneously. A plain time counts from the start of the par.",
    ),
    decision: super::reference_text(
        "GEVH only says that times are relative. An expression that names a time still counts from the start of the script.",
    ),
    source: super::reference_text("GEVH D.2.5, D.2.6"),
    example: super::reference_text(
        "<par time='1' repetitionCount='2'><null time='1'/><null time='3'/></par>",
    ),
    content: Content::Elements,
    attributes: REPETITION,
    ..Element::new("par", CLAUSE_PARENTS, Role::Group(ClauseKind::Par))
};

#[cfg(test)]
mod tests {
    use crate::schema::testing::{codes, one};

    #[test]
    fn children_and_repetition_are_kept() {
        let kind = one("<par time='1' repetitionCount='3' duration='2s'><null/><null/></par>");
        let group = kind.group().unwrap();
        assert_eq!((kind.name(), group.children.len()), ("par", 2));
        assert_eq!(
            (group.repetition_count, group.iteration_secs),
            (3, Some(2.0))
        );
    }

    #[test]
    fn a_count_below_one_is_an_error() {
        let text = "<eml><body><par time='1' repetitionCount='0'><null/></par></body></eml>";
        assert_eq!(codes(text), ["eml::out-of-range"]);
    }
}
