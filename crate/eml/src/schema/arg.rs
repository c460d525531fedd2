//! `arg`: an argument of a function.

use super::{Attribute, Element, Kind};

pub(super) static ELEMENT: Element = Element {
    doc: doc!(
        "One argument of a function. The function segment goes from startX, startY, startZ, startYaw, startPitch, startRoll to endX and so on in timePeriod seconds; what is left out stays as it is."
    ),
    decision: doc!(
        "Of several with one name the last counts, and a warning says so: the example of GEVH repeats endX where startX, endY and endZ are meant."
    ),
    source: doc!("GEVH D.1.8"),
    example: doc!(
        "<vh-move time='0' functionName='segment'><function-args><arg name='timePeriod' value='4'/><arg name='endYaw' value='90'/></function-args></vh-move>"
    ),
    attributes: &[
        Attribute::identifier("name", doc!("The argument's name.")).required(),
        Attribute::new(
            "value",
            Kind::NumberOrText,
            doc!("Its value: a number, or a text."),
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
