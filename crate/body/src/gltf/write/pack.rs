//! Compression of a figure's buffer by `EXT_meshopt_compression`: each view is a separate, lossless
//! stream. The decoded views belong to a second buffer, the fallback buffer of the extension, which
//! no file contains.

use meshoptimizer_rs::codec::{
    IndexEncoding, VertexEncoding, encode_index_buffer, encode_index_sequence, encode_vertex_buffer,
};
use meshoptimizer_rs::{Error, Workspace};
use serde_json::{Value, json};

use super::buffer::{Buffer, Packing};
use crate::gltf::read::packed::EXTENSION;

impl Packing {
    fn mode(self) -> &'static str {
        match self {
            Self::Attributes { .. } => "ATTRIBUTES",
            Self::Triangles { .. } => "TRIANGLES",
            Self::Indices { .. } => "INDICES",
        }
    }

    fn stride(self) -> usize {
        match self {
            Self::Attributes { stride } => stride,
            Self::Triangles { width } | Self::Indices { width } => width,
        }
    }

    /// Compresses `bytes`, which must consist of whole records.
    fn stream(self, bytes: &[u8]) -> Result<Vec<u8>, Error> {
        let mut workspace = Workspace::default();
        match self {
            // The extension supports only the first version of this codec.
            Self::Attributes { stride } => encode_vertex_buffer(
                bytes,
                bytes.len() / stride,
                stride,
                VertexEncoding::new(0, 0)?,
                &mut workspace,
            ),
            Self::Triangles { width } => encode_index_buffer(
                &indices(bytes, width),
                IndexEncoding::DEFAULT,
                &mut workspace,
            ),
            Self::Indices { width } => encode_index_sequence(
                &indices(bytes, width),
                IndexEncoding::DEFAULT,
                &mut workspace,
            ),
        }
    }
}

/// Reads little-endian indices of two or four bytes.
fn indices(bytes: &[u8], width: usize) -> Vec<u32> {
    let number = |b: &[u8]| b.iter().rev().fold(0, |n, b| n << 8 | u32::from(*b));
    bytes.chunks_exact(width).map(number).collect()
}

/// Compresses the views that get smaller by it; returns the JSON of the buffers.
pub(super) fn pack(buffer: &mut Buffer) -> Value {
    let whole = std::mem::take(&mut buffer.bytes);
    let mut fallback = 0usize;
    for (view, packing) in buffer.views.iter_mut().zip(&buffer.packings) {
        let number = |key: &str| view[key].as_u64().map_or(0, |n| n as usize);
        let from = number("byteOffset");
        let plain = &whole[from..from + number("byteLength")];
        let packed = packing.and_then(|packing| {
            let mut records = plain.to_vec();
            records.resize(plain.len().next_multiple_of(packing.stride()), 0);
            let stream = packing.stream(&records).ok()?;
            (stream.len() < plain.len()).then_some((packing, records.len(), stream))
        });
        let Some((packing, length, stream)) = packed else {
            buffer
                .bytes
                .resize(buffer.bytes.len().next_multiple_of(4), 0);
            view["byteOffset"] = json!(buffer.bytes.len());
            buffer.bytes.extend_from_slice(plain);
            continue;
        };
        view["buffer"] = json!(1);
        view["byteOffset"] = json!(fallback);
        view["byteLength"] = json!(length);
        view["extensions"] = json!({ EXTENSION: {
            "buffer": 0,
            "byteOffset": buffer.bytes.len(),
            "byteLength": stream.len(),
            "byteStride": packing.stride(),
            "count": length / packing.stride(),
            "mode": packing.mode(),
        }});
        fallback += length.next_multiple_of(4);
        buffer.bytes.extend_from_slice(&stream);
    }
    let mut buffers = vec![json!({ "byteLength": buffer.bytes.len() })];
    if fallback > 0 {
        buffers.push(json!({
            "byteLength": fallback,
            "extensions": { EXTENSION: { "fallback": true } },
        }));
    }
    Value::Array(buffers)
}
