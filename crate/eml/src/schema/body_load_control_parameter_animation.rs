//! `body-load-control-parameter-animation`: fills the library.

use super::{Attribute, Element, Kind};
use crate::ClauseKind;

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text("Loads an animation of control parameters into the library."),
    decision: super::reference_text(
        "The source does not document the file format; ours is JSON, described in docs/face.md. Paths never leave their folder.",
    ),
    source: super::reference_text("GEVH D.3.29"),
    example: super::reference_text(
        "<body-load-control-parameter-animation time='5' file='yawn.json' isResourcesRelative='true'/>",
    ),
    attributes: &[
        Attribute::new("file", Kind::Path, "The path of the file.").required(),
        Attribute::flag(
            "isResourcesRelative",
            "Whether the path is relative to the asset library instead of the folder of the story.",
        )
        .default("true"),
    ],
    ..Element::record("body-load-control-parameter-animation", || {
        ClauseKind::LoadControlParameterAnimation(Default::default())
    })
};

#[cfg(test)]
mod tests {
    use crate::ClauseKind;
    use crate::schema::testing::{clause_codes, one};

    #[test]
    fn the_library_is_meant_unless_it_says_otherwise() {
        let kind = one("<body-load-control-parameter-animation time='5' file='a/b.xml'/>");
        let ClauseKind::LoadControlParameterAnimation(load) = kind else {
            panic!("{kind:?}")
        };
        assert!(
            load.is_resources_relative,
            "the path is relative to the resources by default"
        );
        assert_eq!(load.file, "a/b.xml");
    }
    #[test]
    fn paths_stay_in_their_folder() {
        assert_eq!(
            clause_codes("<body-load-control-parameter-animation time='5' file='../secret'/>"),
            ["eml::bad-path"]
        );
    }
}
