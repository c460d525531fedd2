//! The reader on hostile files.

mod common;

use std::fs;
use std::path::PathBuf;

use common::container;
use raconteur_base::noise;
use raconteur_body::read::{ReadError, read_figure};
use raconteur_body::{Bone, MaterialKind};

fn shipped() -> Vec<u8> {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../assets/figures/sofia.glb");
    fs::read(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

/// Replaces a piece of the shipped figure's JSON chunk by one of the same length.
fn tampered(from: &str, to: &str) -> Vec<u8> {
    assert!(
        to.len() <= from.len(),
        "the replacement is not longer than the original"
    );
    let mut glb = shipped();
    let at = glb.windows(from.len()).position(|w| w == from.as_bytes());
    let at = at.unwrap_or_else(|| panic!("the figure's JSON holds no {from}"));
    glb[at..at + from.len()].fill(b' ');
    glb[at..at + to.len()].copy_from_slice(to.as_bytes());
    glb
}

#[test]
fn the_shipped_figure_is_whole() {
    let figure = read_figure("sofia", &shipped()).expect("a figure");
    for kind in [
        MaterialKind::Skin,
        MaterialKind::Eye,
        MaterialKind::Hair,
        MaterialKind::Cloth,
    ] {
        assert!(
            figure.meshes.iter().any(|m| m.material.kind == kind),
            "no {kind:?}"
        );
    }
    for name in ["tongueOut", "tongueUp"] {
        assert!(figure.morph_index(name).is_some(), "no {name}");
    }
    assert!(
        figure.lid_closure_rad.iter().all(|r| *r > 0.1),
        "both lids of the figure close by more than 0.1 rad"
    );
    for mesh in &figure.meshes {
        for (w, j) in mesh.weights.iter().zip(&mesh.joints) {
            assert!(
                (w.iter().sum::<f32>() - 1.0).abs() < 1e-5,
                "the weights of a vertex add up to 1"
            );
            assert!(
                j.iter()
                    .all(|j| usize::from(*j) < figure.skeleton.joints().len()),
                "every vertex joint exists"
            );
        }
    }
    let bytes = shipped().len();
    assert!(bytes <= 2_400_000, "{bytes} bytes");
}

#[test]
fn coarser_levels_that_are_no_triangles_are_refused() {
    let json = String::from_utf8_lossy(&shipped()).into_owned();
    let at = json.find("\"coarser\":[").expect("levels of detail");
    let end = json[at..].find(']').expect("their end");
    let levels = &json[at..=at + end];
    for (wrong, what) in [("0", "positions"), ("99999", "nothing")] {
        let glb = tampered(levels, &format!("\"coarser\":[{wrong}]"));
        let read = read_figure("x", &glb);
        assert!(read.is_err(), "a level made of {what}");
    }
    let without = tampered(levels, "\"coarser\":[]");
    let whole = read_figure("x", &shipped()).expect("a figure");
    let bare = read_figure("x", &without).expect("a figure");
    let levels = |f: &raconteur_body::Figure| f.meshes.iter().map(|m| m.coarser.len()).sum();
    let [with, without]: [usize; 2] = [levels(&whole), levels(&bare)];
    assert_eq!(with, without + 2, "one mesh has lost its levels");
}

#[test]
fn faults_are_named() {
    let fault = |glb: &[u8]| read_figure("x", glb).expect_err("a fault");
    let whole = shipped();
    assert!(
        matches!(fault(b""), ReadError::NotGlb(_)),
        "an empty file is not a GLB"
    );
    assert!(
        matches!(fault(b"PK\x03\x04 a zip file"), ReadError::NotGlb(_)),
        "a zip archive is not a GLB"
    );
    assert!(
        matches!(fault(&whole[..whole.len() / 2]), ReadError::NotGlb(_)),
        "a truncated file is not a GLB"
    );
    assert!(
        matches!(fault(&container("{not json")), ReadError::NotGlb(_)),
        "invalid JSON is not a GLB"
    );
    assert!(
        matches!(fault(&container("{}")), ReadError::NotGlb(_)),
        "an empty object is not a GLB"
    );
    let draco =
        r#"{"asset":{"version":"2.0"},"extensionsRequired":["KHR_draco_mesh_compression"]}"#;
    assert!(
        matches!(fault(&container(draco)), ReadError::Extension(e) if e.contains("draco")),
        "an unsupported extension is named"
    );
    let cycle = r#"{"asset":{"version":"2.0"},"nodes":[{"children":[1]},{"children":[0]}]}"#;
    assert!(
        matches!(fault(&container(cycle)), ReadError::Cycle),
        "a cycle of nodes is rejected"
    );
    let nobody = r#"{"asset":{"version":"2.0"},"nodes":[{"name":"Hips"}]}"#;
    assert!(
        matches!(fault(&container(nobody)), ReadError::NoSkeleton { .. }),
        "a file without joints has no skeleton"
    );
    let deep = format!("{}{}", "[".repeat(100_000), "]".repeat(100_000));
    assert!(
        matches!(fault(&container(&deep)), ReadError::NotGlb(_)),
        "deeply nested JSON is rejected"
    );
    let bone = Bone::LWrist.name();
    let renamed = tampered(&format!("\"{bone}\""), "\"bone_of_none\"");
    assert!(
        matches!(fault(&renamed), ReadError::NoSkeleton { missing } if missing == bone),
        "the missing joint is named"
    );
}

#[test]
fn no_tampering_panics() {
    // The test changes one byte or range at a time, at positions chosen by a hash; most changes
    // affect the JSON chunk and the header, which contain counts, offsets and indices.
    let whole = shipped();
    let json = u32::from_le_bytes([whole[12], whole[13], whole[14], whole[15]]) as usize;
    let mut refused = 0;
    for round in 0..400 {
        let mut glb = whole.clone();
        for k in 0..4 {
            let span = if k == 3 { glb.len() } else { 20 + json };
            let at = noise::hash(round, k, 1) as usize % span;
            // Half of the time, digits stay digits, so that the JSON often stays valid.
            glb[at] = if glb[at].is_ascii_digit() && noise::hash(round, k, 2).is_multiple_of(2) {
                b'0' + (noise::hash(round, k, 3) % 10) as u8
            } else {
                noise::hash(round, k, 4) as u8
            };
        }
        if round % 7 == 0 {
            glb.truncate(noise::hash(round, 9, 5) as usize % whole.len());
        }
        refused += usize::from(read_figure("x", &glb).is_err());
    }
    assert!(refused > 50, "only {refused} of 400 were refused");
}
