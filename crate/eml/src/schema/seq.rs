//! `seq`: sequential clauses.

use super::group::REPETITION;
use super::{CLAUSE_PARENTS, Content, Element, Role};
use crate::ClauseKind;

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text(
        "Plays its clauses one after another. A plain time is the delay after the end of the previous clause, or after the start of the seq.",
    ),
    decision: super::reference_text(
        "GEVH only says that times are relative; they are read as in SMIL. An expression that names a time still counts from the start of the script.",
    ),
    source: super::reference_text("GEVH D.2.4, D.2.6"),
    example: super::reference_text(
        "<seq time='1'><event time='0' type='a'/><event time='1' type='b'/></seq>",
    ),
    content: Content::Elements,
    attributes: REPETITION,
    ..Element::new("seq", CLAUSE_PARENTS, Role::Group(ClauseKind::Seq))
};

#[cfg(test)]
mod tests {
    use crate::schema::testing::{codes, one};

    #[test]
    fn children_and_repetition_are_kept() {
        let kind = one("<seq time='1' repetitionCount='3' duration='2s'><null/><null/></seq>");
        let group = kind.group().unwrap();
        assert_eq!((kind.name(), group.children.len()), ("seq", 2));
        assert_eq!(
            (group.repetition_count, group.iteration_secs),
            (3, Some(2.0))
        );
    }

    #[test]
    fn a_count_below_one_is_an_error() {
        let text = "<eml><body><seq time='1' repetitionCount='0'><null/></seq></body></eml>";
        assert_eq!(codes(text), ["eml::out-of-range"]);
    }
}
