//! Lip collisions: lips pass neither through each other nor through the teeth, measured on the
//! rendered meshes, independently of the tissue's collision handling.

#![allow(clippy::expect_used, reason = "tests fail by panicking")]

use raconteur_actor::FaceRig;
use raconteur_actor::articulation::{ORDINARY_LOUDNESS, articulate, hold_closures};
use raconteur_actor::lips::MouthTargets;
use raconteur_actor::parameters::VISEMES;
use raconteur_base::{DAffine3, DVec3, noise};
use raconteur_body::annotation::{Annotations, annotations};
use raconteur_body::face::{FaceControls, Network, NodeState, Tissue};
use raconteur_body::read::read_figure;
use raconteur_body::{Bone, Figure, Mesh, Pose};
use raconteur_speech::phones;
use raconteur_tier::{FIGURES, share, sized};

/// Maximum penetration of lips into each other or into teeth, metres.
const MAX_DEPTH_M: f64 = 1e-3;

struct Face {
    figure: Figure,
    names: Annotations,
    rig: FaceRig,
    network: Network,
}

/// Positions at one instant, in the skull's bind pose, metres.
struct Drawn {
    skin: Vec<DVec3>,
    lips: [Vec<[DVec3; 3]>; 2],
    /// Of teeth and gums.
    teeth: Vec<[DVec3; 3]>,
}

impl Face {
    fn read(name: &str) -> Self {
        let path = format!(
            "{}/../../assets/figures/{name}.glb",
            env!("CARGO_MANIFEST_DIR")
        );
        let glb = std::fs::read(path).expect("a figure");
        let figure = read_figure(name, &glb).expect("a figure");
        let mut face = Self {
            names: annotations(&glb).expect("annotations"),
            rig: FaceRig::new(&figure),
            network: Network::new(figure.tissue.as_ref().expect("tissue")),
            figure,
        };
        let rest = FaceControls::default();
        let Self {
            network, figure, ..
        } = &mut face;
        network.settle(figure.tissue.as_ref().expect("tissue"), &rest);
        face
    }

    fn tissue(&self) -> &Tissue {
        self.figure.tissue.as_ref().expect("tissue")
    }

    fn step(&mut self, controls: &FaceControls) {
        let tissue = self.figure.tissue.as_ref().expect("tissue");
        self.network.step(tissue, controls);
    }

    /// Returns the membership of the head's vertices in a segment.
    fn segment(&self, name: &str) -> (usize, Vec<bool>) {
        let segment = self.names.segments.iter().find(|s| s.name == name);
        let segment = segment.expect(name);
        let mut is_in = vec![false; self.figure.meshes[segment.mesh].positions.len()];
        for [first, count] in &segment.runs {
            is_in[*first as usize..(first + count) as usize].fill(true);
        }
        (segment.mesh, is_in)
    }

    fn drawn(&mut self, controls: &FaceControls) -> Drawn {
        let mut nodes = vec![NodeState::default(); self.tissue().rest.len()];
        let tissue = self.figure.tissue.as_ref().expect("tissue");
        self.network.write(tissue, 1.0, &mut nodes);
        let mut pose = Pose::zero();
        let mut morphs = vec![0.0; self.figure.morph_names.len()];
        self.rig.write(controls, [0.0; 2], &mut pose, &mut morphs);
        let mut world = Vec::new();
        self.figure.skeleton.solve(&pose, &mut world);
        let moved = |b: Bone| world[b.index()] * self.figure.inverse_bind[b.index()];
        let jaw: DAffine3 = moved(Bone::Skull).inverse() * moved(Bone::Chin);
        let wide = |p: &[f32; 3]| DVec3::from_array(p.map(f64::from));

        let (head, _) = self.segment("upper lip");
        let mesh = &self.figure.meshes[head];
        let mut skin: Vec<DVec3> = mesh.positions.iter().map(wide).collect();
        let mut is_bound = vec![false; skin.len()];
        let binding = mesh.binding.as_ref().expect("a binding");
        for (v, by, _) in binding.apply(&nodes) {
            skin[v] += wide(&by);
            is_bound[v] = true;
        }
        let lips = ["upper lip", "lower lip"].map(|name| {
            let (_, is_in) = self.segment(name);
            assert!(
                is_in
                    .iter()
                    .zip(&is_bound)
                    .all(|(lip, bound)| !lip || *bound),
                "every lip vertex is bound"
            );
            let all = mesh.indices.chunks_exact(3);
            all.filter(|t| t.iter().all(|&v| is_in[v as usize]))
                .map(|t| [t[0], t[1], t[2]].map(|v| skin[v as usize]))
                .collect()
        });
        let is_hard = |m: &&Mesh| m.name == "teeth" || m.name == "gums";
        let hard = self.figure.meshes.iter().filter(is_hard);
        let teeth: Vec<[DVec3; 3]> = hard.flat_map(|mesh| rigid(mesh, &jaw)).collect();
        assert!(
            teeth.len() > 3000,
            "the teeth have more than 3000 triangles"
        );
        Drawn { skin, lips, teeth }
    }
}

/// Triangles of a mesh of which some vertices go with the lower jaw.
fn rigid(mesh: &Mesh, jaw: &DAffine3) -> Vec<[DVec3; 3]> {
    let place = |v: u32| {
        let v = v as usize;
        let p = DVec3::from_array(mesh.positions[v].map(f64::from));
        let of_jaw = |(j, w): (&u16, &f32)| {
            let is_jaw = usize::from(*j) == Bone::Chin.index();
            if is_jaw { f64::from(*w) } else { 0.0 }
        };
        let share: f64 = mesh.joints[v]
            .iter()
            .zip(&mesh.weights[v])
            .map(of_jaw)
            .sum();
        p.lerp(jaw.transform_point3(p), share)
    };
    let all = mesh.indices.chunks_exact(3);
    all.map(|t| [place(t[0]), place(t[1]), place(t[2])])
        .collect()
}

/// Returns the intersection of a line through `p` along `way` with a triangle, in lengths of `way`
/// from `p` (Möller and Trumbore 1997).
fn crossing(p: DVec3, way: DVec3, [a, b, c]: &[DVec3; 3]) -> Option<f64> {
    let (u, v) = (*b - *a, *c - *a);
    let n = way.cross(v);
    let det = u.dot(n);
    if det.abs() < 1e-18 {
        return None;
    }
    let from = p - *a;
    let s = from.dot(n) / det;
    let q = from.cross(u);
    let t = way.dot(q) / det;
    (s >= 0.0 && t >= 0.0 && s + t <= 1.0).then(|| v.dot(q) / det)
}

/// Distance from a point to a triangle.
fn distance(p: DVec3, [a, b, c]: &[DVec3; 3]) -> f64 {
    let n = (*b - *a).cross(*c - *a).normalize_or(DVec3::Y);
    if crossing(p, n, &[*a, *b, *c]).is_some() {
        return (p - *a).dot(n).abs();
    }
    let to_edge = |a: DVec3, b: DVec3| {
        let ab = b - a;
        let on = ((p - a).dot(ab) / ab.length_squared().max(1e-18)).clamp(0.0, 1.0);
        p.distance(a + ab * on)
    };
    to_edge(*a, *b).min(to_edge(*b, *c)).min(to_edge(*c, *a))
}

/// Returns the penetration depth of the corners of one lip into the other, whose flesh lies `up` of
/// its surface: distance of points beyond the first surface to its nearest.
fn lip_in_lip(own: &[[DVec3; 3]], other: &[[DVec3; 3]], up: DVec3) -> f64 {
    let mut deepest: f64 = 0.0;
    for p in own.iter().flatten() {
        let over = |t: &[DVec3; 3]| {
            let (low, high) = (t[0].min(t[1]).min(t[2]), t[0].max(t[1]).max(t[2]));
            low.x <= p.x && p.x <= high.x && low.z <= p.z && p.z <= high.z
        };
        // Surfaces on the path back out: the first skin of the other lip is behind p.
        let near = other.iter().filter(|t| over(t));
        let beyond = near
            .filter_map(|t| crossing(*p, -up, t))
            .fold(f64::MIN, f64::max);
        if beyond > 0.0 {
            let to = other.iter().map(|t| distance(*p, t)).fold(beyond, f64::min);
            deepest = deepest.max(to);
        }
    }
    deepest
}

/// Returns the distance by which corners of the lips would have to move forwards, away from the
/// middle of the mouth, to be in front of teeth and gums.
fn lips_in_teeth(lips: &[[DVec3; 3]], teeth: &[[DVec3; 3]]) -> f64 {
    let back = teeth.iter().flatten().map(|p| p.z).fold(f64::MAX, f64::min);
    let mut deepest: f64 = 0.0;
    for p in lips.iter().flatten() {
        let out = DVec3::new(p.x, 0.0, p.z - back).normalize_or(DVec3::Z);
        let level = |t: &&[DVec3; 3]| {
            let ys = t.map(|q| q.y);
            ys.iter().any(|y| *y <= p.y) && ys.iter().any(|y| *y >= p.y)
        };
        let near = teeth.iter().filter(level);
        let last = near
            .filter_map(|t| crossing(*p, out, t))
            .fold(0.0, f64::max);
        deepest = deepest.max(last);
    }
    deepest
}

/// The deepest of lip in lip and lips in teeth, metres.
fn depths(drawn: &Drawn) -> [f64; 2] {
    let [upper, lower] = &drawn.lips;
    let lips = lip_in_lip(lower, upper, DVec3::Y).max(lip_in_lip(upper, lower, DVec3::NEG_Y));
    let teeth = lips_in_teeth(upper, &drawn.teeth).max(lips_in_teeth(lower, &drawn.teeth));
    [lips, teeth]
}

fn viseme(phone: &str, loudness: f64) -> FaceControls {
    let mut controls = FaceControls::default();
    if let Some(row) = phones::by_name(phone) {
        articulate(&MouthTargets::from_phone(row), loudness, &mut controls);
    }
    controls
}

fn assert_apart(drawn: &Drawn, what: &str) {
    let [lips, teeth] = depths(drawn);
    assert!(
        lips < MAX_DEPTH_M && teeth < MAX_DEPTH_M,
        "{what}: lip in lip {:.2} mm, in teeth {:.2} mm",
        1e3 * lips,
        1e3 * teeth
    );
}

#[test]
fn what_is_pushed_in_is_found() {
    let mut face = Face::read("sofia");
    let drawn = face.drawn(&FaceControls::default());
    assert_apart(&drawn, "at rest");
    assert!(
        drawn.lips.iter().all(|l| l.len() > 1000) && drawn.skin.len() > 20_000,
        "lips and skin are complete"
    );
    let moved = |l: usize, by: DVec3| -> Vec<[DVec3; 3]> {
        drawn.lips[l].iter().map(|t| t.map(|p| p + by)).collect()
    };
    let up = lip_in_lip(&moved(1, DVec3::Y * 3e-3), &drawn.lips[0], DVec3::Y);
    let down = lip_in_lip(&moved(0, DVec3::Y * -3e-3), &drawn.lips[1], DVec3::NEG_Y);
    let back = lips_in_teeth(&moved(0, DVec3::Z * -0.01), &drawn.teeth);
    assert!(
        up > 1e-3 && down > 1e-3 && back > 4e-3,
        "{up} {down} {back}"
    );
}

#[test]
fn in_no_viseme_do_lips_pass_through_lips_or_teeth() {
    for (turn, name) in FIGURES.into_iter().enumerate() {
        let mut face = Face::read(name);
        for (viseme_name, phone) in share(&VISEMES, turn, FIGURES.len()) {
            let mut controls = viseme(phone, ORDINARY_LOUDNESS);
            hold_closures(&mut controls);
            for _ in 0..60 {
                face.step(&controls);
            }
            assert_apart(&face.drawn(&controls), &format!("{name} {viseme_name}"));
        }
    }
}

#[test]
fn in_babble_lips_pass_neither_through_lips_nor_through_teeth() {
    for (seed, name) in (0u64..).zip(FIGURES) {
        let mut face = Face::read(name);
        let mut last = FaceControls::default();
        for i in 0..sized(10, 40) {
            let u = |id: u64| noise::unit(seed, id, i);
            let phone = VISEMES[(u(0) * VISEMES.len() as f64) as usize].1;
            let next = viseme(phone, ORDINARY_LOUDNESS * (0.7 + 0.6 * u(1)));
            // Phones of 60 to 140 ms.
            let steps = 7 + (u(2) * 10.0) as u32;
            for k in 1..=steps {
                let mut controls = last.lerp(&next, f64::from(k) / f64::from(steps));
                hold_closures(&mut controls);
                face.step(&controls);
                if k % 5 == 0 || k == steps {
                    assert_apart(&face.drawn(&controls), &format!("{name} {phone} {i}.{k}"));
                }
            }
            last = next;
        }
    }
}
