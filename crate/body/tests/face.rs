//! Soft faces of the shipped figures: they rest, stay intact for any controls, and each muscle has
//! its anatomical effect.

use raconteur_base::{Side, noise};
use raconteur_body::Figure;
use raconteur_body::face::{FaceControls, Muscle, Network, NodeState, Tissue};
use raconteur_body::read::read_figure;
use raconteur_tier::{FIGURES, sized};

/// Half a second.
const HALF_A_SECOND: usize = 60;

fn figure(name: &str) -> Figure {
    let path = format!(
        "{}/../../assets/figures/{name}.glb",
        env!("CARGO_MANIFEST_DIR")
    );
    read_figure(name, &std::fs::read(path).expect("a figure")).expect("a figure")
}

fn tissue(name: &str) -> Tissue {
    figure(name).tissue.expect("a face with tissue")
}

/// A face that has settled.
fn settled(tissue: &Tissue, controls: &FaceControls) -> Network {
    let mut network = Network::new(tissue);
    let rest = FaceControls::default();
    network.reset(tissue, &rest, &rest);
    for _ in 0..2 * HALF_A_SECOND {
        network.step(tissue, controls);
    }
    network
}

/// A face with random controls over their whole ranges.
fn random(seed: u64, i: i64) -> FaceControls {
    let u = |id: u64| noise::unit(seed, id, i);
    let mut c = FaceControls::default();
    for (k, x) in (0u64..).zip(&mut c.contraction) {
        if u(500 + k) < 0.3 {
            *x = u(k);
        }
    }
    c.protrusion = [2.0 * u(100) - 1.0, 2.0 * u(101) - 1.0];
    c.seal = if u(102) < 0.3 { u(103) } else { 0.0 };
    c.bite = if u(104) < 0.2 { u(105) } else { 0.0 };
    if u(106) < 0.6 {
        c.jaw.pitch_rad = 0.35 * u(107);
        c.jaw.yaw_rad = 0.2 * u(108) - 0.1;
        c.jaw.forward_m = 0.012 * u(109) - 0.004;
        c.jaw.down_m = 0.004 * u(110);
    }
    c
}

/// The farthest that a node is from where it rests, metres.
fn farthest_m(tissue: &Tissue, network: &Network) -> f32 {
    (0..tissue.rest.len())
        .map(|i| distance(network.place(i), tissue.rest[i]))
        .fold(0.0, f32::max)
}

fn distance(a: [f32; 3], b: [f32; 3]) -> f32 {
    (0..3)
        .map(|k| (a[k] - b[k]) * (a[k] - b[k]))
        .sum::<f32>()
        .sqrt()
}

#[test]
fn the_whole_head_is_a_network_of_thousands() {
    for name in FIGURES {
        let tissue = tissue(name);
        let (nodes, springs) = Network::new(&tissue).size();
        assert!(
            nodes >= 2000 && (18_000..=30_000).contains(&springs),
            "{name}: {nodes}, {springs}"
        );
    }
}

#[test]
fn a_face_of_which_nothing_is_asked_does_not_drift() {
    for name in FIGURES {
        let tissue = tissue(name);
        let network = settled(&tissue, &FaceControls::default());
        assert!(farthest_m(&tissue, &network) < 1e-6, "{name}");
        assert!(network.fastest_m_per_s() < 1e-5, "{name}");
    }
}

/// Edges and diagonals of the faces of a network.
fn edges(tissue: &Tissue) -> Vec<[usize; 2]> {
    let of = |q: &[u16; 4]| {
        let ends = [[0, 1], [1, 2], [2, 3], [3, 0], [0, 2], [1, 3]];
        ends.map(|e| e.map(|k| usize::from(q[k])))
    };
    tissue.quads.iter().flat_map(of).collect()
}

/// Muscles jump thousands of times, each time before the last jump has been followed.
fn jump(seed: u64, name: &str) {
    let tissue = tissue(name);
    let edges = edges(&tissue);
    let rest = FaceControls::default();
    let mut network = Network::new(&tissue);
    network.reset(&tissue, &rest, &rest);
    let mut nodes = vec![NodeState::default(); tissue.rest.len()];
    for i in 0..sized(1_000, 10_000) {
        let controls = random(seed, i);
        for _ in 0..=(noise::unit(seed, 900, i) * 3.0) as usize {
            network.step(&tissue, &controls);
        }
        for &[a, b] in &edges {
            let now = distance(network.place(a), network.place(b));
            let rest = distance(tissue.rest[a], tissue.rest[b]);
            assert!(now <= 2.5 * rest, "{name}: {now} m of {rest} m at {i}");
        }
        if i % 10 == 0 {
            let left = network.left(&tissue);
            let deepest = left.lips_m.max(left.teeth_m).max(left.bone_m);
            assert!(deepest < 1e-3, "{name}: {left:?} at {i}");
        }
        if i % 250 == 0 {
            network.write(&tissue, 0.5, &mut nodes);
            for node in &nodes {
                let all = node
                    .displacement
                    .iter()
                    .chain(&node.normal_delta)
                    .chain(&node.wrinkles);
                assert!(
                    all.chain([&node.blush]).all(|x| x.is_finite()),
                    "all values of the face are finite"
                );
            }
            comes_to_rest(&tissue, network.clone(), &format!("{name} at {i}"));
        }
    }
}

/// Checks that a released face is at rest half a second later, in its rest position, and stays
/// there.
fn comes_to_rest(tissue: &Tissue, mut network: Network, what: &str) {
    let rest = FaceControls::default();
    for _ in 0..HALF_A_SECOND {
        network.step(tissue, &rest);
    }
    let (off, fast) = (farthest_m(tissue, &network), network.fastest_m_per_s());
    assert!(off < 1e-4 && fast < 1e-3, "{what}: {off} m, {fast} m/s");
    let before: Vec<[f32; 3]> = (0..tissue.rest.len()).map(|i| network.place(i)).collect();
    for _ in 0..4 * HALF_A_SECOND {
        network.step(tissue, &rest);
    }
    // The face continues to approach its rest position and moves nowhere else.
    let drift = (0..before.len())
        .map(|i| distance(network.place(i), before[i]))
        .fold(0.0, f32::max);
    let off_later = farthest_m(tissue, &network);
    assert!(
        drift <= off + 2e-6 && off_later < 5e-6,
        "{what}: {drift} m, {off_later} m"
    );
    assert!(network.fastest_m_per_s() < 1e-5, "{what}");
}

#[test]
fn jumps_leave_sofia_whole() {
    jump(0, "sofia");
}

#[test]
fn jumps_leave_papous_whole() {
    jump(1, "papous");
}

#[test]
fn jumps_leave_nuno_whole() {
    jump(2, "nuno");
}

#[test]
fn jumps_leave_amara_whole() {
    jump(3, "amara");
}

#[test]
fn jumps_leave_kenji_whole() {
    jump(4, "kenji");
}

#[test]
fn jumps_leave_lia_whole() {
    jump(5, "lia");
}

#[test]
fn sealed_lips_touch_whatever_pulls_at_them() {
    for name in FIGURES {
        let tissue = tissue(name);
        for i in 0..sized(10, 40) {
            let mut controls = random(7, i);
            for (k, c) in (0u64..).zip(&mut controls.contraction) {
                *c *= 0.5 * noise::unit(8, k, i);
            }
            controls.jaw.pitch_rad = controls.jaw.pitch_rad.min(0.12);
            controls.protrusion = controls.protrusion.map(|p| 0.6 * p);
            controls.bite = 0.0;
            controls.seal = 1.0;
            let network = settled(&tissue, &controls);
            let apart = 1e3 * network.lips_apart_m(&tissue);
            assert!(apart < 0.5, "{name}: {apart} mm at {i}");
        }
    }
}

#[test]
fn the_lower_lip_reaches_the_upper_teeth() {
    for name in FIGURES {
        let tissue = tissue(name);
        for pitch_rad in [0.0, 0.015, 0.03] {
            let mut controls = FaceControls {
                bite: 1.0,
                ..FaceControls::default()
            };
            controls.jaw.pitch_rad = pitch_rad;
            let from = 1e3 * settled(&tissue, &controls).lip_to_teeth_m(&tissue);
            assert!(from < 1.0, "{name}: {from} mm at {pitch_rad}");
        }
    }
}

/// Effect of a muscle (of a pair the left one) on a landmark of the left half or the middle: the
/// minimum movement, millimetres on the reference head, and its main direction.
struct Effect {
    muscle: Muscle,
    landmark: &'static str,
    least_mm: f32,
    way: [f32; 3],
}

/// Returns the effects of the mimic muscles (F&H section 3.1.1, and anatomy where that is silent):
/// `effects.tsv`.
fn effects() -> Vec<Effect> {
    let rows = include_str!("effects.tsv").lines().skip(1);
    rows.map(|row| {
        let cells: Vec<&'static str> = row.split('\t').collect();
        let &[muscle, landmark, least_mm, way] = &cells[..] else {
            panic!("four columns are wanted in {row}")
        };
        Effect {
            muscle: Muscle::by_name(muscle).expect(muscle),
            landmark,
            least_mm: least_mm.parse().expect(row),
            way: match way {
                "left" => [1.0, 0.0, 0.0],
                "right" => [-1.0, 0.0, 0.0],
                "up" => [0.0, 1.0, 0.0],
                "down" => [0.0, -1.0, 0.0],
                "front" => [0.0, 0.0, 1.0],
                "back" => [0.0, 0.0, -1.0],
                other => panic!("{other} is no way"),
            },
        }
    })
    .collect()
}

#[test]
fn each_muscle_has_an_effect_that_is_looked_at() {
    let effects = effects();
    for muscle in Muscle::all() {
        let own = |e: &Effect| e.muscle == muscle || e.muscle.mirrored() == muscle;
        assert!(effects.iter().any(own), "{muscle:?}");
    }
    let is_left = |e: &Effect| e.muscle.side() != Some(Side::Right);
    assert!(
        effects.iter().all(is_left),
        "every effect is on the left or in the middle"
    );
}

#[test]
fn each_muscle_moves_the_skin_as_anatomy_says() {
    for name in FIGURES {
        let path = format!(
            "{}/../../assets/figures/{name}.glb",
            env!("CARGO_MANIFEST_DIR")
        );
        let names =
            raconteur_body::annotation::annotations(&std::fs::read(path).expect("a figure"))
                .expect("annotations");
        let figure = figure(name);
        let tissue = figure.tissue.as_ref().expect("tissue");
        let mut nodes = vec![NodeState::default(); tissue.rest.len()];
        for effect in effects() {
            let (muscle, landmark) = (effect.muscle, effect.landmark);
            let mut controls = FaceControls::default();
            controls.contraction[muscle.index()] = 1.0;
            let mut network = settled(tissue, &controls);
            network.write(tissue, 1.0, &mut nodes);
            let at = names.landmark(landmark).expect(landmark);
            let binding = figure.meshes[at.mesh].binding.as_ref().expect("a binding");
            let (_, by, _) = binding
                .apply(&nodes)
                .find(|(vertex, ..)| *vertex == at.vertex as usize)
                .expect("a landmark that follows the tissue");
            let moved: f32 = (0..3).map(|k| 1e3 * by[k] * effect.way[k]).sum();
            println!("{name}\t{muscle:?}\t{landmark}\t{moved:.2} mm");
            assert!(
                moved >= effect.least_mm * tissue.scale,
                "{name}: {muscle:?} moves {landmark} by {moved} mm"
            );
        }
    }
}

#[test]
fn more_contraction_is_more_movement() {
    let tissue = tissue("sofia");
    for muscle in Muscle::all() {
        let mut last = 0.0;
        for step in 1..=4 {
            let mut controls = FaceControls::default();
            controls.contraction[muscle.index()] = 0.25 * f64::from(step);
            let far = farthest_m(&tissue, &settled(&tissue, &controls));
            assert!(far > last, "{muscle:?}");
            last = far;
        }
    }
}
