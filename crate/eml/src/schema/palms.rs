//! `palms` and its `key`.

use super::gesture_track::{self, CONTROLS, HAND, INTERPOLATION, KEY_TIME, PARENTS, SPACE};
use super::{Attribute, Content, Context, Element};
use crate::{Diagnostic, PalmKey, Track};

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text("A sequence of palm orientations."),
    decision: super::reference_text(
        "The table in GEVH lists id by mistake; a, x, y and z come from the examples. At a = 0 the fingers point in the direction of the smallest rotation from the hanging arm.",
    ),
    source: super::reference_text("GEVH D.5.4"),
    example: super::reference_text(
        "<gesture-key time='1' duration='2'><palms><key a='90' x='1.0' y='0.0' z='0.0'/></palms></gesture-key>",
    ),
    content: Content::Elements,
    attributes: &[HAND, INTERPOLATION, CONTROLS, SPACE],
    required_children: &["key"],
    max_per_parent: Some(2),
    ..Element::part("palms", PARENTS)
};

pub(super) static KEY: Element = Element {
    doc: super::reference_text(
        "A palm orientation at a time: the palm's outward normal and an angle about it.",
    ),
    source: super::reference_text("GEVH D.5.4"),
    example: super::reference_text(
        "<gesture-key time='1' duration='2'><palms><key a='90' x='1.0' y='0.0' z='0.0'/></palms></gesture-key>",
    ),
    attributes: &[
        KEY_TIME,
        Attribute::number("a", "The angle about the normal, left-hand rule.")
            .required()
            .unit("°"),
        Attribute::number("x", "The component of the normal to the speaker's left.").required(),
        Attribute::number("y", "The upward component of the normal.").required(),
        Attribute::number("z", "The backward component of the normal.").required(),
        INTERPOLATION,
        CONTROLS,
    ],
    ..Element::part("key", &["palms"])
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
        // The square must not vanish either: normalising divides by its root.
        if x * x + y * y + z * z < f64::MIN_POSITIVE {
            cx.sink.push(
                Diagnostic::error(
                    "eml::zero-axis",
                    fields.tag,
                    "the palm's normal is zero; the key is dropped",
                )
                .hint("x, y and z give the direction that the palm faces, such as z='-1' for the front"),
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
