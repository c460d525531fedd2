//! `gesture-key`: hand shapes, palm orientations and positions over a while.

use super::gesture_track;
use super::{Attribute, CLAUSE_PARENTS, Content, Context, Element, Fields, Kind, Presence, Role};
use super::{hand_shapes, motion, palms};
use crate::{ClauseKind, GestureKey, Handedness};

pub(super) static ELEMENT: Element = Element {
    name: "gesture-key",
    aliases: &[],
    doc: "Moves the hands through shapes, palm orientations and positions. A feature that is left \
          out keeps its value.",
    source: "GEVH D.5.2",
    parents: CLAUSE_PARENTS,
    content: Content::Elements,
    attributes: &[
        Attribute {
            name: "duration",
            aliases: &[],
            kind: Kind::Seconds,
            default: Presence::Required,
            doc: "The length of the gesture in seconds.",
        },
        Attribute {
            name: "handedness",
            aliases: &[],
            kind: Kind::Choice(&["both", "left", "right"]),
            default: Presence::Default("both"),
            doc: "The hands that take part.",
        },
    ],
    required_children: &[],
    most_per_parent: None,
    role: Role::Clause(build),
};

fn build(cx: &mut Context<'_>, node: usize, fields: &Fields<'_>) -> Option<ClauseKind> {
    let handedness = match cx.choice(fields, "handedness") {
        Some("left") => Handedness::Left,
        Some("right") => Handedness::Right,
        _ => Handedness::Both,
    };
    let duration_secs = cx.seconds(fields, "duration")?;
    let mut gesture = GestureKey {
        duration_secs,
        handedness,
        hand_shapes: Vec::new(),
        palms: Vec::new(),
        motions: Vec::new(),
    };
    cx.children(node, &ELEMENT, |cx, child, element| match element.name {
        "hand-shapes" => {
            let track = hand_shapes::track(cx, child, duration_secs);
            gesture_track::add(cx, &mut gesture.hand_shapes, track, handedness);
        }
        "palms" => {
            let track = palms::track(cx, child, duration_secs);
            gesture_track::add(cx, &mut gesture.palms, track, handedness);
        }
        _ => {
            let track = motion::track(cx, child, duration_secs);
            gesture_track::add(cx, &mut gesture.motions, track, handedness);
        }
    });
    Some(ClauseKind::GestureKey(gesture))
}

#[cfg(test)]
mod tests {
    use crate::schema::testing::{codes, one};
    use crate::{ClauseKind, Handedness};

    #[test]
    fn both_hands_take_part_unless_it_says_otherwise() {
        let ClauseKind::GestureKey(gesture) = one("<gesture-key time='1' duration='0.2s'/>") else {
            panic!()
        };
        assert_eq!(
            (gesture.duration_secs, gesture.handedness),
            (0.2, Handedness::Both)
        );
    }

    #[test]
    fn a_gesture_needs_a_length() {
        let body = |x: &str| {
            format!("<eml><body><null time='1'/><gesture-key time='1' {x}/></body></eml>")
        };
        assert_eq!(codes(&body("")), ["eml::missing-attribute"]);
        assert_eq!(codes(&body("duration='-1'")), ["eml::bad-value"]);
        assert_eq!(codes(&body("duration='long'")), ["eml::bad-time"]);
        assert_eq!(
            codes(&body("duration='1' handedness='boht'")),
            ["eml::bad-value"]
        );
    }
}
