//! `vh-move`: moves the whole figure along a function.

use super::common::FUNCTION;
use super::{Content, Element};
use crate::ClauseKind;

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text("Moves and turns the whole figure along a function of time."),
    decision: super::reference_text(
        "Its position is that of the floor under the figure, in world coordinates. Before its first move, the figure stands where that move begins. The move lasts for the argument timePeriod. In a loop it continues until the next vh-move, and counts as one period long. The figure turns by the full yaw, including whole turns, and tilts the shortest way, by at most one and a half turns per second: a shorter period is extended. A pitch beyond 90° is counted from 180°: the root's frame in table A.1 of GEVH is rotated by half a turn, and the example of D.1.6, with a pitch of 180 throughout, shows a figure that leans to its side and rises. A pitch of 180 is therefore upright, like 0; upside down is a roll of 180.",
    ),
    source: super::reference_text("GEVH D.1.6"),
    example: super::reference_text(
        "<vh-move time='0' functionName='segment'><function-args><arg name='timePeriod' value='2'/><arg name='endZ' value='-20'/></function-args></vh-move>",
    ),
    content: Content::Elements,
    required_children: &["function-args"],
    attributes: &[FUNCTION[0], FUNCTION[1]],
    ..Element::record("vh-move", || ClauseKind::VhMove(Default::default()))
};

#[cfg(test)]
mod tests {
    use crate::ClauseKind;
    use crate::schema::testing::{clause_codes, one};

    #[test]
    fn the_function_and_its_period_are_kept() {
        let kind = one(
            "<vh-move time='0' functionName='segment' isLooping='1'><function-args><arg name='timePeriod' value='2.5'/></function-args></vh-move>",
        );
        let ClauseKind::VhMove(function) = kind else {
            panic!("{kind:?}")
        };
        assert!(function.is_looping, "the function repeats");
        assert_eq!(function.args.map(|a| a.period_secs()), Some(2.5));
    }
    #[test]
    fn it_needs_a_function_and_arguments() {
        assert_eq!(
            clause_codes("<vh-move time='0'><function-args/></vh-move>"),
            ["eml::missing-attribute"]
        );
        assert_eq!(
            clause_codes("<vh-move time='0' functionName='segment'/>"),
            ["eml::missing-child"]
        );
    }
}
