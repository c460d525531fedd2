//! `hand-shapes` and its `key`.

use super::gesture_track::{self, CONTROLS, HAND, INTERPOLATION, KEY_TIME, PARENTS};
use super::{Attribute, Content, Context, Element};
use crate::{Diagnostic, ShapeKey, Track};

/// The highest number of a Portuguese Sign Language hand shape.
const LAST_SHAPE: i64 = 60;

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text("A sequence of hand shapes."),

    source: super::reference_text("GEVH D.5.3"),
    example: super::reference_text(
        "<eml xmlns:r='urn:raconteur:eml:1'><body><gesture-key time='1' duration='2'><hand-shapes><key time='0' id='24'/><key time='50%' id='3' r:id2='24' r:weight='0.3'/></hand-shapes></gesture-key></body></eml>",
    ),
    content: Content::Elements,
    attributes: &[HAND, INTERPOLATION, CONTROLS],
    required_children: &["key"],
    max_per_parent: Some(2),
    ..Element::part("hand-shapes", PARENTS)
};

pub(super) static KEY: Element = Element {
    doc: super::reference_text("A hand shape at a time."),
    source: super::reference_text("GEVH D.5.3"),
    example: super::reference_text(
        "<eml xmlns:r='urn:raconteur:eml:1'><body><gesture-key time='1' duration='2'><hand-shapes><key time='0' id='24'/><key time='50%' id='3' r:id2='24' r:weight='0.3'/></hand-shapes></gesture-key></body></eml>",
    ),
    attributes: &[
        KEY_TIME,
        Attribute::integer(
            "id",
            0,
            i64::MAX,
            "The number of a Portuguese Sign Language hand shape, 0 to 60.",
        )
        .required(),
        Attribute::integer(
            "id2",
            0,
            LAST_SHAPE,
            "A second shape to blend in (GEVH 3.5.1).",
        )
        .extension(),
        Attribute::between("weight", 0.0, 1.0, "The share of the second shape.")
            .default("0.5")
            .extension(),
        INTERPOLATION,
        CONTROLS,
    ],
    ..Element::part("key", &["hand-shapes"])
};

/// Reads the element.
pub(super) fn track(cx: &mut Context<'_>, node: usize, duration: f64) -> Option<Track<ShapeKey>> {
    let fields = cx.fields(node, &ELEMENT);
    gesture_track::read(cx, node, &ELEMENT, &fields, duration, |cx, fields| {
        let id = cx.number(fields, "id")?;
        if id > LAST_SHAPE as f64 {
            let message = format!("there is no hand shape {id}; the key is dropped");
            cx.sink.push(
                Diagnostic::error("eml::unknown-hand-shape", fields.span_of("id"), message)
                    .hint("hand shapes are numbered from 0 to 60"),
            );
            return None;
        }
        let second = cx.number(fields, "id2");
        let weight = cx.number(fields, "weight");
        Some(ShapeKey {
            id: id as u8,
            blend: second.zip(weight).map(|(id, weight)| (id as u8, weight)),
        })
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
            ("-1", "eml::out-of-range"),
            ("7.5", "eml::bad-number"),
            ("claw", "eml::bad-number"),
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
