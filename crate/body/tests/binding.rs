//! Tissue bindings: round trip through a file, and broken bindings.

use std::fs;
use std::path::PathBuf;

use raconteur_base::noise;
use raconteur_body::Figure;
use raconteur_body::face::Binding;
use raconteur_body::read::{ReadError, read_figure};
use raconteur_body::write::to_glb;

/// The shipped figure with a binding of the first `vertices` of its head, rows of 0 to 7
/// nodes, some of which sum to less than 1.
fn bound() -> Figure {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../assets/figures/sofia.glb");
    let bytes = fs::read(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    let mut figure = read_figure("sofia", &bytes).expect("a figure");
    // Its own tissue has other nodes.
    figure.tissue = None;
    for mesh in &mut figure.meshes {
        mesh.binding = None;
    }
    let mut b = Binding {
        starts: vec![0],
        ..Binding::default()
    };
    for v in (0..15_000).filter(|v| v % 7 != 3) {
        let unit = |k| noise::unit(5, u64::from(v), k);
        let row: Vec<f32> = (0..=i64::from(v % 7)).map(|k| unit(k) as f32).collect();
        let whole: f32 = row.iter().sum::<f32>() / if v % 5 == 0 { 0.4 } else { 1.0 };
        for (k, w) in (0i64..).zip(&row) {
            b.nodes.push((unit(100 + k) * 2000.0) as u16);
            b.weights.push(w / whole);
        }
        b.vertices.push(v);
        b.starts.push(b.nodes.len() as u32);
    }
    // A bound vertex without nodes.
    b.vertices.push(20_000);
    b.starts.push(b.nodes.len() as u32);
    figure.meshes[0].binding = Some(b);
    figure
}

/// Node and weight of a row, by node; equal nodes together.
fn row(b: &Binding, i: usize) -> Vec<(u16, f32)> {
    let range = b.starts[i] as usize..b.starts[i + 1] as usize;
    let mut out: Vec<(u16, f32)> = Vec::new();
    for (&node, &weight) in b.nodes[range.clone()].iter().zip(&b.weights[range]) {
        match out.iter_mut().find(|e| e.0 == node) {
            Some(e) => e.1 += weight,
            None => out.push((node, weight)),
        }
    }
    out.sort_by_key(|e| e.0);
    out
}

#[test]
fn a_binding_comes_back_from_the_file() {
    let figure = bound();
    let glb = to_glb(&figure);
    let back = read_figure("sofia", &glb).expect("a figure");
    assert!(
        back.meshes[1..].iter().all(|m| m.binding.is_none()),
        "only the first mesh has a binding"
    );
    assert_eq!(back.meshes[0].binding_fault(), None);
    let (a, b) = (&figure.meshes[0].binding, &back.meshes[0].binding);
    let (a, b) = (a.as_ref().expect("bound"), b.as_ref().expect("bound"));
    assert_eq!(a.vertices, b.vertices);
    for i in 0..a.vertices.len() {
        let (whole, read) = (row(a, i), row(b, i));
        let sum = |r: &[(u16, f32)]| r.iter().map(|e| e.1).sum::<f32>();
        // The sum stays within half a step; otherwise the whole row would drift.
        assert!(
            (sum(&whole) - sum(&read)).abs() <= 0.5 / 255.0 + 1e-5,
            "{i}"
        );
        for &(node, weight) in &whole {
            let found = read.iter().find(|e| e.0 == node).map_or(0.0, |e| e.1);
            // A node that occurs twice in a row is rounded twice.
            assert!(
                (found - weight).abs() <= 2.0 / 255.0 + 1e-5,
                "{i}: {whole:?} {read:?}"
            );
        }
    }
    // Written again, it is the same.
    assert!(
        glb == to_glb(&back),
        "the file is identical when written again"
    );
    // Other readers still find the vertices and triangles.
    let theirs = gltf::Gltf::from_slice_without_validation(&glb).expect("glTF");
    let primitive = theirs.meshes().flat_map(|m| m.primitives()).next();
    let primitive = primitive.expect("a mesh");
    let count = primitive
        .get(&gltf::Semantic::Positions)
        .map_or(0, |a| a.count());
    assert_eq!(count, figure.meshes[0].positions.len());
}

/// Replaces a piece of the file by one of the same length.
fn swapped(glb: &[u8], from: &str, to: &str) -> Vec<u8> {
    assert_eq!(from.len(), to.len());
    let at = glb.windows(from.len()).position(|w| w == from.as_bytes());
    let at = at.unwrap_or_else(|| panic!("no {from}"));
    let mut out = glb.to_vec();
    out[at..at + to.len()].copy_from_slice(to.as_bytes());
    out
}

#[test]
fn broken_bindings_in_files_are_refused() {
    let glb = to_glb(&bound());
    let fault = |glb: &[u8]| match read_figure("x", glb) {
        Ok(_) => panic!("it was taken"),
        Err(fault) => fault,
    };
    let newer = swapped(
        &glb,
        "\"version\":1,\"weights\"",
        "\"version\":2,\"weights\"",
    );
    assert!(
        matches!(fault(&newer), ReadError::Type { .. }),
        "a binding of a newer version is rejected"
    );

    // The binding names its three lists; each is sent elsewhere.
    let text = String::from_utf8_lossy(&glb).into_owned();
    let number = |key: &str| -> usize {
        let place = text.find("\"binding\":{").expect("a binding");
        let from = text[place..].find(key).expect("a list") + place + key.len();
        let digits: String = text[from..]
            .chars()
            .take_while(char::is_ascii_digit)
            .collect();
        digits.parse().expect("a number")
    };
    let (counts, nodes, weights) = (
        number("\"counts\":"),
        number("\"nodes\":"),
        number("\"weights\":"),
    );
    let refer = |key: &str, from: usize, to: &str| {
        let width = from.to_string().len();
        swapped(
            &glb,
            &format!("\"{key}\":{from}"),
            &format!("\"{key}\":{to:>width$}"),
        )
    };
    // Counts per entry instead of per vertex; unequal numbers of entries; no entries.
    assert!(
        matches!(
            fault(&refer("counts", counts, &nodes.to_string())),
            ReadError::Count { .. }
        ),
        "inconsistent counts are rejected"
    );
    assert!(
        read_figure("x", &refer("nodes", nodes, &counts.to_string())).is_err(),
        "inconsistent nodes are rejected"
    );
    assert!(
        read_figure("x", &refer("weights", weights, &counts.to_string())).is_err(),
        "inconsistent weights are rejected"
    );
    // Nodes as weights sum to far more than 1.
    assert!(
        matches!(
            fault(&refer("weights", weights, &nodes.to_string())),
            ReadError::OutOfRange { .. }
        ),
        "weights with a sum above 1 are rejected"
    );
    // One that points nowhere.
    let beyond = refer("weights", weights, "-1");
    assert!(
        matches!(fault(&beyond), ReadError::OutOfRange { .. }),
        "a node beyond the tissue is rejected"
    );
}

#[test]
fn faults_of_a_mesh_are_told() {
    let figure = bound();
    let sound = figure.meshes[0].binding.clone().expect("bound");
    let fault = |change: &dyn Fn(&mut Binding)| {
        let mut mesh = figure.meshes[0].clone();
        let mut b = sound.clone();
        change(&mut b);
        mesh.binding = Some(b);
        mesh.binding_fault()
    };
    assert_eq!(fault(&|_| {}), None);
    let changes: [&dyn Fn(&mut Binding); 9] = [
        &|b| b.weights[3] = f32::NAN,
        &|b| b.weights[3] = -0.1,
        &|b| b.weights[3] = f32::INFINITY,
        &|b| b.weights.truncate(9),
        &|b| b.starts.truncate(9),
        &|b| b.starts[4] = 2,
        &|b| b.starts[0] = 1,
        &|b| b.vertices.swap(4, 5),
        &|b| {
            if let Some(last) = b.vertices.last_mut() {
                *last = 1 << 30;
            }
        },
    ];
    for (i, change) in changes.iter().enumerate() {
        assert!(fault(change).is_some(), "change {i} was taken");
    }
}
