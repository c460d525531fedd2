//! A face of two equal halves stays symmetric while the controls of both halves are equal. The test
//! generates the figure, because no shipped figure has two equal halves.

use std::collections::BTreeMap;

use raconteur_base::noise;
use raconteur_sculpt::{build, people};
use raconteur_tier::{share, sized};
use raconteur_tissue::{FaceControls, Muscle, Network, NodeState};

/// Maximum difference between the halves, metres.
const ALIKE_M: f64 = 1e-4;
/// Cells in which neighbours are looked for, metres.
const CELL_M: f64 = 5e-4;
/// Faces with random controls in the long tier.
const MIXTURES: i64 = 24;

type Place = [f64; 3];

fn mirrored(p: Place) -> Place {
    [-p[0], p[1], p[2]]
}

fn distance(a: Place, b: Place) -> f64 {
    let d = [0, 1, 2].map(|k| (a[k] - b[k]) * (a[k] - b[k]));
    d.iter().sum::<f64>().sqrt()
}

fn cell(p: Place) -> [i32; 3] {
    p.map(|x| (x / CELL_M).floor() as i32)
}

/// Returns, for each position, those at its mirror image. Touching lips have several.
fn partners(rest: &[Place]) -> Vec<Vec<usize>> {
    let mut cells: BTreeMap<[i32; 3], Vec<usize>> = BTreeMap::new();
    for (i, p) in rest.iter().enumerate() {
        cells.entry(cell(*p)).or_default().push(i);
    }
    let around = |p: Place| {
        let [x, y, z] = cell(p);
        let cells = &cells;
        (0..27)
            .map(move |k| [x + k % 3 - 1, y + k / 3 % 3 - 1, z + k / 9 - 1])
            .filter_map(move |c| cells.get(&c))
            .flatten()
            .copied()
    };
    let of = |p: &Place| {
        let image = mirrored(*p);
        around(image)
            .filter(|&j| distance(rest[j], image) < ALIKE_M)
            .collect()
    };
    rest.iter().map(of).collect()
}

/// Returns the largest distance of a position from the mirror image of its partner, metres.
fn farthest(now: &[Place], partners: &[Vec<usize>]) -> f64 {
    let off = |(p, own): (&Place, &Vec<usize>)| {
        let to = own.iter().map(|&j| distance(now[j], mirrored(*p)));
        to.fold(f64::INFINITY, f64::min)
    };
    now.iter().zip(partners).map(off).fold(0.0, f64::max)
}

/// Controls that are equal on both halves.
fn pair(muscle: Muscle, much: f64, c: &mut FaceControls) {
    c.contraction[muscle.index()] = much;
    c.contraction[muscle.mirrored().index()] = much;
}

/// A face with random controls, equal on both halves.
fn mixture(i: i64) -> FaceControls {
    let u = |id: u64| noise::unit(41, id, i);
    let mut c = FaceControls::default();
    for muscle in Muscle::all() {
        let k = muscle.index() as u64;
        if u(500 + k) < 0.4 {
            pair(muscle, u(k), &mut c);
        }
    }
    c.protrusion = [2.0 * u(100) - 1.0, 2.0 * u(101) - 1.0];
    c.seal = if u(102) < 0.3 { u(103) } else { 0.0 };
    c.bite = if u(104) < 0.3 { u(105) } else { 0.0 };
    c.jaw.pitch_rad = 0.25 * u(106);
    c.jaw.forward_m = 0.004 * u(107);
    c
}

/// Returns the tested controls: each muscle with its counterpart at full contraction, the jaw at
/// its limits, protruding, retracted, sealed and biting lips, and mixtures.
fn asked() -> Vec<(String, FaceControls)> {
    let mut all = Vec::new();
    let mut ask = |name: String, set: &dyn Fn(&mut FaceControls)| {
        let mut c = FaceControls::default();
        set(&mut c);
        all.push((name, c));
    };
    for muscle in Muscle::all().filter(|m| m.index() <= m.mirrored().index()) {
        ask(format!("{muscle:?}"), &|c| pair(muscle, 1.0, c));
    }
    ask("open".to_owned(), &|c| c.jaw.pitch_rad = 0.3);
    ask("forward".to_owned(), &|c| c.jaw.forward_m = 0.006);
    ask("protruding".to_owned(), &|c| c.protrusion = [1.0; 2]);
    ask("retracted".to_owned(), &|c| c.protrusion = [-1.0; 2]);
    ask("sealed".to_owned(), &|c| {
        (c.seal, c.jaw.pitch_rad) = (1.0, 0.1);
    });
    ask("biting".to_owned(), &|c| c.bite = 1.0);
    for i in 0..sized(6, MIXTURES) {
        ask(format!("mixture {i}"), &|c| *c = mixture(i));
    }
    all
}

#[test]
fn what_is_asked_of_both_halves_alike_both_do_alike() {
    // The gate makes one of them.
    for name in share(&people::NAMES, 0, people::NAMES.len()) {
        let mut params = people::preset(name).expect("a figure");
        params.head.asymmetry = 0.0;
        let figure = build(&params).figure;
        let tissue = figure.tissue.as_ref().expect("tissue");
        let wide = |p: &[f32; 3]| p.map(f64::from);
        let rest: Vec<Place> = tissue.rest.iter().map(wide).collect();
        let node_partners = partners(&rest);
        let head = &figure.meshes[0];
        let binding = head.binding.as_ref().expect("a binding");
        let bound: Vec<Place> = binding
            .vertices
            .iter()
            .map(|&v| wide(&head.positions[v as usize]))
            .collect();
        let vertex_partners = partners(&bound);
        assert!(
            rest.len() > 2000 && bound.len() > 8000,
            "the head has enough nodes and bound vertices"
        );
        assert!(node_partners.iter().all(|own| !own.is_empty()), "{name}");
        assert!(vertex_partners.iter().all(|own| !own.is_empty()), "{name}");

        let mut nodes = vec![NodeState::default(); rest.len()];
        let mut network = Network::new(tissue);
        for (asked, controls) in asked() {
            network.settle(tissue, &controls);
            network.write(tissue, 1.0, &mut nodes);
            let now: Vec<Place> = (0..rest.len()).map(|i| wide(&network.place(i))).collect();
            let off = farthest(&now, &node_partners);
            let drawn: Vec<Place> = binding
                .apply(&nodes)
                .zip(&bound)
                .map(|((_, by, _), p)| [0, 1, 2].map(|k| p[k] + f64::from(by[k])))
                .collect();
            let drawn_off = farthest(&drawn, &vertex_partners);
            let worst = off.max(drawn_off);
            assert!(worst < ALIKE_M, "{name}: {worst} m for {asked}");
        }
    }
}
