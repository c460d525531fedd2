//! `hand-shapes` and its `key`.

use super::gesture_track::{self, HAND, KEY_TIME, PARENTS};
use super::{Attribute, Content, Context, Element, Kind, Presence, Role};
use crate::{Diagnostic, ShapeKey, Track};

/// The highest number of a Portuguese Sign Language hand shape.
const LAST_SHAPE: i64 = 60;

pub(super) static ELEMENT: Element = Element {
    name: "hand-shapes",
    aliases: &["handshapes"],
    doc: "Shapes that a hand takes one after another.",
    source: "GEVH D.5.3",
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
    doc: "A hand shape at a time.",
    source: "GEVH D.5.3",
    parents: &["hand-shapes"],
    content: Content::Empty,
    attributes: &[
        KEY_TIME,
        Attribute {
            name: "id",
            aliases: &[],
            kind: Kind::Integer {
                least: 0,
                most: i64::MAX,
            },
            default: Presence::Required,
            doc: "The number of a Portuguese Sign Language hand shape, 0 to 60.",
        },
    ],
    required_children: &[],
    most_per_parent: None,
    role: Role::Part,
};

/// Reads the element.
pub(super) fn track(cx: &mut Context<'_>, node: usize, duration: f64) -> Option<Track<ShapeKey>> {
    let fields = cx.fields(node, &ELEMENT);
    gesture_track::read(cx, node, &ELEMENT, &fields, duration, |cx, fields| {
        let id = cx.integer(fields, "id")?;
        match u8::try_from(id) {
            Ok(shape) if id <= LAST_SHAPE => Some(ShapeKey { id: shape }),
            _ => {
                let message = format!("there is no hand shape {id}; the key is dropped");
                cx.sink.push(
                    Diagnostic::error("eml::unknown-hand-shape", fields.span_of("id"), message)
                        .hint("hand shapes are numbered from 0 to 60"),
                );
                None
            }
        }
    })
}

#[cfg(test)]
mod tests {
    use crate::schema::testing::codes;

    fn with(inner: &str) -> Vec<&'static str> {
        codes(&format!(
            "<eml><body><gesture-key time='1' duration='2'>{inner}</gesture-key></body></eml>"
        ))
    }

    #[test]
    fn shapes_are_numbered_from_0_to_60() {
        assert_eq!(
            with("<hand-shapes><key id='0'/><key id='60'/></hand-shapes>"),
            [""; 0]
        );
        for (id, code) in [
            ("61", "eml::unknown-hand-shape"),
            ("4000000000000", "eml::unknown-hand-shape"),
            ("-1", "eml::bad-value"),
            ("7.5", "eml::bad-value"),
            ("claw", "eml::bad-value"),
        ] {
            assert_eq!(
                with(&format!("<hand-shapes><key id='{id}'/></hand-shapes>")),
                [code]
            );
        }
    }

    #[test]
    fn it_needs_keys_and_they_need_a_shape() {
        assert_eq!(with("<hand-shapes/>"), ["eml::missing-child"]);
        assert_eq!(
            with("<hand-shapes><key/></hand-shapes>"),
            ["eml::missing-attribute"]
        );
    }
}
