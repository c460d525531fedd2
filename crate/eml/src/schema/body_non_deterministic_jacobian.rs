//! `body-non-deterministic-jacobian`: a limb by inverse velocity.

use super::common::{MANIPULATOR, ORIENTATION, POSITION};
use super::{Attribute, Element};
use crate::ClauseKind;

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text(
        "Moves the end effector of a limb by inverse velocity: to a target, or at given velocities until it is stopped.",
    ),
    decision: super::reference_text(
        "It has no length: with a target it runs until it reaches it, otherwise until the limb is stopped. Numbers default to 0. It starts and ends gently, is damped where joints cannot follow, and is abandoned after 8 s if a target is not reached. Velocities apply until the limb gets another command or comes to rest at its limits; otherwise for at most ten minutes.",
    ),
    source: super::reference_text("GEVH D.3.24"),
    example: super::reference_text(
        "<body-non-deterministic-jacobian time='8' manipulator='leftLeg' isStaticTarget='true' posX='7.5' posY='20' posZ='-10' roll='-90'/>",
    ),
    attributes: &[
        MANIPULATOR,
        Attribute::flag("isStaticTarget", "Whether it moves to a target.").required(),
        POSITION[0].default("0"),
        POSITION[1].default("0"),
        POSITION[2].default("0"),
        ORIENTATION[0],
        ORIENTATION[1],
        ORIENTATION[2],
        Attribute::placed("cartesianX", "Velocity along x.")
            .default("0")
            .unit("units/s"),
        Attribute::placed("cartesianY", "Velocity along y.")
            .default("0")
            .unit("units/s"),
        Attribute::placed("cartesianZ", "Velocity along z.")
            .default("0")
            .unit("units/s"),
        Attribute::placed("angularX", "Angular velocity about x.")
            .default("0")
            .unit("°/s"),
        Attribute::placed("angularY", "Angular velocity about y.")
            .default("0")
            .unit("°/s"),
        Attribute::placed("angularZ", "Angular velocity about z.")
            .default("0")
            .unit("°/s"),
    ],
    ..Element::record("body-non-deterministic-jacobian", || {
        ClauseKind::Jacobian(Default::default())
    })
};

#[cfg(test)]
mod tests {
    use crate::ClauseKind;
    use crate::schema::testing::{clause_codes, one};

    #[test]
    fn velocities_are_kept() {
        let kind = one(
            "<body-non-deterministic-jacobian time='8' manipulator='leftLeg' isStaticTarget='false' cartesianX='1' angularZ='45'/>",
        );
        let ClauseKind::Jacobian(jacobian) = kind else {
            panic!("{kind:?}")
        };
        assert_eq!(jacobian.velocity, [1.0, 0.0, 0.0]);
        assert_eq!(jacobian.angular_velocity_deg, [0.0, 0.0, 45.0]);
    }
    #[test]
    fn a_target_and_velocities_exclude_each_other() {
        assert_eq!(
            clause_codes(
                "<body-non-deterministic-jacobian time='8' manipulator='leftLeg' isStaticTarget='true' posX='1' cartesianX='1'/>"
            ),
            ["eml::ignored-attribute"]
        );
        assert_eq!(
            clause_codes(
                "<body-non-deterministic-jacobian time='8' manipulator='leftLeg' isStaticTarget='false' posX='1'/>"
            ),
            ["eml::ignored-attribute"]
        );
    }
}
