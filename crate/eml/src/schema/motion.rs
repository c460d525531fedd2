//! `motion` and its `key`.

use super::gesture_track::{self, HAND, KEY_TIME, PARENTS};
use super::{Attribute, Content, Context, Element, Kind, Presence, Role};
use crate::{Coords, MotionKey, Track};

pub(super) static ELEMENT: Element = Element {
    name: "motion",
    aliases: &[],
    doc: "Positions that a wrist passes one after another.",
    source: "GEVH D.5.5",
    parents: PARENTS,
    content: Content::Elements,
    attributes: &[
        HAND,
        Attribute {
            name: "coords",
            aliases: &[],
            kind: Kind::Choice(&["world", "speaker"]),
            default: Presence::Default("speaker"),
            doc: "Whether positions count from the floor of the scene or from the speaker's pelvis.",
        },
    ],
    required_children: &["key"],
    most_per_parent: Some(2),
    role: Role::Part,
};

pub(super) static KEY: Element = Element {
    name: "key",
    aliases: &[],
    doc: "A position of the wrist at a time.",
    source: "GEVH D.5.5",
    parents: &["motion"],
    content: Content::Empty,
    attributes: &[
        KEY_TIME,
        Attribute {
            name: "x",
            aliases: &[],
            kind: Kind::Number,
            default: Presence::Required,
            doc: "Units to the speaker's left; the speaker is about 77 units tall.",
        },
        Attribute {
            name: "y",
            aliases: &[],
            kind: Kind::Number,
            default: Presence::Required,
            doc: "Units upwards.",
        },
        Attribute {
            name: "z",
            aliases: &[],
            kind: Kind::Number,
            default: Presence::Required,
            doc: "Units to the back.",
        },
    ],
    required_children: &[],
    most_per_parent: None,
    role: Role::Part,
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
