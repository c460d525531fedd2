//! `motion` and its `key`.

use super::gesture_track::{self, CONTROLS, HAND, INTERPOLATION, KEY_TIME, PARENTS, SPACE};
use super::{Attribute, Content, Context, Element};
use crate::{Coords, MotionKey, Track};

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text("A sequence of wrist positions."),
    decision: super::reference_text(
        "The table in GEVH lists id by mistake; the coordinates come from fig. 3.13. The source gives no default for coords; speaker is assumed, which puts the example's hand above the head.",
    ),
    source: super::reference_text("GEVH D.5.5"),
    example: super::reference_text(
        "<eml xmlns:r='urn:raconteur:eml:1'><body><gesture-key time='1' duration='2'><motion r:interpolation='cosine'><key time='0.1' x='-7' y='45' z='3'/><key x='-15' y='40' z='3' r:interpolation='hermite' r:controls='0 2'/></motion></gesture-key></body></eml>",
    ),
    content: Content::Elements,
    attributes: &[
        HAND,
        Attribute::choice(
            "coords",
            &["world", "speaker"],
            "Whether positions are relative to the floor of the scene or to the speaker's pelvis.",
        )
        .default("speaker"),
        INTERPOLATION,
        CONTROLS,
        SPACE,
    ],
    required_children: &["key"],
    max_per_parent: Some(2),
    ..Element::part("motion", PARENTS)
};

pub(super) static KEY: Element = Element {
    doc: super::reference_text("A position of the wrist at a time."),
    source: super::reference_text("GEVH D.5.5"),
    example: super::reference_text(
        "<eml xmlns:r='urn:raconteur:eml:1'><body><gesture-key time='1' duration='2'><motion r:interpolation='cosine'><key time='0.1' x='-7' y='45' z='3'/><key x='-15' y='40' z='3' r:interpolation='hermite' r:controls='0 2'/></motion></gesture-key></body></eml>",
    ),
    attributes: &[
        KEY_TIME,
        Attribute::number(
            "x",
            "Units to the speaker's left; the speaker is about 77 units tall.",
        )
        .required()
        .unit("units"),
        Attribute::number("y", "Units upwards.")
            .required()
            .unit("units"),
        Attribute::number("z", "Units to the back.")
            .required()
            .unit("units"),
        INTERPOLATION,
        CONTROLS,
    ],
    ..Element::part("key", &["motion"])
};

/// Reads the element.
pub(super) fn track(cx: &mut Context<'_>, node: usize, duration: f64) -> Option<Track<MotionKey>> {
    let fields = cx.fields(node, &ELEMENT);
    let coords = match cx.choice(&fields, "coords") {
        Some("world") => Coords::World,
        _ => Coords::Speaker,
    };
    gesture_track::read(cx, node, &ELEMENT, &fields, duration, |cx, fields| {
        let position = [
            cx.number(fields, "x"),
            cx.number(fields, "y"),
            cx.number(fields, "z"),
        ];
        let [Some(x), Some(y), Some(z)] = position else {
            return None;
        };
        Some(MotionKey {
            position: [x, y, z],
            coords,
        })
    })
}

#[cfg(test)]
mod tests {
    use crate::schema::testing::one;
    use crate::{ClauseKind, Coords};

    #[test]
    fn positions_count_from_the_speaker_unless_they_say_otherwise() {
        let coords = |attribute: &str| {
            let kind = one(&format!(
                "<gesture-key time='1' duration='3'><motion {attribute}><key x='-7' y='45' \
                 z='3.5'/></motion></gesture-key>"
            ));
            let ClauseKind::GestureKey(gesture) = kind else {
                panic!()
            };
            let key = &gesture.motions[0].keys[0];
            assert_eq!(key.value.position, [-7.0, 45.0, 3.5]);
            key.value.coords
        };
        assert_eq!(coords(""), Coords::Speaker);
        assert_eq!(coords("coords='World'"), Coords::World);
    }
}
