//! Shader sources, shortened by the build script.

const FRAME: &str = include_str!(concat!(env!("OUT_DIR"), "/frame.wgsl"));

/// The shaders of everything on the stage, one module.
pub(crate) const STAGE: [&str; 18] = [
    FRAME,
    include_str!(concat!(env!("OUT_DIR"), "/light.wgsl")),
    include_str!(concat!(env!("OUT_DIR"), "/figure.wgsl")),
    include_str!(concat!(env!("OUT_DIR"), "/surface.wgsl")),
    include_str!(concat!(env!("OUT_DIR"), "/skin.wgsl")),
    include_str!(concat!(env!("OUT_DIR"), "/eye.wgsl")),
    include_str!(concat!(env!("OUT_DIR"), "/mouth.wgsl")),
    include_str!(concat!(env!("OUT_DIR"), "/hair.wgsl")),
    include_str!(concat!(env!("OUT_DIR"), "/lash.wgsl")),
    include_str!(concat!(env!("OUT_DIR"), "/cloth.wgsl")),
    include_str!(concat!(env!("OUT_DIR"), "/theatre.wgsl")),
    include_str!(concat!(env!("OUT_DIR"), "/sets.wgsl")),
    include_str!(concat!(env!("OUT_DIR"), "/fireside.wgsl")),
    include_str!(concat!(env!("OUT_DIR"), "/garden.wgsl")),
    include_str!(concat!(env!("OUT_DIR"), "/night.wgsl")),
    include_str!(concat!(env!("OUT_DIR"), "/school.wgsl")),
    include_str!(concat!(env!("OUT_DIR"), "/bare.wgsl")),
    include_str!(concat!(env!("OUT_DIR"), "/simple.wgsl")),
];

/// The shaders of the last pass.
pub(crate) const TONE_MAP: [&str; 2] = [
    FRAME,
    include_str!(concat!(env!("OUT_DIR"), "/tone_map.wgsl")),
];
