//! `body-non-deterministic-fk`: sets joints.

use super::common::MANIPULATOR;
use super::{Attribute, Element};
use crate::ClauseKind;

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text("Sets the joint angles of a manipulator."),
    decision: super::reference_text(
        "The example writes nJoint. Without it, as many joints move as angles are given. All angles zero is the neutral pose: arms hanging with the palms to the thighs, legs standing, head upright. For a limb, j1 abducts, j2 lifts to the front, j3 bends elbow or knee, j4 rotates forearm or shank, j5 bends the wrist towards the thumb or the toes down, j6 bends the wrist towards the palm or the sole outwards. For the head, j1 and j2 tilt the neck to the left and forwards, j3 turns the head to the left, j4 nods and j5 tilts it. Equal angles on both sides mirror each other. GEVH gives the clause no time, because it sets the joints. To avoid jumps, the movement takes half a second, and proportionally longer for an angle beyond 90°, whatever the limb did before; r:smooth='false' behaves as in GEVH.",
    ),
    source: super::reference_text("GEVH D.3.20"),
    example: super::reference_text(
        "<body-non-deterministic-fk time='0' manipulator='leftArm' nJoints='6' j1='90' j2='45' j3='0' j4='0' j5='0' j6='0'/>",
    ),
    attributes: &[
        MANIPULATOR,
        Attribute::integer(
            "nJoints",
            1,
            6,
            "The number of joints of the manipulator: 6, or 5 for the head.",
        )
        .aliases(&["nJoint"]),
        Attribute::placed("j1", "The angle of joint 1; unchanged by default.").unit("°"),
        Attribute::placed("j2", "The angle of joint 2; unchanged by default.").unit("°"),
        Attribute::placed("j3", "The angle of joint 3; unchanged by default.").unit("°"),
        Attribute::placed("j4", "The angle of joint 4; unchanged by default.").unit("°"),
        Attribute::placed("j5", "The angle of joint 5; unchanged by default.").unit("°"),
        Attribute::placed("j6", "The angle of joint 6; unchanged by default.").unit("°"),
        Attribute::flag(
            "smooth",
            "Whether the joints move smoothly; otherwise they change immediately, in the same frame.",
        )
        .default("true")
        .extension(),
    ],
    ..Element::record("body-non-deterministic-fk", || {
        ClauseKind::ForwardKinematics(Default::default())
    })
};

#[cfg(test)]
mod tests {
    use crate::ClauseKind;
    use crate::schema::testing::{clause_codes, extended, one};

    #[test]
    fn angles_that_are_left_out_stay() {
        let kind =
            one("<body-non-deterministic-fk time='0' manipulator='leftArm' j1='90' j3='-5'/>");
        let ClauseKind::ForwardKinematics(fk) = kind else {
            panic!("{kind:?}")
        };
        assert_eq!(
            fk.joints_deg,
            [Some(90.0), None, Some(-5.0), None, None, None]
        );
    }
    #[test]
    fn it_takes_the_time_that_is_told() {
        let secs = |more: &str| {
            let fk = "<body-non-deterministic-fk time='0' manipulator='head' ";
            extended(&format!("{fk}{more}/>")).own_length_secs()
        };
        assert_eq!(secs("j1='20'"), 0.5);
        assert_eq!(secs("j1='20' j3='-135'"), 0.75);
        assert_eq!(secs("j1='20' x:smooth='false'"), 0.0);
    }
    #[test]
    fn surplus_joints_are_reported() {
        assert_eq!(
            clause_codes("<body-non-deterministic-fk time='0' manipulator='head' j6='1'/>"),
            ["eml::ignored-attribute"]
        );
        assert_eq!(
            clause_codes(
                "<body-non-deterministic-fk time='0' manipulator='head' nJoints='2' j3='1'/>"
            ),
            ["eml::ignored-attribute"]
        );
        assert_eq!(
            clause_codes("<body-non-deterministic-fk time='0' manipulator='leftArm'/>"),
            ["eml::ignored-attribute"]
        );
        assert_eq!(
            clause_codes(
                "<body-non-deterministic-fk time='0' manipulator='leftArm' nJoint='1' j1='1'/>"
            ),
            ["eml::alias"]
        );
    }
}
