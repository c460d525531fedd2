//! `null`: keeps the script running.

use super::{CLAUSE_PARENTS, Content, Element, Role};
use crate::ClauseKind;

pub(super) static ELEMENT: Element = Element {
    name: "null",
    aliases: &[],
    doc: "Does nothing, but keeps the script or the group running until its time.",
    source: "GEVH D.1.5",
    parents: CLAUSE_PARENTS,
    content: Content::Empty,
    attributes: &[],
    required_children: &[],
    most_per_parent: None,
    role: Role::Clause(|_, _, _| Some(ClauseKind::Null)),
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
