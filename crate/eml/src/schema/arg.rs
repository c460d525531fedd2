//! `arg`: an argument of a function.

use super::{Attribute, Element, Kind};

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text(
        "One argument of a function. segment, sinusoid, bezier and hermite go from startX, startY, startZ to endX, endY, endZ in timePeriod seconds. All functions turn from startYaw, startPitch, startRoll to endYaw, endPitch, endRoll. Omitted values stay unchanged. sinusoid adds a wave of amplitude in the direction acrossX, acrossY, acrossZ (up by default), with the given number of cycles. bezier has the control points control1X… and control2X…, hermite has startVelocityX… and endVelocityX… in units per second. circle, ellipse and helix make the given number of turns around centerX…, at radius (ellipse: radiusX and radiusY), in the plane that faces normalX… (the front by default), from startAngle, counted from the figure's left upwards. helix rises by rise along the normal. lemniscate is a horizontal figure of eight with radius to either side, rotated by tilt. Without a center, these begin at the limb's current position.",
    ),
    decision: super::reference_text(
        "If several arguments have the same name, the last one counts, with a warning: the example in GEVH repeats endX where startX, endY and endZ are meant.",
    ),
    source: super::reference_text("GEVH D.1.8"),
    example: super::reference_text(
        "<vh-move time='0' functionName='segment'><function-args><arg name='timePeriod' value='4'/><arg name='endYaw' value='90'/></function-args></vh-move>",
    ),
    attributes: &[
        Attribute::identifier("name", "The name of the argument.").required(),
        Attribute::new(
            "value",
            Kind::NumberOrText,
            "The value: a number or a text.",
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
