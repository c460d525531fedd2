//! Step of the soft face and its skin. Published for comparison: about 40 steps per second (F&H
//! section 3.1.2). Budget (one core of a two-core cloud machine): 0.2 ms per step.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use raconteur_body::face::{FaceControls, Muscle, Network, NodeState};
use raconteur_body::read::read_figure;

/// Returns controls of a face that speaks and smiles: periodic with a hundred steps.
fn asked(i: u32) -> FaceControls {
    let mut controls = FaceControls::default();
    let along = f64::from(i % 100) / 100.0;
    controls.jaw.pitch_rad = 0.2 * along;
    controls.contraction[Muscle::ZygomaticusMajorLeft.index()] = 0.5;
    controls.contraction[Muscle::OrbicularisOrisUpper.index()] = along;
    controls.contraction[Muscle::FrontalisMedialLeft.index()] = 1.0 - along;
    controls.seal = if i % 100 < 20 { 1.0 } else { 0.0 };
    controls
}

fn faces(c: &mut Criterion) {
    let path = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../assets/figures/sofia.glb"
    );
    let figure = read_figure("sofia", &std::fs::read(path).expect("a figure")).expect("a figure");
    let tissue = figure.tissue.as_ref().expect("tissue");
    let mut network = Network::new(tissue);
    let (points, springs) = network.size();
    let rest = FaceControls::default();
    network.reset(tissue, &rest, &rest);
    let mut n = 0;
    c.bench_function(
        &format!("a step of {points} points and {springs} springs"),
        |b| {
            b.iter(|| {
                n += 1;
                network.step(tissue, &asked(n));
            });
        },
    );
    let mut nodes = vec![NodeState::default(); tissue.rest.len()];
    c.bench_function("nodes of a face", |b| {
        b.iter(|| network.write(tissue, black_box(0.5), &mut nodes));
    });
    let bound: usize = figure
        .meshes
        .iter()
        .filter_map(|m| m.binding.as_ref())
        .map(|b| b.vertices.len())
        .sum();
    c.bench_function(&format!("{bound} vertices follow the nodes"), |b| {
        b.iter(|| {
            let bindings = figure.meshes.iter().filter_map(|m| m.binding.as_ref());
            let moved = bindings.flat_map(|binding| binding.apply(&nodes));
            moved
                .map(|(_, moved, turned)| moved[1] + turned[1])
                .sum::<f32>()
        });
    });
}

criterion_group!(benches, faces);
criterion_main!(benches);
