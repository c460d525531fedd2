//! Lights of a contact sheet.

use raconteur_player::base::DVec3;
use raconteur_player::stage::{DirectedLight, Lighting, Set};

/// A light by name.
pub(crate) struct Named {
    pub(crate) name: &'static str,
    pub(crate) lighting: Lighting,
}

fn directed(towards: [f64; 3], irradiance: [f32; 3]) -> DirectedLight {
    DirectedLight {
        towards_light_in_world: DVec3::from_array(towards).normalize(),
        irradiance,
    }
}

/// Every light: a photographer's studio, the story's stage, and a lamp from the side, which
/// shows relief. The studio and the lamp are designed, by eye.
fn all() -> [Named; 3] {
    [
        Named {
            name: "studio",
            lighting: Lighting {
                key: directed([-0.55, 0.60, 0.90], [0.92, 0.90, 0.86]),
                fill: directed([0.80, 0.20, 0.80], [0.30, 0.31, 0.33]),
                rim: directed([0.60, 0.70, -0.90], [0.60, 0.60, 0.60]),
                sky: [0.26, 0.26, 0.27],
                ground: [0.16, 0.15, 0.14],
                exposure: 1.0,
            },
        },
        Named {
            name: "stage",
            lighting: Lighting::default(),
        },
        Named {
            name: "side",
            lighting: Lighting {
                key: directed([-1.0, 0.25, 0.18], [1.15, 1.12, 1.05]),
                fill: directed([0.80, 0.20, 0.80], [0.03, 0.03, 0.035]),
                rim: directed([0.60, 0.70, -0.90], [0.25, 0.25, 0.27]),
                sky: [0.07, 0.07, 0.075],
                ground: [0.05, 0.045, 0.04],
                exposure: 1.0,
            },
        },
    ]
}

/// The names of all lights.
pub(crate) fn names() -> Vec<&'static str> {
    all().iter().map(|l| l.name).collect()
}

/// The lights that the sheet compares.
pub(crate) fn compared() -> Vec<Named> {
    all().into()
}

/// A light by its name.
pub(crate) fn named(name: &str) -> Option<Lighting> {
    all()
        .into_iter()
        .find(|l| l.name == name)
        .map(|l| l.lighting)
}

/// A grey room.
pub(crate) fn room() -> Set {
    Set {
        floor: [0.20; 3],
        backdrop_low: [0.20; 3],
        backdrop_high: [0.30; 3],
        glow: [0.0; 3],
        curtain: false,
    }
}
