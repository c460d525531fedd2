//! Writer of a figure as glTF 2.0 binary.
//!
//! Positions, normals, texture coordinates and morph targets are quantised (KHR_mesh_quantization).
//! The positions' grid is the same for the whole figure and is undone by the inverse bind matrices,
//! as glTF requires for skinned meshes. The same figure always gives the same bytes.

mod binding;
mod buffer;
mod pack;

use raconteur_base::{DAffine3, DVec3, Side};
use serde_json::{Map, Value, json};

use super::annotation::Annotations;
use super::read::packed;
use super::springs;
use crate::face::file;
use crate::figure::{Figure, Material, MaterialKind, Mesh};
use crate::skeleton::{Bone, Drive};
use buffer::{Buffer, FLOAT, Packing, UNSIGNED_BYTE};

/// The extension of positions and the like as small integers.
const QUANTIZATION: &str = "KHR_mesh_quantization";

/// Quantisation grid of the positions: a power of two, so values on it are exact in `f32`.
struct Grid {
    /// World position of the integer origin, metres.
    origin: DVec3,
    /// Metres a step.
    step: f64,
}

impl Grid {
    /// Returns the finest grid of 16 bits that holds all meshes. A figure up to 2 m gets steps of
    /// 1/32768 m (0.03 mm).
    fn around(meshes: &[Mesh]) -> Self {
        let points = || meshes.iter().flat_map(|m| &m.positions).map(|p| vec(*p));
        let low = points().fold(DVec3::MAX, DVec3::min);
        let high = points().fold(DVec3::MIN, DVec3::max);
        if low.cmpgt(high).any() {
            return Self {
                origin: DVec3::ZERO,
                step: 1.0 / 32768.0,
            };
        }
        // A sixteenth of a metre is exact and hardly changes when a figure is written again.
        let origin = ((low + high) * 0.5 * 16.0).round() / 16.0;
        let reach = (high - origin).max(origin - low).max_element();
        let mut step = 1.0 / 32768.0;
        while step * 32767.0 < reach {
            step *= 2.0;
        }
        Self { origin, step }
    }

    fn quantise(&self, p: DVec3) -> [i16; 3] {
        ((p - self.origin) / self.step)
            .to_array()
            .map(|x| x.round() as i16)
    }

    /// Returns the transform from the quantisation grid to world.
    fn world_from_grid(&self) -> DAffine3 {
        DAffine3::from_scale_rotation_translation(
            DVec3::splat(self.step),
            raconteur_base::DQuat::IDENTITY,
            self.origin,
        )
    }
}

fn vec(p: [f32; 3]) -> DVec3 {
    DVec3::new(f64::from(p[0]), f64::from(p[1]), f64::from(p[2]))
}

/// Returns a JSON number with seven decimals: enough for `f32`, and short in the file.
fn number(x: f64) -> Value {
    let r = (x * 1e7).round() / 1e7;
    // Zero has one sign in the file.
    json!(if r == 0.0 { 0.0 } else { r })
}

fn numbers(xs: &[f64]) -> Value {
    Value::Array(xs.iter().map(|&x| number(x)).collect())
}

fn material(m: &Material) -> Value {
    let kind = MaterialKind::NAMES
        .iter()
        .find(|n| n.0 == m.kind)
        .map_or("plain", |n| n.1);
    let color: Vec<f64> = m.base_color.iter().map(|&c| f64::from(c)).collect();
    let mut value = json!({
        "name": kind,
        "doubleSided": m.double_sided,
        "alphaMode": if m.base_color[3] < 1.0 { "BLEND" } else { "OPAQUE" },
        "pbrMetallicRoughness": {
            "baseColorFactor": numbers(&color),
            "metallicFactor": 0.0,
            "roughnessFactor": number(f64::from(m.roughness)),
        },
        "extras": { "kind": kind },
    });
    // Texture i shows image i.
    if let Some(i) = m.maps.base_color {
        value["pbrMetallicRoughness"]["baseColorTexture"] = json!({ "index": i });
    }
    if let Some(i) = m.maps.normal {
        value["normalTexture"] = json!({ "index": i });
    }
    if let Some(i) = m.maps.wrinkles {
        value["extras"]["wrinkleTexture"] = json!({ "index": i });
    }
    value
}

fn mesh(buffer: &mut Buffer, grid: &Grid, figure: &Figure, mesh: &Mesh, material: usize) -> Value {
    let colors: Vec<u8> = mesh.colors.iter().flatten().copied().collect();
    let weights: Vec<u8> = mesh
        .weights
        .iter()
        .flat_map(|w| weights_in_255ths(*w))
        .collect();
    let mut primitive = json!({
        "attributes": {
            "POSITION": buffer.positions(grid, mesh),
            "NORMAL": buffer.normals(mesh),
            "COLOR_0": buffer.attribute(&colors, 4, UNSIGNED_BYTE, true, "VEC4"),
            "JOINTS_0": buffer.joints(mesh),
            "WEIGHTS_0": buffer.attribute(&weights, 4, UNSIGNED_BYTE, true, "VEC4"),
        },
        "indices": buffer.indices(&mesh.indices, mesh.positions.len()),
        "material": material,
    });
    // The reader treats absent coordinates as zeros.
    if mesh.uvs.iter().flatten().any(|x| *x != 0.0) {
        primitive["attributes"]["TEXCOORD_0"] = json!(buffer.uvs(mesh));
    }
    let mut value = json!({ "name": mesh.name });
    if let Some(b) = &mesh.binding {
        value["extras"] = json!({ "binding": binding::write(buffer, b, mesh.positions.len()) });
    }
    if !mesh.coarser.is_empty() {
        let levels = mesh.coarser.iter();
        let accessors: Vec<usize> = levels
            .map(|triangles| buffer.indices(triangles, mesh.positions.len()))
            .collect();
        value["extras"]["coarser"] = json!(accessors);
    }
    if !mesh.morphs.is_empty() {
        let targets: Vec<Value> = mesh
            .morphs
            .iter()
            .map(|m| buffer.morph(grid, mesh, m))
            .collect();
        let names: Vec<&String> = mesh
            .morphs
            .iter()
            .map(|m| &figure.morph_names[m.target])
            .collect();
        primitive["targets"] = json!(targets);
        value["extras"]["targetNames"] = json!(names);
        value["weights"] = json!(vec![0.0; names.len()]);
    }
    value["primitives"] = json!([primitive]);
    value
}

/// Returns weights rounded to 255ths whose sum is exactly 255; the largest absorbs the rounding.
#[must_use]
pub fn weights_in_255ths(w: [f32; 4]) -> [u8; 4] {
    let mut q = w.map(|x| (x * 255.0).round() as i32);
    let mut largest = 0;
    for i in 1..4 {
        if w[i] > w[largest] {
            largest = i;
        }
    }
    q[largest] += 255 - q.iter().sum::<i32>();
    q.map(|x| x.clamp(0, 255) as u8)
}

/// Joints as nodes in the bind pose; node i is joint i.
fn joint_nodes(figure: &Figure) -> Vec<Value> {
    let world: Vec<DAffine3> = figure.inverse_bind.iter().map(DAffine3::inverse).collect();
    let joints = figure.skeleton.joints();
    joints
        .iter()
        .enumerate()
        .map(|(i, joint)| {
            let local = joint
                .parent
                .map_or(world[i], |p| world[p].inverse() * world[i]);
            let (_, rotation, translation) = local.to_scale_rotation_translation();
            let mut node = json!({
                "name": joint.name,
                "translation": numbers(&translation.to_array()),
                "rotation": numbers(&rotation.normalize().to_array()),
            });
            let children: Vec<usize> = (0..joints.len())
                .filter(|&c| joints[c].parent == Some(i))
                .collect();
            if !children.is_empty() {
                node["children"] = json!(children);
            }
            node
        })
        .collect()
}

/// Writes the figure as a `.glb` file for every reader of `KHR_mesh_quantization`.
#[must_use]
pub fn to_glb(figure: &Figure) -> Vec<u8> {
    let (mut document, buffer) = document(figure, &Annotations::default());
    document["buffers"] = json!([{ "byteLength": buffer.bytes.len() }]);
    finish(document, buffer)
}

/// Writes the figure as a compressed `.glb` file with the annotations of its meshes: about half as
/// long. Corners of triangles may be rotated, for example 1, 2, 0 for 0, 1, 2.
#[must_use]
pub fn to_packed_glb(figure: &Figure, annotations: &Annotations) -> Vec<u8> {
    let (mut document, mut buffer) = document(figure, annotations);
    document["buffers"] = pack::pack(&mut buffer);
    let needed = [packed::EXTENSION, QUANTIZATION];
    document["extensionsUsed"] = json!(used(figure, &needed));
    document["extensionsRequired"] = json!(needed);
    finish(document, buffer)
}

/// Returns the names of the extensions that a file uses: the needed ones, and that of springs if
/// the figure has any.
fn used<'a>(figure: &Figure, needed: &[&'a str]) -> Vec<&'a str> {
    let springs = (!figure.springs.is_empty()).then_some(springs::EXTENSION);
    needed.iter().copied().chain(springs).collect()
}

fn finish(mut document: Value, buffer: Buffer) -> Vec<u8> {
    document["accessors"] = Value::Array(buffer.accessors);
    document["bufferViews"] = Value::Array(buffer.views);
    glb(document.to_string().into_bytes(), buffer.bytes)
}

/// Writes the inverse bind matrices, which also undo the quantisation grid, and returns their
/// accessor.
fn inverse_bind(buffer: &mut Buffer, figure: &Figure, grid: &Grid) -> usize {
    let bytes: Vec<u8> = figure
        .inverse_bind
        .iter()
        .flat_map(|m| {
            let grid_bind = *m * grid.world_from_grid();
            let columns = raconteur_base::DMat4::from(grid_bind).to_cols_array();
            columns.into_iter().flat_map(|x| (x as f32).to_le_bytes())
        })
        .collect();
    let view = buffer.plain(&bytes);
    buffer.accessor(json!({
        "bufferView": view, "componentType": FLOAT, "type": "MAT4",
        "count": figure.inverse_bind.len(),
    }))
}

/// Returns the JSON of the meshes and of the materials that they share.
fn meshes(buffer: &mut Buffer, grid: &Grid, figure: &Figure) -> (Vec<Value>, Vec<Value>) {
    let mut materials: Vec<&Material> = Vec::new();
    let mut meshes = Vec::new();
    for m in &figure.meshes {
        let slot = materials
            .iter()
            .position(|x| **x == m.material)
            .unwrap_or_else(|| {
                materials.push(&m.material);
                materials.len() - 1
            });
        meshes.push(mesh(buffer, grid, figure, m, slot));
    }
    (meshes, materials.into_iter().map(material).collect())
}

/// Returns the data that glTF has no place for.
fn scene_extras(buffer: &mut Buffer, figure: &Figure, annotations: &Annotations) -> Value {
    let mut extras = Map::new();
    let mut put = |key: &str, value: Value| extras.insert(key.to_owned(), value);
    put("statureMetres", number(figure.skeleton.stature_m()));
    put("lidClosureRadians", numbers(&figure.lid_closure_rad));
    if figure.dominant_hand == Side::Left {
        put("handedness", "left".into());
    }
    if let Some(sex) = figure.sex {
        put("sex", number(sex));
    }
    if let Some(tissue) = figure.tissue.as_ref().filter(|t| t.lines > 0.0) {
        put("lines", number(f64::from(tissue.lines)));
    }
    if let Some(tissue) = &figure.tissue {
        let packing = Packing::Attributes {
            stride: file::PADDING,
        };
        let view = buffer.packable(&file::to_bytes(tissue), packing);
        put("tissue", json!(view));
    }
    if *annotations != Annotations::default() {
        extras.extend(annotations.to_json());
    }
    Value::Object(extras)
}

/// Returns the document without the parts derived from the buffer: its views, its accessors and
/// itself.
fn document(figure: &Figure, annotations: &Annotations) -> (Value, Buffer) {
    let grid = Grid::around(&figure.meshes);
    let mut buffer = Buffer::default();
    let inverse_bind = inverse_bind(&mut buffer, figure, &grid);
    let (meshes, materials) = meshes(&mut buffer, &grid, figure);
    let images: Vec<Value> = figure
        .images
        .iter()
        .map(|i| json!({ "mimeType": i.mime_type, "bufferView": buffer.plain(&i.bytes) }))
        .collect();
    let joint_count = figure.skeleton.joints().len();
    let mut nodes = joint_nodes(figure);
    for (i, m) in figure.meshes.iter().enumerate() {
        nodes.push(json!({ "name": m.name, "mesh": i, "skin": 0 }));
    }
    let mut roots: Vec<usize> = vec![Bone::Sacroiliac.index()];
    roots.extend(joint_count..nodes.len());
    debug_assert!(figure.skeleton.joints()[0].drive == Drive::Bone(Bone::Sacroiliac));
    let mut document = json!({
        "asset": { "version": "2.0", "generator": "raconteur" },
        "extensionsUsed": used(figure, &[QUANTIZATION]),
        "extensionsRequired": [QUANTIZATION],
        "scene": 0,
        "scenes": [{
            "name": figure.name,
            "nodes": roots,
            "extras": scene_extras(&mut buffer, figure, annotations),
        }],
        "nodes": nodes,
        "skins": [{
            "inverseBindMatrices": inverse_bind,
            "joints": (0..joint_count).collect::<Vec<_>>(),
            "skeleton": 0,
        }],
        "meshes": meshes,
        "materials": materials,
    });
    if !figure.springs.is_empty() {
        document["extensions"] =
            json!({ springs::EXTENSION: springs::write(&figure.springs, &numbers) });
    }
    // glTF allows no empty lists. Texture i shows image i.
    if !images.is_empty() {
        let textures: Vec<Value> = (0..images.len()).map(|i| json!({ "source": i })).collect();
        document["textures"] = json!(textures);
        document["images"] = json!(images);
    }
    (document, buffer)
}

/// Packs the two chunks; JSON is padded with spaces, the binary with zeros.
fn glb(mut json_chunk: Vec<u8>, mut bin: Vec<u8>) -> Vec<u8> {
    json_chunk.resize(json_chunk.len().next_multiple_of(4), b' ');
    bin.resize(bin.len().next_multiple_of(4), 0);
    let total = 12 + 8 + json_chunk.len() + 8 + bin.len();
    let mut out = Vec::with_capacity(total);
    out.extend_from_slice(b"glTF");
    out.extend_from_slice(&2u32.to_le_bytes());
    out.extend_from_slice(&(total as u32).to_le_bytes());
    for (tag, chunk) in [(b"JSON", json_chunk), (b"BIN\0", bin)] {
        out.extend_from_slice(&(chunk.len() as u32).to_le_bytes());
        out.extend_from_slice(tag);
        out.extend_from_slice(&chunk);
    }
    out
}
