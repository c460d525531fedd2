//! Heads with tissue, rendered from handmade states of the nodes: a raised patch, each kind of
//! wrinkle, blush and pallor.
//!
//! `cargo run -p raconteur-render --example tissue -- FIGURE.glb FOLDER [MOMENT …]` writes PNGs of
//! all moments or the named ones. A figure without bindings receives one to a coarse grid over its
//! face.

#![allow(clippy::expect_used, reason = "an example ends at its first fault")]

use std::fs::File;
use std::path::{Path, PathBuf};

use glam::Vec3;
use raconteur_base::{DAffine3, DVec3, Side, ops};
use raconteur_body::face::{Binding, NodeState};
use raconteur_body::read::read_figure;
use raconteur_body::skeleton::Drive;
use raconteur_body::{Figure, MaterialKind};
use raconteur_render::{Headless, RenderOptions};
use raconteur_stage::{Camera, Frame, Line};
use zune_jpeg::zune_core::bytestream::ZCursor;
use zune_jpeg::zune_core::colorspace::ColorSpace;
use zune_jpeg::zune_core::options::DecoderOptions;

/// Distance between the nodes of the grid, metres.
const STEP_M: f32 = 0.006;
/// Nodes of the grid to the right and upwards.
const GRID: [i32; 2] = [27, 33];

/// A test time: its name, and the displacement of a node at a position, in units of the eyes'
/// distance from their middle.
struct ExampleState {
    name: &'static str,
    state: fn(Vec3) -> NodeState,
}

/// Returns 1 at a position, fading to 0 over a radius.
fn near(q: Vec3, x: f32, y: f32, radius: f32) -> f32 {
    let d = ((q.x.abs() - x).powi(2) + (q.y - y).powi(2)) / (radius * radius);
    ops::exp(-f64::from(d)) as f32
}

fn raised(q: Vec3) -> NodeState {
    NodeState {
        displacement: [0.0, 0.0, 0.010 * near(q, 0.7, -0.6, 0.25)],
        ..NodeState::default()
    }
}

fn brows_up(q: Vec3) -> NodeState {
    let up = near(q, 0.3, 0.55, 0.55) + near(q, 0.8, 0.5, 0.45);
    NodeState {
        displacement: [0.0, 0.006 * up.min(1.0), 0.0],
        wrinkles: [1.0, 0.0, 0.0],
        ..NodeState::default()
    }
}

fn frown_and_smile(q: Vec3) -> NodeState {
    let brow = near(q, 0.3, 0.35, 0.3);
    let corner = near(q, 0.4, -1.1, 0.3);
    let cheek = near(q, 0.65, -0.6, 0.35);
    let side = if q.x < 0.0 { -1.0 } else { 1.0 };
    NodeState {
        displacement: [
            side * (0.005 * corner - 0.004 * brow),
            0.006 * corner + 0.003 * cheek - 0.003 * brow,
            0.004 * cheek,
        ],
        wrinkles: [0.0, 1.0, 0.0],
        ..NodeState::default()
    }
}

fn sneer_and_purse(q: Vec3) -> NodeState {
    let lips = near(q, 0.0, -1.15, 0.4);
    NodeState {
        displacement: [-0.010 * q.x * lips, 0.0, 0.003 * lips],
        wrinkles: [0.0, 0.0, 1.0],
        ..NodeState::default()
    }
}

fn blood(blush: f32) -> NodeState {
    NodeState {
        blush,
        ..NodeState::default()
    }
}

const MOMENTS: [ExampleState; 8] = [
    ExampleState {
        name: "rest",
        state: |_| NodeState::default(),
    },
    ExampleState {
        name: "raised",
        state: raised,
    },
    ExampleState {
        name: "red",
        state: brows_up,
    },
    ExampleState {
        name: "green",
        state: frown_and_smile,
    },
    ExampleState {
        name: "blue",
        state: sneer_and_purse,
    },
    ExampleState {
        name: "blush",
        state: |_| blood(1.0),
    },
    ExampleState {
        name: "pallor",
        state: |_| blood(-1.0),
    },
    ExampleState {
        name: "lines",
        state: |_| NodeState::default(),
    },
];

/// Returns the point between the eyes and their distance, bind pose, metres.
fn eyes(figure: &Figure) -> (Vec3, f32) {
    let joints = figure.skeleton.joints();
    let [left, right] = Side::BOTH.map(|side| {
        let joint = joints.iter().position(|j| j.drive == Drive::Eye(side));
        let bind = figure.inverse_bind[joint.expect("eyes")].inverse();
        bind.translation.as_vec3()
    });
    ((left + right) * 0.5, left.distance(right))
}

/// Binds the face to a grid seen from the front, each vertex to its four nearest nodes; the border
/// of the grid follows partly.
fn bind(figure: &mut Figure) {
    let (middle, _) = eyes(figure);
    let kinds = [MaterialKind::Skin, MaterialKind::Lash, MaterialKind::Mouth];
    for mesh in &mut figure.meshes {
        let mut b = Binding {
            starts: vec![0],
            ..Binding::default()
        };
        for (v, p) in (0u32..).zip(&mesh.positions) {
            let d = Vec3::from(*p) - middle;
            let at = [
                d.x / STEP_M + 0.5 * GRID[0] as f32,
                d.y / STEP_M + 0.6 * GRID[1] as f32,
            ];
            let cell = at.map(|x| x.floor() as i32);
            let inside = (0..2).all(|i| (0..GRID[i] - 1).contains(&cell[i]));
            if !kinds.contains(&mesh.material.kind) || !inside || d.z < -0.06 {
                continue;
            }
            let rim = (0..2)
                .map(|i| at[i].min((GRID[i] - 1) as f32 - at[i]))
                .fold((d.z + 0.06) / STEP_M, f32::min);
            let part = (rim / 3.0).clamp(0.0, 1.0);
            let f = [at[0] - cell[0] as f32, at[1] - cell[1] as f32];
            for (i, j) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
                b.nodes.push(((cell[1] + j) * GRID[0] + cell[0] + i) as u16);
                let along = |t: f32, k: i32| if k == 0 { 1.0 - t } else { t };
                b.weights.push(part * along(f[0], i) * along(f[1], j));
            }
            b.vertices.push(v);
            b.starts.push(b.nodes.len() as u32);
        }
        mesh.binding = (!b.vertices.is_empty()).then_some(b);
    }
}

/// Returns the positions of the nodes: the mean of their vertices. In units of the eyes' distance
/// from their middle.
fn places(figure: &Figure) -> Vec<Vec3> {
    let (middle, distance) = eyes(figure);
    let mut sums: Vec<(Vec3, f32)> = Vec::new();
    for mesh in &figure.meshes {
        let Some(b) = &mesh.binding else { continue };
        for (vertex, ends) in b.vertices.iter().zip(b.starts.windows(2)) {
            let p = Vec3::from(mesh.positions[*vertex as usize]);
            for entry in ends[0] as usize..ends[1] as usize {
                let (node, weight) = (usize::from(b.nodes[entry]), b.weights[entry]);
                if sums.len() <= node {
                    sums.resize(node + 1, (Vec3::ZERO, 0.0));
                }
                sums[node].0 += p * weight;
                sums[node].1 += weight;
            }
        }
    }
    sums.iter()
        .map(|(sum, weight)| (*sum / weight.max(1e-6) - middle) / distance)
        .collect()
}

/// States whose normals turn as a sheet over the nodes would: by the slope of the
/// displacement towards the front.
fn states(places: &[Vec3], state: fn(Vec3) -> NodeState, distance: f32) -> Vec<NodeState> {
    let forward = |q: Vec3| state(q).displacement[2];
    let e = 0.05;
    places
        .iter()
        .map(|&q| {
            let slope = |d: Vec3| (forward(q + d) - forward(q - d)) / (2.0 * e * distance);
            NodeState {
                normal_delta: [-slope(Vec3::X * e), -slope(Vec3::Y * e), 0.0],
                ..state(q)
            }
        })
        .collect()
}

/// Springs between neighbours, as a face page would show them.
fn lines(figure: &Figure, places: &[Vec3]) -> Vec<Line> {
    let (middle, distance) = eyes(figure);
    let world = |q: Vec3| -> [f32; 3] { (middle + (q - Vec3::Z * 0.08) * distance).into() };
    let mut lines = Vec::new();
    for (i, &a) in places.iter().enumerate() {
        for &b in &places[..i] {
            if a.distance(b) * distance < 1.3 * STEP_M {
                lines.push(Line {
                    from_in_world: world(a),
                    to_in_world: world(b),
                    color: [40, 150, 220, 200],
                    width_px: 1.5,
                });
            }
        }
        lines.push(Line {
            from_in_world: world(a),
            to_in_world: world(a),
            color: [230, 120, 20, 255],
            width_px: 4.0,
        });
    }
    lines
}

fn decode(bytes: &[u8]) -> (u32, u32, Vec<u8>) {
    let options = DecoderOptions::default().jpeg_set_out_colorspace(ColorSpace::RGBA);
    let mut decoder = zune_jpeg::JpegDecoder::new_with_options(ZCursor::new(bytes), options);
    let rgba = decoder.decode().expect("a JPEG");
    let info = decoder.info().expect("a size");
    (u32::from(info.width), u32::from(info.height), rgba)
}

fn save(path: &Path, (width, height): (u32, u32), rgba: &[u8]) {
    let mut encoder = png::Encoder::new(File::create(path).expect("a file"), width, height);
    encoder.set_color(png::ColorType::Rgba);
    encoder.set_depth(png::BitDepth::Eight);
    let mut writer = encoder.write_header().expect("a header");
    writer.write_image_data(rgba).expect("pixels");
}

fn main() {
    let mut args = std::env::args_os().skip(1).map(PathBuf::from);
    let (Some(glb), Some(folder)) = (args.next(), args.next()) else {
        eprintln!("usage: tissue FIGURE.glb FOLDER [MOMENT …]");
        return;
    };
    let wanted: Vec<PathBuf> = args.collect();
    let is_wanted =
        |m: &&ExampleState| wanted.is_empty() || wanted.iter().any(|w| w.as_os_str() == m.name);
    let bytes = std::fs::read(&glb).expect("a file");
    let name = glb
        .file_stem()
        .map_or("figure".into(), |n| n.to_string_lossy());
    let mut figure = read_figure(&name, &bytes).expect("a figure");
    if figure.meshes.iter().all(|m| m.binding.is_none()) {
        bind(&mut figure);
    }
    let places = places(&figure);
    let (middle, distance) = eyes(&figure);

    let mut device = Headless::new_blocking(RenderOptions::default()).expect("a device");
    device.set_figure(&figure).expect("a sound figure");
    for (index, image) in figure.images.iter().enumerate() {
        let (width, height, rgba) = decode(&image.bytes);
        device
            .set_image(index, width, height, &rgba)
            .expect("a sound picture");
    }
    let size = (900, 1000);
    for (view, yaw) in [("front", 0.0), ("side", 0.75)] {
        for moment in MOMENTS.iter().filter(is_wanted) {
            let mut frame = Frame::with_capacity(0, figure.morph_names.len());
            frame.world_from_joint = figure.inverse_bind.iter().map(DAffine3::inverse).collect();
            let target = middle.as_dvec3() - DVec3::Y * 0.02;
            let away = DVec3::new(ops::sin(yaw), 0.02, ops::cos(yaw)) * 0.95;
            frame.camera = Camera {
                eye_in_world: target + away,
                target_in_world: target,
                fov_y_rad: 0.27,
                ..Camera::default()
            };
            frame.tissue = states(&places, moment.state, distance);
            if moment.name == "lines" {
                frame.lines = lines(&figure, &places);
            }
            let rgba = device
                .render_rgba(&frame, size.0, size.1)
                .expect("a picture");
            save(
                &folder.join(format!("{name}-{}-{view}.png", moment.name)),
                size,
                &rgba,
            );
        }
    }
}
