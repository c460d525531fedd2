//! `set`: a named set of tracks.

use super::{Attribute, Content, Element};
use crate::SetKind;

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text(
        "Names a set of layers or of body groups, which may contain other sets.",
    ),
    decision: super::reference_text(
        "A reference to an undefined set is a warning and counts as empty, as in the example in GEVH; sets that contain each other are an error. In addition to the groups of the example, left_leg and right_leg exist.",
    ),
    source: super::reference_text("GEVH D.3.3"),
    example: super::reference_text(
        "<eml><head><body-expression-configuration><sets-configuration><set name='arms' type='bodyGroup'><it name='left_arm'/><it name='right_arm'/></set><set name='upperBody' type='bodyGroup'><it name='torso'/><ref name='arms'/></set></sets-configuration></body-expression-configuration></head><body><null time='1'/></body></eml>",
    ),
    content: Content::Elements,
    attributes: &[
        Attribute::identifier("name", "The set's name.").required(),
        Attribute::choice(
            "type",
            SetKind::WORDS,
            "Its members: layers of a player (multiple) or body groups (bodyGroup).",
        )
        .required(),
    ],
    ..Element::part("set", &["sets-configuration"])
};

#[cfg(test)]
mod tests {
    use crate::items_of;
    use crate::schema::testing::codes;

    fn head(sets: &str) -> String {
        format!(
            "<eml><head><body-expression-configuration><sets-configuration>{sets}\
             </sets-configuration></body-expression-configuration></head><body><null time='1'/>\
             </body></eml>"
        )
    }

    #[test]
    fn sets_come_to_their_items_through_other_sets() {
        let parsed = crate::parse(&head(
            "<set name='arms' type='bodyGroup'><it name='left_arm'/><it name='right_arm'/></set>\
             <set name='all' type='bodyGroup'><it name='head'/><ref name='arms'/></set>",
        ));
        assert_eq!(parsed.diagnostics, []);
        let items = items_of(&parsed.document.sets, "all");
        assert_eq!(items, ["head", "left_arm", "right_arm"]);
    }

    #[test]
    fn references_to_nothing_cycles_and_repeated_names_are_reported() {
        let with = |sets: &str| codes(&head(sets));
        let set = "<set name='a' type='bodyGroup'>";
        assert_eq!(
            with(&format!("{set}<ref name='b'/></set>")),
            ["eml::unknown-set"]
        );
        assert_eq!(
            with(&format!("{set}<it name='tail'/></set>")),
            ["eml::unknown-body-group"]
        );
        assert_eq!(
            with(&format!("{set}<ref name='a'/></set>")),
            ["eml::set-cycle"]
        );
        assert_eq!(
            with(&format!("{set}</set>{set}</set>")),
            ["eml::duplicate-set"]
        );
        let other = "<set name='b' type='bodyGroup'><ref name='a'/></set>";
        let text = head(&format!(
            "{set}<it name='head'/><ref name='b'/></set>{other}"
        ));
        assert_eq!(codes(&text), ["eml::set-cycle"]);
        assert_eq!(items_of(&crate::parse(&text).document.sets, "b"), ["head"]);
    }
}
