//! Rendering costs of a shipped figure at each quality, including the read-back of pixels, at the
//! width of a player on a page: on software Vulkan, the time of a machine without a graphics card.

#![allow(clippy::expect_used, reason = "a bench ends at its first fault")]

use std::path::Path;

use criterion::{Criterion, criterion_group, criterion_main};
use raconteur_base::DVec3;
use raconteur_body::Pose;
use raconteur_body::read::read_figure;
use raconteur_render::{Headless, Quality, RenderOptions};
use raconteur_stage::{Frame, FramingMargin, Shot};

const SIZE: (u32, u32) = (828, 570);
/// The same shape with the most pixels of the lowest rung.
const SMALL: (u32, u32) = (362, 249);

fn frames(criterion: &mut Criterion) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets/figures/sofia.glb");
    let bytes = std::fs::read(path).expect("a shipped figure");
    let figure = read_figure("sofia", &bytes).expect("a sound figure");
    let aspect = f64::from(SIZE.0) / f64::from(SIZE.1);
    let mut frame = Frame::with_capacity(figure.skeleton.joints().len(), figure.morph_names.len());
    let skeleton = &figure.skeleton;
    skeleton.solve(&Pose::zero(), &mut frame.world_from_joint);
    frame.camera = Shot::Medium.frame(
        DVec3::ZERO,
        skeleton.stature_m(),
        aspect,
        FramingMargin::default(),
    );
    let mut group = criterion.benchmark_group("frame");
    group.sample_size(10);
    for (quality, name) in Quality::NAMES {
        let mut device =
            Headless::new_blocking(RenderOptions { quality }).expect("a Vulkan device");
        device.set_figure(&figure).expect("a sound figure");
        group.bench_function(name, |bencher| {
            bencher.iter(|| device.render_rgba(&frame, SIZE.0, SIZE.1).expect("drawn"));
        });
        if quality == Quality::Lowest {
            group.bench_function("lowest, enlarged by the browser", |bencher| {
                bencher.iter(|| device.render_rgba(&frame, SMALL.0, SMALL.1).expect("drawn"));
            });
        }
    }
    group.finish();
}

criterion_group!(benches, frames);
criterion_main!(benches);
