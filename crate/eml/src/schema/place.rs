//! `place`: the place of a referent on the stage.

use super::{Attribute, Element};
use crate::ClauseKind;

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text(
        "Gives a referent of the speech a place on the stage: from its time on, head and gaze turn to the place when the speech mentions the referent.",
    ),
    decision: super::reference_text(
        "A later place of the same name moves the referent, which keeps its words and may get more. Case and surrounding punctuation of words do not matter, and the endings 's, s, es, n and en also count. Mentions before its time have no place.",
    ),
    source: super::reference_text("Extension; So et al. 2009"),
    example: super::reference_text(
        "<eml xmlns:r='urn:raconteur:eml:1'><body><r:place time='0' name='goat' x='40' words='goat nanny'/><voice-text time='0'>The goat was in the house.</voice-text></body></eml>",
    ),
    extension: true,
    attributes: &[
        Attribute::identifier("name", "The name of the referent.").required(),
        Attribute::number("x", "Units to the speaker's left, as in a key of motion.")
            .default("0")
            .unit("units"),
        Attribute::number("y", "Units upwards from the speaker's pelvis.")
            .default("20")
            .unit("units"),
        Attribute::number("z", "Units to the back.")
            .default("-30")
            .unit("units"),
        Attribute::text(
            "words",
            "The words that mention the referent, with spaces between them; by default its name.",
        ),
    ],
    ..Element::record("place", || ClauseKind::Place(Box::default()))
};

#[cfg(test)]
mod tests {
    use crate::ClauseKind;
    use crate::schema::testing::{codes, extended};

    #[test]
    fn a_place_is_read_and_stands_in_front_by_default() {
        for (eml, position, words) in [
            ("<x:place time='1' name='goat'/>", [0.0, 20.0, -30.0], None),
            (
                "<x:place time='1' name='goat' x='-40' y='8.5' z='3' words='goat Ziege'/>",
                [-40.0, 8.5, 3.0],
                Some("goat Ziege"),
            ),
        ] {
            let ClauseKind::Place(place) = extended(eml) else {
                panic!("{eml}")
            };
            assert_eq!(place.name, "goat", "{eml}");
            assert_eq!([place.x, place.y, place.z], position, "{eml}");
            assert_eq!(place.words.as_deref(), words, "{eml}");
        }
    }

    #[test]
    fn a_place_needs_a_name_and_finite_numbers() {
        let found = |attributes: &str| {
            codes(&format!(
                "<eml xmlns:x='urn:raconteur:eml:1'><body><null time='1'/>\
                 <x:place time='0' {attributes}/></body></eml>"
            ))
        };
        assert_eq!(found(""), ["eml::missing-attribute"], "no name");
        assert_eq!(
            found("name='goat' x='NaN'"),
            ["eml::bad-number"],
            "no number"
        );
        assert_eq!(
            found("name='goat' x='10000000'"),
            ["eml::bad-number"],
            "too far"
        );
    }
}
