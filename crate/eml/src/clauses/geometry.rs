//! Display of the figure's construction (GEVH D.3.4).

use crate::record::{record, words};

words! {
    /// Fill mode of surfaces.
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
    /// Meshes to render.
    VisibleMeshes {
        /// The body.
        Body = "body",
        /// The bones.
        Bones = "bones",
        /// Body and bones.
        Both = "both",
    }
}

record! {
    /// Rendering switches; `None` keeps a setting.
    ConfigureGeometry = "body-configure-geometry" {
        /// Fill mode of surfaces.
        fill_mode: Option<FillMode> = "fillMode",
        /// Enables rendering of the bones' frames.
        frames_visible: Option<bool> = "areFramesVisible",
        /// Enables rendering of the hierarchy's centres.
        centers_visible: Option<bool> = "areHierarchyCentersVisible",
        /// Meshes to render.
        meshes: Option<VisibleMeshes> = "visibleMeshes",
        /// Enables materials.
        materials_active: Option<bool> = "areMaterialsActive",
        /// Enables textures.
        textures_active: Option<bool> = "areTexturesActive",
        /// Enables rendering of the manipulators.
        manipulators_visible: Option<bool> = "areManipulatorsVisible",
        /// Enables rendering of the body, whatever the meshes (extension).
        body_visible: Option<bool> = "isBodyVisible",
        /// Enables rendering of the face's springs (extension).
        springs_visible: Option<bool> = "areSpringsVisible",
        /// Enables rendering of the face's muscles (extension).
        muscles_visible: Option<bool> = "areMusclesVisible",
        /// Enables rendering of the skull under the face (extension).
        skull_visible: Option<bool> = "isSkullVisible",
    }
}
