//! Close shots of the shipped figures: no sparkles on the skin, no light in unlit areas, and no
//! grain in shadows next to the nose.
//!
//! Each bound lies between the current value and the one before the skin was corrected; both are
//! specified with it, as rendered by Mesa's llvmpipe. Sparkles numbered four in three images.

use crate::device::headless;
use crate::figures::{At, FIGURES, figure, frame, send};
use raconteur_base::DVec3;
use raconteur_body::figure::TextureMaps;
use raconteur_body::{Figure, MaterialKind};
use raconteur_render::{Headless, Quality, RenderOptions};
use raconteur_stage::{DirectedLight, Lighting};
use raconteur_tier::share;

/// Nose, jaw, ear and nails, from the front, half to the side, the side and below; angles in
/// radians.
const VIEWS: [(At, f64, f64); 6] = [
    (At::Nose, 0.0, 0.0),
    (At::Nose, 0.5, -0.35),
    (At::Jaw, 0.5, -0.4),
    (At::Ear, 1.15, 0.0),
    (At::Ear, 0.3, 0.0),
    (At::Nails, 1.2, 0.2),
];
const SIDE: usize = 192;
/// Maximum brightness excess of skin over chalk, of 255: 45 is measured, formerly 96 to 109.
const GLOW: i32 = 65;
/// Maximum number of grain pixels in the images of a figure: 17 to 37 are measured, formerly 120 to
/// 218.
const GRAIN: usize = 45;

/// Returns isolated bright pixels: brighter than all pixels two away from them, by a quarter and 30
/// of 255.
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
    for (turn, name) in FIGURES.into_iter().enumerate() {
        let mut figure = figure(name);
        // Strands of hair, lashes, eyes and their wet may glitter.
        figure.meshes.retain(|m| {
            matches!(
                m.material.kind,
                MaterialKind::Skin | MaterialKind::Nail | MaterialKind::Mouth
            )
        });
        send(&mut device, &figure);
        // In the gate each view of some figures.
        for (at, yaw, pitch) in share(&VIEWS, turn % 2, 2) {
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

/// Returns a figure's skin only, and the same as chalk: chalk shows the incident light and
/// transmits none.
fn skin_and_chalk(name: &str) -> [Figure; 2] {
    let mut skin = figure(name);
    skin.meshes
        .retain(|m| m.material.kind == MaterialKind::Skin);
    let mut chalk = skin.clone();
    for mesh in &mut chalk.meshes {
        mesh.material.kind = MaterialKind::Plain;
        mesh.material.maps = TextureMaps::default();
        mesh.material.base_color = [0.8, 0.8, 0.8, 1.0];
        mesh.material.roughness = 1.0;
        mesh.colors.iter_mut().for_each(|c| *c = [255; 4]);
    }
    [skin, chalk]
}

/// Returns lighting with one lamp, or none if it has no strength.
fn lamp(towards: DVec3, irradiance: [f32; 3], exposure: f32) -> Lighting {
    let dark = DirectedLight {
        towards_light_in_world: DVec3::Y,
        irradiance: [0.0; 3],
    };
    Lighting {
        key: DirectedLight {
            towards_light_in_world: towards.normalize(),
            irradiance,
        },
        fill: dark,
        rim: dark,
        sky: [0.0; 3],
        ground: [0.0; 3],
        exposure,
        softness: 1.0,
    }
}

/// Returns the red channel of an image.
fn red(device: &mut Headless, figure: &Figure, light: Lighting, view: (At, f64, f64)) -> Vec<i32> {
    let (at, yaw, pitch) = view;
    let frame = frame(figure, light, at, yaw, pitch);
    let side = SIDE as u32;
    let picture = device.render_rgba(&frame, side, side).expect("drawn");
    picture.chunks_exact(4).map(|p| i32::from(p[0])).collect()
}

/// Checks the brightness excess of skin over chalk in the light of a lamp, the highest but
/// nineteen: light scattered under the skin or transmitted through the flesh.
#[test]
fn no_light_comes_through_below_the_jaw() {
    const VIEWS: [(At, f64, f64); 4] = [
        (At::Jaw, 0.5, -0.4),
        (At::Jaw, -0.6, -0.4),
        (At::Jaw, 0.0, -0.5),
        (At::Jaw, 0.9, -0.2),
    ];
    let stage = Lighting::default();
    let key = stage.key;
    let on = lamp(key.towards_light_in_world, key.irradiance, stage.exposure);
    let off = lamp(key.towards_light_in_world, [0.0; 3], stage.exposure);
    let mut device = headless(Quality::High);
    for (turn, name) in FIGURES.into_iter().enumerate() {
        let views = share(&VIEWS, turn % 2, 2);
        let lit = skin_and_chalk(name).map(|figure| {
            send(&mut device, &figure);
            let of = |view: &(At, f64, f64)| {
                let view = *view;
                let (on, off) = (
                    red(&mut device, &figure, on, view),
                    red(&mut device, &figure, off, view),
                );
                on.iter().zip(&off).map(|(a, b)| a - b).collect::<Vec<_>>()
            };
            views.iter().map(of).collect::<Vec<_>>()
        });
        for (v, view) in views.iter().enumerate() {
            let mut glow: Vec<i32> = lit[0][v]
                .iter()
                .zip(&lit[1][v])
                .map(|(skin, chalk)| skin - chalk)
                .collect();
            glow.sort_unstable();
            let highest = glow[glow.len() - 20];
            assert!(highest < GLOW, "{name} {view:?}: {highest}");
        }
    }
}

/// Returns the brightness difference of a pixel from all its neighbours.
fn grain(picture: &[i32], x: usize, y: usize) -> i32 {
    let at = |dx: usize, dy: usize| picture[(y + dy - 1) * SIDE + x + dx - 1];
    let around = (0..9).filter(|i| *i != 4).map(|i| at(i % 3, i / 3));
    let (low, high) = around.fold((255, 0), |(low, high), v| (v.min(low), v.max(high)));
    (low - at(1, 1)).max(at(1, 1) - high)
}

#[test]
fn a_shadow_beside_the_nose_has_no_grain() {
    for (turn, quality) in [Quality::Medium, Quality::High].into_iter().enumerate() {
        let mut device = headless(quality);
        for name in share(&FIGURES, turn, 2) {
            let [_, chalk] = skin_and_chalk(name);
            send(&mut device, &chalk);
            let mut strong = 0;
            for yaw in [0.0, 0.5] {
                // From the side and from above.
                for towards in [DVec3::new(0.9, 0.3, 0.6), DVec3::new(0.0, 1.0, 0.5)] {
                    let light = lamp(towards, [1.0; 3], 1.0);
                    let picture = red(&mut device, &chalk, light, (At::Nose, yaw, 0.0));
                    let inner = (1..SIDE - 1).flat_map(|y| (1..SIDE - 1).map(move |x| (x, y)));
                    strong += inner.filter(|(x, y)| grain(&picture, *x, *y) > 8).count();
                }
            }
            assert!(strong < GRAIN, "{quality:?} {name}: {strong} pixels");
        }
    }
}
