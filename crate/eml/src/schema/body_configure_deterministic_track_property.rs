//! `body-configure-deterministic-track-property`: speed, weight or switch of tracks.

use super::{Attribute, ConditionalKind, Content, Element, Kind};
use crate::{ClauseKind, TrackProperty, Transition};

const fn value(word: &'static str, kind: Kind) -> ConditionalKind {
    ConditionalKind {
        attribute: "property",
        word,
        kind,
    }
}

/// Values of each property; the maximum speed is a hundred times the recorded one.
const VALUES: &[ConditionalKind] = &[
    value(
        "speed",
        Kind::Number {
            least: -100.0,
            most: 100.0,
        },
    ),
    value(
        "weight",
        Kind::Number {
            least: 0.0,
            most: 1.0,
        },
    ),
    value("enable", Kind::Bool),
];

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text("Sets the speed, the weight or the enabled state of tracks."),
    decision: super::reference_text(
        "After each change, the weights of a player's tracks are scaled to a sum of 1 (GEVH 3.2.1).",
    ),
    source: super::reference_text("GEVH D.3.6"),
    example: super::reference_text(
        "<eml><head><body-expression-configuration><sets-configuration><set name='fullBody' type='bodyGroup'><it name='torso'/></set></sets-configuration></body-expression-configuration></head><body><body-configure-deterministic-track-property time='2.5' property='speed' newValue='0.5' duration='0' transition='linear'><tracks><ref name='fullBody'/></tracks></body-configure-deterministic-track-property></body></eml>",
    ),
    content: Content::Elements,
    required_children: &["tracks"],
    attributes: &[
        Attribute::choice("property", TrackProperty::WORDS, "The property.").required(),
        Attribute::new("newValue", Kind::NumberOrBool, "Its new value.")
            .with_conditional_kinds(VALUES)
            .required(),
        Attribute::identifier("player", "The player; by default the first one."),
        Attribute::seconds(
            "duration",
            "The duration of the change; only for speed and weight.",
        )
        .default("0"),
        Attribute::choice("transition", Transition::WORDS, "The interpolation.").default("linear"),
    ],
    ..Element::record("body-configure-deterministic-track-property", || {
        ClauseKind::DeterministicTrackProperty(Default::default())
    })
};

#[cfg(test)]
mod tests {
    use crate::schema::testing::{clause_codes, one};
    use crate::{ClauseKind, TrackProperty};

    #[test]
    fn the_example_of_the_source_is_read() {
        let kind = one(
            "<body-configure-deterministic-track-property time='2.5' property='weight' newValue='0.5' duration='2'><tracks><ly name='1'/></tracks></body-configure-deterministic-track-property>",
        );
        let ClauseKind::DeterministicTrackProperty(property) = kind else {
            panic!("{kind:?}")
        };
        assert_eq!((property.new_value, property.duration_secs), (0.5, 2.0));
        assert_eq!(property.property, TrackProperty::Weight);
    }

    #[test]
    fn each_property_has_a_range_of_its_own() {
        let property = |word: &str, value: &str| {
            clause_codes(&format!(
                "<body-configure-deterministic-track-property time='0' property='{word}' \
                 newValue='{value}'><tracks><bg name='head'/></tracks>\
                 </body-configure-deterministic-track-property>"
            ))
        };
        for (word, fine, beyond, code) in [
            ("speed", "-100", "101", "eml::out-of-range"),
            ("weight", "1", "1.01", "eml::out-of-range"),
            ("weight", "0", "-0.01", "eml::out-of-range"),
            ("Enable", "true", "0.5", "eml::bad-boolean"),
        ] {
            let codes = property(word, fine);
            assert!(codes.iter().all(|c| *c == "eml::letter-case"), "{codes:?}");
            assert_eq!(property(word, beyond), [code]);
        }
    }

    #[test]
    fn tracks_are_needed_and_a_switch_takes_no_time() {
        assert_eq!(
            clause_codes(
                "<body-configure-deterministic-track-property time='0' property='speed' newValue='1'/>"
            ),
            ["eml::missing-child"]
        );
        assert_eq!(
            clause_codes(
                "<body-configure-deterministic-track-property time='0' property='enable' newValue='1' duration='2'><tracks><ly name='1'/></tracks></body-configure-deterministic-track-property>"
            ),
            ["eml::ignored-attribute"]
        );
    }
}
