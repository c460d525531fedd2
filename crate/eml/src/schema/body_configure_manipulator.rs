//! `body-configure-manipulator`: switches a manipulator.

use super::common::MANIPULATOR;
use super::{Attribute, Element};
use crate::ClauseKind;

pub(super) static ELEMENT: Element = Element {
    doc: doc!("Switches a manipulator and its joint limits."),
    decision: doc!(
        "The manipulators are leftArm, rightArm, leftLeg, rightLeg and head; what is left out stays as it is."
    ),
    source: doc!("GEVH D.3.19"),
    example: doc!(
        "<body-configure-manipulator time='0' manipulator='leftArm' isOn='true' jointLimitsActive='false'/>"
    ),
    attributes: &[
        MANIPULATOR,
        Attribute::flag("isOn", doc!("Whether it moves its limb.")).aliases(&["is0n"]),
        Attribute::flag("jointLimitsActive", doc!("Whether its joints have limits.")),
    ],
    ..Element::record("body-configure-manipulator", || {
        ClauseKind::ConfigureManipulator(Default::default())
    })
};

#[cfg(test)]
mod tests {
    use crate::schema::testing::{clause_codes, one};
    use crate::{ClauseKind, Manipulator};

    #[test]
    fn switches_are_kept() {
        let kind = one(
            "<body-configure-manipulator time='0' manipulator='rightLeg' jointLimitsActive='0'/>",
        );
        let ClauseKind::ConfigureManipulator(c) = kind else {
            panic!("{kind:?}")
        };
        assert_eq!(c.manipulator, Manipulator::RightLeg);
        assert_eq!((c.is_on, c.joint_limits_active), (None, Some(false)));
    }
    #[test]
    fn only_known_limbs_are_manipulators() {
        assert_eq!(
            clause_codes("<body-configure-manipulator time='0' manipulator='tail'/>"),
            ["eml::bad-choice"]
        );
    }
}
