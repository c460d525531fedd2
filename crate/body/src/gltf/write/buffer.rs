//! Builder of the binary chunk of a figure's file, with the views and accessors of its JSON.

use serde_json::{Map, Value, json};

use super::{Grid, vec};
use crate::figure::{MaterialKind, Mesh, Morph};

/// glTF's component types.
pub(super) const BYTE: u32 = 5120;
pub(super) const UNSIGNED_BYTE: u32 = 5121;
pub(super) const SHORT: u32 = 5122;
pub(super) const UNSIGNED_SHORT: u32 = 5123;
pub(super) const UNSIGNED_INT: u32 = 5125;
pub(super) const FLOAT: u32 = 5126;
/// Targets of buffer views.
const ARRAY_BUFFER: u32 = 34962;
const ELEMENT_ARRAY_BUFFER: u32 = 34963;

/// Compression of a buffer view, chosen by its contents.
#[derive(Clone, Copy)]
pub(super) enum Packing {
    /// Vertex attributes as records of `stride` bytes (a multiple of four), each byte stored as its
    /// difference from the previous record.
    Attributes { stride: usize },
    /// Triangle packing, whose corners may be rotated; indices of `width` bytes.
    Triangles { width: usize },
    /// Indices in their order, `width` bytes each.
    Indices { width: usize },
}

/// Binary chunk of a figure file under construction, with its buffer views and accessors.
#[derive(Default)]
pub(super) struct Buffer {
    pub(super) bytes: Vec<u8>,
    pub(super) views: Vec<Value>,
    /// Compression of each view in a compressed file; the others stay unchanged.
    pub(super) packings: Vec<Option<Packing>>,
    pub(super) accessors: Vec<Value>,
}

impl Buffer {
    /// Bytes that are never compressed and follow one another.
    pub(super) fn plain(&mut self, bytes: &[u8]) -> usize {
        self.view(bytes, None, None, None)
    }

    /// Adds contiguous bytes that are compressed with a given packing.
    pub(super) fn packable(&mut self, bytes: &[u8], packing: Packing) -> usize {
        self.view(bytes, None, None, Some(packing))
    }

    fn view(
        &mut self,
        bytes: &[u8],
        stride: Option<usize>,
        target: Option<u32>,
        packing: Option<Packing>,
    ) -> usize {
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
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
        self.packings.push(packing);
        self.views.len() - 1
    }

    pub(super) fn accessor(&mut self, value: Value) -> usize {
        self.accessors.push(value);
        self.accessors.len() - 1
    }

    /// Adds a vertex attribute; `stride` is a multiple of four as glTF requires.
    pub(super) fn attribute(
        &mut self,
        bytes: &[u8],
        stride: usize,
        component: u32,
        normalized: bool,
        ty: &str,
    ) -> usize {
        let count = bytes.len() / stride;
        let packing = Some(Packing::Attributes { stride });
        let view = self.view(bytes, Some(stride), Some(ARRAY_BUFFER), packing);
        let mut accessor = json!({
            "bufferView": view, "componentType": component, "count": count, "type": ty,
        });
        if normalized {
            accessor["normalized"] = json!(true);
        }
        self.accessor(accessor)
    }

    pub(super) fn positions(&mut self, grid: &Grid, mesh: &Mesh) -> usize {
        let q: Vec<[i16; 3]> = mesh
            .positions
            .iter()
            .map(|p| grid.quantise(vec(*p)))
            .collect();
        let index = self.attribute(&padded_i16(&q), 8, SHORT, false, "VEC3");
        bounds(&mut self.accessors[index], &q);
        index
    }

    pub(super) fn normals(&mut self, mesh: &Mesh) -> usize {
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

    pub(super) fn uvs(&mut self, mesh: &Mesh) -> usize {
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

    pub(super) fn joints(&mut self, mesh: &Mesh) -> usize {
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
    pub(super) fn indices(&mut self, indices: &[u32], vertices: usize) -> usize {
        let small = vertices <= usize::from(u16::MAX);
        let bytes: Vec<u8> = if small {
            indices
                .iter()
                .flat_map(|&i| (i as u16).to_le_bytes())
                .collect()
        } else {
            indices.iter().flat_map(|i| i.to_le_bytes()).collect()
        };
        let packing = Some(Packing::Triangles {
            width: if small { 2 } else { 4 },
        });
        let view = self.view(&bytes, None, Some(ELEMENT_ARRAY_BUFFER), packing);
        self.accessor(json!({
            "bufferView": view,
            "componentType": if small { UNSIGNED_SHORT } else { UNSIGNED_INT },
            "count": indices.len(), "type": "SCALAR",
        }))
    }

    /// Writes a morph target as two sparse accessors over zeros (positions and normals) and returns
    /// its JSON.
    pub(super) fn morph(&mut self, grid: &Grid, mesh: &Mesh, morph: &Morph) -> Value {
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
        let index_view = self.plain(&index_bytes);
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
        let delta_view = self.plain(&delta_bytes);
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
        // The morph targets of a mesh have the same attributes, so either all of them have normals
        // or none.
        let turns = |m: &Morph| m.normal_deltas.iter().flatten().any(|x| *x != 0.0);
        if !mesh.morphs.iter().any(turns) {
            return json!({ "POSITION": position });
        }
        let normal_view = self.plain(&normals);
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

/// Adds the bounds that glTF requires for positions.
fn bounds(accessor: &mut Value, q: &[[i16; 3]]) {
    let fold = |start: i16, pick: fn(i16, i16) -> i16| {
        q.iter()
            .fold([start; 3], |a, b| [0, 1, 2].map(|i| pick(a[i], b[i])))
    };
    accessor["min"] = json!(fold(i16::MAX, i16::min));
    accessor["max"] = json!(fold(i16::MIN, i16::max));
}
