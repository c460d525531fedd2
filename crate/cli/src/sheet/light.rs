//! Lights of a contact sheet.

use raconteur_base::DVec3;
use raconteur_stage::{DirectedLight, Lighting, Set, StageSet};

/// Returns a light from the character's right with little else, which shows relief. Designed, by
/// eye.
fn lamp() -> Lighting {
    let directed = |towards: [f64; 3], grey: f32| DirectedLight {
        towards_light_in_world: DVec3::from_array(towards).normalize(),
        irradiance: [grey; 3],
    };
    Lighting {
        key: directed([-1.0, 0.25, 0.18], 1.12),
        fill: directed([0.80, 0.20, 0.80], 0.03),
        rim: directed([0.60, 0.70, -0.90], 0.25),
        sky: [0.07; 3],
        ground: [0.045; 3],
        exposure: 1.0,
        softness: 1.0,
    }
}

/// The name of the lamp among the lights.
const LAMP: &str = "side";

/// Returns the names of all lights of contact sheets.
pub(crate) fn names() -> Vec<&'static str> {
    let presets = Lighting::PRESETS.iter().map(|(name, _)| *name);
    presets.chain([LAMP]).collect()
}

/// Returns a light by name; `None` for an unknown name.
pub(crate) fn named(name: &str) -> Option<Lighting> {
    if name == LAMP {
        return Some(lamp());
    }
    Lighting::named(name)
}

/// Returns the set used for contact sheets, a grey studio.
pub(crate) fn room() -> Set {
    Set::from_kind(StageSet::Studio)
}
