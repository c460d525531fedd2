//! `arg`: an argument of a function.

use super::{Attribute, Element, Kind};

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text(
        "One argument of a function. The functions segment, sinusoid, bezier and hermite go from startX, startY, startZ to endX and so on in timePeriod seconds; all turn from startYaw, startPitch, startRoll to endYaw and so on; what is left out stays as it is. sinusoid has a wave of amplitude in the direction acrossX and so on (up when left out), cycles times. bezier has control1X and so on and control2X, hermite startVelocityX and endVelocityX in units a second. circle, ellipse and helix go turns times round centerX and so on, at radius (the ellipse at radiusX and radiusY) in the plane that faces normalX and so on (the front when left out), from startAngle, counted from the figure's left upwards; the helix rises by rise along the normal. lemniscate is a lying eight of radius to either side, turned by tilt. Without a center they begin where the limb is.",
    ),
    decision: super::reference_text(
        "Of several with one name the last counts, and a warning says so: the example of GEVH repeats endX where startX, endY and endZ are meant.",
    ),
    source: super::reference_text("GEVH D.1.8"),
    example: super::reference_text(
        "<vh-move time='0' functionName='segment'><function-args><arg name='timePeriod' value='4'/><arg name='endYaw' value='90'/></function-args></vh-move>",
    ),
    attributes: &[
        Attribute::identifier("name", "The argument's name.").required(),
        Attribute::new(
            "value",
            Kind::NumberOrText,
            "Its value: a number, or a text.",
        )
        .required(),
    ],
    ..Element::part("arg", &["function-args"])
};

#[cfg(test)]
mod tests {
    use crate::schema::testing::{clause_codes, one};
    use crate::{ArgValue, ClauseKind};

    #[test]
    fn values_are_numbers_or_texts() {
        let kind = one(
            "<vh-move time='0' functionName='f'><function-args><arg name='a' value='1.5'/><arg name='b' value='left'/></function-args></vh-move>",
        );
        let ClauseKind::VhMove(function) = kind else {
            panic!("{kind:?}")
        };
        let args = function.args.unwrap();
        assert_eq!(args.number("a"), Some(1.5));
        assert_eq!(args.args[1].value, ArgValue::Text("left".into()));
    }
    #[test]
    fn a_repeated_name_is_reported() {
        assert_eq!(
            clause_codes(
                "<vh-move time='0' functionName='f'><function-args><arg name='a' value='1'/><arg name='a' value='2'/></function-args></vh-move>"
            ),
            ["eml::duplicate-argument"]
        );
    }
}
