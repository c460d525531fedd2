//! Builder of a glTF file: JSON and its buffer.

use base64::prelude::{BASE64_STANDARD, Engine as _};
use raconteur_base::DVec3;
use serde_json::{Value, json};

/// A file's JSON and its buffer.
pub(crate) struct File {
    pub(crate) json: Value,
    pub(crate) bin: Vec<u8>,
    /// Parts by VRM's name in the order of their octahedra, six vertices each.
    pub(crate) parts: Vec<String>,
}

impl File {
    fn view(&mut self, bytes: &[u8]) -> usize {
        self.bin.resize(self.bin.len().next_multiple_of(4), 0);
        let view = json!({ "buffer": 0, "byteOffset": self.bin.len(), "byteLength": bytes.len() });
        self.bin.extend_from_slice(bytes);
        push(&mut self.json["bufferViews"], view)
    }

    pub(crate) fn accessor(
        &mut self,
        bytes: &[u8],
        component: u32,
        ty: &str,
        count: usize,
    ) -> usize {
        let view = self.view(bytes);
        let accessor = json!({
            "bufferView": view, "componentType": component, "type": ty, "count": count,
        });
        push(&mut self.json["accessors"], accessor)
    }

    pub(crate) fn vectors(&mut self, list: &[DVec3]) -> usize {
        let bytes: Vec<u8> = list
            .iter()
            .flat_map(DVec3::to_array)
            .flat_map(|x| (x as f32).to_le_bytes())
            .collect();
        self.accessor(&bytes, 5126, "VEC3", list.len())
    }

    /// The vertices of a part in the first mesh.
    pub(crate) fn range(&self, part: &str) -> core::ops::Range<usize> {
        let i = self.parts.iter().position(|p| p == part);
        let i = i.unwrap_or_else(|| panic!("no part {part}"));
        6 * i..6 * i + 6
    }

    /// As a binary file.
    pub(crate) fn glb(&self) -> Vec<u8> {
        let mut json = self.json.clone();
        json["buffers"] = json!([{ "byteLength": self.bin.len() }]);
        pack(json.to_string().as_bytes(), &self.bin)
    }

    /// As a text file with its data inside.
    pub(crate) fn gltf(&self) -> Vec<u8> {
        let uri = format!(
            "data:application/octet-stream;base64,{}",
            BASE64_STANDARD.encode(&self.bin)
        );
        let mut json = self.json.clone();
        json["buffers"] = json!([{ "byteLength": self.bin.len(), "uri": uri }]);
        json.to_string().into_bytes()
    }
}

pub(super) fn push(list: &mut Value, item: Value) -> usize {
    if !list.is_array() {
        *list = json!([]);
    }
    let list = list.as_array_mut().expect("a list");
    list.push(item);
    list.len() - 1
}

/// A container of two chunks.
pub(crate) fn pack(json: &[u8], bin: &[u8]) -> Vec<u8> {
    let mut out = b"glTF\x02\0\0\0\0\0\0\0".to_vec();
    for (tag, chunk, fill) in [(b"JSON", json, b' '), (b"BIN\0", bin, 0)] {
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
