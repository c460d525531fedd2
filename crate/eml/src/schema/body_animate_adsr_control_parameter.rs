//! `body-animate-ADSR-control-parameter`: four phases of a parameter.

use super::{Attribute, Element};
use crate::ClauseKind;

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text(
        "Leads a control parameter through attack, decay, sustain and release.",
    ),
    decision: super::reference_text(
        "The course is straight from value to value. The D stands for decay, as the attributes say, not delay, as the text does. The example of GEVH belongs to body-set-control-parameter.",
    ),
    source: super::reference_text("GEVH D.3.28"),
    example: super::reference_text(
        "<body-animate-ADSR-control-parameter time='0' parameterId='Disgust' attackDurationTime='0.2' attackValue='1' decayDurationTime='0.1' decayValue='0.7' sustainDurationTime='1' releaseDurationTime='0.5'/>",
    ),
    attributes: &[
        Attribute::identifier("parameterId", "The parameter, such as Disgust.").required(),
        Attribute::seconds(
            "attackDurationTime",
            "How long the value before takes to become the attack value.",
        )
        .default("0"),
        Attribute::number("attackValue", "The value of this phase.").default("1"),
        Attribute::seconds(
            "decayDurationTime",
            "How long that takes to become the decay value.",
        )
        .default("0"),
        Attribute::number("decayValue", "The value of this phase.").default("0"),
        Attribute::seconds("sustainDurationTime", "How long the sustain value is held.")
            .default("0"),
        Attribute::number(
            "sustainValue",
            "The value that is held; the decay value when it is left out.",
        ),
        Attribute::seconds(
            "releaseDurationTime",
            "How long that takes to become the release value.",
        )
        .default("0"),
        Attribute::number("releaseValue", "The value of this phase.").default("0"),
    ],
    ..Element::record("body-animate-ADSR-control-parameter", || {
        ClauseKind::AdsrControlParameter(Default::default())
    })
};

#[cfg(test)]
mod tests {
    use crate::ClauseKind;
    use crate::schema::testing::one;

    #[test]
    fn its_length_is_the_sum_of_its_phases() {
        let kind = one(
            "<body-animate-ADSR-control-parameter time='0' parameterId='Disgust' attackDurationTime='1' decayDurationTime='0.5' sustainDurationTime='2' releaseDurationTime='0.5'/>",
        );
        let ClauseKind::AdsrControlParameter(ref adsr) = kind else {
            panic!("{kind:?}")
        };
        assert_eq!((adsr.attack_value, adsr.sustain_value), (1.0, None));
        assert_eq!(kind.own_length_secs(), 4.0);
    }
}
