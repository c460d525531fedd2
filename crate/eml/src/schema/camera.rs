//! `camera`: takes a shot.

use super::{Attribute, Element};
use crate::{CameraAngle, ClauseKind, Lead, ShotKind};

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text("Takes a shot."),
    source: super::reference_text("Extension; GEVH 3.5.4.1"),
    decision: super::reference_text(
        "Without one, and after by='emotion', the strongest emotion chooses shot and angle by the rules of GEVH 3.5.4.1, unless r:environment says otherwise; where nothing is felt it is the shot of whoever shows the story, which players begin with: storyteller, head to chest (on a phone held upright to the waist) with the eyes on the upper third, that widens slowly where a gesture or a dance needs it. Full and medium shots make room for gestures; every shot follows a figure that vh-move leads away as far as it must.",
    ),
    example: super::reference_text(
        "<eml xmlns:r='urn:raconteur:eml:1'><body><r:camera time='0' shot='closeUp' angle='low' transition='2'/></body></eml>",
    ),
    extension: true,
    one_of: &["shot", "angle", "by"],
    attributes: &[
        Attribute::choice(
            "by",
            Lead::WORDS,
            "Who leads the camera from here on: what is written here, or the strongest emotion again.",
        )
        .default("script"),
        Attribute::choice(
            "shot",
            ShotKind::WORDS,
            "How much it shows; unchanged when left out.",
        ),
        Attribute::choice(
            "angle",
            CameraAngle::WORDS,
            "From where it looks; unchanged when left out.",
        ),
        Attribute::seconds("transition", "How long the change takes; 0 is at once.").default("0"),
    ],
    ..Element::record("camera", || ClauseKind::Camera(Default::default()))
};

#[cfg(test)]
mod tests {
    use crate::schema::testing::extended;
    use crate::{ClauseKind, ShotKind};

    #[test]
    fn shots_are_read() {
        let kind = extended("<x:camera time='0' shot='closeup' transition='2s'/>");
        let ClauseKind::Camera(camera) = kind else {
            panic!("{kind:?}")
        };
        assert_eq!((camera.shot, camera.angle), (Some(ShotKind::CloseUp), None));
        assert_eq!(camera.transition_secs, 2.0);
    }
}
