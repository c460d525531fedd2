//! `body-non-deterministic-stop`: stops a limb.

use super::{Attribute, Element};
use crate::{ClauseKind, Manipulator};

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text("Stops a manipulator."),
    source: super::reference_text("GEVH D.3.25"),
    example: super::reference_text("<body-non-deterministic-stop time='3' manipulator='leftArm'/>"),
    attributes: &[
        Attribute::choice("manipulator", Manipulator::WORDS, "The limb, or the head.").required(),
    ],
    ..Element::record("body-non-deterministic-stop", || {
        ClauseKind::ManipulatorStop(Default::default())
    })
};

#[cfg(test)]
mod tests {
    use crate::schema::testing::one;
    use crate::{ClauseKind, Manipulator};

    #[test]
    fn the_limb_is_kept() {
        let kind = one("<body-non-deterministic-stop time='3' manipulator='LEFTARM'/>");
        let ClauseKind::ManipulatorStop(stop) = kind else {
            panic!("{kind:?}")
        };
        assert_eq!(stop.manipulator, Manipulator::LeftArm);
    }
}
