//! Parts cut from the surface of a head: skin, and the bag of the mouth.

use std::collections::BTreeMap;

use raconteur_base::DVec3;

use super::cage::Zone;
use super::chart::Chart;
use super::surface::Surface;
use crate::part::{MeshPart, PartMorph, PartVertex};
use raconteur_body::figure::{Material, MaterialKind, TextureMaps};

/// Returns true for the mouth cavity, which is a separate part.
pub(super) fn is_bag(zone: Zone) -> bool {
    matches!(zone, Zone::Mouth(5..))
}

/// Returns the cut of the skin part from the surface of the head.
pub(super) fn skin_cut(vertices: &[PartVertex]) -> PartCut<'_> {
    PartCut {
        name: "head",
        kind: MaterialKind::Skin,
        roughness: 0.48,
        vertices,
        keep: |z| !is_bag(z),
    }
}

/// Returns the surface vertex of each vertex of a part cut from it, by position: a part may contain
/// a position twice at a texture seam.
pub(super) fn behind(part: &MeshPart, positions: &[DVec3]) -> Vec<u32> {
    let key = |p: DVec3| p.to_array().map(f64::to_bits);
    let by_place: BTreeMap<[u64; 3], u32> = positions
        .iter()
        .zip(0u32..)
        .map(|(&p, v)| (key(p * 1e-3), v))
        .collect();
    part.vertices
        .iter()
        .map(|v| by_place.get(&key(v.position)).copied().unwrap_or(u32::MAX))
        .collect()
}

/// Specification of a mesh part that is cut from the surface of the head.
pub(super) struct PartCut<'a> {
    pub(super) name: &'a str,
    pub(super) kind: MaterialKind,
    pub(super) roughness: f32,
    /// Vertices of the whole surface.
    pub(super) vertices: &'a [PartVertex],
    /// Predicate that selects the zones of the part.
    pub(super) keep: fn(Zone) -> bool,
}

/// Returns the faces of the selected zones, and the chart vertex of each of their vertices.
pub(super) fn faces_of_zones(
    surface: &Surface,
    chart: &Chart,
    keep: fn(Zone) -> bool,
) -> (Vec<usize>, Vec<Vec<u32>>) {
    let mut index = vec![u32::MAX; chart.uv.len()];
    let mut used: Vec<usize> = Vec::new();
    let kept = chart.faces.iter().zip(&surface.zones);
    let faces = kept
        .filter(|&(_, &z)| keep(z))
        .map(|(face, _)| {
            let slot = |&v: &u32| {
                let slot = &mut index[v as usize];
                if *slot == u32::MAX {
                    *slot = used.len() as u32;
                    used.push(v as usize);
                }
                *slot
            };
            face.iter().map(slot).collect()
        })
        .collect();
    (used, faces)
}

/// Cuts the faces of the selected zones as a part of their own, with vertices doubled along the
/// chart's cut; `moved` contains the morphs of the whole surface.
pub(super) fn cut_part(
    surface: &Surface,
    chart: &Chart,
    moved: &[(&'static str, Vec<DVec3>)],
    cut: &PartCut<'_>,
) -> MeshPart {
    let (used, faces) = faces_of_zones(surface, chart, cut.keep);
    let source = |v: &usize| chart.source[*v] as usize;
    let morphs = moved
        .iter()
        .map(|(name, d)| part_morph(name, &used.iter().map(|v| d[source(v)]).collect::<Vec<_>>()))
        .filter(|m| !m.deltas.is_empty())
        .collect();
    MeshPart {
        name: cut.name.to_owned(),
        material: Material {
            kind: cut.kind,
            base_color: [1.0; 4],
            roughness: cut.roughness,
            double_sided: false,
            maps: TextureMaps::default(),
        },
        vertices: used
            .iter()
            .map(|v| PartVertex {
                uv: chart.uv[*v],
                ..cut.vertices[source(v)].clone()
            })
            .collect(),
        faces,
        morphs,
        bound: Vec::new(),
    }
}

/// Movements below 20 µm are left out.
fn part_morph(name: &str, deltas_mm: &[DVec3]) -> PartMorph {
    let kept = |(_, d): &(usize, &DVec3)| d.length_squared() > 4e-4;
    PartMorph {
        name: name.to_owned(),
        deltas: deltas_mm
            .iter()
            .enumerate()
            .filter(kept)
            .map(|(i, &d)| (i as u32, d * 1e-3))
            .collect(),
    }
}
