//! Avatars with compressed views, as written by `gltfpack -cc`.

use meshoptimizer_rs::Workspace;
use meshoptimizer_rs::codec::{
    ExpMode, IndexEncoding, VertexEncoding, encode_filter_exp, encode_index_buffer,
    encode_vertex_buffer,
};
use raconteur_avatar::{ImportError, import_figure, open_figure};
use raconteur_base::noise;
use raconteur_body::Figure;
use raconteur_body::read::ReadError;
use serde_json::{Value, json};

use crate::made::{Avatar, Dialect, File, make, pack};

const EXTENSION: &str = "EXT_meshopt_compression";

fn number(of: &Value, key: &str) -> usize {
    of[key].as_u64().map_or(0, |n| n as usize)
}

/// Returns a view's stream, and the properties of its extension apart from its location.
fn stream(accessor: &Value, bytes: &[u8]) -> Option<(Vec<u8>, Value)> {
    let count = number(accessor, "count");
    let stride = bytes.len() / count;
    let workspace = &mut Workspace::default();
    let records = |bytes: &[u8]| {
        let version = VertexEncoding::new(0, 0).expect("a version");
        encode_vertex_buffer(bytes, count, stride, version, &mut Workspace::default())
            .expect("records")
    };
    let (stream, mode, filter) =
        match (accessor["type"].as_str(), number(accessor, "componentType")) {
            (Some("SCALAR"), 5123) => {
                let corners = bytes.as_chunks::<2>().0.iter();
                let corners: Vec<u32> = corners.map(|c| u16::from_le_bytes(*c).into()).collect();
                let stream = encode_index_buffer(&corners, IndexEncoding::DEFAULT, workspace);
                (stream.expect("triangles"), "TRIANGLES", "NONE")
            }
            (Some("VEC3"), 5126) => {
                let floats = bytes.as_chunks::<4>().0.iter();
                let floats: Vec<f32> = floats.map(|c| f32::from_le_bytes(*c)).collect();
                let filtered =
                    encode_filter_exp(count, stride, 23, &floats, ExpMode::Separate, workspace);
                let stream = records(&filtered.expect("numbers"));
                (stream, "ATTRIBUTES", "EXPONENTIAL")
            }
            _ if stride.is_multiple_of(4) => (records(bytes), "ATTRIBUTES", "NONE"),
            _ => return None,
        };
    let says = json!({ "byteStride": stride, "count": count, "mode": mode, "filter": filter });
    Some((stream, says))
}

/// The file with compressed views and a buffer that is not there.
fn compressed(file: &File) -> (Value, Vec<u8>) {
    let mut json = file.json.clone();
    let accessors = json["accessors"].as_array().expect("accessors").clone();
    let (mut bin, mut fallback) = (Vec::new(), 0);
    for (i, view) in (0..).zip(json["bufferViews"].as_array_mut().expect("views")) {
        let from = number(view, "byteOffset");
        let length = number(view, "byteLength");
        let bytes = &file.bin[from..from + length];
        let mut shows = accessors.iter().filter(|a| a["bufferView"] == json!(i));
        if let Some((stream, mut says)) = shows.next().and_then(|a| stream(a, bytes)) {
            says["buffer"] = json!(0);
            says["byteOffset"] = json!(bin.len());
            says["byteLength"] = json!(stream.len());
            view["buffer"] = json!(1);
            view["byteOffset"] = json!(fallback);
            view["extensions"] = json!({ EXTENSION: says });
            fallback += length.next_multiple_of(4);
            bin.extend(stream);
        } else {
            view["byteOffset"] = json!(bin.len());
            bin.extend(bytes);
        }
        bin.resize(bin.len().next_multiple_of(4), 0);
    }
    assert!(fallback > 0, "at least one view is compressed");
    json["buffers"] = json!([
        { "byteLength": bin.len() },
        { "byteLength": fallback, "extensions": { EXTENSION: { "fallback": true } } },
    ]);
    json["extensionsRequired"] = json!([EXTENSION]);
    (json, bin)
}

fn glb((json, bin): &(Value, Vec<u8>)) -> Vec<u8> {
    pack(json.to_string().as_bytes(), bin)
}

fn avatar() -> File {
    make(&Avatar {
        morphs: vec!["jawOpen", "mouthSmileLeft"],
        ..Avatar::new(Dialect::Vrm1)
    })
}

fn near<const N: usize>(p: &[[f32; N]], q: &[[f32; N]]) -> bool {
    let mut pairs = p.iter().flatten().zip(q.iter().flatten());
    p.len() == q.len() && pairs.all(|(x, y)| (x - y).abs() < 1e-5)
}

#[test]
fn compressed_avatars_are_as_plain_ones() {
    let file = avatar();
    let figure = |bytes: &[u8]| -> Figure {
        let imported = open_figure("x", bytes);
        imported.unwrap_or_else(|e| panic!("{e}")).figure
    };
    let (plain, packed) = (figure(&file.glb()), figure(&glb(&compressed(&file))));
    assert_eq!(plain.meshes.len(), packed.meshes.len());
    assert_eq!(plain.morph_names, packed.morph_names);
    assert!(
        plain.meshes.iter().any(|m| !m.morphs.is_empty()),
        "the figure has morph targets"
    );
    for (a, b) in plain.meshes.iter().zip(&packed.meshes) {
        assert!(a.joints == b.joints, "compression keeps the joints");
        assert_eq!(a.indices.len(), b.indices.len());
        for (s, t) in a.indices.chunks(3).zip(b.indices.chunks(3)) {
            let mut t = t.to_vec();
            let turns = t.iter().position(|v| *v == s[0]).expect("the same corners");
            t.rotate_left(turns);
            assert_eq!(s, t);
        }
        // The filter of positions rounds, and weights of twisting helpers follow it.
        assert!(
            near(&a.weights, &b.weights),
            "compression keeps the weights within its precision"
        );
        assert!(
            near(&a.positions, &b.positions),
            "compression keeps the positions within its precision"
        );
        assert_eq!(a.morphs.len(), b.morphs.len());
        for (m, n) in a.morphs.iter().zip(&b.morphs) {
            assert!(
                near(&m.position_deltas, &n.position_deltas),
                "compression keeps the morph deltas within its precision"
            );
        }
    }
}

#[test]
fn streams_that_are_none_are_refused() {
    let sound = compressed(&avatar());
    let fault = |change: &dyn Fn(&mut Value)| {
        let mut file = sound.clone();
        let views = file.0["bufferViews"].as_array_mut().expect("views");
        let packed = views.iter_mut().find(|v| v.get("extensions").is_some());
        change(packed.expect("a compressed view"));
        import_figure("x", &glb(&file)).expect_err("a fault")
    };
    let set = |key: &'static str, value: Value| {
        fault(&move |view| view["extensions"][EXTENSION][key] = value.clone())
    };
    let packed = |e: &ImportError| matches!(e, ImportError::Read(ReadError::Packed { .. }));
    assert!(
        packed(&set("count", json!(0))),
        "a stream of 0 elements is rejected"
    );
    assert!(
        packed(&set("byteLength", json!(2))),
        "a stream of 2 bytes is rejected"
    );
    assert!(
        packed(&set("mode", json!("STRIPS"))),
        "an unknown mode is rejected"
    );
    assert!(
        packed(&set("filter", json!("COLOR"))),
        "an unsupported filter is rejected"
    );
    assert!(
        matches!(
            set("byteOffset", json!(1_u64 << 40)),
            ImportError::Read(ReadError::Truncated { .. })
        ),
        "an offset beyond the buffer is rejected"
    );
    assert!(
        matches!(
            set("buffer", json!(7)),
            ImportError::Read(ReadError::OutOfRange { .. })
        ),
        "an unknown buffer is rejected"
    );
    // The buffer that is not there cannot be read from, and no view unpacks to a terabyte.
    assert!(
        matches!(
            set("buffer", json!(1)),
            ImportError::Read(ReadError::Truncated { .. })
        ),
        "a buffer that is too short is rejected"
    );
    let huge = fault(&|view| {
        let stride = number(&view["extensions"][EXTENSION], "byteStride");
        view["byteLength"] = json!(stride as u64 * (3 << 30));
        view["extensions"][EXTENSION]["count"] = json!(3_u64 << 30);
    });
    assert!(
        matches!(huge, ImportError::Read(ReadError::TooLarge)),
        "an oversized stream is rejected"
    );
}

#[test]
fn no_stream_panics() {
    let (json, bin) = compressed(&avatar());
    let mut refused = 0;
    for round in 0..300 {
        let mut bin = bin.clone();
        for k in 0..3 {
            let at = noise::hash(round, k, 1) as usize % bin.len();
            bin[at] = noise::hash(round, k, 2) as u8;
        }
        refused += usize::from(import_figure("x", &glb(&(json.clone(), bin))).is_err());
    }
    assert!(refused > 30, "only {refused} of 300 were refused");
}
