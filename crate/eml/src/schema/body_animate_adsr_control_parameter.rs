//! `body-animate-ADSR-control-parameter`: four phases of a parameter.

use super::{Attribute, Element};
use crate::ClauseKind;

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text(
        "Drives a control parameter through attack, decay, sustain and release.",
    ),
    decision: super::reference_text(
        "Values are interpolated linearly. The D stands for decay, as in the attributes, not delay, as in the text. The example in GEVH belongs to body-set-control-parameter.",
    ),
    source: super::reference_text("GEVH D.3.28"),
    example: super::reference_text(
        "<body-animate-ADSR-control-parameter time='0' parameterId='Disgust' attackDurationTime='0.2' attackValue='1' decayDurationTime='0.1' decayValue='0.7' sustainDurationTime='1' releaseDurationTime='0.5'/>",
    ),
    attributes: &[
        Attribute::identifier("parameterId", "The parameter, such as Disgust.").required(),
        Attribute::seconds(
            "attackDurationTime",
            "The time from the previous value to the attack value.",
        )
        .default("0"),
        Attribute::number("attackValue", "The value of this phase.").default("1"),
        Attribute::seconds(
            "decayDurationTime",
            "The time from there to the decay value.",
        )
        .default("0"),
        Attribute::number("decayValue", "The value of this phase.").default("0"),
        Attribute::seconds(
            "sustainDurationTime",
            "The time for which the sustain value is held.",
        )
        .default("0"),
        Attribute::number(
            "sustainValue",
            "The sustained value; by default the decay value.",
        ),
        Attribute::seconds(
            "releaseDurationTime",
            "The time from there to the release value.",
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
