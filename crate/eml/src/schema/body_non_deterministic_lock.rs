//! `body-non-deterministic-lock`: holds a limb.

use super::common::MANIPULATOR;
use super::{Attribute, Element};
use crate::ClauseKind;

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text(
        "Locks the end effector of a limb in its position while the rest of the body moves, or releases it.",
    ),
    source: super::reference_text("GEVH D.3.26"),
    example: super::reference_text(
        "<body-non-deterministic-lock time='0' manipulator='leftArm' isLock='true'/>",
    ),
    attributes: &[
        MANIPULATOR,
        Attribute::flag("isLock", "Whether it is locked.").required(),
    ],
    ..Element::record("body-non-deterministic-lock", || {
        ClauseKind::ManipulatorLock(Default::default())
    })
};

#[cfg(test)]
mod tests {
    use crate::ClauseKind;
    use crate::schema::testing::{clause_codes, one};

    #[test]
    fn locks_are_kept() {
        let kind =
            one("<body-non-deterministic-lock time='3' manipulator='leftArm' isLock='TRUE'/>");
        let ClauseKind::ManipulatorLock(lock) = kind else {
            panic!("{kind:?}")
        };
        assert!(lock.is_lock, "the clause is a lock");
    }
    #[test]
    fn it_says_whether() {
        assert_eq!(
            clause_codes("<body-non-deterministic-lock time='3' manipulator='leftArm'/>"),
            ["eml::missing-attribute"]
        );
        assert_eq!(
            clause_codes(
                "<body-non-deterministic-lock time='3' manipulator='leftArm' isLock='yes'/>"
            ),
            ["eml::bad-boolean"]
        );
    }
}
