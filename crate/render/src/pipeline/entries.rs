//! Entry points of the shaders.

use raconteur_body::MaterialKind;

use crate::figure::{AlphaMode, PipelineKey};

pub(super) fn figure_entry(bound: bool) -> &'static str {
    if bound { "vs_bound" } else { "vs_figure" }
}

/// Returns the shader entry of a material. Hairs of brows and lashes are widened if rendered as
/// such.
pub(super) fn material_entry(key: PipelineKey) -> &'static str {
    match (key.kind, key.bound) {
        (MaterialKind::Lash, true) => "vs_bound_lash",
        (MaterialKind::Lash, false) => "vs_lash",
        (_, bound) => figure_entry(bound),
    }
}

pub(super) fn fragment_entry(key: PipelineKey, simple: bool) -> &'static str {
    match key.kind {
        MaterialKind::Skin | MaterialKind::Nail if simple => "fs_simple_skin",
        MaterialKind::Hair if simple => "fs_simple_hair",
        MaterialKind::Hair if key.alpha_mode == AlphaMode::Blend => "fs_hair_soft",
        MaterialKind::Cloth | MaterialKind::Leather if simple => "fs_simple_cloth",
        MaterialKind::Plain if simple && key.alpha_mode == AlphaMode::Opaque => "fs_simple_skin",
        MaterialKind::Skin => "fs_skin",
        MaterialKind::Eye => "fs_eye",
        MaterialKind::Cornea => "fs_cornea",
        MaterialKind::Teeth => "fs_teeth",
        MaterialKind::Mouth => "fs_mouth",
        MaterialKind::Hair => "fs_hair",
        MaterialKind::Lash => "fs_lash",
        MaterialKind::Cloth => "fs_cloth",
        MaterialKind::Leather => "fs_leather",
        MaterialKind::Nail => "fs_nail",
        MaterialKind::Plain => "fs_plain",
        MaterialKind::Rib
        | MaterialKind::Woven
        | MaterialKind::Denim
        | MaterialKind::Corduroy
        | MaterialKind::Fleece => "fs_cloth",
    }
}
