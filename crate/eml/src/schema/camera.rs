//! `camera`: takes a shot.

use super::{Attribute, Element};
use crate::{CameraAngle, ClauseKind, ControlSource, ShotKind};

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text("Sets the shot."),
    source: super::reference_text("Extension; GEVH 3.5.4.1"),
    decision: super::reference_text(
        "Without one, and after by='emotion', the strongest emotion chooses shot and angle by the rules of GEVH 3.5.4.1, unless r:environment disables it. Without an emotion, the host's shot applies. Players begin with storyteller: head to chest (head to waist on a phone in portrait orientation) with the eyes on the upper third, widening slowly when a gesture or a dance needs it. Full and medium shots leave space for gestures. Every shot follows a figure moved by vh-move as far as necessary.",
    ),
    example: super::reference_text(
        "<eml xmlns:r='urn:raconteur:eml:1'><body><r:camera time='0' shot='closeUp' angle='low' transition='2'/></body></eml>",
    ),
    extension: true,
    one_of: &["shot", "angle", "by"],
    attributes: &[
        Attribute::choice(
            "by",
            ControlSource::WORDS,
            "Who controls the camera from here on: this element, or the strongest emotion.",
        )
        .default("script"),
        Attribute::choice(
            "shot",
            ShotKind::WORDS,
            "The distance; unchanged by default.",
        ),
        Attribute::choice(
            "angle",
            CameraAngle::WORDS,
            "The angle; unchanged by default.",
        ),
        Attribute::seconds("transition", "The duration of the change; 0 is immediate.")
            .default("0"),
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
