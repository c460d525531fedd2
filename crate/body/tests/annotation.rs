//! Names on the mesh in hostile files.

mod common;

use common::container;
use raconteur_body::annotation::annotations;
use raconteur_body::read::ReadError;
use serde_json::{Value, json};

/// A file with one mesh of ten vertices and these extras.
fn with(extras: &Value) -> Vec<u8> {
    let root = json!({
        "asset": { "version": "2.0" },
        "scene": 0,
        "scenes": [{ "extras": extras }],
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 } }] }],
        "accessors": [{ "count": 10 }],
    });
    container(&root.to_string())
}

#[test]
fn names_in_range_are_read() {
    let read = annotations(&with(&json!({
        "landmarks": { "n": [0, 9] },
        "segments": [
            { "name": "face", "parent": null, "mesh": 0, "runs": [] },
            { "name": "nose", "parent": 0, "mesh": 0, "runs": [0, 4, 6, 4] },
        ],
    })));
    let read = read.unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(read.landmark("n").map(|l| l.vertex), Some(9));
    assert_eq!(read.segments[1].runs, [[0, 4], [6, 4]]);
    assert!(
        annotations(&with(&Value::Null)).is_ok_and(|a| a.landmarks.is_empty()),
        "a null annotation has no landmarks"
    );
}

#[test]
fn nonsense_is_an_error() {
    let bad = [
        json!({ "landmarks": { "n": [0, 10] } }),
        json!({ "landmarks": { "n": [1, 0] } }),
        json!({ "landmarks": { "n": [0, -1] } }),
        json!({ "landmarks": { "n": "tip" } }),
        json!({ "segments": [{ "mesh": 0, "parent": 0, "runs": [] }] }),
        json!({ "segments": [{ "mesh": 7, "runs": [] }] }),
        json!({ "segments": [{ "mesh": 0, "runs": [0] }] }),
        json!({ "segments": [{ "mesh": 0, "runs": [0, 11] }] }),
        json!({ "segments": [{ "mesh": 0, "runs": [u64::MAX, u64::MAX] }] }),
        json!({ "segments": [{ "mesh": 0, "runs": [4, 4, 0, 4] }] }),
    ];
    for extras in bad {
        assert!(annotations(&with(&extras)).is_err(), "{extras}");
    }
    assert!(
        matches!(annotations(b"glTF"), Err(ReadError::NotGlb(_))),
        "a header without content is not a GLB"
    );
    assert!(
        matches!(annotations(b""), Err(ReadError::NotGlb(_))),
        "an empty file is not a GLB"
    );
}
