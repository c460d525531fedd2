//! `posture`: the spine and the shoulder girdle.

use super::{Attribute, Element};
use crate::ClauseKind;

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text(
        "Moves the spine and the shoulder girdle to a posture, which stays until the next one. The figure's own motion is added to it: breath, weight, and what its gestures do with the trunk.",
    ),
    decision: super::reference_text(
        "Angles that are left out are 0: a posture without angles is the upright one. The arms of gestures keep their places, as far as they reach them.",
    ),
    source: super::reference_text("Extension; GEVH 3.3, D.3"),
    example: super::reference_text(
        "<eml xmlns:r='urn:raconteur:eml:1'><body><r:posture time='0' lean='12' turn='-20' leftShoulder='8'/><r:posture time='3'/></body></eml>",
    ),
    extension: true,
    attributes: &[
        Attribute::between("lean", -20.0, 40.0, "Lean of the trunk to the front.")
            .default("0")
            .unit("°"),
        Attribute::between("tilt", -25.0, 25.0, "Tilt of the trunk to its left.")
            .default("0")
            .unit("°"),
        Attribute::between("turn", -45.0, 45.0, "Turn of the trunk to its left.")
            .default("0")
            .unit("°"),
        Attribute::between(
            "leftShoulder",
            -8.0,
            20.0,
            "Elevation of the left shoulder.",
        )
        .default("0")
        .unit("°"),
        Attribute::between(
            "rightShoulder",
            -8.0,
            20.0,
            "Elevation of the right shoulder.",
        )
        .default("0")
        .unit("°"),
        Attribute::between("duration", 0.2, 3.0, "The duration of the movement.")
            .default("0.8")
            .unit("s"),
    ],
    ..Element::record("posture", || ClauseKind::Posture(Box::default()))
};

#[cfg(test)]
mod tests {
    use crate::ClauseKind;
    use crate::schema::testing::{codes, extended};

    #[test]
    fn a_posture_is_upright_where_it_says_nothing() {
        let eml = "<x:posture time='1' lean='12' leftShoulder='-4.5'/>";
        let kind = extended(eml);
        assert_eq!(kind.own_length_secs(), 0.8, "its movement takes time");
        let ClauseKind::Posture(posture) = kind else {
            panic!("{eml}")
        };
        assert_eq!(
            [posture.lean_deg, posture.tilt_deg, posture.turn_deg],
            [12.0, 0.0, 0.0]
        );
        assert_eq!(
            [posture.left_shoulder_deg, posture.right_shoulder_deg],
            [-4.5, 0.0]
        );
    }

    #[test]
    fn a_posture_is_one_that_people_take() {
        let found = codes(
            "<eml xmlns:x='urn:raconteur:eml:1'><body><x:posture time='0' lean='90' turn='left' \
             duration='0'/></body></eml>",
        );
        assert_eq!(
            found,
            ["eml::out-of-range", "eml::bad-number", "eml::out-of-range"]
        );
    }
}
