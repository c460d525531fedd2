//! `body-non-deterministic-frame-interpolation`: to a target on a straight path.

use super::common::{MANIPULATOR, ORIENTATION, POSITION};
use super::{Attribute, Element};
use crate::ClauseKind;

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text("Moves the end effector of a limb to a target in a straight line."),
    decision: super::reference_text("A position is required; angles default to 0."),
    source: super::reference_text("GEVH D.3.22"),
    example: super::reference_text(
        "<body-non-deterministic-frame-interpolation time='8' manipulator='leftLeg' timePeriod='2' posX='7.5' posY='20' posZ='-10' roll='-90'/>",
    ),
    attributes: &[
        MANIPULATOR,
        Attribute::seconds("timePeriod", "The duration.").required(),
        POSITION[0].required(),
        POSITION[1].required(),
        POSITION[2].required(),
        ORIENTATION[0],
        ORIENTATION[1],
        ORIENTATION[2],
    ],
    ..Element::record("body-non-deterministic-frame-interpolation", || {
        ClauseKind::FrameInterpolation(Default::default())
    })
};

#[cfg(test)]
mod tests {
    use crate::ClauseKind;
    use crate::schema::testing::{clause_codes, one};

    #[test]
    fn the_period_is_its_length() {
        let kind = one(
            "<body-non-deterministic-frame-interpolation time='8' manipulator='leftLeg' timePeriod='2' posX='7.5' posY='20' posZ='-10' roll='-90'/>",
        );
        let ClauseKind::FrameInterpolation(motion) = kind else {
            panic!("{kind:?}")
        };
        assert_eq!(motion.period_secs, 2.0);
        assert_eq!(motion.target.position, [7.5, 20.0, -10.0]);
    }
    #[test]
    fn a_period_and_a_position_are_needed() {
        assert_eq!(
            clause_codes(
                "<body-non-deterministic-frame-interpolation time='8' manipulator='leftLeg' posX='7.5' posY='20' posZ='-10' roll='-90'/>"
            ),
            ["eml::missing-attribute"]
        );
        assert_eq!(
            clause_codes(
                "<body-non-deterministic-frame-interpolation time='8' manipulator='leftLeg' timePeriod='2' posX='1' posZ='1'/>"
            ),
            ["eml::missing-attribute"]
        );
    }
}
