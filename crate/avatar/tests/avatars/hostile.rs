//! Corrupted and real imported files: errors, never a panic.

use std::fs;
use std::path::PathBuf;

use crate::made::{Avatar, Dialect, make, pack};
use raconteur_avatar::{ImportError, import_figure, open_figure};
use raconteur_base::{DAffine3, noise};

/// Returns a real file; prints a reason and returns `None` if the shared folder is absent.
fn real(name: &str) -> Option<Vec<u8>> {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../../shared/models");
    let bytes = fs::read(folder.join(name)).ok();
    if bytes.is_none() {
        println!("{name} is not there; this part of the test is left out");
    }
    bytes
}

#[test]
fn sample_figures_perform() {
    for (name, codes) in [
        ("CesiumMan.glb", &["mouth-still", "fingers-missing"][..]),
        ("RobotExpressive.glb", &["mouth-still", "rescaled"][..]),
    ] {
        let Some(bytes) = real(name) else { continue };
        let imported = open_figure(name, &bytes).unwrap_or_else(|e| panic!("{name}: {e}"));
        let figure = imported.figure;
        assert!((0.9..2.2).contains(&figure.skeleton.stature_m()), "{name}");
        for code in codes {
            assert!(
                imported.diagnostics.iter().any(|d| d.code == *code),
                "{name}: {code}"
            );
        }
        for m in &figure.inverse_bind {
            assert!(m.is_finite(), "the matrix is finite");
        }
    }
    if let Some(bytes) = real("CesiumMan.glb") {
        let figure = open_figure("CesiumMan", &bytes).expect("a figure").figure;
        assert_eq!(figure.images.len(), 1);
        assert_eq!(figure.meshes[0].material.maps.base_color, Some(0));
    }
    if let Some(bytes) = real("Fox.glb") {
        let fault = open_figure("Fox", &bytes).map(|i| i.figure.name);
        assert!(
            matches!(fault, Err(ImportError::NotHumanoid(_))),
            "{fault:?}"
        );
    }
}

#[test]
fn faults_are_named() {
    let fault = |bytes: &[u8]| open_figure("x", bytes).expect_err("a fault").to_string();
    assert!(fault(b"").contains("empty"), "the error for an empty file");
    assert!(
        fault(b"Kaydara FBX Binary  ").contains("FBX"),
        "the error for an FBX file"
    );
    assert!(
        fault(b"PK\x03\x04").contains("zip"),
        "the error for a zip archive"
    );
    assert!(
        fault(b"nonsense").contains("neither"),
        "the error for an unknown format"
    );
    assert!(
        fault(b"{}").contains("asset version"),
        "the error for a missing asset version"
    );
    let whole = make(&Avatar::new(Dialect::Vrm1));
    let glb = whole.glb();
    assert!(
        fault(&glb[..glb.len() / 2]).contains("shorter"),
        "the error for a truncated file"
    );
    let tampered = |change: &dyn Fn(&mut serde_json::Value)| {
        let mut file = make(&Avatar::new(Dialect::Vrm1));
        change(&mut file.json);
        fault(&file.glb())
    };
    let cycle = tampered(&|j| j["nodes"][6]["children"] = serde_json::json!([2]));
    assert!(cycle.contains("cycle"), "{cycle}");
    let joint = tampered(&|j| j["skins"][0]["joints"][3] = 999.into());
    assert!(joint.contains("joint"), "{joint}");
    let index = tampered(&|j| j["meshes"][0]["primitives"][0]["indices"] = 999.into());
    assert!(index.contains("indices"), "{index}");
    let huge = tampered(&|j| {
        j["accessors"][0] = serde_json::json!({
            "componentType": 5126, "type": "VEC3", "count": 4_000_000_000u64,
        });
    });
    assert!(huge.contains("more numbers"), "{huge}");
    let big = tampered(&|j| j["nodes"][3]["scale"] = serde_json::json!([1e300, 1e300, 1e300]));
    assert!(
        !big.is_empty(),
        "the fault of an excessive scale has a message"
    );
}

/// Replaces a number of the JSON by a hostile word.
fn with_hostile_number(json: &str, seed: u64) -> String {
    const WORDS: [&str; 12] = [
        "0",
        "1",
        "-1",
        "65535",
        "4294967295",
        "18446744073709551615",
        "1e308",
        "-1e-308",
        "0.5",
        "null",
        "[]",
        "\"x\"",
    ];
    let bytes = json.as_bytes();
    let starts: Vec<usize> = (1..bytes.len())
        .filter(|&i| bytes[i].is_ascii_digit() && matches!(bytes[i - 1], b':' | b',' | b'['))
        .collect();
    let at = starts[noise::hash(seed, 1, 0) as usize % starts.len()];
    let end = bytes[at..]
        .iter()
        .position(|b| matches!(b, b',' | b']' | b'}'))
        .map_or(bytes.len(), |n| at + n);
    let word = WORDS[noise::hash(seed, 2, 0) as usize % WORDS.len()];
    format!("{}{word}{}", &json[..at], &json[end..])
}

/// Replaces bytes of the buffer by others, or by those of NaN.
fn with_hostile_bytes(bin: &mut [u8], seed: u64) {
    for k in 0..4 {
        let at = noise::hash(seed, 3, k) as usize % bin.len();
        if k == 0 && at + 4 < bin.len() {
            bin[at & !3..(at & !3) + 4].copy_from_slice(&f32::NAN.to_le_bytes());
        } else {
            bin[at] = noise::hash(seed, 4, k) as u8;
        }
    }
}

fn parts(glb: &[u8]) -> (String, Vec<u8>) {
    let length = u32::from_le_bytes([glb[12], glb[13], glb[14], glb[15]]) as usize;
    let json = String::from_utf8_lossy(&glb[20..20 + length]).into_owned();
    (json, glb.get(28 + length..).unwrap_or_default().to_vec())
}

/// Tampers `rounds` times; returns how often the file was refused.
fn tamper(glb: &[u8], rounds: u64) -> usize {
    let (json, bin) = parts(glb);
    // Sample files have spaces and line ends in their JSON.
    let tree: serde_json::Value = serde_json::from_str(&json).expect("JSON");
    let json = tree.to_string();
    let mut refused = 0;
    for round in 0..rounds {
        let mut bin = bin.clone();
        let mut text = json.clone();
        match round % 4 {
            0 => with_hostile_bytes(&mut bin, round),
            1 => text = with_hostile_number(&with_hostile_number(&text, round), round + 7777),
            _ => text = with_hostile_number(&text, round),
        }
        let mut file = pack(text.as_bytes(), &bin);
        if round % 16 == 5 {
            file.truncate(noise::hash(round, 5, 0) as usize % file.len());
        }
        match import_figure("x", &file) {
            Err(_) => refused += 1,
            Ok(imported) => {
                let figure = imported.figure;
                assert!(
                    figure.inverse_bind.iter().all(DAffine3::is_finite),
                    "round {round}"
                );
                for mesh in &figure.meshes {
                    let finite = |v: &[f32; 3]| v.iter().all(|x| x.is_finite());
                    assert!(mesh.positions.iter().all(finite), "round {round}");
                    assert!(mesh.normals.iter().all(finite), "round {round}");
                    assert!(
                        mesh.indices
                            .iter()
                            .all(|i| (*i as usize) < mesh.positions.len()),
                        "every index refers to a vertex"
                    );
                }
            }
        }
    }
    refused
}

#[test]
fn no_tampering_panics() {
    for (dialect, morphs) in [
        (Dialect::Vrm0, vec!["one", "two"]),
        (
            Dialect::ReadyPlayerMe,
            vec!["jawOpen", "viseme_aa", "eyeBlinkLeft"],
        ),
    ] {
        let avatar = Avatar {
            morphs,
            expressions: vec![("aa", 0), ("blink", 1), ("joy", 1)],
            ..Avatar::new(dialect)
        };
        let refused = tamper(&make(&avatar).glb(), 1500);
        assert!(refused > 300, "only {refused} of 1500 were refused");
    }
    for name in ["CesiumMan.glb", "RobotExpressive.glb", "Fox.glb"] {
        if let Some(bytes) = real(name) {
            tamper(&bytes, 120);
        }
    }
}
