//! `body-set-control-parameter`: sets a control parameter.

use super::{Attribute, Element};
use crate::ClauseKind;

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text("Sets the value of a control parameter."),
    source: super::reference_text("GEVH D.3.27"),
    example: super::reference_text(
        "<body-set-control-parameter time='0' parameterId='Disgust' value='1.0'/>",
    ),
    attributes: &[
        Attribute::identifier("parameterId", "The parameter, such as Disgust.").required(),
        Attribute::number(
            "value",
            "The value; 0 is none, 1 is full. Parameters with two directions, such as JawYaw, extend to -1.",
        )
        .required(),
    ],
    ..Element::record("body-set-control-parameter", || {
        ClauseKind::SetControlParameter(Default::default())
    })
};

#[cfg(test)]
mod tests {
    use crate::ClauseKind;
    use crate::schema::testing::{clause_codes, one};

    #[test]
    fn the_example_of_the_source_is_read() {
        let kind = one("<body-set-control-parameter time='0' parameterId='Disgust' value='1.0'/>");
        let ClauseKind::SetControlParameter(set) = kind else {
            panic!("{kind:?}")
        };
        assert_eq!((set.parameter.as_str(), set.value), ("Disgust", 1.0));
    }
    #[test]
    fn a_value_is_needed() {
        assert_eq!(
            clause_codes(
                "<body-set-control-parameter time='0' parameterId='Disgust' value='full'/>"
            ),
            ["eml::bad-number"]
        );
        assert_eq!(
            clause_codes("<body-set-control-parameter time='0' parameterId='' value='1'/>"),
            ["eml::bad-name"]
        );
    }
}
