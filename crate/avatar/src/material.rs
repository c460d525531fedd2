//! Materials and images of an imported file.

use raconteur_base::ops;
use serde_json::Value;

use super::error::{DiagnosticSink, ImportError};
use raconteur_body::figure::{Image, Material, MaterialKind, TextureMaps};
use raconteur_body::read::ReadError;
use raconteur_body::read::accessor::Source;

/// Material of an imported primitive, with the set and transform of its texture coordinates.
#[derive(Clone)]
pub(super) struct Surface {
    pub(super) material: Material,
    /// Texture coordinate set.
    pub(super) uv_set: usize,
    /// Matrix (row by row) and offset that texture coordinates are moved by.
    pub(super) uv_transform: [[f64; 3]; 2],
}

const LEFT_OUT: &str = "an image is neither PNG nor JPEG and was ignored";
const USUAL: &str = "export pictures as PNG or JPEG";

const UNMOVED: [[f64; 3]; 2] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];

fn index(v: &Value) -> Option<usize> {
    v.as_u64().and_then(|n| usize::try_from(n).ok())
}

fn items<'v>(v: &'v Value, key: &str) -> &'v [Value] {
    v[key].as_array().map_or(&[], Vec::as_slice)
}

fn number(v: &Value, default: f64, what: &'static str) -> Result<f64, ReadError> {
    let x = v.as_f64().unwrap_or(default);
    if (x as f32).is_finite() {
        Ok(x)
    } else {
        Err(ReadError::NotFinite { what })
    }
}

/// Images of an imported file, with the index of each in the figure's list. Images other than PNG
/// or JPEG are omitted, with a diagnostic if a surface uses one.
pub(super) struct ImageTable {
    pub(super) images: Vec<Image>,
    places: Vec<Option<usize>>,
}

impl ImageTable {
    pub(super) fn read(json: &Value, source: &mut Source<'_>) -> Result<Self, ImportError> {
        let (mut images, mut places) = (Vec::new(), Vec::new());
        for image in items(json, "images") {
            let view =
                index(&image["bufferView"]).ok_or(ReadError::OutOfRange { what: "a picture" })?;
            let bytes = source.view_bytes(view, "a picture")?;
            let mime_type = if bytes.starts_with(b"\x89PNG\r\n\x1a\n") {
                "image/png"
            } else if bytes.starts_with(b"\xFF\xD8\xFF") {
                "image/jpeg"
            } else {
                places.push(None);
                continue;
            };
            places.push(Some(images.len()));
            images.push(Image {
                mime_type: mime_type.to_owned(),
                bytes: bytes.to_vec(),
            });
        }
        Ok(Self { images, places })
    }

    /// Returns the image of a texture reference.
    fn image_of(
        &self,
        json: &Value,
        reference: &Value,
        notes: &mut DiagnosticSink,
    ) -> Result<Option<usize>, ReadError> {
        let what = "a material's texture";
        let Some(texture) = index(&reference["index"]) else {
            return Ok(None);
        };
        let texture = items(json, "textures")
            .get(texture)
            .ok_or(ReadError::OutOfRange { what })?;
        // Images from extensions are alternatives for programs that support them; a texture with
        // only an extension image shows nothing.
        let place = match index(&texture["source"]) {
            Some(image) => *self
                .places
                .get(image)
                .ok_or(ReadError::OutOfRange { what })?,
            None => None,
        };
        if place.is_none() {
            notes.add("picture-left-out", LEFT_OUT, USUAL);
        }
        Ok(place)
    }

    /// Removes images not used by any mesh, and renumbers the others.
    pub(super) fn keep_used<'m>(
        self,
        materials: impl Iterator<Item = &'m mut Material>,
    ) -> Vec<Image> {
        let mut places: Vec<Option<usize>> = vec![None; self.images.len()];
        let mut order = Vec::new();
        for material in materials {
            for slot in [&mut material.maps.base_color, &mut material.maps.normal] {
                if let Some(old) = *slot {
                    *slot = Some(*places[old].get_or_insert_with(|| {
                        order.push(old);
                        order.len() - 1
                    }));
                }
            }
        }
        let mut images: Vec<Option<Image>> = self.images.into_iter().map(Some).collect();
        order
            .into_iter()
            .filter_map(|old| images[old].take())
            .collect()
    }
}

/// Returns the `KHR_texture_transform` of a texture reference as a 2×3 matrix: scale, then
/// rotation, then offset.
fn transform(reference: &Value) -> Result<[[f64; 3]; 2], ReadError> {
    let t = &reference["extensions"]["KHR_texture_transform"];
    if !t.is_object() {
        return Ok(UNMOVED);
    }
    let what = "a texture's transform";
    let pair = |key: &str, default: f64| -> Result<[f64; 2], ReadError> {
        Ok([
            number(&t[key][0], default, what)?,
            number(&t[key][1], default, what)?,
        ])
    };
    let [ox, oy] = pair("offset", 0.0)?;
    let [sx, sy] = pair("scale", 1.0)?;
    let (sin, cos) = ops::sincos(number(&t["rotation"], 0.0, what)?);
    Ok([[cos * sx, sin * sy, ox], [-sin * sx, cos * sy, oy]])
}

fn uv_set(reference: &Value) -> usize {
    let moved = &reference["extensions"]["KHR_texture_transform"]["texCoord"];
    index(moved)
        .or_else(|| index(&reference["texCoord"]))
        .unwrap_or(0)
}

/// Returns the material of a primitive and the mapping of its texture.
pub(super) fn surface(
    json: &Value,
    material: Option<usize>,
    pictures: &ImageTable,
    notes: &mut DiagnosticSink,
) -> Result<Surface, ReadError> {
    let what = "a mesh's material";
    let m = match material {
        None => &Value::Null,
        Some(i) => items(json, "materials")
            .get(i)
            .ok_or(ReadError::OutOfRange { what })?,
    };
    let pbr = &m["pbrMetallicRoughness"];
    // Older files specify diffuse and gloss.
    let gloss = &m["extensions"]["KHR_materials_pbrSpecularGlossiness"];
    let old = gloss.is_object();
    let (factor, color) = if old {
        (&gloss["diffuseFactor"], &gloss["diffuseTexture"])
    } else {
        (&pbr["baseColorFactor"], &pbr["baseColorTexture"])
    };
    let mut base_color = [1.0; 4];
    for (i, c) in base_color.iter_mut().enumerate() {
        *c = number(&factor[i], 1.0, what)?.clamp(0.0, 1.0) as f32;
    }
    // Opaque materials ignore alpha; cut-out materials have it in their image.
    if m["alphaMode"].as_str() != Some("BLEND") {
        base_color[3] = 1.0;
    }
    let unlit = m["extensions"]["KHR_materials_unlit"].is_object();
    if unlit {
        notes.add(
            "unlit-lit",
            "surfaces that ask for no light are lit like the rest of the stage",
            "",
        );
    }
    let roughness = if old {
        1.0 - number(&gloss["glossinessFactor"], 1.0, what)?.clamp(0.0, 1.0)
    } else {
        number(&pbr["roughnessFactor"], 1.0, what)?.clamp(0.0, 1.0)
    };
    let normal = &m["normalTexture"];
    let color_map = pictures.image_of(json, color, notes)?;
    let mut normal_map = pictures.image_of(json, normal, notes)?;
    let uv_transform = transform(color)?;
    if normal_map.is_some()
        && color_map.is_some()
        && (uv_set(normal) != uv_set(color) || transform(normal)? != uv_transform)
    {
        normal_map = None;
        notes.add(
            "normals-left-out",
            "a normal map uses other texture coordinates than its colours and was ignored",
            "",
        );
    }
    let leading = if color_map.is_some() { color } else { normal };
    Ok(Surface {
        material: Material {
            kind: MaterialKind::Plain,
            base_color,
            roughness: if unlit { 1.0 } else { roughness as f32 },
            double_sided: m["doubleSided"].as_bool().unwrap_or(false),
            maps: TextureMaps {
                base_color: color_map,
                normal: normal_map,
                wrinkles: None,
            },
        },
        uv_set: uv_set(leading),
        uv_transform: transform(leading)?,
    })
}
