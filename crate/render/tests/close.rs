//! The shipped figures in close shots: nothing on their skin sparkles.

#![allow(clippy::expect_used, reason = "tests fail by panicking")]

#[path = "common/shipped.rs"]
mod shipped;

use raconteur_body::MaterialKind;
use raconteur_render::{Headless, RenderOptions};
use raconteur_stage::Lighting;
use shipped::{At, FIGURES, figure, frame, send};

/// Nose, jaw, ear and nails, from the front, half to the side, the side and below; angles in
/// radians. No eye is in them: what is wet may glitter.
const VIEWS: [(At, f64, f64); 6] = [
    (At::Nose, 0.0, 0.0),
    (At::Nose, 0.5, -0.35),
    (At::Jaw, 0.5, -0.4),
    (At::Ear, 1.2, 0.0),
    (At::Ear, 0.3, 0.0),
    (At::Nails, 1.2, 0.2),
];
const SIDE: usize = 192;

/// Pixels that are brighter than all that lie two away from them, by a quarter and 30 of 255: what
/// lights up alone.
fn sparks(rgba: &[u8]) -> Vec<(usize, usize)> {
    let luma = |x: usize, y: usize| {
        let p = &rgba[4 * (y * SIDE + x)..];
        0.3 * f64::from(p[0]) + 0.59 * f64::from(p[1]) + 0.11 * f64::from(p[2])
    };
    let mut out = Vec::new();
    for y in 2..SIDE - 2 {
        for x in 2..SIDE - 2 {
            let ring = (0..5).flat_map(|k| [(k, 0), (k, 4), (0, k), (4, k)]);
            let around = ring.map(|(i, j)| luma(x + i - 2, y + j - 2));
            if luma(x, y) > 1.25 * around.fold(0.0, f64::max) + 30.0 {
                out.push((x, y));
            }
        }
    }
    out
}

#[test]
fn no_pixel_of_the_skin_lights_up_alone() {
    let mut device = Headless::new_blocking(RenderOptions::default())
        .unwrap_or_else(|e| panic!("{e}; on Debian: apt-get install mesa-vulkan-drivers"));
    let mut all = Vec::new();
    for name in FIGURES {
        let mut figure = figure(name);
        // Strands of hair, lashes and the wet of eyes may glitter.
        figure.meshes.retain(|m| {
            matches!(
                m.material.kind,
                MaterialKind::Skin | MaterialKind::Nail | MaterialKind::Mouth | MaterialKind::Eye
            )
        });
        send(&mut device, &figure);
        for (at, yaw, pitch) in VIEWS {
            let frame = frame(&figure, Lighting::default(), at, yaw, pitch);
            let side = SIDE as u32;
            let picture = device.render_rgba(&frame, side, side).expect("drawn");
            let found = sparks(&picture);
            if !found.is_empty() {
                all.push(format!("{name}, {at:?} from {yaw}, {pitch}: {found:?}"));
            }
        }
    }
    assert!(all.is_empty(), "{all:#?}");
}
