//! `body-non-deterministic-function`: a limb along a function.

use super::common::{FUNCTION, MANIPULATOR};
use super::{Content, Element};
use crate::ClauseKind;

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text("Moves the end effector of a limb along a function of time."),
    decision: super::reference_text(
        "The arguments are those of vh-move; GEVH lost them in its example. In a loop (isLooping='true') it continues until the limb is stopped, and counts as one period long. A loop requires a timePeriod above 0; otherwise it ends automatically, with a diagnostic. The orientation turns the shortest way from the start angles to the end angles. A limb that is not at the start of the function catches up during the movement.",
    ),
    source: super::reference_text("GEVH D.3.23"),
    example: super::reference_text(
        "<body-non-deterministic-function time='0' manipulator='leftArm' functionName='segment' isLooping='false'><function-args><arg name='timePeriod' value='2'/><arg name='endY' value='40'/></function-args></body-non-deterministic-function>",
    ),
    content: Content::Elements,
    required_children: &["function-args"],
    attributes: &[MANIPULATOR, FUNCTION[0], FUNCTION[1]],
    ..Element::record("body-non-deterministic-function", || {
        ClauseKind::ManipulatorFunction(Default::default())
    })
};

#[cfg(test)]
mod tests {
    use crate::schema::testing::one;
    use crate::{ClauseKind, Manipulator};

    #[test]
    fn the_period_is_its_length() {
        let kind = one(
            "<body-non-deterministic-function time='0' manipulator='head' functionName='segment'><function-args><arg name='timePeriod' value='2'/></function-args></body-non-deterministic-function>",
        );
        let ClauseKind::ManipulatorFunction(function) = kind else {
            panic!("{kind:?}")
        };
        assert_eq!(function.manipulator, Manipulator::Head);
        assert_eq!(function.args.map(|a| a.period_secs()), Some(2.0));
    }
}
