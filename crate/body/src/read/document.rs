//! The parts of a glTF document that make a figure, taken from its JSON by hand.
//!
//! A page downloads this reader with the player. Typed deserialisers for all of glTF weigh
//! 60 KB compressed there, a fifth of the budget; a figure needs a few dozen fields.
//! Fields of a wrong type count as absent; what must be there is asked for by the reader.

use raconteur_base::json::{ABSENT, Json};

use super::ReadError;

const MAGIC: &[u8; 4] = b"glTF";
const CHUNK_JSON: u32 = 0x4E4F_534A;
const CHUNK_BIN: u32 = 0x004E_4942;

/// A node's own placement and what hangs on it.
pub(crate) struct Node {
    pub(crate) name: String,
    pub(crate) children: Vec<usize>,
    pub(crate) matrix: Option<[f64; 16]>,
    pub(crate) translation: Option<[f64; 3]>,
    pub(crate) rotation: Option<[f64; 4]>,
    pub(crate) scale: Option<[f64; 3]>,
    pub(crate) mesh: Option<usize>,
    pub(crate) skin: Option<usize>,
}

pub(crate) struct Skin {
    pub(crate) joints: Vec<usize>,
    pub(crate) inverse_bind_matrices: Option<usize>,
}

pub(crate) struct Mesh {
    pub(crate) name: String,
    pub(crate) target_names: Vec<String>,
    pub(crate) binding: Option<Binding>,
    pub(crate) primitives: Vec<Primitive>,
}

pub(crate) struct Primitive {
    attributes: Vec<(String, usize)>,
    pub(crate) indices: Option<usize>,
    /// glTF's drawing mode; 4 is triangles.
    pub(crate) mode: u64,
    pub(crate) material: Option<usize>,
    pub(crate) targets: Vec<Target>,
}

/// Where the binding of a mesh lies: accessors.
pub(crate) struct Binding {
    pub(crate) version: u64,
    pub(crate) counts: usize,
    pub(crate) nodes: usize,
    pub(crate) weights: usize,
}

impl Primitive {
    /// The accessor of an attribute.
    pub(crate) fn attribute(&self, name: &str) -> Option<usize> {
        self.attributes
            .iter()
            .find(|(n, _)| n == name)
            .map(|(_, a)| *a)
    }
}

pub(crate) struct Target {
    pub(crate) positions: Option<usize>,
    pub(crate) normals: Option<usize>,
}

pub(crate) struct Material {
    pub(crate) kind: String,
    pub(crate) base_color: [f64; 4],
    pub(crate) roughness: f64,
    pub(crate) double_sided: bool,
    pub(crate) base_color_texture: Option<usize>,
    pub(crate) normal_texture: Option<usize>,
    pub(crate) wrinkle_texture: Option<usize>,
}

/// A picture in the binary chunk.
pub(crate) struct Image {
    pub(crate) mime_type: String,
    pub(crate) view: usize,
}

/// Type of one number in a buffer.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Component {
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

    pub(crate) fn bytes(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::U32 | Self::F32 => 4,
        }
    }
}

pub(crate) struct Accessor {
    pub(crate) buffer_view: Option<usize>,
    pub(crate) byte_offset: u64,
    pub(crate) count: u64,
    pub(crate) component: Option<Component>,
    /// Numbers an element; 0 for an unknown type.
    pub(crate) width: usize,
    pub(crate) normalized: bool,
    pub(crate) sparse: Option<Sparse>,
}

pub(crate) struct Sparse {
    pub(crate) count: u64,
    pub(crate) index_component: Option<Component>,
    pub(crate) index_view: usize,
    pub(crate) index_offset: u64,
    pub(crate) value_view: usize,
    pub(crate) value_offset: u64,
}

pub(crate) struct View {
    pub(crate) buffer: usize,
    pub(crate) byte_offset: u64,
    pub(crate) byte_length: u64,
    pub(crate) byte_stride: Option<usize>,
}

/// A document and its binary chunk.
pub(crate) struct Document<'a> {
    pub(crate) extensions_required: Vec<String>,
    pub(crate) stature_m: Option<f64>,
    pub(crate) lid_closure_rad: Option<[f64; 2]>,
    pub(crate) sex: Option<f64>,
    pub(crate) is_left_handed: bool,
    /// The view that holds the tissue of the face.
    pub(crate) tissue: Option<usize>,
    pub(crate) nodes: Vec<Node>,
    pub(crate) skins: Vec<Skin>,
    pub(crate) meshes: Vec<Mesh>,
    pub(crate) materials: Vec<Material>,
    pub(crate) images: Vec<Image>,
    /// The image of each texture.
    pub(crate) texture_images: Vec<usize>,
    pub(crate) accessors: Vec<Accessor>,
    pub(crate) views: Vec<View>,
    pub(crate) bin: &'a [u8],
}

fn items<'v, 'a>(value: &'v Json<'a>, key: &str) -> &'v [Json<'a>] {
    value[key].items()
}

fn index(value: &Json<'_>, key: &str) -> Option<usize> {
    value[key].index()
}

/// An index that must be there; one that is not points nowhere.
fn needed_index(value: &Json<'_>, key: &str) -> usize {
    index(value, key).unwrap_or(usize::MAX)
}

fn indices(value: &Json<'_>, key: &str) -> Vec<usize> {
    items(value, key)
        .iter()
        .map(|v| v.index().unwrap_or(usize::MAX))
        .collect()
}

fn whole(value: &Json<'_>, key: &str) -> u64 {
    value[key].whole().unwrap_or(0)
}

fn text(value: &Json<'_>, key: &str) -> String {
    value[key].text().unwrap_or_default().to_owned()
}

fn texts(value: &Json<'_>, key: &str) -> Vec<String> {
    items(value, key)
        .iter()
        .filter_map(Json::text)
        .map(str::to_owned)
        .collect()
}

fn numbers<const N: usize>(value: &Json<'_>, key: &str) -> Option<[f64; N]> {
    let list = items(value, key);
    if list.len() != N {
        return None;
    }
    let mut out = [0.0; N];
    for (o, v) in out.iter_mut().zip(list) {
        *o = v.number()?;
    }
    Some(out)
}

fn component(value: &Json<'_>) -> Option<Component> {
    Component::from_code(whole(value, "componentType"))
}

fn node(v: &Json<'_>) -> Node {
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

fn skin(v: &Json<'_>) -> Skin {
    Skin {
        joints: indices(v, "joints"),
        inverse_bind_matrices: index(v, "inverseBindMatrices"),
    }
}

fn primitive(v: &Json<'_>) -> Primitive {
    Primitive {
        attributes: v["attributes"]
            .members()
            .iter()
            .map(|(k, a)| (k.to_string(), a.index().unwrap_or(usize::MAX)))
            .collect(),
        indices: index(v, "indices"),
        mode: v["mode"].whole().unwrap_or(4),
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

fn mesh(v: &Json<'_>) -> Mesh {
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
        primitives: items(v, "primitives").iter().map(primitive).collect(),
    }
}

fn material(v: &Json<'_>) -> Material {
    let pbr = &v["pbrMetallicRoughness"];
    let extras = &v["extras"];
    Material {
        kind: text(extras, "kind"),
        base_color: numbers(pbr, "baseColorFactor").unwrap_or([1.0; 4]),
        roughness: pbr["roughnessFactor"].number().unwrap_or(1.0),
        double_sided: v["doubleSided"].truth().unwrap_or(false),
        base_color_texture: index(&pbr["baseColorTexture"], "index"),
        normal_texture: index(&v["normalTexture"], "index"),
        wrinkle_texture: index(&extras["wrinkleTexture"], "index"),
    }
}

fn accessor(v: &Json<'_>) -> Accessor {
    let sparse = &v["sparse"];
    Accessor {
        buffer_view: index(v, "bufferView"),
        byte_offset: whole(v, "byteOffset"),
        count: whole(v, "count"),
        component: component(v),
        width: match v["type"].text() {
            Some("SCALAR") => 1,
            Some("VEC2") => 2,
            Some("VEC3") => 3,
            Some("VEC4" | "MAT2") => 4,
            Some("MAT3") => 9,
            Some("MAT4") => 16,
            _ => 0,
        },
        normalized: v["normalized"].truth().unwrap_or(false),
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

fn view(v: &Json<'_>) -> View {
    View {
        buffer: needed_index(v, "buffer"),
        byte_offset: whole(v, "byteOffset"),
        byte_length: whole(v, "byteLength"),
        byte_stride: index(v, "byteStride"),
    }
}

fn word(bytes: &[u8], at: usize) -> Option<u32> {
    let b = bytes.get(at..at.checked_add(4)?)?;
    Some(u32::from_le_bytes([b[0], b[1], b[2], b[3]]))
}

/// The JSON and binary chunks of a container.
pub(crate) fn chunks(glb: &[u8]) -> Result<(&[u8], &[u8]), ReadError> {
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
    /// Takes a container apart.
    pub(crate) fn read(glb: &'a [u8]) -> Result<Self, ReadError> {
        let (json, bin) = chunks(glb)?;
        let root = Json::read(json).map_err(|e| ReadError::NotGlb(e.to_string()))?;
        Self::of(&root, bin)
    }

    /// From a document's JSON and its one buffer.
    pub(crate) fn of(root: &Json<'_>, bin: &'a [u8]) -> Result<Self, ReadError> {
        if root["asset"]["version"]
            .text()
            .is_none_or(|v| !v.starts_with("2."))
        {
            return Err(ReadError::NotGlb("its asset version is not 2".to_owned()));
        }
        let scene = index(root, "scene").and_then(|i| items(root, "scenes").get(i));
        let extras = scene.map_or(&ABSENT, |s| &s["extras"]);
        let all = |key: &str| items(root, key).iter();
        Ok(Self {
            extensions_required: texts(root, "extensionsRequired"),
            stature_m: extras["statureMetres"].number(),
            lid_closure_rad: numbers(extras, "lidClosureRadians"),
            sex: extras["sex"].number(),
            is_left_handed: extras["handedness"].text() == Some("left"),
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
            texture_images: all("textures").map(|v| needed_index(v, "source")).collect(),
            accessors: all("accessors").map(accessor).collect(),
            views: all("bufferViews").map(view).collect(),
            bin,
        })
    }
}
