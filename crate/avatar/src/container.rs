//! Conversion of a file's bytes to one JSON tree with one buffer.
//!
//! Binary files have one buffer; text files may spread data over several data URLs. Joining them
//! here gives all later stages one kind of file.

use std::borrow::Cow;
use std::ops::Range;

use base64::Engine as _;
use base64::alphabet::STANDARD;
use base64::engine::general_purpose::{GeneralPurpose, NO_PAD};
use serde_json::{Value, json};

use super::error::ImportError;
use super::packed;
use raconteur_body::read::ReadError;
use raconteur_body::read::document::{self, Document};

/// Maximum size of an input file, and of its decompressed views, bytes. Typical avatars have about
/// 1 to 50 MB.
const MAX_BYTES: usize = 256 << 20;

/// Unsupported compressions, with a hint for each.
const COMPRESSIONS: [(&str, &str); 2] = [
    (
        "KHR_draco_mesh_compression",
        "export it again without Draco compression (`gltf-transform copy` undoes it)",
    ),
    (
        "KHR_texture_basisu",
        "export its pictures as PNG or JPEG instead of KTX2",
    ),
];

/// Extensions that may be required: understood, or without meaning for a figure.
fn is_understood(extension: &str) -> bool {
    matches!(
        extension,
        "KHR_mesh_quantization"
            | "KHR_texture_transform"
            | "KHR_lights_punctual"
            | "KHR_node_visibility"
            | "KHR_xmp_json_ld"
            | "EXT_meshopt_compression"
            | "EXT_texture_webp"
            | "VRM"
            | "VRMC_vrm"
    ) || extension.starts_with("KHR_materials_")
        || extension.starts_with("VRMC_")
}

/// Imported glTF document whose data is joined into one buffer, for binary and text files alike.
pub(super) struct Container<'a> {
    pub(super) root: Value,
    pub(super) bin: Cow<'a, [u8]>,
}

impl<'a> Container<'a> {
    /// Parses the document from the edited JSON.
    pub(super) fn document(&self) -> Result<Document<'_>, ReadError> {
        Document::from_json(&self.root, &self.bin)
    }

    pub(super) fn open(bytes: &'a [u8]) -> Result<Self, ImportError> {
        if bytes.len() > MAX_BYTES {
            return Err(ReadError::TooLarge.into());
        }
        let (json, bin) = if bytes.starts_with(b"glTF") {
            document::chunks(bytes)?
        } else {
            (text_of(bytes)?, &[][..])
        };
        let root = serde_json::from_slice(json).map_err(|e| ReadError::NotGlb(e.to_string()))?;
        let mut container = Self {
            root,
            bin: Cow::Borrowed(bin),
        };
        container.refuse_compression()?;
        container.join_buffers(bin)?;
        container.join_images()?;
        Ok(container)
    }

    fn refuse_compression(&self) -> Result<(), ImportError> {
        let named = |key: &str| -> Vec<&str> {
            let list = self.root[key].as_array().map_or(&[][..], Vec::as_slice);
            list.iter().filter_map(Value::as_str).collect()
        };
        for extension in named("extensionsRequired") {
            if let Some((extension, hint)) = COMPRESSIONS.into_iter().find(|c| c.0 == extension) {
                return Err(ImportError::Compressed { extension, hint });
            }
            if !is_understood(extension) {
                return Err(ReadError::Extension(extension.chars().take(80).collect()).into());
            }
        }
        Ok(())
    }

    fn join_buffers(&mut self, bin: &[u8]) -> Result<(), ImportError> {
        let mut bases: Vec<(u64, u64)> = Vec::new();
        let mut joined: Option<Vec<u8>> = None;
        let buffers = self.root["buffers"]
            .as_array()
            .map_or(&[][..], Vec::as_slice);
        for (i, buffer) in buffers.iter().enumerate() {
            let claimed = buffer["byteLength"].as_u64().unwrap_or(0);
            let truncated = ReadError::Truncated { what: "a buffer" };
            let base = match buffer["uri"].as_str() {
                Some(uri) => {
                    let data = decode_uri(uri, "buffer")?;
                    if claimed > data.len() as u64 {
                        return Err(truncated.into());
                    }
                    let all = joined.get_or_insert_with(|| bin.to_vec());
                    all.resize(all.len().next_multiple_of(4), 0);
                    let base = all.len() as u64;
                    all.extend_from_slice(&data);
                    base
                }
                None if packed::is_fallback(buffer) => {
                    bases.push((0, 0));
                    continue;
                }
                None if i == 0 && claimed <= bin.len() as u64 => 0,
                None => return Err(truncated.into()),
            };
            bases.push((base, claimed));
        }
        if let Some(joined) = joined {
            self.bin = Cow::Owned(joined);
        }
        self.place_views(&bases)
    }

    /// Rebases every view to the single buffer. Compressed views get their own.
    fn place_views(&mut self, bases: &[(u64, u64)]) -> Result<(), ImportError> {
        let mut left = MAX_BYTES;
        let views = self.root["bufferViews"].as_array_mut();
        for view in views.into_iter().flatten() {
            let Some(describe) = packed::stream_of(view) else {
                view["byteOffset"] = json!(place(view, bases)?.start);
                view["buffer"] = json!(0);
                continue;
            };
            let stream = self.bin.get(place(describe, bases)?);
            let stream = stream.ok_or(ReadError::Truncated { what: "a view" })?;
            let bytes = packed::unpack(view, describe, stream, left)?;
            left -= bytes.len();
            let bin = self.bin.to_mut();
            bin.resize(bin.len().next_multiple_of(4), 0);
            view["byteOffset"] = json!(bin.len());
            view["buffer"] = json!(0);
            view["extensions"] = Value::Null;
            bin.extend_from_slice(&bytes);
        }
        Ok(())
    }

    /// Converts images in data URIs to views.
    fn join_images(&mut self) -> Result<(), ImportError> {
        let mut images = self.root["images"].take();
        for image in images.as_array_mut().into_iter().flatten() {
            let Some(uri) = image["uri"].as_str().map(str::to_owned) else {
                continue;
            };
            let data = decode_uri(&uri, "picture")?;
            if !image["mimeType"].is_string() {
                let mime = uri[5..].split([';', ',']).next().unwrap_or_default();
                image["mimeType"] = json!(mime);
            }
            let bin = self.bin.to_mut();
            bin.resize(bin.len().next_multiple_of(4), 0);
            let view = json!({ "buffer": 0, "byteOffset": bin.len(), "byteLength": data.len() });
            bin.extend_from_slice(&data);
            if !self.root["bufferViews"].is_array() {
                self.root["bufferViews"] = json!([]);
            }
            if let Some(views) = self.root["bufferViews"].as_array_mut() {
                image["bufferView"] = json!(views.len());
                views.push(view);
            }
        }
        if !images.is_null() {
            self.root["images"] = images;
        }
        Ok(())
    }
}

/// Returns the range of a view, or of a view's stream, in the joined buffers with these starts and
/// lengths.
fn place(view: &Value, bases: &[(u64, u64)]) -> Result<Range<usize>, ReadError> {
    let what = "a view";
    let slot = view["buffer"]
        .as_u64()
        .and_then(|i| usize::try_from(i).ok());
    let (base, length) = *slot
        .and_then(|i| bases.get(i))
        .ok_or(ReadError::OutOfRange { what })?;
    let from = view["byteOffset"].as_u64().unwrap_or(0);
    let end = from.checked_add(view["byteLength"].as_u64().unwrap_or(0));
    let end = end.filter(|end| *end <= length);
    let end = end.ok_or(ReadError::Truncated { what })?;
    // Existing buffers are in memory, so the offsets fit.
    Ok((base + from) as usize..(base + end) as usize)
}

/// Returns the JSON of a text file without byte order mark.
fn text_of(bytes: &[u8]) -> Result<&[u8], ImportError> {
    let text = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
    let first = text.iter().find(|b| !b.is_ascii_whitespace());
    if first == Some(&b'{') {
        return Ok(text);
    }
    Err(ImportError::NotGltf(if bytes.is_empty() {
        "it is empty"
    } else if bytes.starts_with(b"Kaydara FBX") {
        "it is FBX; export it as .glb, for example from Blender"
    } else if bytes.starts_with(b"PK") {
        "it is a zip archive; unpack it first"
    } else if bytes.starts_with(b"BLENDER") {
        "it is a Blender file; export it as .glb"
    } else {
        "it does not begin as one"
    }))
}

fn decode_uri(uri: &str, what: &'static str) -> Result<Vec<u8>, ImportError> {
    let Some(data) = uri.strip_prefix("data:") else {
        return Err(ImportError::ExternalFile {
            what,
            uri: uri.chars().take(80).collect(),
        });
    };
    let coded = data
        .split_once(',')
        .filter(|(kind, _)| kind.ends_with(";base64"))
        .ok_or(ImportError::DataUri { what })?
        .1;
    base64(coded).ok_or(ImportError::DataUri { what })
}

/// Decodes RFC 4648, section 4; padding is optional, other characters are rejected.
fn base64(text: &str) -> Option<Vec<u8>> {
    const UNPADDED: GeneralPurpose =
        GeneralPurpose::new(&STANDARD, NO_PAD.with_decode_allow_trailing_bits(true));
    let text = text.strip_suffix('=').unwrap_or(text);
    let text = text.strip_suffix('=').unwrap_or(text);
    UNPADDED.decode(text).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_of_the_rfc() {
        for (coded, plain) in [
            ("", ""),
            ("Zg==", "f"),
            ("Zm8=", "fo"),
            ("Zm9v", "foo"),
            ("Zm9vYg==", "foob"),
            ("Zm9vYmE=", "fooba"),
            ("Zm9vYmFy", "foobar"),
        ] {
            assert_eq!(base64(coded), Some(plain.as_bytes().to_vec()));
        }
        assert_eq!(base64("Z"), None);
        assert_eq!(base64("Zm9*"), None);
    }
}
