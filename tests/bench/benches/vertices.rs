//! Costs per frame of following the tissue of a face: 15,000 vertices, each by six of 2,000 nodes,
//! all of which move.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use raconteur_base::noise;
use raconteur_body::face::{Binding, NodeState};
use raconteur_body::figure::{Material, MaterialKind, Mesh, TextureMaps};
use raconteur_render::tissue::{BoundMesh, Nodes};

const VERTICES: u32 = 15_000;
const NODES: i64 = 2_000;
const ROW: i64 = 6;

fn mesh() -> Mesh {
    let n = VERTICES as usize;
    // Neighbours in the mesh follow neighbours in the tissue.
    let node = |v: u32, k: i64| {
        let near = i64::from(v) * NODES / i64::from(VERTICES);
        let off = (noise::unit(7, u64::from(v), k) * 80.0) as i64;
        (near + off).rem_euclid(NODES) as u16
    };
    Mesh {
        name: "face".to_owned(),
        material: Material {
            kind: MaterialKind::Skin,
            base_color: [1.0; 4],
            roughness: 0.5,
            double_sided: false,
            maps: TextureMaps::default(),
        },
        positions: vec![[0.0; 3]; n],
        normals: vec![[0.0, 0.0, 1.0]; n],
        uvs: vec![[0.0; 2]; n],
        colors: vec![[255; 4]; n],
        joints: vec![[0; 4]; n],
        weights: vec![[1.0, 0.0, 0.0, 0.0]; n],
        indices: (0..VERTICES).collect(),
        coarser: Vec::new(),
        morphs: Vec::new(),
        binding: Some(Binding {
            vertices: (0..VERTICES).collect(),
            starts: (0..=VERTICES).map(|v| v * ROW as u32).collect(),
            nodes: (0..VERTICES)
                .flat_map(|v| (0..ROW).map(move |k| node(v, k)))
                .collect(),
            weights: vec![1.0 / ROW as f32; n * ROW as usize],
        }),
    }
}

fn states(beat: i64) -> Vec<NodeState> {
    let number = |node: i64, k: i64| noise::unit(3, node as u64, 16 * beat + k) as f32;
    (0..NODES)
        .map(|i| NodeState {
            displacement: [0, 1, 2].map(|k| 0.02 * number(i, k)),
            normal_delta: [3, 4, 5].map(|k| number(i, k) - 0.5),
            wrinkles: [6, 7, 8].map(|k| number(i, k)),
            blush: number(i, 9),
        })
        .collect()
}

fn tissue(c: &mut Criterion) {
    let mesh = mesh();
    let mut nodes = Nodes::from_meshes([&mesh].into_iter());
    let Some(mut bound) = BoundMesh::new(&mesh, 0) else {
        return;
    };
    let moments = [states(0), states(1)];
    let mut beat = 0;
    c.bench_function("tissue: 15,000 vertices follow six of 2,000 nodes", |b| {
        b.iter(|| {
            beat = 1 - beat;
            if nodes.update(black_box(&moments[beat])) {
                bound.apply(&nodes, 0);
            }
            black_box(bound.current.last());
        });
    });
    c.bench_function("tissue: nothing has moved", |b| {
        b.iter(|| black_box(nodes.update(black_box(&moments[beat]))));
    });
}

criterion_group!(benches, tissue);
criterion_main!(benches);
