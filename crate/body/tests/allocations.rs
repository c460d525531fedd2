//! Allocation test: a step of the soft face allocates nothing, as counted by the allocator.

#[path = "common/counting.rs"]
mod counting;

use counting::counted;
use raconteur_base::noise;
use raconteur_body::face::{FaceControls, Network, NodeState};
use raconteur_body::read::read_figure;

#[test]
fn a_face_that_jumps_allocates_nothing_and_neither_does_its_copy() {
    let path = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../assets/figures/sofia.glb"
    );
    let figure = read_figure("sofia", &std::fs::read(path).expect("a figure")).expect("a figure");
    let tissue = figure.tissue.as_ref().expect("tissue");
    let mut network = Network::new(tissue);
    let mut nodes = vec![NodeState::default(); tissue.rest.len()];
    for _ in 0..2 {
        let rest = FaceControls::default();
        let count = counted(|| {
            network.reset(tissue, &rest, &rest);
            for i in 0..100 {
                let mut controls = rest;
                for (k, c) in (0u64..).zip(&mut controls.contraction) {
                    *c = noise::unit(3, k, i);
                }
                controls.seal = noise::unit(3, 100, i);
                controls.bite = noise::unit(3, 101, i);
                controls.jaw.pitch_rad = 0.3 * noise::unit(3, 102, i);
                network.step(tissue, &controls);
                network.write(tissue, 0.5, &mut nodes);
                for mesh in &figure.meshes {
                    for moved in mesh.binding.iter().flat_map(|b| b.apply(&nodes)) {
                        std::hint::black_box(moved);
                    }
                }
            }
        });
        assert_eq!(count, 0);
        network = network.clone();
    }
}
