//! Conversion of imported animations to clips.

use std::fs;
use std::path::PathBuf;

use raconteur_avatar::{ImportError, convert_animation};
use serde_json::Value;

/// Returns a real file; prints a reason and returns `None` if the shared folder is absent.
fn real(name: &str) -> Option<Vec<u8>> {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../../shared/models");
    let bytes = fs::read(folder.join(name)).ok();
    if bytes.is_none() {
        println!("{name} is not there; this part of the test is left out");
    }
    bytes
}

fn rows(clip: &Value, track: &str, field: &str) -> Vec<Value> {
    let list = clip["tracks"][track][field].as_array();
    list.unwrap_or_else(|| panic!("{track} {field}")).clone()
}

/// Angle between two rotations of a track, radians.
fn turned(a: &Value, b: &Value) -> f64 {
    let four = |v: &Value| [0, 1, 2, 3].map(|i| v[i].as_f64().expect("a number"));
    let (a, b) = (four(a), four(b));
    let dot: f64 = a.iter().zip(b).map(|(x, y)| x * y).sum();
    2.0 * raconteur_base::ops::acos_clamped(dot.abs())
}

#[test]
fn a_walk_swings_the_legs_in_turn_and_closes() {
    let Some(bytes) = real("CesiumMan.glb") else {
        return;
    };
    let text = convert_animation("", &bytes).expect("a clip");
    let clip: Value = serde_json::from_str(&text).expect("JSON");
    let seconds = clip["seconds"].as_f64().expect("a length");
    assert!((1.9..2.1).contains(&seconds), "{seconds}");
    let times = clip["times"].as_array().expect("times").len();
    let (left, right) = (
        rows(&clip, "bone_l_hip", "rotation"),
        rows(&clip, "bone_r_hip", "rotation"),
    );
    assert_eq!((left.len(), right.len()), (times, times));
    // Each thigh swings by some 50°, and when one is at its foremost the other is not.
    let swing = |list: &[Value]| {
        let angles = list.iter().map(|q| turned(q, &list[0]));
        angles.fold(0.0, f64::max)
    };
    for list in [&left, &right] {
        assert!((0.4..1.8).contains(&swing(list)), "{}", swing(list));
    }
    for list in [&left, &right] {
        for q in list {
            let length: f64 = (0..4).map(|i| q[i].as_f64().unwrap_or(0.0).powi(2)).sum();
            assert!(
                (length - 1.0).abs() < 1e-3,
                "the quaternion has unit length"
            );
        }
    }
    // Other layers move the bones that the file lacks.
    assert!(
        clip["tracks"]["bone_l_index0"].is_null(),
        "the fingers have no track"
    );
    let up = rows(&clip, "root", "up");
    assert!(
        up.iter()
            .all(|v| v.as_f64().is_some_and(|x| x.abs() < 15.0)),
        "the vertical motion stays below 15"
    );
}

#[test]
fn one_of_several_is_found_by_its_name() {
    let Some(bytes) = real("RobotExpressive.glb") else {
        return;
    };
    let length = |name: &str| {
        let clip: Value =
            serde_json::from_str(&convert_animation(name, &bytes).expect(name)).expect("JSON");
        clip["seconds"].as_f64().expect("a length")
    };
    assert!(
        length("Wave") > 0.5 && length("Jump") > 0.3,
        "both named clips have a duration"
    );
    assert!(
        convert_animation("Somersault", &bytes).is_err(),
        "an unknown clip name is rejected"
    );
}

#[test]
fn what_is_broken_or_no_human_is_refused() {
    assert!(
        convert_animation("", b"").is_err(),
        "an empty file is rejected"
    );
    assert!(
        convert_animation("", b"{\"asset\":{\"version\":\"2.0\"}}").is_err(),
        "a file without a figure is rejected"
    );
    if let Some(bytes) = real("Fox.glb") {
        let fault = convert_animation("", &bytes);
        assert!(
            matches!(fault, Err(ImportError::NotHumanoid(_))),
            "{fault:?}"
        );
    }
    if let Some(bytes) = real("CesiumMan.glb") {
        for end in (0..bytes.len()).step_by(bytes.len() / 40) {
            assert!(convert_animation("", &bytes[..end]).is_err(), "{end}");
        }
    }
}
