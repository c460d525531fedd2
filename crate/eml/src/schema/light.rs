//! `light`: changes the key light.

use super::{Attribute, Element, Kind};
use crate::{ClauseKind, ControlSource};

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text("Changes the colour and brightness of the key light."),
    decision: super::reference_text(
        "Without one, and after by='emotion', the strongest emotion sets the lighting by table 3.2 and equations 3.1 and 3.2 of GEVH, unless r:environment disables it. A change takes at least 0.5 s, so nothing flashes.",
    ),
    source: super::reference_text("Extension; GEVH 3.5.4.2"),
    example: super::reference_text(
        "<eml xmlns:r='urn:raconteur:eml:1'><body><r:light time='0' color='#ffff00' brightness='1.2' transition='1'/></body></eml>",
    ),
    extension: true,
    one_of: &["color", "brightness", "by"],
    attributes: &[
        Attribute::choice(
            "by",
            ControlSource::WORDS,
            "Who controls the light from here on: this element, or the strongest emotion.",
        )
        .default("script"),
        Attribute::new(
            "color",
            Kind::Color,
            "The colour in sRGB; unchanged by default.",
        ),
        Attribute::between(
            "brightness",
            0.0,
            100.0,
            "The brightness: 1 is the normal brightness; unchanged by default.",
        ),
        Attribute::seconds("transition", "The duration of the change; 0 is immediate.")
            .default("0"),
    ],
    ..Element::record("light", || ClauseKind::Light(Default::default()))
};

#[cfg(test)]
mod tests {
    use crate::ClauseKind;
    use crate::schema::testing::{codes, extended};

    #[test]
    fn colours_are_read() {
        let kind = extended("<x:light time='0' color='#ffFF00'/>");
        let ClauseKind::Light(light) = kind else {
            panic!("{kind:?}")
        };
        assert_eq!((light.color, light.brightness), (Some([255, 255, 0]), None));
    }

    #[test]
    fn a_colour_has_six_digits() {
        let text = "<eml xmlns:x='urn:raconteur:eml:1'><body><null time='1'/><x:light time='0' \
                    color='yellow'/></body></eml>";
        assert_eq!(codes(text), ["eml::bad-color"]);
    }
}
