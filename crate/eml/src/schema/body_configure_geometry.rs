//! `body-configure-geometry`: switches parts of the drawing.

use super::{Attribute, Element};
use crate::{ClauseKind, FillMode, VisibleMeshes};

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text(
        "Switches what is drawn of the figure. What is left out stays as it is.",
    ),
    source: super::reference_text("GEVH D.3.4"),
    example: super::reference_text(
        "<body-configure-geometry time='0' fillMode='solid' visibleMeshes='bones'/>",
    ),
    attributes: &[
        Attribute::choice("fillMode", FillMode::WORDS, "What of a surface is drawn."),
        Attribute::flag(
            "areFramesVisible",
            "Whether the frames of the skeleton are drawn.",
        ),
        Attribute::flag(
            "areHierarchyCentersVisible",
            "Whether the centres of the hierarchy are drawn.",
        ),
        Attribute::choice(
            "visibleMeshes",
            VisibleMeshes::WORDS,
            "Which meshes are drawn.",
        ),
        Attribute::flag("areMaterialsActive", "Whether materials are drawn."),
        Attribute::flag("areTexturesActive", "Whether textures are drawn."),
        Attribute::flag(
            "areManipulatorsVisible",
            "Whether the manipulators are drawn.",
        ),
        Attribute::flag(
            "isBodyVisible",
            "Whether the body is drawn, without bones in its place.",
        )
        .extension(),
        Attribute::flag(
            "areSpringsVisible",
            "Whether the springs of the face's tissue are drawn.",
        )
        .extension(),
        Attribute::flag(
            "areMusclesVisible",
            "Whether the muscles of the face are drawn.",
        )
        .extension(),
        Attribute::flag(
            "isSkullVisible",
            "Whether the bone under the tissue of the face is drawn.",
        )
        .extension(),
    ],
    ..Element::record("body-configure-geometry", || {
        ClauseKind::ConfigureGeometry(Default::default())
    })
};

#[cfg(test)]
mod tests {
    use crate::schema::testing::{clause_codes, one};
    use crate::{ClauseKind, FillMode};

    #[test]
    fn what_is_left_out_stays() {
        let kind = one(
            "<body-configure-geometry time='0' fillMode='wireframe' areTexturesActive='false'/>",
        );
        let ClauseKind::ConfigureGeometry(geometry) = kind else {
            panic!("{kind:?}")
        };
        assert_eq!(geometry.fill_mode, Some(FillMode::Wireframe));
        assert_eq!(
            (geometry.textures_active, geometry.meshes),
            (Some(false), None)
        );
    }
    #[test]
    fn words_are_checked() {
        assert_eq!(
            clause_codes("<body-configure-geometry time='0' fillMode='solidd'/>"),
            ["eml::bad-choice"]
        );
    }
}
