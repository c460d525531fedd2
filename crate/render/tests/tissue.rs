//! Tissue-bound vertices: comparison with plain sums, and their rendering.

#![allow(clippy::expect_used, reason = "tests fail by panicking")]

#[allow(dead_code, reason = "other tests use the rest")]
mod common;
mod device;

use device::headless;
use raconteur_base::{DQuat, DVec3, noise};
use raconteur_body::face::{Binding, NodeState};
use raconteur_body::figure::{Image, TextureMaps};
use raconteur_body::{Bone, Figure, MaterialKind, Mesh, Pose};
use raconteur_render::tissue::{BoundMesh, Nodes, REACH_M, TissueVertex};
use raconteur_render::{Headless, Quality, RenderError};
use raconteur_stage::{Camera, Frame, Line, Shot};

const SIDE: u32 = 128;
const NODES: usize = 40;

/// Binds every vertex of a mesh but each fifth to up to five nodes.
fn bind(mesh: &mut Mesh) {
    let mut b = Binding {
        starts: vec![0],
        ..Binding::default()
    };
    for v in (0..mesh.positions.len() as u32).filter(|v| v % 5 != 4) {
        let size = i64::from(v % 5) + 1;
        for k in 0..size {
            b.nodes
                .push((noise::unit(1, u64::from(v), k) * NODES as f64) as u16);
            b.weights.push(1.0 / size as f32);
        }
        b.vertices.push(v);
        b.starts.push(b.nodes.len() as u32);
    }
    mesh.binding = Some(b);
}

/// Binds every vertex of a mesh wholly to node 0.
fn bind_to_one(mesh: &mut Mesh) {
    let n = mesh.positions.len() as u32;
    mesh.binding = Some(Binding {
        vertices: (0..n).collect(),
        starts: (0..=n).collect(),
        nodes: vec![0; n as usize],
        weights: vec![1.0; n as usize],
    });
}

fn states() -> Vec<NodeState> {
    (0..NODES as u64)
        .map(|i| {
            let number = |k| noise::unit(9, i, k) as f32;
            NodeState {
                displacement: [0, 1, 2].map(|k| 0.1 * (number(k) - 0.5)),
                normal_delta: [3, 4, 5].map(|k| 2.0 * number(k) - 1.0),
                wrinkles: [6, 7, 8].map(number),
                blush: 2.0 * number(9) - 1.0,
            }
        })
        .collect()
}

/// Computes the vertices of a mesh by direct sums, as reference.
fn plainly(mesh: &Mesh, states: &[NodeState], vertex: u32) -> NodeState {
    let mut sum = NodeState::default();
    let b = mesh.binding.as_ref().expect("bound");
    let Ok(i) = b.vertices.binary_search(&vertex) else {
        return sum;
    };
    for entry in b.starts[i] as usize..b.starts[i + 1] as usize {
        let state = states[usize::from(b.nodes[entry])];
        for c in 0..3 {
            sum.displacement[c] += b.weights[entry] * state.displacement[c];
            sum.normal_delta[c] += b.weights[entry] * state.normal_delta[c];
            sum.wrinkles[c] += b.weights[entry] * state.wrinkles[c];
        }
        sum.blush += b.weights[entry] * state.blush;
    }
    sum
}

/// Returns true if two values agree within half a step of the stream and the rounding of another
/// summation order.
fn near(told: f32, whole: f32, step: f32) -> bool {
    (told * step - whole).abs() <= 0.501 * step + 1e-6
}

#[test]
fn the_stream_tells_what_plain_sums_do() {
    let mut figure = common::figure();
    bind(&mut figure.meshes[0]);
    let (mesh, states) = (&figure.meshes[0], states());
    let mut nodes = Nodes::from_meshes(figure.meshes.iter());
    let mut bound = BoundMesh::new(mesh, 100).expect("bound");
    assert!(
        bound.current.iter().all(|v| *v == TissueVertex::REST),
        "the initial stream is at rest"
    );
    assert!(nodes.update(&states), "the first update changes the tissue");
    bound.apply(&nodes, 0);
    assert!(!nodes.update(&states), "nothing has changed");
    assert_eq!(bound.first_vertex, 100);
    for (vertex, told) in (0u32..).zip(&bound.current) {
        let whole = plainly(mesh, &states, vertex);
        for c in 0..3 {
            let d = f32::from(told.moved[c]);
            assert!(
                near(d, whole.displacement[c], REACH_M / 32767.0),
                "{vertex}"
            );
            let n = f32::from(told.moved[3 + c]);
            assert!(near(n, whole.normal_delta[c], 2.0 / 32767.0), "{vertex}");
            let w = f32::from(told.complexion[c]);
            assert!(near(w, whole.wrinkles[c], 1.0 / 255.0), "{vertex}");
        }
        let b = f32::from(told.complexion[3]) - 128.0;
        assert!(near(b, whole.blush, 1.0 / 127.0), "{vertex}");
    }
    // Missing and invalid nodes are at rest.
    let mut broken = states.clone();
    broken.truncate(NODES / 2);
    broken[3].displacement[1] = f32::NAN;
    broken[4].blush = f32::INFINITY;
    let mut sound = broken.clone();
    sound.resize(NODES, NodeState::default());
    (sound[3], sound[4]) = Default::default();
    nodes.update(&broken);
    bound.apply(&nodes, 0);
    let mut other = bound.clone();
    nodes.update(&sound);
    other.apply(&nodes, 0);
    assert_eq!(bound.current, other.current);
    // Values out of range are clamped.
    let far = NodeState {
        displacement: [9.0, -9.0, 0.0],
        normal_delta: [-9.0, 9.0, 0.0],
        wrinkles: [-1.0, 7.0, 0.5],
        blush: -7.0,
    };
    nodes.update(&[far; NODES]);
    bound.apply(&nodes, 0);
    assert_eq!(bound.current[0].moved, [32767, -32767, 0, -32767, 32767, 0]);
    assert_eq!(bound.current[0].complexion, [0, 255, 128, 1]);
}

#[test]
fn a_level_moves_the_vertices_that_it_draws() {
    let mut figure = common::figure();
    let mesh = &mut figure.meshes[0];
    bind(mesh);
    mesh.coarser = vec![mesh.indices[3..9].to_vec(), mesh.indices[..3].to_vec()];
    let mesh = &figure.meshes[0];
    let mut nodes = Nodes::from_meshes(figure.meshes.iter());
    assert!(nodes.update(&states()), "the update changes the tissue");
    let applied = |level| {
        let mut bound = BoundMesh::new(mesh, 0).expect("bound");
        bound.apply(&nodes, level);
        bound.current
    };
    let finest = applied(0);
    for level in 1..3 {
        for (vertex, told) in (0u32..).zip(applied(level)) {
            let drawn = mesh.triangles_at(level).contains(&vertex);
            let of_finest = finest[vertex as usize];
            let expected = if drawn { of_finest } else { TissueVertex::REST };
            assert_eq!(told, expected, "vertex {vertex} at level {level}");
        }
    }
}

fn draw(device: &mut Headless, frame: &Frame) -> Vec<u8> {
    device.render_rgba(frame, SIDE, SIDE).expect("drawn")
}

fn differing(a: &[u8], b: &[u8], limit: u8) -> usize {
    let far = |p: &[u8], q: &[u8]| p.iter().zip(q).any(|(x, y)| x.abs_diff(*y) > limit);
    let pixels = a.chunks_exact(4).zip(b.chunks_exact(4));
    pixels.filter(|(p, q)| far(p, q)).count()
}

/// Returns the mean of red, green and blue over the image centre.
fn middle(picture: &[u8]) -> [f64; 3] {
    let mut sum = [0.0; 3];
    let (from, to) = (SIDE / 2 - 6, SIDE / 2 + 6);
    for y in from..to {
        for x in from..to {
            let at = 4 * (y * SIDE + x) as usize;
            for (s, c) in sum.iter_mut().zip(&picture[at..at + 3]) {
                *s += f64::from(*c) / 144.0;
            }
        }
    }
    sum
}

/// Returns the test figure's head only, half of it attached to the chin.
fn head() -> Figure {
    let mut figure = common::figure();
    figure.meshes.truncate(1);
    let mesh = &mut figure.meshes[0];
    mesh.morphs.clear();
    let (skull, chin) = (Bone::Skull.index() as u16, Bone::Chin.index() as u16);
    mesh.joints.fill([skull, chin, 0, 0]);
    mesh.weights.fill([0.5, 0.5, 0.0, 0.0]);
    figure
}

#[test]
fn bound_vertices_move_with_their_nodes_and_not_with_the_chin() {
    let mut figure = head();
    let mut open = Pose::zero();
    open.set(Bone::Chin, DQuat::from_rotation_z(0.5));
    let closed = common::frame(&figure, &Pose::zero(), Shot::Close, 1.0);
    let mut frame = common::frame(&figure, &open, Shot::Close, 1.0);
    let mut device = headless(Quality::Medium);
    device.set_figure(&figure).expect("a sound figure");
    let free = draw(&mut device, &closed);
    assert!(
        differing(&free, &draw(&mut device, &frame), 12) > 100,
        "unbound vertices move with the chin"
    );
    bind_to_one(&mut figure.meshes[0]);
    device.set_figure(&figure).expect("a sound figure");
    let rest = draw(&mut device, &closed);
    assert_eq!(differing(&free, &rest, 1), 0, "at rest it looks as before");
    assert!(rest == draw(&mut device, &frame), "the skull holds it");
    frame.tissue = vec![NodeState {
        displacement: [0.04, 0.0, 0.0],
        ..NodeState::default()
    }];
    let moved = draw(&mut device, &frame);
    assert!(
        differing(&rest, &moved, 12) > 100,
        "the moved nodes change the image"
    );
    frame.tissue.clear();
    assert!(rest == draw(&mut device, &frame), "back at rest");
    // The wireframe moves too.
    frame.visibility.fill = raconteur_stage::Fill::Wireframe;
    let edges = draw(&mut device, &frame);
    frame.tissue = vec![NodeState {
        displacement: [0.04, 0.0, 0.0],
        ..NodeState::default()
    }];
    assert!(
        differing(&edges, &draw(&mut device, &frame), 12) > 100,
        "the wireframe moves with the nodes"
    );
}

#[test]
fn a_broken_binding_is_refused() {
    let mut figure = head();
    bind_to_one(&mut figure.meshes[0]);
    let mut device = headless(Quality::Low);
    device.set_figure(&figure).expect("a sound figure");
    let changes: [fn(&mut Binding); 4] = [
        |b| b.weights[7] = f32::NAN,
        |b| b.vertices[7] = 8,
        |b| b.starts[7] = 9,
        |b| b.nodes.truncate(5),
    ];
    for change in changes {
        let mut broken = figure.clone();
        change(broken.meshes[0].binding.as_mut().expect("bound"));
        assert!(
            matches!(device.set_figure(&broken), Err(RenderError::BadMesh { .. })),
            "a broken binding is rejected"
        );
    }
}

/// A square of skin before the camera, all of it bound to one node; image 0 is its map of
/// wrinkles.
fn square() -> (Figure, Frame) {
    let mut figure = common::figure();
    let mut mesh = common::empty(MaterialKind::Skin);
    for (x, y, u, v) in [
        (-0.02_f32, 0.02_f32, 0.0, 0.0),
        (0.02, 0.02, 1.0, 0.0),
        (-0.02, -0.02, 0.0, 1.0),
        (0.02, -0.02, 1.0, 1.0),
    ] {
        mesh.positions.push([x, 1.75 + y, 0.2]);
        mesh.normals.push([0.0, 0.0, 1.0]);
        mesh.uvs.push([u, v]);
        mesh.colors.push([150, 105, 80, 255]);
        mesh.joints.push([0; 4]);
        mesh.weights.push([1.0, 0.0, 0.0, 0.0]);
    }
    mesh.indices = vec![0, 2, 1, 1, 2, 3];
    mesh.material.maps = TextureMaps {
        wrinkles: Some(0),
        ..TextureMaps::default()
    };
    bind_to_one(&mut mesh);
    figure.meshes = vec![mesh];
    figure.images = vec![Image {
        mime_type: "image/png".to_owned(),
        bytes: Vec::new(),
    }];
    let mut frame = common::frame(&figure, &Pose::zero(), Shot::Close, 1.0);
    let at = DVec3::new(0.0, 1.75, 0.2);
    frame.camera = Camera {
        eye_in_world: at + DVec3::Z * 0.5,
        target_in_world: at,
        fov_y_rad: 0.06,
        ..Camera::default()
    };
    frame.lighting.fill.irradiance = [0.0; 3];
    frame.lighting.rim.irradiance = [0.0; 3];
    (figure, frame)
}

fn state(wrinkles: [f32; 3], blush: f32) -> Vec<NodeState> {
    vec![NodeState {
        wrinkles,
        blush,
        ..NodeState::default()
    }]
}

#[test]
fn wrinkles_rise_by_their_channel_and_their_strength() {
    let (figure, mut frame) = square();
    let mut device = headless(Quality::Low);
    device.set_figure(&figure).expect("a sound figure");
    frame.lighting.key.towards_light_in_world = DVec3::new(1.0, 0.0, 1.0).normalize();
    frame.tissue = state([1.0; 3], 0.0);
    let level = draw(&mut device, &frame);
    // Over the middle 10 mm of 40, red rises to the right from −1 to 1 mm; green falls so.
    let side = 320_u32;
    let ramp: Vec<u8> = (0..side * side)
        .flat_map(|i| {
            let t = (128.0 + (f64::from(i % side) - 159.5) * 254.0 / 80.0).clamp(1.0, 255.0) as u8;
            [t, 255 - (t - 1), 128, 255]
        })
        .collect();
    device
        .set_image(0, side, side, &ramp)
        .expect("a sound picture");
    frame.tissue.clear();
    let rest = draw(&mut device, &frame);
    assert!(rest == level, "no strength, no wrinkle");
    let mut at = |wrinkles| {
        frame.tissue = state(wrinkles, 0.0);
        middle(&draw(&mut device, &frame))[1]
    };
    let (flat, half, red, green) = (
        at([0.0, 0.0, 1.0]),
        at([0.5, 0.0, 0.0]),
        at([1.0, 0.0, 0.0]),
        at([0.0, 1.0, 0.0]),
    );
    // A surface rising to the right faces left, away from the lamp.
    assert!(
        red < half && half < flat && flat < green,
        "{red} {half} {flat} {green}"
    );
    assert!(
        green - flat > 8.0 && flat - red > 8.0,
        "{red} {flat} {green}"
    );
    let both = at([1.0, 1.0, 0.0]);
    assert!((both - flat).abs() < 2.0, "they cancel: {both} {flat}");
}

#[test]
fn furrows_are_darker_and_redder() {
    let (figure, mut frame) = square();
    let mut device = headless(Quality::Low);
    device.set_figure(&figure).expect("a sound figure");
    frame.tissue = state([1.0; 3], 0.0);
    let mut at = |height: u8| {
        device
            .set_image(0, 1, 1, &[height, 128, 128, 255])
            .expect("a sound picture");
        middle(&draw(&mut device, &frame))
    };
    let (deep, level, high) = (at(50), at(128), at(200));
    assert!(
        level.iter().zip(high).all(|(a, b)| (a - b).abs() < 1.0),
        "a raised surface keeps the colour of a level one"
    );
    assert!((0..3).all(|c| deep[c] < level[c]), "{deep:?} {level:?}");
    assert!(
        deep[0] / deep[1] > level[0] / level[1],
        "{deep:?} {level:?}"
    );
}

#[test]
fn blood_comes_and_goes() {
    // On the cheek of a face.
    let mut figure = common::figure();
    figure.meshes.truncate(1);
    let mesh = &mut figure.meshes[0];
    mesh.morphs.clear();
    bind_to_one(mesh);
    let mut frame = common::frame(&figure, &Pose::zero(), Shot::Close, 1.0);
    let cheek = DVec3::new(0.03, 1.78, 0.1);
    frame.camera = Camera {
        eye_in_world: cheek + DVec3::Z,
        target_in_world: cheek,
        fov_y_rad: 0.05,
        ..Camera::default()
    };
    let mut device = headless(Quality::Medium);
    let mut with = |tone: [u8; 4], blush: f32| {
        figure.meshes[0].colors.fill(tone);
        device.set_figure(&figure).expect("a sound figure");
        frame.tissue = state([0.0; 3], blush);
        middle(&draw(&mut device, &frame))
    };
    for tone in [[140, 100, 76, 255], [60, 26, 10, 255]] {
        let [pale, rest, red] = [-1.0, 0.0, 1.0].map(|b| with(tone, b));
        let hue = |c: [f64; 3]| c[0] / c[1];
        assert!(
            hue(pale) < hue(rest) && hue(rest) < hue(red),
            "{pale:?} {rest:?} {red:?}"
        );
        assert!(
            pale[1] > rest[1] && rest[1] > red[1],
            "{pale:?} {rest:?} {red:?}"
        );
        // Blood absorbs little red.
        let taken = |c: usize| red[c] / rest[c];
        assert!(taken(0) > 0.85 && taken(1) < 0.93, "{rest:?} {red:?}");
    }
}

#[test]
fn lines_lie_over_the_body_and_faintly_behind_it() {
    let figure = head();
    let frame = common::frame(&figure, &Pose::zero(), Shot::Close, 1.0);
    let mut device = headless(Quality::Medium);
    device.set_figure(&figure).expect("a sound figure");
    let without = draw(&mut device, &frame);
    let seen = |frame: &Frame, picture: &[u8]| {
        let all = picture.chunks_exact(4).zip(without.chunks_exact(4));
        let blue = |p: &[u8]| f64::from(p[2]) - f64::from(p[0]);
        assert_eq!(frame.tissue, []);
        all.map(|(p, q)| (blue(p) - blue(q)).max(0.0)).sum::<f64>()
    };
    let mut with = |z: f32, length: f32| {
        let mut frame = frame.clone();
        frame.lines = vec![Line {
            from_in_world: [-length, 1.81, z],
            to_in_world: [length, 1.81, z],
            color: [10, 40, 250, 255],
            width_px: 3.0,
        }];
        let picture = draw(&mut device, &frame);
        seen(&frame, &picture)
    };
    let (before, behind, dot) = (with(0.13, 0.03), with(0.05, 0.03), with(0.13, 0.0));
    assert!(before > 2000.0, "{before}");
    assert!(
        behind > 0.15 * before && behind < 0.7 * before,
        "{behind} of {before}"
    );
    assert!(dot > 200.0 && dot < 0.5 * before, "{dot} of {before}");
    // No lines are left when none are requested.
    assert!(
        without == draw(&mut device, &frame),
        "the image without lines is unchanged"
    );
}
