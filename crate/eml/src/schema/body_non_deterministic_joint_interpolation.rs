//! `body-non-deterministic-joint-interpolation`: to a target by the joints.

use super::common::{MANIPULATOR, ORIENTATION, POSITION};
use super::{Attribute, Element};
use crate::ClauseKind;

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text(
        "Moves the end effector of a limb to a target by interpolating its joints.",
    ),
    decision: super::reference_text(
        "One of staticTime and staticVelocity is required; staticTime takes precedence. A position is required; angles default to 0. With a velocity, the clause counts as having no length, because that depends on the figure.",
    ),
    source: super::reference_text("GEVH D.3.21"),
    example: super::reference_text(
        "<body-non-deterministic-joint-interpolation time='8' manipulator='leftLeg' staticTime='2' posX='7.5' posY='20' posZ='-10' roll='-90'/>",
    ),
    one_of: &["staticTime", "staticVelocity"],
    attributes: &[
        MANIPULATOR,
        Attribute::seconds("staticTime", "The duration."),
        Attribute::between(
            "staticVelocity",
            0.0,
            1e6,
            "The joint speed, instead of a duration.",
        )
        .unit("rad/s"),
        POSITION[0].required(),
        POSITION[1].required(),
        POSITION[2].required(),
        ORIENTATION[0],
        ORIENTATION[1],
        ORIENTATION[2],
    ],
    ..Element::record("body-non-deterministic-joint-interpolation", || {
        ClauseKind::JointInterpolation(Default::default())
    })
};

#[cfg(test)]
mod tests {
    use crate::ClauseKind;
    use crate::schema::testing::{clause_codes, one};

    #[test]
    fn the_target_is_in_units_and_degrees() {
        let kind = one(
            "<body-non-deterministic-joint-interpolation time='8' manipulator='leftLeg' staticTime='2s' posX='7.5' posY='20' posZ='-10' roll='-90'/>",
        );
        let ClauseKind::JointInterpolation(motion) = kind else {
            panic!("{kind:?}")
        };
        assert_eq!(motion.target.position, [7.5, 20.0, -10.0]);
        assert_eq!(motion.target.angles_deg, [0.0, 0.0, -90.0]);
        assert_eq!(motion.static_time_secs, Some(2.0));
    }
    #[test]
    fn a_time_or_a_velocity_is_needed() {
        assert_eq!(
            clause_codes(
                "<body-non-deterministic-joint-interpolation time='8' manipulator='leftLeg' posX='7.5' posY='20' posZ='-10' roll='-90'/>"
            ),
            ["eml::missing-attribute"]
        );
        assert_eq!(
            clause_codes(
                "<body-non-deterministic-joint-interpolation time='8' manipulator='leftLeg' staticTime='1' staticVelocity='1' posX='7.5' posY='20' posZ='-10' roll='-90'/>"
            ),
            ["eml::ignored-attribute"]
        );
    }
}
