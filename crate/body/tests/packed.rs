//! Compressed views: an independent decoder finds the same figure in them, and no stream makes this
//! decoder panic.

use std::fs;
use std::path::PathBuf;

use raconteur_base::noise;
use raconteur_body::annotation::Annotations;
use raconteur_body::read::packed::EXTENSION;
use raconteur_body::read::{ReadError, document, read_figure};
use raconteur_body::write::{to_glb, to_packed_glb};
use serde_json::{Value, json};

fn shipped() -> Vec<u8> {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../assets/figures/sofia.glb");
    fs::read(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

/// A container of two chunks.
fn container(json: &Value, bin: &[u8]) -> Vec<u8> {
    let mut out = b"glTF\x02\0\0\0\0\0\0\0".to_vec();
    for (tag, chunk, fill) in [
        (b"JSON", json.to_string().as_bytes(), b' '),
        (b"BIN\0", bin, 0),
    ] {
        let length = chunk.len().next_multiple_of(4);
        out.extend((length as u32).to_le_bytes());
        out.extend(tag);
        out.extend(chunk);
        out.resize(out.len() + length - chunk.len(), fill);
    }
    let total = (out.len() as u32).to_le_bytes();
    out[8..12].copy_from_slice(&total);
    out
}

/// JSON and binary chunk.
fn parts(glb: &[u8]) -> (Value, Vec<u8>) {
    let (json, bin) = document::chunks(glb).expect("a container");
    (serde_json::from_slice(json).expect("JSON"), bin.to_vec())
}

fn number(of: &Value, key: &str) -> usize {
    of[key].as_u64().map_or(0, |n| n as usize)
}

fn stretch<'a>(of: &Value, bin: &'a [u8]) -> &'a [u8] {
    let from = number(of, "byteOffset");
    &bin[from..from + number(of, "byteLength")]
}

/// The shipped figure as other programs see it: meshoptimizer itself has unpacked its views.
fn unpacked_by_another() -> (Value, Vec<u8>) {
    fn vertices<const N: usize>(stream: &[u8], count: usize) -> Vec<u8>
    where
        [u8; N]: Default,
    {
        meshopt::decode_vertex_buffer::<[u8; N]>(stream, count)
            .expect("vertices")
            .concat()
    }
    let (mut json, bin) = parts(&shipped());
    let mut whole = Vec::new();
    for view in json["bufferViews"].as_array_mut().expect("views") {
        let bytes = match view["extensions"].get(EXTENSION) {
            None => stretch(view, &bin).to_vec(),
            Some(packed) => {
                let (stream, count) = (stretch(packed, &bin), number(packed, "count"));
                let shorts = |list: Vec<u16>| -> Vec<u8> {
                    list.into_iter().flat_map(u16::to_le_bytes).collect()
                };
                match (packed["mode"].as_str(), number(packed, "byteStride")) {
                    (Some("ATTRIBUTES"), 4) => vertices::<4>(stream, count),
                    (Some("ATTRIBUTES"), 8) => vertices::<8>(stream, count),
                    (Some("ATTRIBUTES"), 16) => vertices::<16>(stream, count),
                    (Some("TRIANGLES"), 2) => {
                        shorts(meshopt::decode_index_buffer(stream, count).expect("triangles"))
                    }
                    (Some("INDICES"), 2) => {
                        shorts(meshopt::decode_index_sequence(stream, count).expect("indices"))
                    }
                    other => panic!("{other:?}"),
                }
            }
        };
        assert_eq!(bytes.len(), number(view, "byteLength"));
        whole.resize(whole.len().next_multiple_of(4), 0);
        view["buffer"] = json!(0);
        view["byteOffset"] = json!(whole.len());
        if let Some(fields) = view.as_object_mut() {
            fields.remove("extensions");
        }
        whole.extend(bytes);
    }
    json["buffers"] = json!([{ "byteLength": whole.len() }]);
    let bare = json!(["KHR_mesh_quantization"]);
    json["extensionsUsed"] = bare.clone();
    json["extensionsRequired"] = bare;
    (json, whole)
}

#[test]
fn another_reader_finds_the_same_figure() {
    let ours = read_figure("sofia", &shipped()).expect("a figure");
    let (json, bin) = unpacked_by_another();
    let theirs: gltf::json::Root = serde_json::from_value(json).expect("glTF");
    let theirs = gltf::Document::from_json_without_validation(theirs);
    let primitives: Vec<_> = theirs.meshes().flat_map(|m| m.primitives()).collect();
    assert_eq!(ours.meshes.len(), primitives.len());
    for (mesh, primitive) in ours.meshes.iter().zip(&primitives) {
        let count = |s| primitive.get(&s).map_or(0, |a| a.count());
        assert_eq!(mesh.positions.len(), count(gltf::Semantic::Positions));
        assert_eq!(mesh.weights.len(), count(gltf::Semantic::Weights(0)));
        assert_eq!(mesh.morphs.len(), primitive.morph_targets().count());
        let reader = primitive.reader(|_| Some(&bin));
        let indices: Vec<u32> = reader
            .read_indices()
            .map(|i| i.into_u32().collect())
            .unwrap_or_default();
        assert_eq!(mesh.indices, indices, "{}", mesh.name);
    }
    let skin = theirs.skins().next().expect("a skin");
    assert_eq!(skin.joints().count(), ours.skeleton.joints().len());
}

#[test]
fn both_decoders_find_the_same_bytes() {
    let (json, bin) = unpacked_by_another();
    let theirs = read_figure("sofia", &container(&json, &bin)).expect("a figure");
    let ours = read_figure("sofia", &shipped()).expect("a figure");
    // The plain file contains every number of a figure.
    assert!(
        to_glb(&ours) == to_glb(&theirs),
        "both decoders read the same figure"
    );
    assert!(
        ours.tissue == theirs.tissue,
        "both decoders read the same tissue"
    );
}

#[test]
fn the_extension_is_declared_as_it_is_specified() {
    let (json, bin) = parts(&shipped());
    for list in ["extensionsUsed", "extensionsRequired"] {
        let names = json[list].as_array().expect("extensions");
        assert!(names.contains(&json!(EXTENSION)), "{list}");
    }
    let buffers = json["buffers"].as_array().expect("buffers");
    assert_eq!(buffers.len(), 2);
    assert!(
        bin.len() - number(&buffers[0], "byteLength") < 4,
        "the first buffer covers the binary chunk"
    );
    assert_eq!(
        buffers[1]["extensions"][EXTENSION],
        json!({ "fallback": true })
    );
    let mut end = 0;
    for view in json["bufferViews"].as_array().expect("views") {
        let buffer = &buffers[number(view, "buffer")];
        let last = number(view, "byteOffset") + number(view, "byteLength");
        assert!(last <= number(buffer, "byteLength"), "{view}");
        let Some(packed) = view["extensions"].get(EXTENSION) else {
            assert_eq!(number(view, "buffer"), 0, "{view}");
            continue;
        };
        assert_eq!(number(view, "buffer"), 1, "{view}");
        // Decoded views do not overlap.
        assert!(
            number(view, "byteOffset") >= end && number(view, "byteOffset") < end + 4,
            "the view starts at the next aligned offset"
        );
        end = last;
        let stride = number(packed, "byteStride");
        assert_eq!(number(view, "byteLength"), stride * number(packed, "count"));
        assert!(
            view["byteStride"].is_null() || number(view, "byteStride") == stride,
            "the declared stride matches the stream"
        );
        // The version of each codec that the extension has.
        let header = match packed["mode"].as_str() {
            Some("ATTRIBUTES") => 0xA0,
            Some("TRIANGLES") => 0xE1,
            Some("INDICES") => 0xD1,
            other => panic!("{other:?}"),
        };
        assert_eq!(stretch(packed, &bin)[0], header, "{view}");
    }
}

#[test]
fn writing_is_repeatable_and_loses_nothing() {
    let figure = read_figure("sofia", &shipped()).expect("a figure");
    let none = Annotations::default();
    let packed = to_packed_glb(&figure, &none);
    assert!(
        packed == to_packed_glb(&figure, &none),
        "the same figure packs to the same bytes"
    );
    assert!(
        packed.len() * 10 < to_glb(&figure).len() * 6,
        "the packed file is less than 60 % of the plain one"
    );
    let mut back = read_figure("sofia", &packed).expect("a figure");
    for (a, b) in back.meshes.iter_mut().zip(&figure.meshes) {
        for level in 0..=b.coarser.len() {
            assert_eq!(
                turned(a.triangles_at(level)),
                turned(b.triangles_at(level)),
                "{}",
                b.name
            );
        }
        a.indices.clone_from(&b.indices);
        a.coarser.clone_from(&b.coarser);
    }
    assert!(
        to_glb(&back) == to_glb(&figure),
        "the packed figure reads back unchanged"
    );
}

/// Triangles, each with its least corner first: a packed file may turn them.
fn turned(indices: &[u32]) -> Vec<[u32; 3]> {
    let mut triangles = indices.as_chunks::<3>().0.to_vec();
    for t in &mut triangles {
        let least = (0..3).min_by_key(|&i| t[i]).unwrap_or(0);
        t.rotate_left(least);
    }
    triangles
}

/// The compressed views of the shipped figure, `change`d one after the other.
fn faults_of(change: impl Fn(&mut Value, &mut Vec<u8>)) -> Vec<Option<ReadError>> {
    let (json, bin) = parts(&shipped());
    let views = json["bufferViews"].as_array().expect("views");
    let is_packed = |i: &usize| views[*i]["extensions"].get(EXTENSION).is_some();
    (0..views.len())
        .filter(is_packed)
        .step_by(5)
        .map(|i| {
            let (mut json, mut bin) = (json.clone(), bin.clone());
            change(&mut json["bufferViews"][i], &mut bin);
            read_figure("x", &container(&json, &bin)).err()
        })
        .collect()
}

#[test]
fn descriptions_that_do_not_fit_their_streams_are_refused() {
    let all = |key: &str, value: Value| {
        faults_of(|view, _| view["extensions"][EXTENSION][key] = value.clone())
    };
    let packed = |f: &Option<ReadError>| matches!(f, Some(ReadError::Packed { .. }));
    assert!(
        all("count", json!(u64::MAX)).iter().all(packed),
        "an excessive count is rejected"
    );
    assert!(
        all("count", json!(0)).iter().all(packed),
        "a count of 0 is rejected"
    );
    assert!(
        all("count", json!(1 << 25)).iter().all(packed),
        "a count beyond the limit is rejected"
    );
    assert!(
        all("byteStride", json!(12)).iter().all(packed),
        "a stride that does not fit is rejected"
    );
    assert!(
        all("byteLength", json!(3)).iter().all(packed),
        "a stream of 3 bytes is rejected"
    );
    for (key, value) in [
        ("byteLength", json!(u64::MAX)),
        ("byteOffset", json!(u64::MAX)),
        ("byteOffset", json!(1 << 30)),
    ] {
        let truncated = |f: &Option<ReadError>| matches!(f, Some(ReadError::Truncated { .. }));
        assert!(
            all(key, value).iter().all(truncated),
            "a range beyond the buffer is rejected"
        );
    }
    let elsewhere = |f: &Option<ReadError>| matches!(f, Some(ReadError::OutOfRange { .. }));
    assert!(
        all("buffer", json!(1)).iter().all(elsewhere),
        "a view of another buffer is rejected"
    );
    // Another program may know these; ours are without.
    let unknown = |f: &Option<ReadError>| matches!(f, Some(ReadError::Extension(_)));
    assert!(
        all("filter", json!("OCTAHEDRAL")).iter().all(unknown),
        "an unsupported filter is rejected"
    );
    assert!(
        all("mode", json!("STRIPS")).iter().all(unknown),
        "an unsupported mode is rejected"
    );
    // A view and its stream that agree on more than a figure can need, and on more than the stream
    // can contain.
    for (count, large) in [(1u64 << 40, true), (1 << 22, false)] {
        let faults = faults_of(|view, _| {
            let stride = number(&view["extensions"][EXTENSION], "byteStride") as u64;
            view["byteLength"] = json!(stride * count * 3);
            view["extensions"][EXTENSION]["count"] = json!(count * 3);
        });
        for fault in faults {
            let is_large = matches!(fault, Some(ReadError::TooLarge));
            assert!(is_large || !large && packed(&fault), "{fault:?}");
        }
    }
}

#[test]
fn no_stream_panics() {
    // One compressed view in the least document.
    let (whole, bin) = parts(&shipped());
    let streams: Vec<Value> = whole["bufferViews"]
        .as_array()
        .expect("views")
        .iter()
        .filter(|v| v["extensions"].get(EXTENSION).is_some())
        .cloned()
        .collect();
    let mut taken = 0;
    for round in 0..3000u64 {
        let random = |k: i64| noise::hash(7, round, k);
        let view = &streams[random(0) as usize % streams.len()];
        let described = &view["extensions"][EXTENSION];
        let mut stream = stretch(described, &bin).to_vec();
        match round % 3 {
            // A byte here and there, early ones more often.
            0 => {
                for k in 0..4 {
                    let span = if k % 2 == 0 { stream.len() } else { 40 };
                    let at = random(10 + k) as usize % span.min(stream.len());
                    stream[at] = random(20 + k) as u8;
                }
            }
            1 => stream.truncate(random(1) as usize % stream.len()),
            // Only a header and noise.
            _ => {
                for (k, b) in (0i64..).zip(stream.iter_mut().skip(1)) {
                    *b = random(100 + k) as u8;
                }
            }
        }
        let mut view = view.clone();
        view["extensions"][EXTENSION]["byteOffset"] = json!(0);
        view["extensions"][EXTENSION]["byteLength"] = json!(stream.len());
        let json = json!({
            "asset": whole["asset"],
            "bufferViews": [view],
        });
        let root = document::Document::from_json(&json, &stream).expect("a document");
        let mut source = raconteur_body::read::accessor::Source::new(&root);
        taken += usize::from(source.view_bytes(0, "noise").is_ok());
    }
    // Changed numbers often still form a stream; noise rarely does.
    assert!((1..2000).contains(&taken), "{taken} of 3000 were taken");
}
