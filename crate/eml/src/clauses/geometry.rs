//! How the figure is drawn, for those who look at its making (GEVH D.3.4).

use crate::record::{record, words};

words! {
    /// What of a surface is drawn.
    FillMode {
        /// The surface.
        Solid = "solid",
        /// The edges of its triangles.
        Wireframe = "wireframe",
        /// Their corners.
        Point = "point",
    }
}

words! {
    /// Which meshes are drawn.
    VisibleMeshes {
        /// The body.
        Body = "body",
        /// The bones.
        Bones = "bones",
        /// Both.
        Both = "both",
    }
}

record! {
    /// Switches of the drawing; `None` keeps a setting.
    ConfigureGeometry = "body-configure-geometry" {
        /// What of a surface is drawn.
        fill_mode: Option<FillMode> = "fillMode",
        /// Whether the frames of the bones are drawn.
        frames_visible: Option<bool> = "areFramesVisible",
        /// Whether the centres of the hierarchy are drawn.
        centers_visible: Option<bool> = "areHierarchyCentersVisible",
        /// Which meshes are drawn.
        meshes: Option<VisibleMeshes> = "visibleMeshes",
        /// Whether materials are used.
        materials_active: Option<bool> = "areMaterialsActive",
        /// Whether textures are used.
        textures_active: Option<bool> = "areTexturesActive",
        /// Whether the manipulators are drawn.
        manipulators_visible: Option<bool> = "areManipulatorsVisible",
        /// Whether the body is drawn, whatever the meshes (extension).
        body_visible: Option<bool> = "isBodyVisible",
        /// Whether the springs of the face are drawn (extension).
        springs_visible: Option<bool> = "areSpringsVisible",
        /// Whether the muscles of the face are drawn (extension).
        muscles_visible: Option<bool> = "areMusclesVisible",
        /// Whether the bone under the face is drawn (extension).
        skull_visible: Option<bool> = "isSkullVisible",
    }
}
