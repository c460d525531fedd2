//! A figure as glTF 2.0 binary.
//!
//! Positions, normals, texture coordinates and morphs are quantised (KHR_mesh_quantization);
//! the positions' grid is the same for the whole figure and is undone by the inverse bind
//! matrices, which is where glTF wants it for skinned meshes. The same figure always gives
//! the same bytes.

mod binding;

use raconteur_base::{DAffine3, DVec3, Side};
use serde_json::{Map, Value, json};

use crate::annotation::Annotations;
use crate::face::file;
use crate::figure::{Figure, Material, MaterialKind, Mesh, Morph};
use crate::skeleton::{Bone, Drive};

/// The positions' grid: a power of two, so that values on it are exact in f32.
struct Grid {
    /// World position of the integer origin, metres.
    origin: DVec3,
    /// Metres a step.
    step: f64,
}

impl Grid {
    /// The finest grid of 16 bits that holds all meshes. A figure up to 2 m gets steps of
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

    /// World from grid.
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

/// A JSON number with seven decimals: enough for f32, short in the file.
fn number(x: f64) -> Value {
    let r = (x * 1e7).round() / 1e7;
    // Zero has one sign in the file.
    json!(if r == 0.0 { 0.0 } else { r })
}

fn numbers(xs: &[f64]) -> Value {
    Value::Array(xs.iter().map(|&x| number(x)).collect())
}

/// glTF's component types.
const BYTE: u32 = 5120;
const UNSIGNED_BYTE: u32 = 5121;
const SHORT: u32 = 5122;
const UNSIGNED_SHORT: u32 = 5123;
const UNSIGNED_INT: u32 = 5125;
const FLOAT: u32 = 5126;
/// Targets of buffer views.
const ARRAY_BUFFER: u32 = 34962;
const ELEMENT_ARRAY_BUFFER: u32 = 34963;

/// The binary chunk with its views and accessors while it grows.
#[derive(Default)]
struct Buffer {
    bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
}

impl Buffer {
    fn view(&mut self, bytes: &[u8], stride: Option<usize>, target: Option<u32>) -> usize {
        while !self.bytes.len().is_multiple_of(4) {
            self.bytes.push(0);
        }
        let mut view = Map::new();
        view.insert("buffer".into(), json!(0));
        view.insert("byteOffset".into(), json!(self.bytes.len()));
        view.insert("byteLength".into(), json!(bytes.len()));
        if let Some(s) = stride {
            view.insert("byteStride".into(), json!(s));
        }
        if let Some(t) = target {
            view.insert("target".into(), json!(t));
        }
        self.bytes.extend_from_slice(bytes);
        self.views.push(Value::Object(view));
        self.views.len() - 1
    }

    fn accessor(&mut self, value: Value) -> usize {
        self.accessors.push(value);
        self.accessors.len() - 1
    }

    /// A vertex attribute; `stride` is a multiple of four as glTF asks.
    fn attribute(
        &mut self,
        bytes: &[u8],
        stride: usize,
        component: u32,
        normalized: bool,
        ty: &str,
    ) -> usize {
        let count = bytes.len() / stride;
        let view = self.view(bytes, Some(stride), Some(ARRAY_BUFFER));
        self.accessor(json!({
            "bufferView": view, "componentType": component, "count": count, "type": ty,
            "normalized": normalized,
        }))
    }

    fn positions(&mut self, grid: &Grid, mesh: &Mesh) -> usize {
        let q: Vec<[i16; 3]> = mesh
            .positions
            .iter()
            .map(|p| grid.quantise(vec(*p)))
            .collect();
        let index = self.attribute(&padded_i16(&q), 8, SHORT, false, "VEC3");
        bounds(&mut self.accessors[index], &q);
        index
    }

    fn normals(&mut self, mesh: &Mesh) -> usize {
        if is_smooth(mesh.material.kind) {
            let q: Vec<[i16; 3]> = mesh
                .normals
                .iter()
                .map(|n| n.map(|x| (x * 32767.0).round() as i16))
                .collect();
            self.attribute(&padded_i16(&q), 8, SHORT, true, "VEC3")
        } else {
            let bytes: Vec<u8> = mesh
                .normals
                .iter()
                .flat_map(|n| {
                    let [x, y, z] = n.map(|x| (x * 127.0).round() as i8 as u8);
                    [x, y, z, 0]
                })
                .collect();
            self.attribute(&bytes, 4, BYTE, true, "VEC3")
        }
    }

    fn uvs(&mut self, mesh: &Mesh) -> usize {
        let within = |low: f32| mesh.uvs.iter().flatten().all(|x| (low..=1.0).contains(x));
        let flat = || mesh.uvs.iter().flatten();
        if within(0.0) {
            let bytes: Vec<u8> = flat()
                .flat_map(|x| ((x * 65535.0).round() as u16).to_le_bytes())
                .collect();
            self.attribute(&bytes, 4, UNSIGNED_SHORT, true, "VEC2")
        } else if within(-1.0) {
            let bytes: Vec<u8> = flat()
                .flat_map(|x| ((x * 32767.0).round() as i16).to_le_bytes())
                .collect();
            self.attribute(&bytes, 4, SHORT, true, "VEC2")
        } else {
            let bytes: Vec<u8> = flat().flat_map(|x| x.to_le_bytes()).collect();
            self.attribute(&bytes, 8, FLOAT, false, "VEC2")
        }
    }

    fn joints(&mut self, mesh: &Mesh) -> usize {
        if mesh.joints.iter().flatten().all(|&j| j < 256) {
            let bytes: Vec<u8> = mesh.joints.iter().flatten().map(|&j| j as u8).collect();
            self.attribute(&bytes, 4, UNSIGNED_BYTE, false, "VEC4")
        } else {
            let bytes: Vec<u8> = mesh
                .joints
                .iter()
                .flatten()
                .flat_map(|j| j.to_le_bytes())
                .collect();
            self.attribute(&bytes, 8, UNSIGNED_SHORT, false, "VEC4")
        }
    }

    /// Triangles over `vertices` vertices.
    fn indices(&mut self, indices: &[u32], vertices: usize) -> usize {
        let small = vertices <= usize::from(u16::MAX);
        let bytes: Vec<u8> = if small {
            indices
                .iter()
                .flat_map(|&i| (i as u16).to_le_bytes())
                .collect()
        } else {
            indices.iter().flat_map(|i| i.to_le_bytes()).collect()
        };
        let view = self.view(&bytes, None, Some(ELEMENT_ARRAY_BUFFER));
        self.accessor(json!({
            "bufferView": view,
            "componentType": if small { UNSIGNED_SHORT } else { UNSIGNED_INT },
            "count": indices.len(), "type": "SCALAR",
        }))
    }

    /// One morph target as two sparse accessors over zeros: positions and normals.
    fn morph(&mut self, grid: &Grid, mesh: &Mesh, morph: &Morph) -> Value {
        let count = mesh.positions.len();
        let small = count <= usize::from(u16::MAX);
        let mut order: Vec<usize> = (0..morph.vertices.len()).collect();
        // Sparse indices must ascend.
        order.sort_by_key(|&i| morph.vertices[i]);
        let index_bytes: Vec<u8> = order
            .iter()
            .flat_map(|&i| {
                let v = morph.vertices[i];
                if small {
                    (v as u16).to_le_bytes().to_vec()
                } else {
                    v.to_le_bytes().to_vec()
                }
            })
            .collect();
        let deltas: Vec<[i16; 3]> = order
            .iter()
            .map(|&i| morph.position_deltas[i].map(|x| (f64::from(x) / grid.step).round() as i16))
            .collect();
        let normals: Vec<u8> = order
            .iter()
            .flat_map(|&i| {
                morph.normal_deltas[i].map(|x| (x.clamp(-1.0, 1.0) * 127.0).round() as i8 as u8)
            })
            .collect();
        let mut with_zero = deltas.clone();
        with_zero.push([0; 3]);
        let index_view = self.view(&index_bytes, None, None);
        // Small movements fit a byte on the same grid.
        let fine = deltas.iter().flatten().all(|x| (-127..=127).contains(x));
        let delta_bytes: Vec<u8> = if fine {
            deltas.iter().flatten().map(|x| *x as i8 as u8).collect()
        } else {
            deltas
                .iter()
                .flatten()
                .flat_map(|x| x.to_le_bytes())
                .collect()
        };
        let delta_view = self.view(&delta_bytes, None, None);
        let index_type = if small { UNSIGNED_SHORT } else { UNSIGNED_INT };
        let sparse = |values: usize| {
            json!({
                "count": order.len(),
                "indices": { "bufferView": index_view, "componentType": index_type },
                "values": { "bufferView": values },
            })
        };
        let position = self.accessor(json!({
            "componentType": if fine { BYTE } else { SHORT }, "count": count, "type": "VEC3",
            "sparse": sparse(delta_view),
        }));
        bounds(&mut self.accessors[position], &with_zero);
        // The targets of a mesh have the same attributes, so all of them turn normals or none.
        let turns = |m: &Morph| m.normal_deltas.iter().flatten().any(|x| *x != 0.0);
        if !mesh.morphs.iter().any(turns) {
            return json!({ "POSITION": position });
        }
        let normal_view = self.view(&normals, None, None);
        let normal = self.accessor(json!({
            "componentType": BYTE, "normalized": true, "count": count, "type": "VEC3",
            "sparse": sparse(normal_view),
        }));
        json!({ "POSITION": position, "NORMAL": normal })
    }
}

/// Surfaces whose sharp highlights would show the steps of 8-bit normals.
fn is_smooth(kind: MaterialKind) -> bool {
    matches!(kind, MaterialKind::Eye | MaterialKind::Cornea)
}

fn padded_i16(q: &[[i16; 3]]) -> Vec<u8> {
    q.iter()
        .flat_map(|&[x, y, z]| [x, y, z, 0])
        .flat_map(i16::to_le_bytes)
        .collect()
}

/// Adds the bounds that glTF asks of positions.
fn bounds(accessor: &mut Value, q: &[[i16; 3]]) {
    let fold = |start: i16, pick: fn(i16, i16) -> i16| {
        q.iter()
            .fold([start; 3], |a, b| [0, 1, 2].map(|i| pick(a[i], b[i])))
    };
    accessor["min"] = json!(fold(i16::MAX, i16::min));
    accessor["max"] = json!(fold(i16::MIN, i16::max));
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
    // The reader takes absent coordinates for zeros.
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

/// Weights rounded to 255ths whose sum is exactly 255; the largest takes the rounding.
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

/// The figure as a `.glb` file.
#[must_use]
pub fn to_glb(figure: &Figure) -> Vec<u8> {
    to_annotated_glb(figure, &Annotations::default())
}

/// The figure as a `.glb` file with the names on its meshes.
#[must_use]
pub fn to_annotated_glb(figure: &Figure, annotations: &Annotations) -> Vec<u8> {
    let grid = Grid::around(&figure.meshes);
    let mut buffer = Buffer::default();
    let inverse_bind: Vec<u8> = figure
        .inverse_bind
        .iter()
        .flat_map(|m| {
            let grid_bind = *m * grid.world_from_grid();
            let columns = raconteur_base::DMat4::from(grid_bind).to_cols_array();
            columns.into_iter().flat_map(|x| (x as f32).to_le_bytes())
        })
        .collect();
    let joint_count = figure.skeleton.joints().len();
    let bind_view = buffer.view(&inverse_bind, None, None);
    let bind_accessor = buffer.accessor(json!({
        "bufferView": bind_view, "componentType": FLOAT, "count": joint_count, "type": "MAT4",
    }));

    let mut materials: Vec<&Material> = Vec::new();
    let mut meshes = Vec::new();
    let mut nodes = joint_nodes(figure);
    for (i, m) in figure.meshes.iter().enumerate() {
        let slot = materials
            .iter()
            .position(|x| **x == m.material)
            .unwrap_or_else(|| {
                materials.push(&m.material);
                materials.len() - 1
            });
        meshes.push(mesh(&mut buffer, &grid, figure, m, slot));
        nodes.push(json!({ "name": m.name, "mesh": i, "skin": 0 }));
    }
    let mut roots: Vec<usize> = vec![Bone::Sacroiliac.index()];
    roots.extend(joint_count..nodes.len());
    debug_assert!(figure.skeleton.joints()[0].drive == Drive::Bone(Bone::Sacroiliac));

    let images: Vec<Value> = figure
        .images
        .iter()
        .map(
            |i| json!({ "mimeType": i.mime_type, "bufferView": buffer.view(&i.bytes, None, None) }),
        )
        .collect();
    let textures: Vec<Value> = (0..images.len()).map(|i| json!({ "source": i })).collect();

    let tissue = figure
        .tissue
        .as_ref()
        .map(|t| buffer.view(&file::to_bytes(t), None, None));

    let mut document = json!({
        "asset": { "version": "2.0", "generator": "raconteur" },
        "extensionsUsed": ["KHR_mesh_quantization"],
        "extensionsRequired": ["KHR_mesh_quantization"],
        "scene": 0,
        "scenes": [{
            "name": figure.name,
            "nodes": roots,
            "extras": {
                "statureMetres": number(figure.skeleton.stature_m()),
                "lidClosureRadians": numbers(&figure.lid_closure_rad),
            },
        }],
        "nodes": nodes,
        "skins": [{
            "inverseBindMatrices": bind_accessor,
            "joints": (0..joint_count).collect::<Vec<_>>(),
            "skeleton": 0,
        }],
        "meshes": meshes,
        "materials": materials.into_iter().map(material).collect::<Vec<_>>(),
        "accessors": buffer.accessors,
        "bufferViews": buffer.views,
        "buffers": [{ "byteLength": buffer.bytes.len() }],
    });
    if let Some(extras) = document["scenes"][0]["extras"].as_object_mut() {
        if figure.dominant_hand == Side::Left {
            extras.insert("handedness".to_owned(), "left".into());
        }
        if let Some(sex) = figure.sex {
            extras.insert("sex".to_owned(), number(sex));
        }
        if let Some(view) = tissue {
            extras.insert("tissue".to_owned(), json!(view));
        }
        if *annotations != Annotations::default() {
            extras.extend(annotations.to_json());
        }
    }
    // glTF allows no empty lists.
    if !images.is_empty() {
        document["images"] = json!(images);
        document["textures"] = json!(textures);
    }
    glb(document.to_string().into_bytes(), buffer.bytes)
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
