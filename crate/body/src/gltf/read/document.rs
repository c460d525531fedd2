//! Figure parts of a glTF document, read from its JSON.
//!
//! The tests read the same files with the `gltf` crate. It is not used here, according to
//! measurements: its typed JSON adds 70 KB (gzip) to a page's download, more than the remaining
//! budget of the WebGL2 build; it stores node transforms in single precision, which moves every
//! joint by up to 3e-8 m; it rejects avatars whose exporters write `null` for absent members; and
//! its container reader computes with a claimed length before checking it. Fields of a wrong type
//! count as absent; the reader checks required fields.

use serde_json::Value;

use super::ReadError;
use super::packed::CompressedView;
use crate::gltf::fields::{
    as_index, index, indices, items, needed_index, numbers, text, texts, whole,
};
use crate::gltf::springs;
use crate::springs::Springs;

const MAGIC: &[u8; 4] = b"glTF";
const CHUNK_JSON: u32 = 0x4E4F_534A;
const CHUNK_BIN: u32 = 0x004E_4942;

/// Node of a glTF document: local transform, children, mesh and skin.
pub struct Node {
    pub name: String,
    pub children: Vec<usize>,
    pub matrix: Option<[f64; 16]>,
    pub translation: Option<[f64; 3]>,
    pub rotation: Option<[f64; 4]>,
    pub scale: Option<[f64; 3]>,
    pub mesh: Option<usize>,
    pub skin: Option<usize>,
}

pub struct Skin {
    pub joints: Vec<usize>,
    pub inverse_bind_matrices: Option<usize>,
}

pub struct Mesh {
    pub name: String,
    pub target_names: Vec<String>,
    pub binding: Option<Binding>,
    /// Accessors of the triangles of coarser levels of detail.
    pub coarser: Vec<usize>,
    pub primitives: Vec<Primitive>,
}

pub struct Primitive {
    attributes: Vec<(String, usize)>,
    pub indices: Option<usize>,
    /// glTF's drawing mode; 4 is triangles.
    pub mode: u64,
    pub material: Option<usize>,
    pub targets: Vec<Target>,
}

/// Accessors that bind a mesh to the tissue of the face: nodes and weights per vertex.
pub struct Binding {
    pub version: u64,
    pub counts: usize,
    pub nodes: usize,
    pub weights: usize,
}

impl Primitive {
    /// Returns the accessor of a vertex attribute by name; `None` if the primitive lacks it.
    pub fn attribute(&self, name: &str) -> Option<usize> {
        self.attributes
            .iter()
            .find(|(n, _)| n == name)
            .map(|(_, a)| *a)
    }
}

pub struct Target {
    pub positions: Option<usize>,
    pub normals: Option<usize>,
}

pub struct Material {
    pub kind: String,
    pub base_color: [f64; 4],
    pub roughness: f64,
    pub double_sided: bool,
    pub base_color_texture: Option<usize>,
    pub normal_texture: Option<usize>,
    pub wrinkle_texture: Option<usize>,
}

/// Image stored in the binary chunk of a glTF document: media type and buffer view.
pub struct Image {
    pub mime_type: String,
    pub view: usize,
}

/// Component type of the numbers in an accessor.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Component {
    I8,
    U8,
    I16,
    U16,
    U32,
    F32,
}

impl Component {
    fn from_code(code: u64) -> Option<Self> {
        Some(match code {
            5120 => Self::I8,
            5121 => Self::U8,
            5122 => Self::I16,
            5123 => Self::U16,
            5125 => Self::U32,
            5126 => Self::F32,
            _ => return None,
        })
    }

    pub fn bytes(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::U32 | Self::F32 => 4,
        }
    }
}

pub struct Accessor {
    pub buffer_view: Option<usize>,
    pub byte_offset: u64,
    pub count: u64,
    pub component: Option<Component>,
    /// Numbers an element; 0 for an unknown type.
    pub width: usize,
    pub normalized: bool,
    pub sparse: Option<Sparse>,
}

pub struct Sparse {
    pub count: u64,
    pub index_component: Option<Component>,
    pub index_view: usize,
    pub index_offset: u64,
    pub value_view: usize,
    pub value_offset: u64,
}

pub struct View {
    pub buffer: usize,
    pub byte_offset: u64,
    pub byte_length: u64,
    pub byte_stride: Option<usize>,
    pub packed: Option<CompressedView>,
}

/// Parsed parts of a glTF document that make up a figure, with the binary chunk.
pub struct Document<'a> {
    pub extensions_required: Vec<String>,
    pub stature_m: Option<f64>,
    pub lid_closure_rad: Option<[f64; 2]>,
    /// [`Tissue::lines`](crate::face::Tissue::lines); 0 if the file has none.
    pub lines: f64,
    pub sex: Option<f64>,
    pub is_left_handed: bool,
    /// View that holds the tissue of the face.
    pub tissue: Option<usize>,
    pub nodes: Vec<Node>,
    pub skins: Vec<Skin>,
    pub meshes: Vec<Mesh>,
    pub materials: Vec<Material>,
    pub images: Vec<Image>,
    /// The image of each texture.
    pub texture_images: Vec<usize>,
    /// Spring chains; their joints are nodes.
    pub springs: Springs,
    pub accessors: Vec<Accessor>,
    pub views: Vec<View>,
    pub bin: &'a [u8],
}

fn component(value: &Value) -> Option<Component> {
    Component::from_code(whole(value, "componentType"))
}

fn node(v: &Value) -> Node {
    Node {
        name: text(v, "name"),
        children: indices(v, "children"),
        matrix: numbers(v, "matrix"),
        translation: numbers(v, "translation"),
        rotation: numbers(v, "rotation"),
        scale: numbers(v, "scale"),
        mesh: index(v, "mesh"),
        skin: index(v, "skin"),
    }
}

fn skin(v: &Value) -> Skin {
    Skin {
        joints: indices(v, "joints"),
        inverse_bind_matrices: index(v, "inverseBindMatrices"),
    }
}

fn primitive(v: &Value) -> Primitive {
    Primitive {
        attributes: v["attributes"]
            .as_object()
            .into_iter()
            .flatten()
            .map(|(k, a)| (k.clone(), as_index(a).unwrap_or(usize::MAX)))
            .collect(),
        indices: index(v, "indices"),
        mode: v["mode"].as_u64().unwrap_or(4),
        material: index(v, "material"),
        targets: items(v, "targets")
            .iter()
            .map(|t| Target {
                positions: index(t, "POSITION"),
                normals: index(t, "NORMAL"),
            })
            .collect(),
    }
}

fn mesh(v: &Value) -> Mesh {
    let extras = &v["extras"];
    let binding = &extras["binding"];
    Mesh {
        name: text(v, "name"),
        target_names: texts(extras, "targetNames"),
        binding: binding.is_object().then(|| Binding {
            version: whole(binding, "version"),
            counts: needed_index(binding, "counts"),
            nodes: needed_index(binding, "nodes"),
            weights: needed_index(binding, "weights"),
        }),
        coarser: indices(extras, "coarser"),
        primitives: items(v, "primitives").iter().map(primitive).collect(),
    }
}

fn material(v: &Value) -> Material {
    let pbr = &v["pbrMetallicRoughness"];
    let extras = &v["extras"];
    Material {
        kind: text(extras, "kind"),
        base_color: numbers(pbr, "baseColorFactor").unwrap_or([1.0; 4]),
        roughness: pbr["roughnessFactor"].as_f64().unwrap_or(1.0),
        double_sided: v["doubleSided"].as_bool().unwrap_or(false),
        base_color_texture: index(&pbr["baseColorTexture"], "index"),
        normal_texture: index(&v["normalTexture"], "index"),
        wrinkle_texture: index(&extras["wrinkleTexture"], "index"),
    }
}

fn accessor(v: &Value) -> Accessor {
    let sparse = &v["sparse"];
    Accessor {
        buffer_view: index(v, "bufferView"),
        byte_offset: whole(v, "byteOffset"),
        count: whole(v, "count"),
        component: component(v),
        width: match v["type"].as_str() {
            Some("SCALAR") => 1,
            Some("VEC2") => 2,
            Some("VEC3") => 3,
            Some("VEC4" | "MAT2") => 4,
            Some("MAT3") => 9,
            Some("MAT4") => 16,
            _ => 0,
        },
        normalized: v["normalized"].as_bool().unwrap_or(false),
        sparse: sparse.is_object().then(|| Sparse {
            count: whole(sparse, "count"),
            index_component: component(&sparse["indices"]),
            index_view: needed_index(&sparse["indices"], "bufferView"),
            index_offset: whole(&sparse["indices"], "byteOffset"),
            value_view: needed_index(&sparse["values"], "bufferView"),
            value_offset: whole(&sparse["values"], "byteOffset"),
        }),
    }
}

fn view(v: &Value) -> View {
    View {
        buffer: needed_index(v, "buffer"),
        byte_offset: whole(v, "byteOffset"),
        byte_length: whole(v, "byteLength"),
        byte_stride: index(v, "byteStride"),
        packed: CompressedView::from_json(v),
    }
}

fn word(bytes: &[u8], at: usize) -> Option<u32> {
    let b = bytes.get(at..at.checked_add(4)?)?;
    Some(u32::from_le_bytes([b[0], b[1], b[2], b[3]]))
}

/// Splits a GLB container into its JSON and binary chunks.
pub fn chunks(glb: &[u8]) -> Result<(&[u8], &[u8]), ReadError> {
    let bad = |what: &str| ReadError::NotGlb(what.to_owned());
    if glb.get(..4) != Some(MAGIC) {
        return Err(bad("it does not begin with glTF"));
    }
    if word(glb, 4) != Some(2) {
        return Err(bad("its version is not 2"));
    }
    let claimed = word(glb, 8).ok_or_else(|| bad("the header is incomplete"))? as usize;
    let file = glb
        .get(..claimed)
        .ok_or_else(|| bad("it is shorter than it claims"))?;
    let (mut json, mut bin) = (None, None);
    let mut at = 12;
    while at < file.len() {
        let header = word(file, at).zip(word(file, at + 4));
        let (length, kind) = header.ok_or_else(|| bad("a chunk has no whole header"))?;
        let from = at + 8;
        let end = from
            .checked_add(length as usize)
            .filter(|end| *end <= file.len());
        let end = end.ok_or_else(|| bad("a chunk is shorter than it claims"))?;
        match kind {
            CHUNK_JSON if json.is_none() => json = Some(&file[from..end]),
            CHUNK_BIN if bin.is_none() => bin = Some(&file[from..end]),
            _ => {}
        }
        // Chunks begin at multiples of four.
        at = end.next_multiple_of(4);
    }
    Ok((
        json.ok_or_else(|| bad("it has no JSON chunk"))?,
        bin.unwrap_or_default(),
    ))
}

impl<'a> Document<'a> {
    /// Parses a GLB container.
    pub fn read(glb: &'a [u8]) -> Result<Self, ReadError> {
        let (json, bin) = chunks(glb)?;
        let root = serde_json::from_slice(json).map_err(|e| ReadError::NotGlb(e.to_string()))?;
        Self::from_json(&root, bin)
    }

    /// Creates a document from its JSON and its one buffer.
    pub fn from_json(root: &Value, bin: &'a [u8]) -> Result<Self, ReadError> {
        if root["asset"]["version"]
            .as_str()
            .is_none_or(|v| !v.starts_with("2."))
        {
            return Err(ReadError::NotGlb("its asset version is not 2".to_owned()));
        }
        let scene = index(root, "scene").and_then(|i| items(root, "scenes").get(i));
        let extras = scene.map_or(&Value::Null, |s| &s["extras"]);
        let all = |key: &str| items(root, key).iter();
        Ok(Self {
            extensions_required: texts(root, "extensionsRequired"),
            stature_m: extras["statureMetres"].as_f64(),
            lid_closure_rad: numbers(extras, "lidClosureRadians"),
            sex: extras["sex"].as_f64(),
            lines: extras["lines"].as_f64().unwrap_or(0.0).clamp(0.0, 1.0),
            is_left_handed: extras["handedness"].as_str() == Some("left"),
            tissue: index(extras, "tissue"),
            nodes: all("nodes").map(node).collect(),
            skins: all("skins").map(skin).collect(),
            meshes: all("meshes").map(mesh).collect(),
            materials: all("materials").map(material).collect(),
            images: all("images")
                .map(|v| Image {
                    mime_type: text(v, "mimeType"),
                    view: needed_index(v, "bufferView"),
                })
                .collect(),
            springs: springs::read(root),
            texture_images: all("textures").map(|v| needed_index(v, "source")).collect(),
            accessors: all("accessors").map(accessor).collect(),
            views: all("bufferViews").map(view).collect(),
            bin,
        })
    }
}
