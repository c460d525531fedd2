//! Detection of self-intersecting skin in faces.

use std::collections::BTreeMap;
use std::io::Write as _;

use anyhow::Result;
use raconteur_base::DVec3;
use raconteur_base::self_intersection::crossings;
use raconteur_faces::Editor;

use crate::{parallel, terminal};

/// Skin mesh of a face model with coincident vertices merged, used to find self-intersections.
pub(super) struct WeldedSkin {
    /// Representative vertex of each vertex.
    of: Vec<u32>,
    triangles: Vec<[u32; 3]>,
}

impl WeldedSkin {
    /// Merges coincident vertices of a shape and drops triangles that become degenerate.
    pub(super) fn weld(shape: &[f64], triangles: &[[u32; 3]]) -> Self {
        let mut places: BTreeMap<[u64; 3], u32> = BTreeMap::new();
        let of: Vec<u32> = (0u32..)
            .zip(shape.as_chunks::<3>().0)
            .map(|(v, p)| *places.entry(p.map(f64::to_bits)).or_insert(v))
            .collect();
        let joined = triangles.iter().map(|t| t.map(|v| of[v as usize]));
        let triangles = joined
            .filter(|t| t[0] != t[1] && t[1] != t[2] && t[2] != t[0])
            .collect();
        Self { of, triangles }
    }

    /// Returns the triangles over representative vertices.
    pub(super) fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// Returns the representative vertex at the position of a vertex.
    pub(super) fn stands_for(&self, vertex: u32) -> u32 {
        self.of[vertex as usize]
    }

    /// Pairs of triangles that cross in a shape.
    pub(super) fn crossings(&self, shape: &[f64]) -> Vec<[usize; 2]> {
        let places = shape.as_chunks::<3>().0;
        let place = |&v: &u32| DVec3::from_array(places[v as usize]);
        let points: Vec<DVec3> = self.of.iter().map(place).collect();
        crossings(&points, &self.triangles)
    }
}

/// Returns true if random faces of `count` seeds have no self-intersecting skin; prints the
/// intersections.
pub(super) fn check(editor: &Editor, count: u64) -> Result<bool> {
    let model = editor.model();
    let skin = WeldedSkin::weld(model.shape.mean(), &model.triangles);
    let segment = |t: usize| model.segments.segment_of(skin.triangles[t][0]);
    let name = |t: usize| segment(t).map_or("", |s| s.name.as_str());
    let found = parallel::map(0..count, |seed| {
        let mut counts: BTreeMap<[&str; 2], usize> = BTreeMap::new();
        for pair in skin.crossings(&editor.drawn(&editor.random(seed))) {
            let mut names = pair.map(name);
            names.sort_unstable();
            *counts.entry(names).or_default() += 1;
        }
        Ok(counts)
    })?;
    let mut faces: BTreeMap<[&str; 2], (usize, usize)> = BTreeMap::new();
    for (names, pairs) in found.iter().flatten() {
        let entry = faces.entry(*names).or_default();
        *entry = (entry.0 + 1, entry.1.max(*pairs));
    }
    let mut out = terminal::out();
    let crossed = found.iter().filter(|f| !f.is_empty()).count();
    writeln!(
        out,
        "{crossed} of {count} faces have skin that passes through skin"
    )?;
    for ([a, b], (faces, most)) in &faces {
        writeln!(
            out,
            "{a} and {b}: {faces} faces, up to {most} pairs of triangles"
        )?;
    }
    Ok(crossed == 0)
}
