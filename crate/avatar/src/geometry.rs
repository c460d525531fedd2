//! Vertices of an imported file in its rest pose, in its own world space.
//!
//! The node transforms carry skinned and rigid meshes to the world, as any viewer shows the file
//! without motion; from then on only this crate's skeleton counts. Multiple skins, skins with own
//! bind matrices and scaled nodes therefore need no special handling.

mod shapes;

use raconteur_base::surface::vertex_normals;
use raconteur_base::{DAffine3, DMat3, DMat4, DVec3};
use serde_json::Value;

pub(super) use self::shapes::Shape;
use super::error::{DiagnosticSink, ImportError};
use super::face::ImportedFace;
use super::material::{ImageTable, Surface, surface};
use super::tree::Tree;
use raconteur_body::read::ReadError;
use raconteur_body::read::accessor::Source;
use raconteur_body::read::document;

/// The most vertices of a figure; those of avatars are tens of thousands.
const MAX_VERTICES: usize = 1 << 20;
/// The most triangles.
const MAX_TRIANGLES: usize = 4 << 20;
/// Maximum number of joints per vertex that are read; [`super::bind`] keeps the four heaviest.
pub(super) const INFLUENCES: usize = 8;

/// Vertices and triangles of one imported primitive, in the world frame of its file.
pub(super) struct Geometry {
    pub(super) name: String,
    pub(super) surface: Surface,
    pub(super) positions: Vec<DVec3>,
    pub(super) normals: Vec<DVec3>,
    pub(super) uvs: Vec<[f32; 2]>,
    pub(super) colors: Vec<[u8; 4]>,
    pub(super) indices: Vec<u32>,
    /// Nodes that carry each vertex, and their shares, which sum to 1.
    pub(super) nodes: Vec<[u32; INFLUENCES]>,
    pub(super) shares: Vec<[f32; INFLUENCES]>,
    pub(super) shapes: Vec<Shape>,
    /// True if a single node carries all of it.
    pub(super) rigid: bool,
}

/// Reader of all geometry in the scene of an imported file.
pub(super) struct Reader<'a, 's> {
    pub(super) json: &'a Value,
    pub(super) tree: &'a Tree<'a>,
    pub(super) source: &'s mut Source<'a>,
    pub(super) pictures: &'a ImageTable,
    pub(super) face: &'a ImportedFace,
    pub(super) notes: &'s mut DiagnosticSink,
    pub(super) vertices_left: usize,
    pub(super) triangles_left: usize,
}

/// Nodes with the file's world from the vertices' own frame in the rest pose.
struct Skin {
    nodes: Vec<usize>,
    carried: Vec<DAffine3>,
}

fn wide(v: [f32; 3]) -> DVec3 {
    DVec3::from_array(v.map(f64::from))
}

impl<'a, 's> Reader<'a, 's> {
    pub(super) fn new(
        json: &'a Value,
        tree: &'a Tree<'a>,
        source: &'s mut Source<'a>,
        pictures: &'a ImageTable,
        face: &'a ImportedFace,
        notes: &'s mut DiagnosticSink,
    ) -> Self {
        Self {
            json,
            tree,
            source,
            pictures,
            face,
            notes,
            vertices_left: MAX_VERTICES,
            triangles_left: MAX_TRIANGLES,
        }
    }

    pub(super) fn read(mut self) -> Result<Vec<Geometry>, ImportError> {
        let root = self.tree.root;
        let mut out = Vec::new();
        for node in self.shown_nodes()? {
            let n = &root.nodes[node];
            let Some(mesh) = n.mesh else { continue };
            let skin = match n.skin {
                Some(skin) => self.skin(skin)?,
                None => Skin {
                    nodes: vec![node],
                    carried: vec![self.tree.world[node]],
                },
            };
            let m = root.meshes.get(mesh).ok_or(ReadError::OutOfRange {
                what: "a node's mesh",
            })?;
            for primitive in &m.primitives {
                out.extend(self.primitive(mesh, m, primitive, &skin, n.skin.is_none())?);
            }
        }
        if out.is_empty() {
            return Err(ReadError::NoMesh.into());
        }
        Ok(out)
    }

    /// Nodes of the scene, parents first, less those that `KHR_node_visibility` hides with all
    /// below them; of all nodes where the file has no scene.
    fn shown_nodes(&self) -> Result<Vec<usize>, ReadError> {
        let (parents, order) = (&self.tree.parents, &self.tree.order);
        let scene = self.json["scene"].as_u64().unwrap_or(0);
        let scene = usize::try_from(scene).ok().map(|i| &self.json["scenes"][i]);
        let roots = scene.and_then(|s| s["nodes"].as_array());
        let mut in_scene = vec![roots.is_none(); parents.len()];
        for root in roots.into_iter().flatten() {
            let index = root.as_u64().and_then(|n| usize::try_from(n).ok());
            let slot = index.and_then(|i| in_scene.get_mut(i));
            *slot.ok_or(ReadError::OutOfRange { what: "a scene" })? = true;
        }
        let mut hidden: Vec<bool> = (0..parents.len())
            .map(|n| {
                let visibility = &self.json["nodes"][n]["extensions"]["KHR_node_visibility"];
                visibility["visible"].as_bool() == Some(false)
            })
            .collect();
        for &node in order {
            if let Some(parent) = parents[node] {
                in_scene[node] |= in_scene[parent];
                hidden[node] |= hidden[parent];
            }
        }
        let shown = order.iter().filter(|&&n| in_scene[n] && !hidden[n]);
        Ok(shown.copied().collect())
    }

    fn skin(&mut self, index: usize) -> Result<Skin, ReadError> {
        let root = self.tree.root;
        let skin = root.skins.get(index).ok_or(ReadError::OutOfRange {
            what: "a node's skin",
        })?;
        let mut carried = Vec::with_capacity(skin.joints.len());
        for &joint in &skin.joints {
            carried.push(*self.tree.world.get(joint).ok_or(ReadError::OutOfRange {
                what: "a skin's joint",
            })?);
        }
        if let Some(accessor) = skin.inverse_bind_matrices {
            let what = "inverse bind matrices";
            let matrices: Vec<[f32; 16]> = self.source.dense(accessor, what)?;
            if matrices.len() < carried.len() {
                return Err(ReadError::Count { what });
            }
            for (carried, m) in carried.iter_mut().zip(matrices) {
                *carried *= DAffine3::from_mat4(DMat4::from_cols_array(&m.map(f64::from)));
                if !carried.is_finite() {
                    return Err(ReadError::NotFinite { what });
                }
            }
        }
        Ok(Skin {
            nodes: skin.joints.clone(),
            carried,
        })
    }

    fn same<T>(v: Vec<T>, count: usize, what: &'static str) -> Result<Vec<T>, ReadError> {
        if v.len() == count {
            Ok(v)
        } else {
            Err(ReadError::Count { what })
        }
    }

    fn primitive(
        &mut self,
        mesh: usize,
        m: &document::Mesh,
        p: &document::Primitive,
        skin: &Skin,
        rigid: bool,
    ) -> Result<Option<Geometry>, ImportError> {
        if p.mode < 4 {
            self.notes
                .add("lines-left-out", "points or lines are not drawn", "");
            return Ok(None);
        }
        let what = "positions";
        let accessor = p
            .attribute("POSITION")
            .ok_or(ReadError::OutOfRange { what })?;
        self.refuse_draco(accessor)?;
        let claimed = self.source.claimed_count(accessor, what)?;
        self.vertices_left = usize::try_from(claimed)
            .ok()
            .and_then(|n| self.vertices_left.checked_sub(n))
            .ok_or(ReadError::TooLarge)?;
        let raw: Vec<[f32; 3]> = self.source.dense(accessor, what)?;
        let count = raw.len();
        if count == 0 {
            return Ok(None);
        }
        let mut indices = self.triangles(p, count)?;
        let (joints, shares) = if rigid {
            let mut one = [0.0; INFLUENCES];
            one[0] = 1.0;
            (vec![[0; INFLUENCES]; count], vec![one; count])
        } else {
            self.influences(p, count, skin.nodes.len())?
        };
        let linear = |v: usize| {
            let parts = joints[v].iter().zip(&shares[v]).filter(|(_, w)| **w > 0.0);
            parts.fold(DMat3::ZERO, |sum, (j, w)| {
                sum + skin.carried[*j as usize].matrix3 * f64::from(*w)
            })
        };
        let positions: Vec<DVec3> = (0..count)
            .map(|v| {
                let parts = joints[v].iter().zip(&shares[v]).filter(|(_, w)| **w > 0.0);
                let at = wide(raw[v]);
                parts.fold(DVec3::ZERO, |sum, (j, w)| {
                    sum + skin.carried[*j as usize].transform_point3(at) * f64::from(*w)
                })
            })
            .collect();
        if positions.iter().any(|p| p.abs().max_element() > 1e9) {
            return Err(ReadError::NotFinite { what }.into());
        }
        // A mirrored part turns its triangles inside out.
        if linear(0).determinant() < 0.0 {
            for t in indices.chunks_exact_mut(3) {
                t.swap(1, 2);
            }
        }
        let normals = self.normals(p, &positions, &indices, linear)?;
        let surface = surface(self.json, p.material, self.pictures, self.notes)?;
        let uvs = self.uvs(p, count, &surface)?;
        let colors = self.colors(p, count)?;
        let shapes = self.shapes(mesh, p, count, linear)?;
        Ok(Some(Geometry {
            name: m.name.chars().take(80).collect(),
            surface,
            positions,
            normals,
            uvs,
            colors,
            indices,
            nodes: joints
                .into_iter()
                .map(|quad| quad.map(|j| skin.nodes[j as usize] as u32))
                .collect(),
            shares,
            shapes,
            rigid,
        }))
    }

    /// Returns the file's normals in the rest pose; if there are none, those of the triangles.
    fn normals(
        &mut self,
        p: &document::Primitive,
        positions: &[DVec3],
        indices: &[u32],
        linear: impl Fn(usize) -> DMat3,
    ) -> Result<Vec<DVec3>, ReadError> {
        let Some(a) = p.attribute("NORMAL") else {
            return Ok(vertex_normals(positions, indices.as_chunks::<3>().0));
        };
        let raw: Vec<[f32; 3]> = self.source.dense(a, "normals")?;
        let raw = Self::same(raw, positions.len(), "normals")?;
        let turned = raw.into_iter().enumerate();
        Ok(turned
            .map(|(v, n)| turned_normal(linear(v), wide(n)))
            .collect())
    }

    /// Rejects Draco data without an uncompressed alternative. Draco as an option is accepted.
    fn refuse_draco(&self, accessor: usize) -> Result<(), ImportError> {
        let a = &self.json["accessors"][accessor];
        let used = self.json["extensionsUsed"].as_array();
        let draco = "KHR_draco_mesh_compression";
        let names_it = used.is_some_and(|l| l.iter().any(|e| e.as_str() == Some(draco)));
        if names_it && a["bufferView"].is_null() && a["sparse"].is_null() {
            return Err(ImportError::Compressed {
                extension: draco,
                hint: "export it again without Draco compression",
            });
        }
        Ok(())
    }

    fn triangles(&mut self, p: &document::Primitive, count: usize) -> Result<Vec<u32>, ReadError> {
        let flat: Vec<u32> = match p.indices {
            Some(a) => {
                let list = self.source.integers::<1>(a, "indices")?;
                list.into_iter().map(|[i]| i).collect()
            }
            None => (0..count as u32).collect(),
        };
        if flat.iter().any(|&i| i as usize >= count) {
            return Err(ReadError::OutOfRange { what: "a triangle" });
        }
        let list: Vec<u32> = match p.mode {
            4 if flat.len().is_multiple_of(3) => flat,
            5 => (0..flat.len().saturating_sub(2))
                .flat_map(|i| {
                    // Every second triangle of a strip has the opposite winding.
                    let odd = i % 2;
                    [flat[i], flat[i + 1 + odd], flat[i + 2 - odd]]
                })
                .collect(),
            6 => (1..flat.len().saturating_sub(1))
                .flat_map(|i| [flat[0], flat[i], flat[i + 1]])
                .collect(),
            _ => return Err(ReadError::Type { what: "triangles" }),
        };
        self.triangles_left = self
            .triangles_left
            .checked_sub(list.len() / 3)
            .ok_or(ReadError::TooLarge)?;
        Ok(list)
    }

    #[allow(clippy::type_complexity, reason = "two parallel columns")]
    fn influences(
        &mut self,
        p: &document::Primitive,
        count: usize,
        joint_count: usize,
    ) -> Result<(Vec<[u32; INFLUENCES]>, Vec<[f32; INFLUENCES]>), ReadError> {
        let mut joints = vec![[0; INFLUENCES]; count];
        let mut shares = vec![[0.0; INFLUENCES]; count];
        for set in 0..INFLUENCES / 4 {
            let named = |kind: &str| p.attribute(&format!("{kind}_{set}"));
            let (Some(j), Some(w)) = (named("JOINTS"), named("WEIGHTS")) else {
                if set == 0 {
                    return Err(ReadError::OutOfRange { what: "joints" });
                }
                break;
            };
            let quads: Vec<[u32; 4]> =
                Self::same(self.source.integers(j, "joints")?, count, "joints")?;
            let weights: Vec<[f32; 4]> =
                Self::same(self.source.dense(w, "weights")?, count, "weights")?;
            for (v, (quad, weight)) in quads.into_iter().zip(weights).enumerate() {
                for k in 0..4 {
                    // Exporters leave arbitrary joint numbers where the weight is zero.
                    if weight[k] <= 0.0 {
                        continue;
                    }
                    if quad[k] as usize >= joint_count {
                        return Err(ReadError::OutOfRange {
                            what: "a vertex's joint",
                        });
                    }
                    joints[v][4 * set + k] = quad[k];
                    shares[v][4 * set + k] = weight[k];
                }
            }
        }
        if joint_count == 0 {
            return Err(ReadError::OutOfRange {
                what: "a skin without joints",
            });
        }
        for share in &mut shares {
            let sum: f32 = share.iter().sum();
            if sum > 0.0 && sum.is_finite() {
                *share = share.map(|w| w / sum);
            } else {
                // A vertex without weights belongs to the skin's first joint.
                *share = [0.0; INFLUENCES];
                share[0] = 1.0;
            }
        }
        Ok((joints, shares))
    }

    fn uvs(
        &mut self,
        p: &document::Primitive,
        count: usize,
        surface: &Surface,
    ) -> Result<Vec<[f32; 2]>, ReadError> {
        let what = "texture coordinates";
        let maps = surface.material.maps;
        let named = p.attribute(&format!("TEXCOORD_{}", surface.uv_set));
        let Some(a) = named.filter(|_| maps.base_color.is_some() || maps.normal.is_some()) else {
            return Ok(vec![[0.0; 2]; count]);
        };
        let raw: Vec<[f32; 2]> = Self::same(self.source.dense(a, what)?, count, what)?;
        Ok(raw
            .into_iter()
            .map(|[u, v]| {
                let row = |[a, b, c]: [f64; 3]| (a * f64::from(u) + b * f64::from(v) + c) as f32;
                surface.uv_transform.map(row)
            })
            .collect())
    }

    fn colors(&mut self, p: &document::Primitive, count: usize) -> Result<Vec<[u8; 4]>, ReadError> {
        let what = "colours";
        let Some(a) = p.attribute("COLOR_0") else {
            return Ok(vec![[255; 4]; count]);
        };
        let byte = |x: f32| (x * 255.0).round().clamp(0.0, 255.0) as u8;
        // The fourth number is our occlusion, not theirs.
        let rgb: Vec<[f32; 3]> = if self.source.width(a, what)? == 3 {
            self.source.dense(a, what)?
        } else {
            let rgba: Vec<[f32; 4]> = self.source.dense(a, what)?;
            rgba.into_iter().map(|[r, g, b, _]| [r, g, b]).collect()
        };
        let rgb = Self::same(rgb, count, what)?;
        Ok(rgb
            .into_iter()
            .map(|[r, g, b]| [byte(r), byte(g), byte(b), 255])
            .collect())
    }
}

/// Transforms a normal by the inverse transpose; a flattened part is handled as far as possible.
fn turned_normal(linear: DMat3, n: DVec3) -> DVec3 {
    let det = linear.determinant();
    let turned = if det.abs() > 1e-30 {
        linear.inverse().transpose() * n
    } else {
        linear * n
    };
    turned.try_normalize().unwrap_or(DVec3::Y)
}
