//! `body-configure-geometry`: switches parts of the rendering.

use super::{Attribute, Element};
use crate::{ClauseKind, FillMode, VisibleMeshes};

pub(super) static ELEMENT: Element = Element {
    doc: super::reference_text(
        "Selects what is rendered of the figure. Omitted attributes stay unchanged.",
    ),
    source: super::reference_text("GEVH D.3.4"),
    example: super::reference_text(
        "<body-configure-geometry time='0' fillMode='solid' visibleMeshes='bones'/>",
    ),
    attributes: &[
        Attribute::choice("fillMode", FillMode::WORDS, "How surfaces are rendered."),
        Attribute::flag(
            "areFramesVisible",
            "Whether the frames of the skeleton are rendered.",
        ),
        Attribute::flag(
            "areHierarchyCentersVisible",
            "Whether the centres of the hierarchy are rendered.",
        ),
        Attribute::choice(
            "visibleMeshes",
            VisibleMeshes::WORDS,
            "The rendered meshes.",
        ),
        Attribute::flag("areMaterialsActive", "Whether materials are rendered."),
        Attribute::flag("areTexturesActive", "Whether textures are rendered."),
        Attribute::flag(
            "areManipulatorsVisible",
            "Whether the manipulators are rendered.",
        ),
        Attribute::flag(
            "isBodyVisible",
            "Whether the body is rendered; no bones replace it.",
        )
        .extension(),
        Attribute::flag(
            "areSpringsVisible",
            "Whether the springs of the face's tissue are rendered.",
        )
        .extension(),
        Attribute::flag(
            "areMusclesVisible",
            "Whether the muscles of the face are rendered.",
        )
        .extension(),
        Attribute::flag(
            "isSkullVisible",
            "Whether the bone under the tissue of the face is rendered.",
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
