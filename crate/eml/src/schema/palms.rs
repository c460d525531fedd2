//! `palms` and its `key`.

use super::gesture_track::{self, HAND, KEY_TIME, PARENTS};
use super::{Attribute, Content, Context, Element, Kind, Presence, Role};
use crate::{Diagnostic, PalmKey, Track};

pub(super) static ELEMENT: Element = Element {
    name: "palms",
    aliases: &[],
    doc: "Orientations that a palm takes one after another.",
    source: "GEVH D.5.4",
    parents: PARENTS,
    content: Content::Elements,
    attributes: &[HAND],
    required_children: &["key"],
    most_per_parent: Some(2),
    role: Role::Part,
};

pub(super) static KEY: Element = Element {
    name: "key",
    aliases: &[],
    doc: "A palm orientation at a time: the palm's outward normal and an angle about it.",
    source: "GEVH D.5.4",
    parents: &["palms"],
    content: Content::Empty,
    attributes: &[
        KEY_TIME,
        Attribute {
            name: "a",
            aliases: &[],
            kind: Kind::Number,
            default: Presence::Required,
            doc: "The angle about the normal in degrees, left-hand rule.",
        },
        Attribute {
            name: "x",
            aliases: &[],
            kind: Kind::Number,
            default: Presence::Required,
            doc: "The normal's part to the speaker's left.",
        },
        Attribute {
            name: "y",
            aliases: &[],
            kind: Kind::Number,
            default: Presence::Required,
            doc: "The normal's part upwards.",
        },
        Attribute {
            name: "z",
            aliases: &[],
            kind: Kind::Number,
            default: Presence::Required,
            doc: "The normal's part to the back.",
        },
    ],
    required_children: &[],
    most_per_parent: None,
    role: Role::Part,
};

/// Reads the element.
pub(super) fn track(cx: &mut Context<'_>, node: usize, duration: f64) -> Option<Track<PalmKey>> {
    let fields = cx.fields(node, &ELEMENT);
    gesture_track::read(cx, node, &ELEMENT, &fields, duration, |cx, fields| {
        let angle_deg = cx.number(fields, "a");
        let axis = [
            cx.number(fields, "x"),
            cx.number(fields, "y"),
            cx.number(fields, "z"),
        ];
        let [Some(x), Some(y), Some(z)] = axis else {
            return None;
        };
        // The square must not vanish either: whoever normalises divides by its root.
        if x * x + y * y + z * z < f64::MIN_POSITIVE {
            cx.sink.push(
                Diagnostic::error(
                    "eml::zero-axis",
                    fields.tag,
                    "the palm's normal is zero; the key is dropped",
                )
                .hint("x, y and z say where the palm faces, such as z='-1' for the front"),
            );
            return None;
        }
        Some(PalmKey {
            angle_deg: angle_deg?,
            axis: [x, y, z],
        })
    })
}

#[cfg(test)]
mod tests {
    use crate::schema::testing::{codes, one};
    use crate::{ClauseKind, PalmKey};

    #[test]
    fn the_example_of_the_thesis_is_read() {
        let kind = one(
            "<gesture-key duration='3' handedness='right' time='3.0'><palms><key a='90' x='1.0' \
             y='0.0' z='0.0'/></palms></gesture-key>",
        );
        let ClauseKind::GestureKey(gesture) = kind else {
            panic!()
        };
        let expected = PalmKey {
            angle_deg: 90.0,
            axis: [1.0, 0.0, 0.0],
        };
        assert_eq!(gesture.palms[0].keys[0].value, expected);
    }

    #[test]
    fn a_normal_needs_a_direction() {
        let with = |key: &str| {
            codes(&format!(
                "<eml><body><gesture-key time='1' duration='2'><palms>{key}</palms></gesture-key>\
                 </body></eml>"
            ))
        };
        assert_eq!(with("<key a='0' x='0' y='0' z='0'/>"), ["eml::zero-axis"]);
        assert_eq!(
            with("<key a='0' x='1e-200' y='0' z='0'/>"),
            ["eml::zero-axis"]
        );
        assert_eq!(
            with("<key a='0' x='NaN' y='0' z='1'/>"),
            ["eml::bad-number"]
        );
        assert_eq!(
            with("<key a='0' x='1e999' y='0' z='1'/>"),
            ["eml::bad-number"]
        );
    }
}
