//! Morph targets of a geometry, from the file's targets.

use raconteur_base::{DMat3, DVec3, ops};
use raconteur_body::read::{ReadError, document};

use super::{Reader, wide};
use crate::face::{Region, WeightedTarget};

/// Morph of one imported geometry: changed vertices with their offsets.
pub(crate) struct Shape {
    pub(crate) name: &'static str,
    pub(crate) vertices: Vec<u32>,
    /// The file's unit.
    pub(crate) positions: Vec<DVec3>,
    pub(crate) normals: Vec<DVec3>,
}

impl Reader<'_, '_> {
    pub(super) fn shapes(
        &mut self,
        mesh: usize,
        p: &document::Primitive,
        count: usize,
        linear: impl Fn(usize) -> DMat3,
    ) -> Result<Vec<Shape>, ReadError> {
        let face = self.face;
        let targets = self.targets(mesh, p, count)?;
        let moved_by = |parts: &[WeightedTarget]| {
            let mut moved = vec![false; count];
            for part in parts.iter().filter(|part| part.mesh == mesh) {
                for &v in targets[part.target].iter().flat_map(|t| &t.positions.0) {
                    moved[v as usize] = true;
                }
            }
            moved
        };
        let mut shapes = Vec::new();
        let (mut mouth, mut lids) = (None, None);
        for channel in &face.channels {
            if !channel.parts.iter().any(|part| part.mesh == mesh) {
                continue;
            }
            let [positions, normals] = displaced(&channel.parts, mesh, &targets, count);
            let allowed: &dyn Fn(usize) -> bool = match channel.region {
                Region::Everywhere => &|_| true,
                Region::Mouth => {
                    let mouth = &*mouth.get_or_insert_with(|| moved_by(&face.mouth));
                    &move |v| mouth[v]
                }
                Region::Brows => {
                    let mouth = &*mouth.get_or_insert_with(|| moved_by(&face.mouth));
                    let lids = &*lids.get_or_insert_with(|| moved_by(&face.lids));
                    &move |v| !mouth[v] && !lids[v]
                }
            };
            let vertices: Vec<u32> = (0..count)
                .filter(|&v| {
                    allowed(v) && (positions[v] != DVec3::ZERO || normals[v] != DVec3::ZERO)
                })
                .map(|v| v as u32)
                .collect();
            if vertices.is_empty() {
                continue;
            }
            let moved = [&*positions, &*normals];
            shapes.push(shape(channel.name, vertices, moved, &linear)?);
        }
        Ok(shapes)
    }

    /// Reads the morph targets of a primitive that the face's channels use, each once.
    fn targets(
        &mut self,
        mesh: usize,
        p: &document::Primitive,
        count: usize,
    ) -> Result<Vec<Option<Target>>, ReadError> {
        let face = self.face;
        let mut targets: Vec<Option<Target>> = Vec::new();
        targets.resize_with(p.targets.len(), || None);
        let all = face.channels.iter().flat_map(|c| &c.parts);
        let all = all.chain(&face.mouth).chain(&face.lids);
        for part in all.filter(|part| part.mesh == mesh) {
            let what = "a morph target";
            let target = p
                .targets
                .get(part.target)
                .ok_or(ReadError::OutOfRange { what })?;
            let slot = &mut targets[part.target];
            if slot.is_none() {
                let mut read = |a: Option<usize>, what| match a {
                    Some(a) => self.source.moved(a, count, what),
                    None => Ok(Default::default()),
                };
                *slot = Some(Target {
                    positions: read(target.positions, what)?,
                    normals: read(target.normals, "a morph's normals")?,
                });
            }
        }
        Ok(targets)
    }
}

/// Returns the displacement of positions and normals of a mesh's vertices by the parts of a
/// channel.
fn displaced(
    parts: &[WeightedTarget],
    mesh: usize,
    targets: &[Option<Target>],
    count: usize,
) -> [Vec<DVec3>; 2] {
    let mut positions = vec![DVec3::ZERO; count];
    let mut normals = vec![DVec3::ZERO; count];
    for part in parts.iter().filter(|part| part.mesh == mesh) {
        let Some(target) = &targets[part.target] else {
            continue;
        };
        for (to, from) in [
            (&mut positions, &target.positions),
            (&mut normals, &target.normals),
        ] {
            for (&v, delta) in from.0.iter().zip(&from.1) {
                to[v as usize] += wide(*delta) * part.factor;
            }
        }
    }
    [positions, normals]
}

/// Returns a sparse shape from the displacements of all positions and normals; `linear` transforms
/// those of a vertex.
fn shape(
    name: &'static str,
    vertices: Vec<u32>,
    [positions, normals]: [&[DVec3]; 2],
    linear: &impl Fn(usize) -> DMat3,
) -> Result<Shape, ReadError> {
    let at = |list: &[DVec3], unit: bool| -> Vec<DVec3> {
        let each = vertices.iter().map(|&v| {
            let m = linear(v as usize);
            let scale = if unit {
                ops::cbrt(m.determinant().abs()).max(1e-12)
            } else {
                1.0
            };
            m * list[v as usize] / scale
        });
        each.collect()
    };
    let (positions, normals) = (at(positions, false), at(normals, true));
    let mut all = positions.iter().chain(&normals);
    if all.any(|d| d.abs().max_element() > 1e9) {
        let what = "a morph target";
        return Err(ReadError::NotFinite { what });
    }
    Ok(Shape {
        name,
        vertices,
        positions,
        normals,
    })
}

/// Sparse morph target: vertices with displacements of positions and normals.
struct Target {
    positions: (Vec<u32>, Vec<[f32; 3]>),
    normals: (Vec<u32>, Vec<[f32; 3]>),
}
